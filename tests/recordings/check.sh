#!/bin/sh
# Succeeds if SINEW_MOCAP_DIR lists folders with the recordings that `make recordings` reads; else says what is missing.
set -eu

here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
explain() {
    cat >&2 <<EOF
recordings: $1
recordings: set SINEW_MOCAP_DIR to the folder of the 18 motion capture files that these tests read
recordings: (or to several, separated by ':').
recordings: most are trials of the CMU Graphics Lab Motion Capture Database (mocap.cs.cmu.edu),
recordings: the others come from DeepMimic, ReActIdle and assimp;
recordings: docs/corpus.md lists source, trial number and licence of each. \`make test\` needs none of them.
EOF
    exit 1
}
[ -n "${SINEW_MOCAP_DIR:-}" ] || explain "SINEW_MOCAP_DIR is not set."
missing=""
clips=$(sed -n '/^pub const CLIPS/,/^];/s/^ *"\(.*\)",$/\1.bvh/p' "$here/../common/mocap.rs")
for file in $clips expected.json stats.json; do
    found=""
    old=$IFS
    IFS=:
    for folder in $SINEW_MOCAP_DIR; do
        [ -f "$folder/$file" ] && found=yes
    done
    IFS=$old
    [ -n "$found" ] || missing="$missing $file"
done
[ -z "$missing" ] || explain "not in SINEW_MOCAP_DIR ($SINEW_MOCAP_DIR):$missing."
