#!/bin/sh
# Our kernels and ticks against Pinocchio's and MuJoCo's, alternately on one core, three rounds, medians of each round:
# a table of ratios.
#
# Usage: tools/benches/peers.sh [SCRATCH]            SCRATCH: where the peers are built, default target/peers
#   SINEW_PEERS_DIR   sources of the peer benches, default ../shared/peers
#   SINEW_CORE        core to pin to, default 1
# Needs python3 with venv, g++ (about 3 GB for the Pinocchio headers), and taskset. Set-up takes some minutes, once.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
peers=${SINEW_PEERS_DIR:-$root/../shared/peers}
scratch=${1:-$root/target/peers}
core=${SINEW_CORE:-1}
rounds=3
[ -f "$peers/pin_bench.cpp" ] || { echo "no peers in $peers: set SINEW_PEERS_DIR" >&2; exit 1; }
mkdir -p "$scratch"
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1

if [ ! -x "$scratch/venv/bin/python" ]; then
    python3 -m venv "$scratch/venv"
    "$scratch/venv/bin/pip" install --quiet mujoco pin cmeel-eigen
fi
[ -f "$scratch/model/human.txt" ] || "$scratch/venv/bin/python" "$peers/gen_model.py" "$scratch/model"
if [ ! -x "$scratch/pin_bench" ]; then
    prefix=$(ls -d "$scratch"/venv/lib/python*/site-packages/cmeel.prefix)
    echo "building the Pinocchio bench" >&2
    # The library's own instantiations, as most users of the wheel run it.
    g++ -isystem "$prefix/include" -isystem "$prefix/include/eigen3" -std=c++17 -O3 -DNDEBUG -DEIGEN_NO_DEBUG \
        -DBOOST_MPL_LIMIT_LIST_SIZE=30 -DBOOST_MPL_LIMIT_VECTOR_SIZE=30 -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS \
        -DBOOST_FUSION_INVOKE_MAX_ARITY=12 -DPINOCCHIO_ENABLE_TEMPLATE_INSTANTIATION \
        "$peers/pin_bench.cpp" -o "$scratch/pin_bench" \
        -L"$prefix/lib" -lpinocchio_default -lboost_serialization -Wl,-rpath,"$prefix/lib"
fi

cd "$root"
target=${CARGO_TARGET_DIR:-$root/target}
cargo bench -p benches --bench dynamics --bench control --bench world_step --no-run
run_ours() {
    taskset -c "$core" cargo bench --quiet -p tools --bench "$1" -- \
        --noplot --warm-up-time 0.5 --measurement-time 2 "$2"
}
round=1
while [ $round -le $rounds ]; do
    echo "round $round of $rounds" >&2
    taskset -c "$core" "$scratch/pin_bench" "$scratch/model/human.txt" pin >"$scratch/pin-$round.jsonl"
    taskset -c "$core" "$scratch/venv/bin/python" "$peers/mj_bench.py" "$scratch/model" >"$scratch/mj-$round.jsonl"
    run_ours dynamics '' >"$scratch/ours-$round.log"
    run_ours control '' >>"$scratch/ours-$round.log"
    run_ours world_step '/1$' >>"$scratch/ours-$round.log"
    rm -rf "$scratch/ours-$round"
    cp -r "$target/criterion" "$scratch/ours-$round"
    round=$((round + 1))
done

"$scratch/venv/bin/python" - "$scratch" "$rounds" <<'PY'
import json, pathlib, statistics, sys

scratch, rounds = pathlib.Path(sys.argv[1]), range(1, int(sys.argv[2]) + 1)

def peer_us(name, n):
    """Median of a peer's row; `name` starts with the engine: pin/… or mj/…"""
    rows = (json.loads(line) for line in (scratch / f"{name.split('/')[0]}-{n}.jsonl").read_text().splitlines())
    return next(r["us_med"] for r in rows if r["name"].startswith(name))

def ours(path, n):
    estimates = json.loads((scratch / f"ours-{n}" / path / "new" / "estimates.json").read_text())
    return estimates["median"]["point_estimate"] / 1e3

# name, ours, figures per call, peer, what the two do
pairs = [
    ("inverse dynamics", "one/rnea", 1, "pin/rnea", "kinematics and RNEA"),
    ("inverse dynamics, 8 lanes", "eight/rnea_x8", 8, "pin/rnea", "per figure"),
    ("inertia matrix", "one/crba", 1, "pin/crba_local", "kinematics and CRBA"),
    ("factor", "one/factor", 1, "pin/sparse_LTL_decompose", "tree-sparse"),
    ("solve", "one/solve", 1, "pin/sparse_LTL_solve", "tree-sparse"),
    ("forward dynamics", "one/aba", 1, "pin/aba_local", "kinematics and ABA"),
    ("inverse dynamics", "one/rnea", 1, "mj/inverse_free", "MuJoCo, no contact"),
    ("paper control tick", "control/tick/paper", 1, "pin/paper_tick_limits_x1", "without stepping, as the peer"),
    ("modern decision", "control/decide/modern", 1, "pin/paper_tick_limits_x1",
     "the paper's tick of the peer, for scale"),
    ("world step, modern", "world_step/modern/1", 1, "mj/step_PD_stand dt=1/240",
     "one tick of 1/60 s against one PD step of 1/240 s"),
    ("world step, paper", "world_step/paper/1", 1, "pin/paper_tick_limits_x1",
     "ours with contact solver, integration and report"),
]
print(f"{'what':28} {'ours us':>9} {'peer us':>9} {'ratio':>7}  (ratios of the rounds)")
for what, path, figures, peer, note in pairs:
    try:
        mine = [ours(path, n) / figures for n in rounds]
    except FileNotFoundError:
        continue
    theirs = [peer_us(peer, n) for n in rounds]
    ratios = [a / b for a, b in zip(mine, theirs)]
    spread = " ".join(f"{r:.3f}" for r in ratios)
    medians = " ".join(f"{statistics.median(v):{w}.3f}" for v, w in ((mine, 9), (theirs, 9), (ratios, 7)))
    print(f"{what:28} {medians}  ({spread}) {note}")
PY
