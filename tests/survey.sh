#!/bin/sh
# Compares every measure of every clip of this build with the stored surveys (docs/survey.md).
#
#     tests/survey.sh [--store] SETTING...
#
# A SETTING is a line of the table below; its survey is stored as docs/survey/SETTING.json. --store stores the surveys
# of this build instead, for a commit that says why they moved, and writes their pages. Ends with 1 if a clip got worse
# or is missing. Settings on recordings need both folders in SINEW_MOCAP_DIR, separated by ':' (docs/corpus.md).
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)

# Options of `sinew survey` by setting, and the section of docs/limits.md that shows it, if there is one. `corpus` reads
# tests/corpus, all others read the recordings. A setting of live streams that ends with -30 or -100 is helped with at
# most that share of the weight.
setting() {
    options="" section="" help=""
    base=$1
    case $1 in
    live-30 | live-*-30) help=" --follow assisted" base=${1%-30} ;;
    live-100 | live-*-100) help=" --follow always" base=${1%-100} ;;
    esac
    live="--live-window 1$help"
    case $base in
    corpus) section=own-corpus ;;
    strict) section=recordings ;;
    noise) options="--copies 20 --noise 1mm,0.2deg" section=noise ;;
    loads) options="--load 10@r_hand" section=loads ;;
    assisted) options="--follow assisted" ;;
    assisted-100) options="--follow always" ;;
    rehearsed-30) options="--follow assisted --rehearse" ;;
    live) options="$live" section=live ;;
    live-500ms) options="--live-window 0.5${help:- --follow assisted}" ;;
    live-300ms) options="--live-window 0.3${help:- --follow assisted}" ;;
    live-noise) options="$live --copies 20 --noise 1mm,0.2deg" ;;
    live-push) options="$live --push 20@random" ;;
    live-load) options="$live --load 5@r_hand" ;;
    live-woman) options="$live --body adult-woman" ;;
    live-child) options="$live --body child" ;;
    live-30hz) options="$live --rate 30" ;;
    live-120hz) options="$live --rate 120" ;;
    *)
        echo "survey: no setting $1; there are:" $(sed -n 's/^    \([a-z0-9-]*\)) [os].*;;$/\1/p' "$0") >&2
        exit 2
        ;;
    esac
    # Pages show what physics alone does.
    [ -z "$help" ] || section=""
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
cd "$root"
for name in "$@"; do
    setting "$name"
    if [ "$name" = corpus ]; then
        folders=tests/corpus
    else
        folders=${SINEW_MOCAP_DIR:?survey: $name needs recordings (docs/corpus.md)}
    fi
    old=$IFS
    IFS=:
    # shellcheck disable=SC2086 # a list of folders
    set -- $folders
    IFS=$old
    stored=docs/survey/$name.json
    # shellcheck disable=SC2086 # words
    if [ -n "$store" ]; then
        "$binary" survey "$@" $options --out "$stored" --summary docs/survey \
            ${section:+--page docs/limits.md#$section}
    elif ! [ -f "$stored" ]; then
        echo "survey: nothing is stored for $name: tests/survey.sh --store $name" >&2
        status=1
    else
        "$binary" survey "$@" $options --out "$results/$name.json" --compare "$stored" || status=1
    fi
done
exit $status
