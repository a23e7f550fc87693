#!/bin/sh
# Compares every measure of every clip of this build with the stored survey (docs/survey.md).
#
#     tests/survey.sh [--store] [FOLDER...]
#
# FOLDER is a corpus; its survey is stored as docs/survey/NAME.json, where NAME is the last part of the folder. Without
# any, these are tests/corpus and the folders that SINEW_MOCAP_DIR lists, separated by ':'. --store stores the surveys
# of this build instead, for a commit that says why they moved. Ends with 1 if a clip got worse, or is missing.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
store=""
if [ "${1:-}" = --store ]; then
    store=yes
    shift
fi
if [ $# -eq 0 ]; then
    set -- "$root/tests/corpus"
    old=$IFS
    IFS=:
    for folder in ${SINEW_MOCAP_DIR:-}; do
        set -- "$@" "$folder"
    done
    IFS=$old
fi
# An example needs what tests need: the same crates with the same features, so that nothing is compiled twice.
"${CARGO:-cargo}" build --locked --quiet --manifest-path "$root/Cargo.toml" --bin sinew --example client
target=${CARGO_TARGET_DIR:-$root/target}
mkdir -p "$target/survey"
status=0
for folder in "$@"; do
    name=$(basename -- "$folder")
    stored=$root/docs/survey/$name.json
    new=$target/survey/$name.json
    if [ -n "$store" ]; then
        "$target/debug/sinew" survey "$folder" --out "$new"
        cp "$new" "$stored"
    elif [ ! -f "$stored" ]; then
        echo "survey: no survey of $folder is stored: tests/survey.sh --store $folder writes docs/survey/$name.json" >&2
        status=1
    else
        "$target/debug/sinew" survey "$folder" --out "$new" --compare "$stored" || status=1
    fi
done
exit $status
