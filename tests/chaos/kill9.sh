#!/bin/sh
# Kills a server under load every few seconds and looks what is left: tests/chaos/kill9.sh [--seconds N] [--write]
#
# Prints losses and recovery times as a table; --write puts it into docs/durability.md. SINEW_BIN names another binary.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
cd "$root"
SINEW_CHAOS_SECONDS=120
while [ $# -gt 0 ]; do
    case $1 in
    --seconds)
        SINEW_CHAOS_SECONDS=${2:?a number of seconds}
        shift 2
        ;;
    --write)
        export SINEW_CHAOS_PAGE="$root/docs/durability.md"
        shift
        ;;
    *)
        echo "usage: $0 [--seconds N] [--write]" >&2
        exit 64
        ;;
    esac
done
export SINEW_CHAOS_SECONDS
exec "${CARGO:-cargo}" test --locked --test command chaos:: -- --nocapture
