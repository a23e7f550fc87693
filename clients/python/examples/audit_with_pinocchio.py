# %% [markdown]
# # Audit against Pinocchio
#
# Do the numbers of Sinew satisfy the equations of motion? Somebody else should compute that. We export the body, load
# it into [Pinocchio](https://github.com/stack-of-tasks/pinocchio) and compare, tick by tick,
#
# $$M \dot v + h \quad\text{with}\quad S^T(\tau + \tau_\text{ligament}) + \sum J^T f$$
#
# over all contacts and pushes. Nothing of the right side is computed by the simulator that is checked except the forces
# themselves.

# %%
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pinocchio as pin

import sinew
from sinew.frames import numbers
from sinew.v1 import body_pb2

# %% [markdown]
# The field `audit` is the last integration step of each tick as it was solved. A push at 1 s makes it interesting.

# %%
with sinew.serve() as client:
    recording = client.simulate(
        "squat",
        body="adult-woman",
        disturbances=[sinew.Push(impulse_newton_seconds=(15.0, 5.0, 0.0), start_s=1.0, duration_s=0.2)],
        duration_s=3.0,
        fields=["audit", "status"],
    )
    mjcf = client.export_body("adult-woman")
body = recording.body

# %% [markdown]
# Sinew's velocity is: angular velocity and velocity of the pelvis in world axes, then 39 joint rates; the rates of a
# ball joint lie along the signed axes that the body lists. Pinocchio's is: velocity and angular velocity of the pelvis
# in its own axes, then balls along x, y, z. So $u = T v$, and $\dot u = T \dot v + \dot T v$.

# %%
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "body.mjcf"
    file.write_text(mjcf)
    model = pin.buildModelFromMJCF(str(file))
data = model.createData()
frames = [model.getFrameId(name, pin.FrameType.BODY) for name in body.segments]
axis = np.array([[d.axis.x, d.axis.y, d.axis.z] for d in body.message.dofs])


def in_pinocchio(positions, velocity):
    """q, T and the drift of T for one state; joints stand in the same order."""
    rotation = pin.Quaternion(*positions[[6, 3, 4, 5]]).matrix()
    T, drift = np.zeros((45, 45)), np.zeros(45)
    T[0:3, 3:6] = T[3:6, 0:3] = rotation.T
    drift[0:3] = -rotation.T @ np.cross(velocity[0:3], velocity[3:6])
    for joint in body.message.joints[1:]:
        own = slice(6 + joint.dof_start, 6 + joint.dof_start + joint.dof_count)
        ball = joint.type == body_pb2.JOINT_TYPE_BALL
        T[own, own] = axis[joint.dof_start : joint.dof_start + 3].T if ball else np.eye(joint.dof_count)
    return positions, T, drift


def residual(audit):
    """Of the equations of motion, over the largest term."""
    positions, velocity = numbers(audit.positions), numbers(audit.velocity)
    q, T, drift = in_pinocchio(positions, velocity)
    left = T.T @ pin.rnea(model, data, q, T @ velocity, T @ numbers(audit.acceleration) + drift)
    right = np.zeros(45)
    right[6:] = numbers(audit.torque) + numbers(audit.ligament_torque)
    scale = np.abs(right).max()
    pin.computeJointJacobians(model, data, q)
    pin.updateFramePlacements(model, data)
    for group in (audit.contacts, audit.applied):
        points, forces = numbers(group.position).reshape(-1, 3), numbers(group.force).reshape(-1, 3)
        for segment, point, force in zip(group.segment, points, forces):
            J = pin.getFrameJacobian(model, data, frames[segment], pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
            arm = point - data.oMf[frames[segment]].translation
            term = T.T @ (J[:3].T @ force + J[3:].T @ np.cross(arm, force))
            right += term
            scale = max(scale, np.abs(term).max())
    return np.abs(left - right).max() / scale


# %%
residuals = np.array([residual(m.audit) for m in recording.messages])
outcome = "stands" if recording.fell_at_s is None else "fell"
print(f"{len(residuals)} ticks; largest residual {residuals.max():.1e} of the largest term; {outcome}")
assert residuals.max() < 1e-9

# %% [markdown]
# A check that cannot fail shows nothing: one torque off by a thousandth is seen at once.

# %%
wrong = type(recording.messages[0].audit)()
wrong.CopyFrom(recording.messages[60].audit)
knee = body.dof("r_knee_flexion")
wrong.torque.f64[knee] *= 1.001
print(f"with the right knee's torque off by a thousandth: {residual(wrong):.1e}")
assert residual(wrong) > 1e-6

# %%
drawing, ax = plt.subplots(figsize=(8, 3))
ax.semilogy(recording.time_s, residuals, ".", ms=4, color="#1f5fa8", label="residual, relative")
ax.axhline(np.finfo(float).eps, color="#777c84", lw=1, ls=":", label="rounding of one number")
ax.axhline(1e-9, color="#d01f2e", lw=1, label="what we promise")
ax.axvspan(1.0, 1.2, color="#ecebe6", label="push")
ax.set(xlabel="time, s", ylim=(1e-17, 1e-7), title="Equations of motion, computed by Pinocchio")
ax.legend(ncols=4, fontsize=8, frameon=False, loc="upper center")
drawing.tight_layout()
