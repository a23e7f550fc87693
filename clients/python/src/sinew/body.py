"""Bodies: names and order of everything that frames refer to by index, and the shapes to draw."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sinew.motion import Floats
from sinew.v1 import body_pb2
from sinew.values import last


def quat_apply(q: Floats, v: Floats) -> Floats:
    """`v` turned by the unit quaternion(s) `q` (x, y, z, w); the leading shapes broadcast."""
    u, w = q[..., :3], q[..., 3:]
    t = 2.0 * np.cross(u, v)
    out: Floats = v + w * t + np.cross(u, t)
    return out


def quat_mul(a: Floats, b: Floats) -> Floats:
    """Rotation `a` after rotation `b`."""
    av, aw, bv, bw = a[..., :3], a[..., 3:], b[..., :3], b[..., 3:]
    vector = aw * bv + bw * av + np.cross(av, bv)
    scalar = aw * bw - np.sum(av * bv, axis=-1, keepdims=True)
    return np.concatenate([vector, scalar], axis=-1)


@dataclass(frozen=True)
class Segment:
    """One rigid part; its frame sits at the joint to its parent. `vertices` `(n, 3)`, m, and `triangles` `(m, 3)` are its
    surface, empty unless geometry was asked for."""

    name: str
    bone: str
    parent: int
    mass_kg: float
    com_m: Floats
    tip_m: Floats
    offset_m: Floats
    vertices: Floats
    triangles: np.ndarray[tuple[int, int], np.dtype[np.int64]]


@dataclass(frozen=True)
class Body:
    """An immutable body of 18 segments and 39 joint degrees of freedom, in the order of frames."""

    name: str
    segments: tuple[Segment, ...]
    dofs: tuple[str, ...]
    dof_segment: tuple[int, ...]
    lower_rad: Floats
    upper_rad: Floats
    height_m: float
    mass_kg: float

    @classmethod
    def of(cls, message: body_pb2.Body) -> Body:
        """From the protobuf message."""
        segments = tuple(
            Segment(
                name=s.name,
                bone=s.bone,
                parent=s.parent,
                mass_kg=s.mass_kg,
                com_m=np.array([s.com_m.x, s.com_m.y, s.com_m.z]),
                tip_m=np.array([s.tip_m.x, s.tip_m.y, s.tip_m.z]),
                offset_m=np.array([j.offset_m.x, j.offset_m.y, j.offset_m.z]),
                vertices=np.array(s.mesh_vertices_m, dtype=np.float64).reshape(-1, 3),
                triangles=np.array(s.mesh_triangles, dtype=np.int64).reshape(-1, 3),
            )
            for s, j in zip(message.segments, message.joints, strict=True)
        )
        return cls(
            name=last(message.name),
            segments=segments,
            dofs=tuple(d.name for d in message.dofs),
            dof_segment=tuple(d.joint for d in message.dofs),
            lower_rad=np.array([d.lower_rad for d in message.dofs]),
            upper_rad=np.array([d.upper_rad for d in message.dofs]),
            height_m=message.profile.height_m,
            mass_kg=sum(s.mass_kg for s in segments),
        )

    def dof(self, name: str) -> int:
        """Index of a DOF by name."""
        try:
            return self.dofs.index(name)
        except ValueError:
            near = [d for d in self.dofs if name in d or d in name]
            hint = f"; did you mean {', '.join(near)}?" if near else ""
            raise LookupError(f"no DOF {name!r}{hint} (all: {', '.join(self.dofs)})") from None

    def segment(self, name: str) -> int:
        """Index of a segment by name."""
        for i, s in enumerate(self.segments):
            if s.name == name:
                return i
        raise LookupError(f"no segment {name!r} (all: {', '.join(s.name for s in self.segments)})")

    def place(self, root_pose: Floats, joint_rotations: Floats) -> Floats:
        """World pose of each segment, `(18, 7)`, from the pelvis pose `(7,)` and `parent_from_segment` `(17, 4)`."""
        out = np.zeros((len(self.segments), 7))
        out[0] = root_pose
        for i, s in enumerate(self.segments[1:], start=1):
            parent = out[s.parent]
            out[i, :3] = parent[:3] + quat_apply(parent[3:], s.offset_m)
            out[i, 3:] = quat_mul(parent[3:], joint_rotations[i - 1])
        return out
