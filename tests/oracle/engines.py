"""Pinocchio and MuJoCo behind one interface that speaks Sinew's conventions.

Sinew's velocity (45) is: angular velocity of the pelvis and velocity of its origin, both in world axes, then 39 joint
rates; the three rates of a ball joint are the child's angular velocity relative to its parent along the signed child
axes of the DOFs. Generalised forces are dual to it; accelerations are its time derivative.

Each engine has velocities of its own, u = T(q) v:

* Pinocchio: linear then angular velocity of the pelvis, both in pelvis axes; balls along child x, y, z.
* MuJoCo: velocity of the pelvis origin in world axes, then angular velocity in pelvis axes; balls along child x, y, z.
* Pinocchio on the URDF: hinges in place of balls, so that T holds the inverse of the map from hinge rates to angular
  velocity.

Hence M = Tᵀ M' T, tau = Tᵀ tau', J = J' T, and what depends on acceleration takes u' = T v' + dT/dt v.
"""

from __future__ import annotations

import json
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin

NV = 45
SEGMENTS = [
    "pelvis", "abdomen", "chest", "head", "l_upper_arm", "l_forearm", "l_hand", "r_upper_arm", "r_forearm", "r_hand",
    "l_thigh", "l_shank", "l_foot", "l_toes", "r_thigh", "r_shank", "r_foot", "r_toes",
]  # fmt: skip
JOINTS = [
    "root", "waist", "thorax", "neck", "l_shoulder", "l_elbow", "l_wrist", "r_shoulder", "r_elbow", "r_wrist",
    "l_hip", "l_knee", "l_ankle", "l_toe", "r_hip", "r_knee", "r_ankle", "r_toe",
]  # fmt: skip
# DOFs of each joint: name after the joint's own, signed axis (0 x, 1 y, 2 z). Written out here so that the tests do not
# take from the program what they check.
_SPINE = [("flexion", 1, 1), ("lateral", 0, 1), ("rotation", 2, 1)]


def _limbs(side: str) -> dict[str, list[tuple[str, int, int]]]:
    m = 1 if side == "l" else -1
    return {
        f"{side}_shoulder": [("flexion", 1, -1), ("abduction", 0, m), ("rotation", 2, -m)],
        f"{side}_elbow": [("flexion", 1, -1), ("pronation", 2, -m)],
        f"{side}_wrist": [("flexion", 0, -m), ("deviation", 1, -1)],
        f"{side}_hip": [("flexion", 1, -1), ("abduction", 0, m), ("rotation", 2, -m)],
        f"{side}_knee": [("flexion", 1, 1)],
        f"{side}_ankle": [("flexion", 1, -1), ("inversion", 0, m), ("rotation", 2, -m)],
        f"{side}_toe": [("extension", 1, -1)],
    }


DOFS = {"waist": _SPINE, "thorax": _SPINE, "neck": _SPINE, **_limbs("l"), **_limbs("r")}
DOF_NAMES = [f"{j}_{d[0]}" for j in JOINTS[1:] for d in DOFS[j]]
assert len(DOF_NAMES) == 39


def axis(dof: tuple[str, int, int]) -> np.ndarray:
    v = np.zeros(3)
    v[dof[1]] = dof[2]
    return v


def axes(joint: str) -> np.ndarray:
    """Signed axes of a joint's DOFs, as columns."""
    return np.array([axis(d) for d in DOFS[joint]]).T


def is_ball(joint: str) -> bool:
    return len(DOFS[joint]) == 3


def rotation(xyzw: np.ndarray) -> np.ndarray:
    return pin.Quaternion(*[float(x) for x in (xyzw[3], xyzw[0], xyzw[1], xyzw[2])]).matrix()


def skew(v: np.ndarray) -> np.ndarray:
    return pin.skew(np.asarray(v, float))


