#!/bin/sh
# The attacks of this folder in their long form: those that repeat themselves go on for SINEW_ABUSE_SECONDS (30).
#
#   tests/abuse/run.sh [FILTER]      for example `net_`, or the name of one attack
#
# SINEW_BIN names another binary to attack, for example an older one.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
cd "$root"
SINEW_ABUSE_SECONDS=${SINEW_ABUSE_SECONDS:-30}
export SINEW_ABUSE_SECONDS
exec "${CARGO:-cargo}" test --locked --test command "abuse::${1:-}" -- --nocapture
