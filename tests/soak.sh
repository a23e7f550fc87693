#!/bin/sh
# Half an hour of everything that clients do to a server, and whether it holds more at the end than at the beginning;
# prints a table. tests/soak.sh [SECONDS] [-- OPTIONS OF CARGO]
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
seconds=1800
case "${1:-}" in
"" | --) ;;
*)
    seconds=$1
    shift
    ;;
esac
[ "${1:-}" != -- ] || shift
cd "$root"
SINEW_SOAK_SECONDS=$seconds cargo test --locked "$@" --test command operations::soak -- --nocapture
