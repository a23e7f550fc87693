"""The exported models as a user loads them: masses, joints, ranges, actuators, visuals, and the torques that the
actuators give.

MJCF and URDF of every body of `dump_dynamics` and of every named body of a server, in MuJoCo and Pinocchio. What the
actuators may give is compared with a scan of the muscles over the range of angles, and with the peaks that the server
gives the sources of.
"""

from __future__ import annotations

import os

import mujoco
import numpy as np
import pinocchio as pin
import pytest
from conftest import build, target
from engines import (
    DOF_NAMES,
    DOFS,
    JOINTS,
    NV,
    SLOTS,
    Mujoco,
    Posture,
    axes,
    hinge_angles,
    hinge_map,
    is_ball,
    relative,
    rotation,
)
from test_dynamics import HINGES, ROUNDING, SOLVED, Worst, clear

import sinew
from sinew.v1 import body_pb2

# A scan of 20,001 angles misses the top of a curve by less than this share.
SCAN = 1e-6
NAMED = ("adult-man", "adult-woman", "child", "older-man", "older-woman")
RANGED = [f"{j}_{d[0]}" for j in JOINTS[1:] if not is_ball(j) for d in DOFS[j]]


def bounds(dump, name: str) -> np.ndarray:
    """Least and largest isometric torque of each DOF over its range of angles, (39, 2)."""
    return np.array(dump.model(name)["strongest"])


def custom(m: mujoco.MjModel, name: str) -> np.ndarray:
    n = m.numeric(name)
    return np.array(n.data)


def test_mjcf_has_the_masses_joints_ranges_and_armature(dump):
    for name in dump.models:
        described = dump.model(name)
        m = mujoco.MjModel.from_xml_path(str(dump.directory / f"{name}.mjcf"))
        assert relative([described["mass"]], [m.body_mass.sum()]) < ROUNDING
        assert (m.nv, m.nu) == (NV, len(DOF_NAMES))
        balls = [j for j in JOINTS[1:] if is_ball(j)]
        assert m.njnt == 1 + len(balls) + len(RANGED)
        ranges = dict(zip(DOF_NAMES, described["range"]))
        for dof in RANGED:
            assert m.joint(dof).limited[0] == 1 and (m.joint(dof).range == ranges[dof]).all()
        for joint in balls:
            for d in DOFS[joint]:
                assert (custom(m, f"{joint}_{d[0]}_range") == ranges[f"{joint}_{d[0]}"]).all()
        armature = np.array(described["armature"])
        for joint in JOINTS[1:]:
            at = m.joint(joint if is_ball(joint) else f"{joint}_{DOFS[joint][0][0]}").dofadr[0]
            assert (m.dof_armature[at : at + len(DOFS[joint])] == armature[np.arange(39)[slice_of(joint)]]).all()
        assert not m.dof_damping.any() and not m.jnt_stiffness.any(), "the body has neither"


def slice_of(joint: str) -> slice:
    """DOFs of a joint among the 39."""
    return slice(SLOTS[joint].start - 6, SLOTS[joint].stop - 6)


def test_motors_are_as_strong_as_the_muscles(dump):
    for name in dump.models:
        m = mujoco.MjModel.from_xml_path(str(dump.directory / f"{name}.mjcf"))
        want = bounds(dump, name)
        for k, dof in enumerate(DOF_NAMES):
            motor = m.actuator(dof)
            assert motor.ctrllimited[0] == 1 and motor.forcelimited[0] == 1
            assert (motor.ctrlrange == motor.forcerange).all()
            assert motor.ctrlrange[0] < 0 < motor.ctrlrange[1]
            assert np.abs(motor.ctrlrange / want[k] - 1).max() < SCAN, (name, dof)


def test_torque_in_is_torque_out(dump):
    """Controls are generalised forces along the DOFs, and move the model as ours are moved: `M v̇ + h = τ`."""
    worst, rng = Worst(), np.random.default_rng(5)
    for name in dump.models:
        engine = Mujoco(dump.directory / f"{name}.mjcf")
        m, d = engine.model, engine.data
        low, high = bounds(dump, name).T
        motors = [m.actuator(dof).id for dof in DOF_NAMES]
        for s in dump.states(name)[:40]:
            engine.set(s["positions"], s["velocity"])
            torque = rng.uniform(0.999 * low, 0.999 * high)
            d.ctrl[motors] = torque
            mujoco.mj_forward(m, d)
            worst.see("torque", np.r_[np.zeros(6), torque], engine.T.T @ d.qfrc_actuator)
            ours = np.linalg.solve(s["mass_matrix"], np.r_[np.zeros(6), torque] - s["bias"])
            worst.see("acceleration", ours, np.linalg.solve(engine.T, d.qacc))
            # Beyond the strength there is nothing more.
            d.ctrl[motors] = np.where(torque > 0, 10 * high, 10 * low)
            mujoco.mj_forward(m, d)
            most = np.where(torque > 0, high, low)
            assert np.abs((engine.T.T @ d.qfrc_actuator)[6:] / most - 1).max() < SCAN
    worst.check({"acceleration": SOLVED}, ROUNDING)


