#!/bin/sh
# Runs six clips of tests/corpus by the binary that users build, and compares the hash of every bit of the last state
# with tests/golden/shipped.txt. That binary rounds, inlines and vectorises as no build of the tests does.
#
#   tests/shipped.sh [--store]     after `make release`, or with SINEW_BIN, a built binary
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
golden=$root/tests/golden/shipped.txt
binary=${SINEW_BIN:-${CARGO_TARGET_DIR:-$root/target}/release/sinew}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for clip in walk-normal.cmu turn.mixamo squat.lafan jump.vrm kick.cmu lie-down.vrm; do
    status=0
    "$binary" run "$root/tests/corpus/$clip.bvh" --report "$work/report.json" >/dev/null 2>"$work/said" || status=$?
    # 3 says that the figure fell, which is a result.
    if [ "$status" != 0 ] && [ "$status" != 3 ]; then
        cat "$work/said" >&2
        exit 1
    fi
    echo "$clip $(sed -n 's/.*"state_hash": *"\([0-9a-f]*\)".*/\1/p' "$work/report.json")"
done >"$work/hashes"
if [ "${1:-}" = --store ]; then
    cp "$work/hashes" "$golden"
fi
if ! diff "$golden" "$work/hashes"; then
    echo "shipped: states differ (< recorded, > this build); after an intended change: tests/shipped.sh --store" >&2
    exit 1
fi
echo "shipped: $(wc -l <"$golden") clips end in the recorded states"
