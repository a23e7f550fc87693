#!/bin/sh
# Lists the lines of this repository that are wider than 120 columns, as file:line, and ends with 1 if there are any.
#
# Checked is what is written by hand and kept in git. Not checked are
#   data and pictures              by their endings
#   what a command generates       protobuf code, notebooks, the bundle of the viewer, lock files, reports in docs
#   Markdown                       rows of tables, and sections between "<!-- survey … begin" and "<!-- survey … end"
#   addresses                      a line whose last word is an address that begins before the margin
#
#   tests/width.sh [FOLDER]    FOLDER: another checkout; works from any directory
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
cd "${1:-$root}"
git ls-files -z --cached --others --exclude-standard -- . \
    ':!*.bvh' ':!*.json' ':!*.png' ':!*.jpg' ':!*.svg' ':!*.bin' ':!*.binpb' ':!*.lock' \
    ':!src/wire/gen' ':!clients/web/src/gen' ':!clients/web/dist' \
    ':!clients/python/src/sinew/v1' ':!*.ipynb' \
    ':!docs/paper' ':!docs/walking' ':!docs/survey' |
    # Bytes, so that every awk counts alike: those after the first of a character are taken out.
    LC_ALL=C xargs -0 awk '
        FNR == 1 { report = 0 }
        FILENAME ~ /\.md$/ && /^<!-- survey .* begin/ { report = 1 }
        FILENAME ~ /\.md$/ && /^<!-- survey .* end/ { report = 0; next }
        length($0) <= 120 || report { next }
        FILENAME ~ /\.md$/ && /^ *[|]/ { next }
        {
            line = $0
            gsub(/[\200-\277]/, "", line)
            if (length(line) <= 120) next
            if (match(line, /https?:\/\/[^ ]*$/) && RSTART <= 120) next
            print FILENAME ":" FNR ": " length(line) " columns"
            wide++
        }
        END { if (wide) { print "width: " wide " lines are wider than 120 columns" > "/dev/stderr"; exit 1 } }'