def test_enabled_limits_act_on_hinges(dump):
    """The flag is off, so that the dynamics are the unconstrained ones; with it on, a knee beyond its range is held."""
    m = mujoco.MjModel.from_xml_path(str(dump.directory / "man.mjcf"))
    for enabled in (False, True):
        if enabled:
            m.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_LIMIT)
        d = mujoco.MjData(m)
        d.qpos[2] = 10.0
        knee = m.joint("l_knee_flexion")
        d.qpos[knee.qposadr[0]] = knee.range[1] + 0.2
        mujoco.mj_forward(m, d)
        assert (d.nefc > 0) == enabled


class MujocoUrdf:
    """The exported URDF in MuJoCo with a floating base, in Sinew's conventions (see `engines`)."""

    def __init__(self, path):
        spec = mujoco.MjSpec.from_file(str(path))
        spec.body("pelvis").add_freejoint(name="root")
        self.model = spec.compile()
        # Random postures are beyond the limits.
        self.model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_LIMIT)
        self.data = mujoco.MjData(self.model)
        assert self.model.nv == NV

    def set(self, positions: np.ndarray, velocity: np.ndarray) -> None:
        p, v, m, d = Posture(positions), np.asarray(velocity, float), self.model, self.data
        mujoco.mj_resetData(m, d)
        T, drift = np.zeros((NV, NV)), np.zeros(NV)
        root = m.joint("root")
        a = root.qposadr[0]
        d.qpos[a : a + 3], d.qpos[a + 3 : a + 7] = p.position, p.quaternion[[3, 0, 1, 2]]
        a = root.dofadr[0]
        T[a : a + 3, 3:6] = np.eye(3)
        T[a + 3 : a + 6, 0:3] = p.rotation.T
        for name in JOINTS[1:]:
            joints = [m.joint(f"{name}_{k[0]}") for k in DOFS[name]]
            at, q, slot = [j.dofadr[0] for j in joints], [j.qposadr[0] for j in joints], SLOTS[name]
            if not is_ball(name):
                d.qpos[q] = p.joints[name]
                T[at, slot] = np.eye(len(at))
                continue
            angle = hinge_angles(name, rotation(p.joints[name]))
            E, _ = hinge_map(name, angle, None)
            own = np.linalg.solve(E, axes(name) @ v[slot])
            _, rate = hinge_map(name, angle, own)
            d.qpos[q] = angle
            T[at, slot] = np.linalg.solve(E, axes(name))
            drift[at] = -np.linalg.solve(E, rate @ own)
        self.T, self.drift = T, drift
        d.qvel[:] = T @ v
        mujoco.mj_fwdPosition(m, d)
        mujoco.mj_fwdVelocity(m, d)
        assert d.ncon == 0 and d.nefc == 0

    def inverse(self, vdot: np.ndarray) -> np.ndarray:
        self.data.qacc[:] = self.T @ vdot + self.drift
        mujoco.mj_inverse(self.model, self.data)
        return self.T.T @ self.data.qfrc_inverse

    def mass_matrix(self) -> np.ndarray:
        M = np.zeros((NV, NV))
        mujoco.mj_fullM(self.model, self.data, M)
        return self.T.T @ M @ self.T