class Posture:
    """The 55 numbers of a posture.

    Pelvis position (3) and rotation (4), then a quaternion x, y, z, w or angles per joint.
    """

    def __init__(self, positions: np.ndarray):
        positions = np.asarray(positions, float)
        assert positions.shape == (55,)
        self.position = positions[:3]
        self.quaternion = positions[3:7]
        self.joints: dict[str, np.ndarray] = {}
        at = 7
        for joint in JOINTS[1:]:
            n = 4 if is_ball(joint) else len(DOFS[joint])
            self.joints[joint] = positions[at : at + n]
            at += n
        assert at == 55
        self.rotation = rotation(self.quaternion)


def velocity_slots() -> dict[str, slice]:
    out, at = {}, 6
    for joint in JOINTS[1:]:
        out[joint] = slice(at, at + len(DOFS[joint]))
        at += len(DOFS[joint])
    return out


SLOTS = velocity_slots()


class Engine:
    """What both engines answer, in Sinew's conventions. `set` must come first."""

    T: np.ndarray
    drift: np.ndarray

    def set(self, positions: np.ndarray, velocity: np.ndarray) -> None:
        raise NotImplementedError

    def _own_acceleration(self, vdot: np.ndarray) -> np.ndarray:
        return self.T @ vdot + self.drift


