"""Motions: what a figure is asked to do, as arrays or in a file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sinew.v1 import motion_pb2, types_pb2

__all__ = ["Motion", "Pose"]

Floats = NDArray[np.float64]
PathLike: TypeAlias = "str | os.PathLike[str]"

_DOFS = 39


@dataclass(frozen=True, kw_only=True)
class Pose:
    """What is asked of one figure at one instant: joint angles, or bone rotations.

    `angles` (39,): anatomical angles in the order of `Body.dofs`, rad. `rotations`: quaternions x, y, z, w by VRM bone
    name (`Body.bones`), of the bone in its parent, or in the world with `world_rotations`. `root` is the pelvis in the
    world: position (3,), m, or position and quaternion (7,); `None` leaves it where it is asked to be now. `velocity`
    (45,), rad/s and m/s as in `FigureState.velocity`, is formed from neighbouring frames if absent; `planted` says
    which feet (left, right) stand, and the server decides if it is absent.
    """

    angles: ArrayLike | None = None
    rotations: Mapping[str, ArrayLike] | None = None
    world_rotations: bool = False
    root: ArrayLike | None = None
    velocity: ArrayLike | None = None
    planted: tuple[bool, bool] | None = None

    def message(self, figure: str = "") -> motion_pb2.FigureMotion:
        """As it is sent."""
        out = motion_pb2.FigureMotion(figure_id=figure)
        if self.root is not None:
            out.root.CopyFrom(_pose(np.asarray(self.root, dtype=np.float64)))
        if self.angles is not None:
            out.joint_angles_rad.extend(np.asarray(self.angles, dtype=np.float64).ravel().tolist())
        for bone, q in (self.rotations or {}).items():
            out.bone_rotations.add(bone=bone, rotation=_quaternion(np.asarray(q, dtype=np.float64)))
        if self.rotations and self.world_rotations:
            out.rotation_space = motion_pb2.ROTATION_SPACE_WORLD
        if self.velocity is not None:
            out.velocity.extend(np.asarray(self.velocity, dtype=np.float64).ravel().tolist())
        if self.planted is not None:
            out.planted.extend(self.planted)
        return out


@dataclass(frozen=True)
class Motion:
    """A motion as arrays: `angles` (n, 39) in the order of `Body.dofs`, rad, and `root` (n, 7), position (m) and
    quaternion x, y, z, w of the pelvis in the world, at `rate_hz` (Hz).
    """

    angles: Floats
    root: Floats
    rate_hz: float
    planted: NDArray[np.bool_] | None = None
    """Which feet (left, right) stand, (n, 2), if known."""

    def __post_init__(self) -> None:
        n = len(self.angles)
        for name, array, shape in (("angles", self.angles, (n, _DOFS)), ("root", self.root, (n, 7))):
            if np.shape(array) != shape:
                raise ValueError(f"{name} must have shape {shape}, has {np.shape(array)}")
        if self.planted is not None and np.shape(self.planted) != (n, 2):
            raise ValueError(f"planted must have shape {(n, 2)}, has {np.shape(self.planted)}")

    def __len__(self) -> int:
        return len(self.angles)

    @property
    def duration_s(self) -> float:
        """From the first to the last frame, s."""
        return max(len(self) - 1, 0) / self.rate_hz

    def pose(self, row: int) -> Pose:
        """One instant."""
        planted = None if self.planted is None else (bool(self.planted[row, 0]), bool(self.planted[row, 1]))
        return Pose(angles=self.angles[row], root=self.root[row], planted=planted)


def _quaternion(q: Floats) -> types_pb2.Quaternion:
    if q.shape != (4,):
        raise ValueError(f"a rotation has 4 numbers x, y, z, w, got shape {q.shape}")
    x, y, z, w = q.tolist()
    return types_pb2.Quaternion(x=x, y=y, z=z, w=w)


def _pose(p: Floats) -> types_pb2.Pose:
    if p.shape not in ((3,), (7,)):
        raise ValueError(f"a root pose has 3 numbers (position) or 7 (position and quaternion), got shape {p.shape}")
    x, y, z = p[:3].tolist()
    out = types_pb2.Pose(position_m=types_pb2.Vector3(x=x, y=y, z=z))
    if len(p) == 7:
        out.rotation.CopyFrom(_quaternion(p[3:]))
    return out


def is_file(source: object) -> bool:
    """A path to a file, as opposed to the name of a clip."""
    if isinstance(source, os.PathLike):
        return True
    return isinstance(source, str) and source.lower().endswith(".bvh")


def bvh_source(
    source: PathLike | bytes,
    *,
    unit_m: float | None = None,
    up_axis: str = "",
    rate_hz: float | None = None,
    fit_floor: bool = True,
    lock_feet: bool = True,
    cutoff_hz: float = 6.0,
    walk_runs: bool | None = None,
) -> motion_pb2.BvhSource:
    """A file with how to read it."""
    data = source if isinstance(source, bytes) else Path(source).read_bytes()
    options = motion_pb2.BvhOptions(
        unit_m=unit_m,
        up_axis=up_axis,
        rate_hz=rate_hz,
        fit_floor=fit_floor,
        lock_feet=lock_feet,
        cutoff_hz=cutoff_hz,
        walk_runs=walk_runs,
    )
    return motion_pb2.BvhSource(data=data, options=options)