def test_mujoco_loads_the_urdf(dump):
    for name in dump.models:
        described = dump.model(name)
        m = mujoco.MjModel.from_xml_path(str(dump.directory / f"{name}.urdf"))
        assert relative([described["mass"]], [m.body_mass.sum()]) < ROUNDING
        assert (m.njnt, m.nv) == (len(DOF_NAMES), len(DOF_NAMES)), "the pelvis is the root; the loader gives it a base"
        want = np.abs(bounds(dump, name)).max(axis=1)
        for k, dof in enumerate(DOF_NAMES):
            joint = m.joint(dof)
            assert joint.limited[0] == 1 and (joint.range == described["range"][k]).all()
            assert m.jnt_actfrclimited[joint.id] == 1
            assert np.abs(m.jnt_actfrcrange[joint.id] / (np.array([-1, 1]) * want[k]) - 1).max() < SCAN, (name, dof)
        shown = 0 if name.startswith("random") else 4 * 18
        assert m.ngeom == shown
        assert not m.geom_contype.any() and not m.geom_conaffinity.any(), "visuals, which touch nothing"
        assert (m.geom_size[:, :2] > 1e-3).all() and (m.geom_size < 0.5).all()


def test_mujoco_agrees_on_the_hinge_chains_of_the_urdf(dump):
    worst, count = Worst(), 0
    for name in dump.models:
        engine = MujocoUrdf(dump.directory / f"{name}.urdf")
        reflected = np.r_[np.zeros(6), dump.model(name)["armature"]]
        for s in filter(clear, dump.states(name)):
            count += 1
            engine.set(s["positions"], s["velocity"])
            # URDF has no armature: take ours out.
            worst.see("M", s["mass_matrix"] - np.diag(reflected), engine.mass_matrix())
            worst.see("tau", s["torque"] - reflected * s["acceleration"], engine.inverse(s["acceleration"]))
    assert count >= 20
    worst.check({}, HINGES)


def test_pinocchio_reads_the_limits_of_the_urdf(dump):
    for name in dump.models:
        m = pin.buildModelFromUrdf(str(dump.directory / f"{name}.urdf"), pin.JointModelFreeFlyer())
        want = np.abs(bounds(dump, name)).max(axis=1)
        at = [m.idx_vs[m.getJointId(dof)] for dof in DOF_NAMES]
        assert np.abs(m.effortLimit[at] / want - 1).max() < SCAN
        assert (m.velocityLimit[at] > 5).all() and (m.velocityLimit[at] < 100).all(), "rad/s, of people"
        at = [m.idx_qs[m.getJointId(dof)] for dof in DOF_NAMES]
        limits = np.array(dump.model(name)["range"])
        assert (m.lowerPositionLimit[at] == limits[:, 0]).all() and (m.upperPositionLimit[at] == limits[:, 1]).all()


@pytest.fixture(scope="module")
def server():
    """A client of a server of its own."""
    build()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SINEW_BIN", os.fspath(target() / "sinew"))
        with sinew.serve() as client:
            yield client


@pytest.mark.parametrize("body", NAMED)
def test_every_named_body_loads_from_the_server(server, body, tmp_path):
    request = body_pb2.GetBodyRequest(name=f"bodies/{body}", include_provenance=True)
    described = server.bodies_stub.GetBody(request, timeout=60).body
    paths = {form: tmp_path / f"body.{form}" for form in ("mjcf", "urdf")}
    for form, path in paths.items():
        path.write_text(server.export_body(body, form))
    mass = sum(s.mass_kg for s in described.segments)
    models = {form: mujoco.MjModel.from_xml_path(str(path)) for form, path in paths.items()}
    assert all(relative([mass], [m.body_mass.sum()]) < ROUNDING for m in models.values())
    assert pin.buildModelFromMJCF(str(paths["mjcf"])).nv == NV
    assert pin.buildModelFromUrdf(str(paths["urdf"]), pin.JointModelFreeFlyer()).nv == NV
    # Peaks as their sources are given, positive direction first. Where the best angle is within the range, they are
    # the bounds.
    reached = 0
    for dof in described.dofs:
        own = [p for p in described.provenance if p.part == dof.name]
        peaks = [p.value for p in own if p.quantity == "isometric peak torque"]
        best = [np.radians(p.value) for p in own if p.quantity == "angle of the peak"]
        assert len(peaks) == len(best) == 2
        low, high = models["mjcf"].actuator(dof.name).ctrlrange
        for bound, peak, angle in ((high, peaks[0], best[0]), (-low, peaks[1], best[1])):
            within = dof.lower_rad <= angle <= dof.upper_rad
            reached += within
            assert abs(bound / peak - 1) < 1e-12 if within else 0.1 * peak <= bound < peak, dof.name
        joint = models["urdf"].joint(dof.name).id
        assert models["urdf"].jnt_actfrcrange[joint, 1] == max(high, -low)
    assert reached > 50, "most muscles are best within the range"
