#!/bin/sh
# Instructions per call, counted by valgrind: the same on any machine load, so that a change of 1 % is a change of the
# code. Usage: tools/benches/instructions.sh [WORK...]     (valgrind needed: apt-get install valgrind) Valgrind knows no
# AVX-512, so the lane kernels are counted in their AVX2 form.
set -eu
cd "$(dirname "$0")/../.."
command -v valgrind >/dev/null || { echo "valgrind is not installed: apt-get install valgrind" >&2; exit 1; }
cargo build --release --quiet -p tools --bin instructions
binary=${CARGO_TARGET_DIR:-target}/release/instructions
[ $# -gt 0 ] || set -- kinematics rnea rnea_x8 crba_factor_solve terms paper_tick modern_tick

count() { # instructions of the whole program for WORK N
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$binary" "$1" "$2" 2>&1 |
        sed -n 's/.*Collected : \([0-9]*\).*/\1/p'
}

printf '%-20s %14s\n' work instructions
for work in "$@"; do
    few=$(count "$work" 100)
    many=$(count "$work" 300)
    if [ -z "$few" ] || [ -z "$many" ]; then
        echo "$work cannot be counted" >&2
        exit 1
    fi
    printf '%-20s %14d\n' "$work" $(((many - few) / 200))
done
