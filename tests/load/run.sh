#!/bin/sh
# Load test: ghz calls a live server through reflection, a bounded number of times; any answer other than OK fails.
# The cases are in cases.json: every unary call of the protos, and the streams.
#
#   tests/load/run.sh [--release] [--table]   options by environment: SINEW_BIN (a built binary), LOAD_SCALE (times as
#   many calls); --table writes the table of docs/performance.md
#
# Installs ghz into .tools if it is missing, which needs Go, and needs the Python package of .venv (make setup).
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
here=$root/tests/load
scale=${LOAD_SCALE:-1}
ghz=$root/.tools/ghz
PATH=$PATH:$root/.venv/bin

flag=
table=
for option in "$@"; do
    case $option in
    --release) flag=--release ;;
    --table) table="--table $root/docs/performance.md" ;;
    *)
        echo "load: unknown option $option" >&2
        exit 2
        ;;
    esac
done

if ! [ -x "$ghz" ]; then
    if command -v ghz >/dev/null 2>&1; then
        ghz=$(command -v ghz)
    elif command -v go >/dev/null 2>&1; then
        echo "load: installing ghz into .tools"
        GOBIN=$root/.tools go install github.com/bojand/ghz/cmd/ghz@v0.93.0
    else
        echo "load: no ghz and no go to install it with; tests/setup.sh brings Go" >&2
        exit 1
    fi
fi

# shellcheck disable=SC2086 # an empty flag must vanish
binary=$("$root/tests/programs.sh" $flag)

work=$(mktemp -d)
server=
finish() {
    if [ -n "$server" ]; then
        kill "$server" 2>/dev/null || true
        wait "$server" 2>/dev/null || true
    fi
    rm -rf "$work"
}
trap finish EXIT INT TERM

# Programs on this machine may do as much as they like, but for their share of all.
"$binary" serve --listen 127.0.0.1:0 --log warn --no-demo --set max_client_share=1 --set max_tick_budget=1000 \
    >"$work/out" 2>"$work/err" &
server=$!
address=
tries=0
while [ -z "$address" ]; do
    address=$(sed -n 's|.*http://\([0-9.]*:[0-9]*\).*|\1|p' "$work/out" | head -n 1)
    tries=$((tries + 1))
    if [ "$tries" -gt 300 ] || ! kill -0 "$server" 2>/dev/null; then
        echo "load: the server did not start" >&2
        cat "$work/err" >&2
        exit 1
    fi
    sleep 0.1
done

# shellcheck disable=SC2086 # no table is no argument
"${LOAD_PYTHON:-$root/.venv/bin/python}" "$here/run.py" "$ghz" "$address" --scale "$scale" $table