class Pinocchio(Engine):
    """The exported MJCF (ball joints) in Pinocchio."""

    def __init__(self, mjcf: Path | str, armature: bool = True):
        self.model = pin.buildModelFromMJCF(str(mjcf))
        if not armature:
            self.model.armature[:] = 0
        self._finish()
        self.joint = {}
        for name in JOINTS:
            first = name if name == "root" or is_ball(name) else f"{name}_{DOFS[name][0][0]}"
            ids = [i for i, n in enumerate(self.model.names) if n in (first, f"Composite_{first}")]
            assert len(ids) == 1, (name, list(self.model.names))
            self.joint[name] = ids[0]

    def _finish(self) -> None:
        assert self.model.nv == NV
        self.data = self.model.createData()
        self.frame = {n: self.model.getFrameId(n, pin.FrameType.BODY) for n in SEGMENTS}
        assert all(i < self.model.nframes for i in self.frame.values())
        self.mass = pin.computeTotalMass(self.model)

    def set(self, positions: np.ndarray, velocity: np.ndarray) -> None:
        p, v = Posture(positions), np.asarray(velocity, float)
        m = self.model
        q, T, drift = pin.neutral(m), np.zeros((NV, NV)), np.zeros(NV)
        R, w, vel = p.rotation, v[:3], v[3:6]
        iq, iv = m.idx_qs[self.joint["root"]], m.idx_vs[self.joint["root"]]
        q[iq : iq + 3], q[iq + 3 : iq + 7] = p.position, p.quaternion
        T[iv : iv + 3, 3:6] = R.T
        T[iv + 3 : iv + 6, 0:3] = R.T
        drift[iv : iv + 3] = -R.T @ np.cross(w, vel)
        for name in JOINTS[1:]:
            self._set_joint(name, p.joints[name], v[SLOTS[name]], q, T, drift)
        self.q, self.v, self.T, self.drift = q, v, T, drift
        self.u = T @ v
        self._bias_done = False

    def _set_joint(self, name, x, rates, q, T, drift) -> None:
        m, j = self.model, self.joint[name]
        iq, iv, n = m.idx_qs[j], m.idx_vs[j], m.nvs[j]
        q[iq : iq + m.nqs[j]] = x
        T[iv : iv + n, SLOTS[name]] = axes(name) if is_ball(name) else np.eye(n)

    def inverse(self, vdot: np.ndarray) -> np.ndarray:
        return self.T.T @ pin.rnea(self.model, self.data, self.q, self.u, self._own_acceleration(vdot))

    def mass_matrix(self) -> np.ndarray:
        M = pin.crba(self.model, self.data, self.q)
        M = np.triu(M) + np.triu(M, 1).T
        return self.T.T @ M @ self.T

    def bias(self) -> np.ndarray:
        own = pin.nonLinearEffects(self.model, self.data, self.q, self.u)
        M = pin.crba(self.model, self.data, self.q)
        M = np.triu(M) + np.triu(M, 1).T
        return self.T.T @ (own + M @ self.drift)

    def forward(self, forces: np.ndarray) -> np.ndarray:
        own = np.linalg.solve(self.T.T, forces)
        a = pin.aba(self.model, self.data, self.q, self.u, own)
        return np.linalg.solve(self.T, a - self.drift)

    def com(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Position, velocity, bias acceleration and Jacobian."""
        d = self.data
        pin.centerOfMass(self.model, d, self.q, self.u, self.drift)
        c, v, a = d.com[0].copy(), d.vcom[0].copy(), d.acom[0].copy()
        J = pin.jacobianCenterOfMass(self.model, d, self.q) @ self.T
        return c, v, a, J

    def momentum(self) -> tuple[np.ndarray, np.ndarray]:
        h = pin.computeCentroidalMomentum(self.model, self.data, self.q, self.u)
        return h.linear.copy(), h.angular.copy()

    def kinetic_energy(self) -> float:
        return pin.computeKineticEnergy(self.model, self.data, self.q, self.u)

    def segment(self, name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Position, rotation, Jacobian (angular first) and bias (angular first) of a segment."""
        m, d, f = self.model, self.data, self.frame[name]
        if not self._bias_done:
            pin.computeJointJacobians(m, d, self.q)
            pin.forwardKinematics(m, d, self.q, self.u, self.drift)
            pin.updateFramePlacements(m, d)
            self._bias_done = True
        world = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        J = pin.getFrameJacobian(m, d, f, world)
        a = pin.getFrameClassicalAcceleration(m, d, f, world)
        M = d.oMf[f]
        return (
            M.translation.copy(),
            M.rotation.copy(),
            np.vstack([J[3:], J[:3]]) @ self.T,
            np.r_[a.angular, a.linear],
        )

    def twist(self, name: str) -> np.ndarray:
        """Angular velocity, and velocity of the origin, of a segment; after `segment`."""
        t = pin.getFrameVelocity(self.model, self.data, self.frame[name], pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
        return np.r_[t.angular, t.linear]


class PinocchioUrdf(Pinocchio):
    """The exported URDF (hinge chains) in Pinocchio; balls away from the singularity of their chain."""

    def __init__(self, urdf: Path | str, armature: np.ndarray | None = None):
        assert armature is None, "a diagonal of ball joints is not one of hinge chains"
        self.model = pin.buildModelFromUrdf(str(urdf), pin.JointModelFreeFlyer())
        self._finish()
        self.joint = {"root": 1}
        self.hinges = {n: [self.model.getJointId(f"{n}_{d[0]}") for d in DOFS[n]] for n in JOINTS[1:]}

    def _set_joint(self, name, x, rates, q, T, drift) -> None:
        m, ids = self.model, self.hinges[name]
        assert all(i < m.njoints for i in ids)
        iq, iv = [m.idx_qs[i] for i in ids], [m.idx_vs[i] for i in ids]
        if not is_ball(name):
            q[iq] = x
            T[iv, SLOTS[name]] = np.eye(len(ids))
            return
        angle = hinge_angles(name, rotation(x))
        E, rate_of_E = hinge_map(name, angle, None)
        own = np.linalg.solve(E, axes(name) @ rates)
        _, rate_of_E = hinge_map(name, angle, own)
        q[iq] = angle
        T[iv, SLOTS[name]] = np.linalg.solve(E, axes(name))
        # w = E(θ) θ'  ⇒  θ'' = E⁻¹ (w' − E' θ')
        drift[iv] = -np.linalg.solve(E, rate_of_E @ own)


def hinge_angles(joint: str, R: np.ndarray) -> np.ndarray:
    """Angles of three hinges about signed y, x, z in series that turn by R."""
    y, x, z = np.arctan2(R[0, 2], R[2, 2]), np.arcsin(np.clip(-R[1, 2], -1, 1)), np.arctan2(R[1, 0], R[1, 1])
    return np.array([y, x, z]) * [d[2] for d in DOFS[joint]]


def hinge_map(joint: str, angle: np.ndarray, rates: np.ndarray | None) -> tuple[np.ndarray, np.ndarray | None]:
    """E with w = E θ' (w in child axes), and its time derivative."""
    a = [axis(d) for d in DOFS[joint]]
    turn = [pin.exp3(a[k] * angle[k]) for k in range(3)]
    E = np.array([turn[2].T @ turn[1].T @ a[0], turn[2].T @ a[1], a[2]]).T
    if rates is None:
        return E, None
    # d/dt (Rᵀ x) = −w × Rᵀ x, with w the rate of the hinges after the column's own, in child axes.
    after = [rates[1] * E[:, 1] + rates[2] * E[:, 2], rates[2] * E[:, 2], np.zeros(3)]
    return E, np.array([-np.cross(after[k], E[:, k]) for k in range(3)]).T


class Mujoco(Engine):
    """The exported MJCF in MuJoCo."""

    def __init__(self, mjcf: Path | str):
        m = mujoco.MjModel.from_xml_path(str(mjcf))
        self.model, self.data = m, mujoco.MjData(m)
        assert m.nv == NV and m.nbody == 19
        self.body = {n: m.body(n).id for n in SEGMENTS}
        self.mass = float(m.body_mass.sum())
        self.names: dict[str, list[str]] = {
            j: ([j] if j == "root" or is_ball(j) else [f"{j}_{d[0]}" for d in DOFS[j]]) for j in JOINTS
        }

    def set(self, positions: np.ndarray, velocity: np.ndarray) -> None:
        p, v = Posture(positions), np.asarray(velocity, float)
        m, d = self.model, self.data
        mujoco.mj_resetData(m, d)
        T = np.zeros((NV, NV))
        wxyz = [3, 0, 1, 2]
        a = m.joint("root").qposadr[0]
        d.qpos[a : a + 3], d.qpos[a + 3 : a + 7] = p.position, p.quaternion[wxyz]
        a = m.joint("root").dofadr[0]
        T[a : a + 3, 3:6] = np.eye(3)
        T[a + 3 : a + 6, 0:3] = p.rotation.T
        for name in JOINTS[1:]:
            x, slot = p.joints[name], SLOTS[name]
            if is_ball(name):
                j = m.joint(name)
                d.qpos[j.qposadr[0] : j.qposadr[0] + 4] = x[wxyz]
                T[j.dofadr[0] : j.dofadr[0] + 3, slot] = axes(name)
            else:
                for k, hinge in enumerate(self.names[name]):
                    j = m.joint(hinge)
                    d.qpos[j.qposadr[0]] = x[k]
                    T[j.dofadr[0], slot.start + k] = 1
        self.T, self.drift = T, np.zeros(NV)  # d/dt (Rᵀ w) = Rᵀ w'
        self.v, self.u = v, T @ v
        d.qvel[:] = self.u
        mujoco.mj_fwdPosition(m, d)
        mujoco.mj_fwdVelocity(m, d)
        assert d.ncon == 0 and d.nefc == 0

    def inverse(self, vdot: np.ndarray) -> np.ndarray:
        self.data.qacc[:] = self._own_acceleration(vdot)
        mujoco.mj_inverse(self.model, self.data)
        return self.T.T @ self.data.qfrc_inverse

    def mass_matrix(self) -> np.ndarray:
        M = np.zeros((NV, NV))
        mujoco.mj_fullM(self.model, self.data, M)
        return self.T.T @ M @ self.T

    def bias(self) -> np.ndarray:
        return self.T.T @ self.data.qfrc_bias

    def forward(self, forces: np.ndarray) -> np.ndarray:
        self.data.qfrc_applied[:] = np.linalg.solve(self.T.T, forces)
        mujoco.mj_forward(self.model, self.data)
        return np.linalg.solve(self.T, self.data.qacc)

    def com(self) -> tuple[np.ndarray, np.ndarray, None, np.ndarray]:
        mujoco.mj_subtreeVel(self.model, self.data)
        J = np.zeros((3, NV))
        mujoco.mj_jacSubtreeCom(self.model, self.data, J, self.body["pelvis"])
        root = self.body["pelvis"]
        return self.data.subtree_com[root].copy(), self.data.subtree_linvel[root].copy(), None, J @ self.T

    def momentum(self) -> tuple[np.ndarray, np.ndarray]:
        mujoco.mj_subtreeVel(self.model, self.data)
        root = self.body["pelvis"]
        return self.data.subtree_linvel[root] * self.mass, self.data.subtree_angmom[root].copy()

    def segment(self, name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        m, d, b = self.model, self.data, self.body[name]
        Jp, Jr, Dp, Dr = (np.zeros((3, NV)) for _ in range(4))
        mujoco.mj_jac(m, d, Jp, Jr, d.xpos[b], b)
        mujoco.mj_jacDot(m, d, Dp, Dr, d.xpos[b], b)
        return (
            d.xpos[b].copy(),
            d.xmat[b].reshape(3, 3).copy(),
            np.vstack([Jr, Jp]) @ self.T,
            np.r_[Dr @ self.u, Dp @ self.u],
        )

    def point_jacobian(self, name: str, world: np.ndarray) -> np.ndarray:
        J = np.zeros((3, NV))
        mujoco.mj_jac(self.model, self.data, J, None, world, self.body[name])
        return J @ self.T


class Dump:
    """What `tools/dump_dynamics.rs` wrote."""

    def __init__(self, directory: Path):
        self.directory = directory
        self.manifest = json.loads((directory / "manifest.json").read_text())
        self.models = [m["name"] for m in self.manifest["models"]]

    def model(self, name: str) -> dict:
        return next(m for m in self.manifest["models"] if m["name"] == name)

    def states(self, name: str) -> list[dict[str, np.ndarray]]:
        width = sum(n for _, n in self.manifest["fields"])
        raw = np.fromfile(self.directory / f"{name}.f64", dtype="<f8").reshape(-1, width)
        out = []
        for row in raw:
            record, at = {}, 0
            for field, n in self.manifest["fields"]:
                record[field] = row[at : at + n]
                at += n
            record["mass_matrix"] = record["mass_matrix"].reshape(NV, NV)
            record["com_jacobian"] = record["com_jacobian"].reshape(3, NV)
            record["segment_position"] = record["segment_position"].reshape(18, 3)
            # Columns were written one after the other.
            record["segment_rotation"] = record["segment_rotation_columns"].reshape(18, 3, 3).transpose(0, 2, 1)
            record["segment_bias"] = record["segment_bias"].reshape(18, 6)
            record["segment_jacobian"] = record["segment_jacobian"].reshape(18, 6, NV)
            for field in ("point_local", "point_world", "point_velocity", "point_bias"):
                record[field] = record[field].reshape(18, 3)
            record["point_jacobian"] = record["point_jacobian"].reshape(18, 3, NV)
            out.append(record)
        return out


def relative(ours: np.ndarray, theirs: np.ndarray) -> float:
    """Largest difference over largest magnitude; infinite if anything is not a number."""
    ours, theirs = np.asarray(ours, float), np.asarray(theirs, float)
    assert ours.shape == theirs.shape, (ours.shape, theirs.shape)
    off = np.abs(ours - theirs).max()
    return float(off / np.abs(theirs).max()) if np.isfinite(off) else float("inf")
