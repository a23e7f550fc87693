"""Makes `data/dynamics_vectors.json`: states of several bodies and what Pinocchio says, in Sinew's conventions.

    cargo build -p tools --bin dump_dynamics
    target/debug/dump_dynamics DIR 2
    .venv/bin/python tests/oracle/make_vectors.py DIR

Inputs (bodies, loads, states, accelerations) come from the dump; every expected number comes from Pinocchio, and is
written only if MuJoCo agrees on it to 1e-12. `vectors.rs` reproduces the file without Python.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import mujoco
import numpy as np
import pinocchio
from engines import NV, SEGMENTS, Dump, Mujoco, Pinocchio, relative

PROBES = ["head", "r_hand", "l_toes"]


def agreed(a, b) -> list:
    a = np.asarray(a, float)
    assert relative(b, a) < 1e-12
    return a.tolist()


def main(directory: Path) -> None:
    dump = Dump(directory)
    models = []
    for name in dump.models:
        model = dump.model(name)
        first, second = (E(directory / f"{name}.mjcf") for E in (Pinocchio, Mujoco))
        cases = []
        for s in dump.states(name)[:2]:
            first.set(s["positions"], s["velocity"])
            second.set(s["positions"], s["velocity"])
            c, v, bias, J = first.com()
            c2, v2, _, J2 = second.com()
            linear, angular = first.momentum()
            linear2, angular2 = second.momentum()
            M = np.array(agreed(first.mass_matrix(), second.mass_matrix()))
            tau = agreed(first.inverse(s["acceleration"]), second.inverse(s["acceleration"]))
            # Zero-moment point of the wrench on the pelvis, moved to the world origin.
            moment = np.array(tau[:3]) + np.cross(s["positions"][:3], tau[3:6])
            probes = []
            for segment in PROBES:
                k = SEGMENTS.index(segment)
                where, R, jacobian, drift = first.segment(segment)
                where2, R2, jacobian2, drift2 = second.segment(segment)
                probes.append(
                    {
                        "segment": k,
                        "position": agreed(where, where2),
                        "rotation": agreed(R, R2),
                        "jacobian_times_acceleration": agreed(
                            jacobian @ s["acceleration"], jacobian2 @ s["acceleration"]
                        ),
                        "bias": agreed(drift, drift2),
                    }
                )
            cases.append(
                {
                    "positions": s["positions"].tolist(),
                    "velocity": s["velocity"].tolist(),
                    "acceleration": s["acceleration"].tolist(),
                    "torque": tau,
                    "bias": agreed(first.bias(), second.bias()),
                    "inertia_lower": [M[i, j] for i in range(NV) for j in range(i + 1)],
                    "com": agreed(c, c2),
                    "com_velocity": agreed(v, v2),
                    "com_bias": bias.tolist(),
                    "com_jacobian": agreed(J, J2),
                    "linear_momentum": agreed(linear, linear2),
                    "angular_momentum": agreed(angular, angular2),
                    "zero_moment_point": [-moment[1] / tau[5], moment[0] / tau[5]],
                    "probes": probes,
                }
            )
        models.append({**model, "cases": cases})
    out = {
        "about": "Made by tests/oracle/make_vectors.py. SI; conventions of Sinew: see engines.py.",
        "versions": {"pinocchio": pinocchio.__version__, "mujoco": mujoco.__version__, "numpy": np.__version__},
        "gravity": dump.manifest["gravity"],
        "models": models,
    }
    text = (
        json.dumps(out, separators=(",", ":")).replace('{"name"', '\n{"name"').replace('{"positions"', '\n{"positions"')
    )
    (Path(__file__).parent / "data" / "dynamics_vectors.json").write_text(text + "\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
