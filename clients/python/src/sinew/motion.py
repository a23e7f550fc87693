"""Desired motion: arrays on this side, clips on the server."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from typing_extensions import TypeAlias

from sinew.v1 import motion_pb2, types_pb2
from sinew.values import last

Floats: TypeAlias = npt.NDArray[np.float64]
"""An array of 64-bit numbers."""
DOF_COUNT = 39


@dataclass(frozen=True)
class Motion:
    """A motion as arrays at a constant rate.

    `joint_angles` `(n, 39)`: anatomical angles, rad, in the order of `Body.dofs`. `root_pose` `(n, 7)`: pelvis in the world,
    position x, y, z (m) and rotation x, y, z, w; `None`: the pelvis stays where it is asked to be.
    """

    joint_angles: Floats
    root_pose: Floats | None
    rate_hz: float

    def __post_init__(self) -> None:
        angles = np.asarray(self.joint_angles, dtype=np.float64)
        if angles.ndim != 2 or angles.shape[1] != DOF_COUNT:
            raise ValueError(f"joint_angles: shape (n, {DOF_COUNT}) expected, {angles.shape} given")
        object.__setattr__(self, "joint_angles", angles)
        if self.root_pose is not None:
            root = np.asarray(self.root_pose, dtype=np.float64)
            if root.shape != (len(angles), 7):
                raise ValueError(f"root_pose: shape ({len(angles)}, 7) expected, {root.shape} given")
            object.__setattr__(self, "root_pose", root)
        if not self.rate_hz > 0:
            raise ValueError(f"rate_hz: a positive number expected, {self.rate_hz} given")

    @classmethod
    def from_array(cls, array: Floats, *, rate_hz: float) -> Motion:
        """From `(n, 39)` joint angles, or `(n, 46)` with the pelvis pose before them."""
        if array.ndim == 2 and array.shape[1] == DOF_COUNT + 7:
            return cls(array[:, 7:], array[:, :7], rate_hz)
        if array.ndim == 2 and array.shape[1] == DOF_COUNT:
            return cls(array, None, rate_hz)
        raise ValueError(f"motion: shape (n, {DOF_COUNT}) or (n, {DOF_COUNT + 7}) expected, {array.shape} given")

    def __len__(self) -> int:
        return len(self.joint_angles)

    @property
    def duration_s(self) -> float:
        """From the first frame to the last."""
        return (len(self) - 1) / self.rate_hz

    def message(self, i: int) -> motion_pb2.FigureMotion:
        """One frame as it is sent."""
        out = motion_pb2.FigureMotion(joint_angles_rad=self.joint_angles[i].tolist())
        if self.root_pose is not None:
            x, y, z, qx, qy, qz, qw = self.root_pose[i].tolist()
            out.root.position_m.CopyFrom(types_pb2.Vector3(x=x, y=y, z=z))
            out.root.rotation.CopyFrom(types_pb2.Quaternion(x=qx, y=qy, z=qz, w=qw))
        return out

    def messages(self) -> Iterator[motion_pb2.FigureMotion]:
        """All frames as they are sent."""
        return (self.message(i) for i in range(len(self)))


@dataclass(frozen=True)
class Clip:
    """A motion that the server holds. `report` says how its file was understood (a protobuf message), where it was a file."""

    name: str
    builtin: bool
    body: str
    rate_hz: float
    frame_count: int
    duration_s: float
    report: types_pb2.RetargetReport | None = None

    @classmethod
    def of(cls, message: motion_pb2.Clip) -> Clip:
        """From the protobuf message."""
        return cls(
            name=last(message.name),
            builtin=message.builtin,
            body=last(message.body),
            rate_hz=message.rate_hz,
            frame_count=message.frame_count,
            duration_s=message.duration_s,
            report=message.report if message.HasField("report") else None,
        )

    def describe(self) -> str:
        """How the file was understood, in a few lines for people."""
        lines = [f"{self.name}: {self.duration_s:.2f} s, {self.frame_count} frames at {self.rate_hz:g} Hz, for {self.body}"]
        r = self.report
        if r is not None:
            by = "shape" if r.by_structure else "name"
            lines.append(f"  {len(r.mapped)} bones found by {by}; one unit is {r.unit_m:g} m, {r.up_axis} is up")
            lines.append(f"  planted feet slid {100 * r.foot_slide_before_m:.1f} cm, now {100 * r.foot_slide_after_m:.1f} cm")
            if r.missing_bones:
                lines.append(f"  without counterpart: {', '.join(r.missing_bones)}")
            for c in sorted(r.clamped, key=lambda c: -c.max_excess_rad)[:3]:
                lines.append(f"  {c.dof}: up to {np.degrees(c.max_excess_rad):.0f}° beyond its limit, taken back")
            lines.extend(f"  {w}" for w in r.warnings)
        return "\n".join(lines)
