#!/bin/sh
# Compares every measure of every clip of this build with the stored surveys (docs/survey.md).
#
#     tests/survey.sh [--store] SETTING...
#
# A SETTING is a line of the table below; its survey is stored as docs/survey/SETTING.json. --store stores the surveys
# of this build instead, for a commit that says why they moved. Ends with 1 if a clip got worse or is missing. Settings
# on recordings need both folders in SINEW_MOCAP_DIR, separated by ':' (docs/corpus.md).
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)

# Options of `sinew survey` by setting. `corpus` reads tests/corpus, all others read the recordings.
options() {
    case $1 in
    corpus | strict) ;;
    *)
        echo "survey: no setting $1; there are: corpus strict" >&2
        exit 2
        ;;
    esac
}

store=""
if [ "${1:-}" = --store ]; then
    store=yes
    shift
fi
binary=$("$root/tests/programs.sh")
results=${CARGO_TARGET_DIR:-$root/target}/survey
mkdir -p "$results"
status=0
for setting in "$@"; do
    options "$setting" >/dev/null
    if [ "$setting" = corpus ]; then
        folders=$root/tests/corpus
    else
        folders=${SINEW_MOCAP_DIR:?survey: $setting needs recordings (docs/corpus.md)}
    fi
    old=$IFS
    IFS=:
    # shellcheck disable=SC2086 # a list of folders and one of words
    set -- $folders
    IFS=$old
    new=$results/$setting.json
    stored=$root/docs/survey/$setting.json
    # shellcheck disable=SC2046
    if [ -n "$store" ]; then
        "$binary" survey "$@" $(options "$setting") --out "$new"
        cp "$new" "$stored"
    elif ! [ -f "$stored" ]; then
        echo "survey: nothing is stored for $setting: tests/survey.sh --store $setting" >&2
        status=1
    else
        "$binary" survey "$@" $(options "$setting") --out "$new" --compare "$stored" || status=1
    fi
done
exit $status
