"""Our dynamics against Pinocchio and MuJoCo, on the bodies that Sinew exports.

More than a thousand random states of human and random bodies, with and without loads: inverse dynamics, inertia matrix,
bias forces, forward dynamics, centre of mass, momentum, poses, Jacobians and their bias terms. Each quantity is
compared as largest difference over largest magnitude, per state.
"""

from __future__ import annotations

from collections import defaultdict

import numpy as np
import pytest
from engines import (
    SEGMENTS,
    Mujoco,
    Pinocchio,
    PinocchioUrdf,
    Posture,
    JOINTS,
    hinge_angles,
    is_ball,
    relative,
    rotation,
    skew,
)

# Two right answers differ by rounding only.
ROUNDING = 1e-12
# Solving with M multiplies rounding by its condition number (up to 10⁶).
SOLVED = 1e-9
# The maps of hinge chains divide by the cosine of the middle angle, squared in bias terms.
HINGES = 1e-10
# How far from 90° middle angles are kept in the comparison with hinge chains, rad.
CLEARANCE = 0.3


class Worst:
    """Collects the largest relative error of each quantity, so that a failure shows them all."""

    def __init__(self) -> None:
        self.errors: dict[str, float] = defaultdict(float)

    def see(self, quantity: str, ours, theirs) -> None:
        self.errors[quantity] = max(self.errors[quantity], relative(ours, theirs))

    def check(self, bounds: dict[str, float], default: float) -> None:
        bad = {q: e for q, e in self.errors.items() if not e <= bounds.get(q, default)}
        assert not bad, f"beyond tolerance: {bad}; all: {dict(self.errors)}"


def compare(engine, states, worst: Worst) -> None:
    for s in states:
        engine.set(s["positions"], s["velocity"])
        worst.see("tau", s["torque"], engine.inverse(s["acceleration"]))
        worst.see("M", s["mass_matrix"], engine.mass_matrix())
        worst.see("h", s["bias"], engine.bias())
        acceleration = engine.forward(s["forces"])
        worst.see("forward (ABA)", s["forward_aba"], acceleration)
        worst.see("forward (factor)", s["forward_factor"], acceleration)
        c, v, a, J = engine.com()
        worst.see("com", s["com"], c)
        worst.see("com velocity", s["com_velocity"], v)
        if a is not None:
            worst.see("com bias", s["com_bias"], a)
        worst.see("com Jacobian", s["com_jacobian"], J)
        linear, angular = engine.momentum()
        worst.see("linear momentum", s["linear_momentum"], linear)
        worst.see("angular momentum", s["angular_momentum"], angular)
        where, turned, jacobians, biases = zip(*(engine.segment(n) for n in SEGMENTS))
        worst.see("positions", s["segment_position"], np.array(where))
        worst.see("rotations", s["segment_rotation"], np.array(turned))
        worst.see("Jacobians", s["segment_jacobian"], np.array(jacobians))
        worst.see("biases", s["segment_bias"], np.array(biases))
        # Points: from the engine's segment, by rigid-body kinematics.
        for k in range(len(SEGMENTS)):
            r = turned[k] @ s["point_local"][k]
            J = jacobians[k][3:] - skew(r) @ jacobians[k][:3]
            w = jacobians[k][:3] @ s["velocity"]
            bias = biases[k][3:] + np.cross(biases[k][:3], r) + np.cross(w, np.cross(w, r))
            worst.see("points", s["point_world"][k], where[k] + r)
            worst.see("point Jacobian", s["point_jacobian"][k], J)
            worst.see("point velocity", s["point_velocity"][k], J @ s["velocity"])
            scale = np.abs(s["point_bias"]).max()
            worst.see("point bias", s["point_bias"][k] / scale + 1, bias / scale + 1)


SOLVING = {"forward (ABA)": SOLVED, "forward (factor)": SOLVED}


def test_there_are_a_thousand_states_with_and_without_loads(dump):
    assert dump.manifest["count"] * len(dump.models) >= 1000
    loads = [bool(dump.model(m)["loads"]) for m in dump.models]
    assert any(loads) and not all(loads)


def test_pinocchio_agrees_on_ball_joints(dump):
    """Equation (6) of the paper."""
    worst = Worst()
    for name in dump.models:
        engine = Pinocchio(dump.directory / f"{name}.mjcf")
        assert relative([dump.model(name)["mass"]], [engine.mass]) < ROUNDING
        states = dump.states(name)
        compare(engine, states, worst)
        # Ours is the energy of the segments: without reflected inertia.
        segments = Pinocchio(dump.directory / f"{name}.mjcf", armature=False)
        for s in states[:20]:
            segments.set(s["positions"], s["velocity"])
            worst.see("kinetic energy", s["kinetic_energy"], [segments.kinetic_energy()])
    worst.check(SOLVING, ROUNDING)


def test_mujoco_agrees_on_ball_joints(dump):
    worst = Worst()
    for name in dump.models:
        engine = Mujoco(dump.directory / f"{name}.mjcf")
        assert relative([dump.model(name)["mass"]], [engine.mass]) < ROUNDING
        compare(engine, dump.states(name), worst)
    worst.check(SOLVING, ROUNDING)


def clear(s) -> bool:
    """No ball joint near the singularity of its hinge chain."""
    p = Posture(s["positions"])
    return all(abs(hinge_angles(j, rotation(p.joints[j]))[1]) < np.pi / 2 - CLEARANCE for j in JOINTS[1:] if is_ball(j))


def test_pinocchio_agrees_on_the_hinge_chains_of_the_urdf(dump):
    worst, count = Worst(), 0
    for name in dump.models:
        engine = PinocchioUrdf(dump.directory / f"{name}.urdf")
        reflected = np.r_[np.zeros(6), dump.model(name)["armature"]]
        for s in filter(clear, dump.states(name)):
            count += 1
            engine.set(s["positions"], s["velocity"])
            # URDF has no armature: take ours out.
            worst.see("M", s["mass_matrix"] - np.diag(reflected), engine.mass_matrix())
            worst.see("tau", s["torque"] - reflected * s["acceleration"], engine.inverse(s["acceleration"]))
            worst.see("h", s["bias"], engine.bias())
            c, v, a, J = engine.com()
            worst.see("com", s["com"], c)
            worst.see("com velocity", s["com_velocity"], v)
            worst.see("com bias", s["com_bias"], a)
            worst.see("com Jacobian", s["com_jacobian"], J)
            for k, n in enumerate(SEGMENTS):
                where, turned, jacobian, bias = engine.segment(n)
                worst.see("rotation", s["segment_rotation"][k], turned)
                worst.see("Jacobian", s["segment_jacobian"][k], jacobian)
                if k:
                    worst.see("bias", s["segment_bias"][k], bias)
    assert count >= 20
    worst.check({}, HINGES)


@pytest.mark.parametrize("mistake", ["gravity", "coriolis", "load"])
def test_a_mistake_is_seen_by_a_wide_margin(dump, mistake):
    """A comparison that cannot fail shows nothing."""
    name = "random_0_loaded"
    engine = Pinocchio(dump.directory / ("random_0.mjcf" if mistake == "load" else f"{name}.mjcf"))
    if mistake == "gravity":
        engine.model.gravity.linear = np.array([0, 0, -9.8])
    least = float("inf")
    for s in dump.states(name)[:20]:
        engine.set(s["positions"], s["velocity"] * (0 if mistake == "coriolis" else 1))
        least = min(least, relative(s["torque"], engine.inverse(s["acceleration"])))
    assert least > 1e6 * ROUNDING
