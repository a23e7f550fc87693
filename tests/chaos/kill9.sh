#!/bin/sh
# Kills a server under load every few seconds and looks what is left: tests/chaos/kill9.sh [--seconds N]
#
# Prints losses and recovery times as a table. SINEW_BIN names another binary.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
cd "$root"
SINEW_CHAOS_SECONDS=120
if [ "${1:-}" = --seconds ]; then
    SINEW_CHAOS_SECONDS=${2:?a number of seconds}
fi
export SINEW_CHAOS_SECONDS
exec "${CARGO:-cargo}" test --locked --test chaos -- --nocapture
