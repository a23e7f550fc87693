#!/bin/sh
# Builds the programs that tests in other languages call, with the features of `cargo test`, so that nothing is compiled
# twice, and prints where `sinew` is. SINEW_BIN names a binary that is built already. Options are those of cargo.
set -eu
if [ -n "${SINEW_BIN:-}" ]; then
    echo "$SINEW_BIN"
    exit 0
fi
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
cd "$root"
profile=debug
[ "${1:-}" != --release ] || profile=release
"${CARGO:-cargo}" build --locked --quiet "$@" --workspace --exclude benches --features sinew/otlp \
    --bin sinew --bin dump_dynamics --bin dump_paper --example client >&2
echo "${CARGO_TARGET_DIR:-$root/target}/$profile/sinew"
