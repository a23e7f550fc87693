#!/bin/sh
# Load test: ghz calls a live server through reflection, a bounded number of times; any answer other than OK fails.
#
#   tests/load/run.sh [--release]      options by environment: SINEW_BIN (a built binary), LOAD_SCALE (times as many
#   calls)
#
# Installs ghz into .tools if it is missing, which needs Go.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
here=$root/tests/load
scale=${LOAD_SCALE:-1}
ghz=$root/.tools/ghz
PATH=$PATH:$root/.venv/bin

profile=debug
flag=
if [ "${1:-}" = --release ]; then
    profile=release
    flag=--release
fi

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

if [ -n "${SINEW_BIN:-}" ]; then
    binary=$SINEW_BIN
else
    # shellcheck disable=SC2086 # an empty flag must vanish
    cargo build --quiet --locked $flag --bin sinew --manifest-path "$root/Cargo.toml"
    binary=${CARGO_TARGET_DIR:-$root/target}/$profile/sinew
fi

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

"$binary" serve --listen 127.0.0.1:0 --log warn --no-demo >"$work/out" 2>"$work/err" &
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

# call NAME SERVICE/METHOD TOTAL CONCURRENCY: sends tests/load/NAME.json
call() {
    report=$work/$1.json
    "$ghz" --insecure --call "sinew.v1.$2" --data-file "$here/$1.json" --total "$3" --concurrency "$4" --timeout 120s \
        --format json --output "$report" "$address"
    python3 - "$report" "$1" "$3" <<'PY'
import json, sys
path, name, total = sys.argv[1], sys.argv[2], int(sys.argv[3])
report = json.load(open(path))
codes = report["statusCodeDistribution"]
at = {p["percentage"]: p["latency"] / 1e6 for p in report.get("latencyDistribution") or []}
p50, p99 = at.get(50, 0), at.get(99, 0)
print(f"{name:16} {report['count']:6} calls  {report['rps']:9.0f} /s  p50 {p50:8.2f} ms  p99 {p99:8.2f} ms  {codes}")
if codes != {"OK": total}:
    print(f"load: {name}: not every answer was OK: {codes} {report.get('errorDistribution')}", file=sys.stderr)
    sys.exit(1)
PY
}

call create_world WorldService/CreateWorld 1 1
call create_figure FigureService/CreateFigure 1 1
call play_clip MotionService/PlayClip 1 1
call step_world WorldService/StepWorld $((400 * scale)) 8
call get_world_frame StateService/GetWorldFrame $((5000 * scale)) 50
call simulate_clip SimulationService/SimulateClip $((12 * scale)) 4
