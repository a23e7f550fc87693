"""Bodies: names, order, limits, masses and shapes; everything that frames refer to by index."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from sinew.rotation import compose, rotate
from sinew.v1 import body_pb2, types_pb2
from sinew.values import last

__all__ = ["Body", "Mesh"]

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Mesh:
    """Closed surface of a segment in the segment frame.

    Vertices (n, 3) in m; triangles (m, 3) are counter-clockwise seen from outside.
    """

    vertices: Floats
    triangles: NDArray[np.int32]


class Body:
    """One body: 18 segments, 39 joint degrees of freedom. It never changes."""

    def __init__(self, message: body_pb2.Body) -> None:
        self.message = message
        """As the server described it."""

    def __repr__(self) -> str:
        return f"Body({self.name!r}, {self.height_m:.2f} m, {self.mass_kg:.1f} kg)"

    @property
    def name(self) -> str:
        """Last part of its resource name, for example `adult-woman`."""
        return last(self.message.name)

    @property
    def height_m(self) -> float:
        """Stature, m."""
        return self.message.profile.height_m

    @cached_property
    def mass_kg(self) -> float:
        """Mass of all segments, kg."""
        return sum(s.mass_kg for s in self.message.segments)

    @cached_property
    def segments(self) -> tuple[str, ...]:
        """Names of the 18 segments in frame order, pelvis first."""
        return tuple(s.name for s in self.message.segments)

    @cached_property
    def bones(self) -> tuple[str, ...]:
        """Canonical bone names (VRM) of the segments."""
        return tuple(s.bone for s in self.message.segments)

    @cached_property
    def parents(self) -> tuple[int, ...]:
        """Index of each segment's parent; -1 for the pelvis."""
        return tuple(s.parent for s in self.message.segments)

    @cached_property
    def dofs(self) -> tuple[str, ...]:
        """Names of the 39 degrees of freedom in frame order, for example `l_knee_flexion`."""
        return tuple(d.name for d in self.message.dofs)

    @cached_property
    def dof_segments(self) -> tuple[int, ...]:
        """Index of the segment that each degree of freedom turns against its parent."""
        return tuple(d.joint for d in self.message.dofs)

    @cached_property
    def angle_limits(self) -> Floats:
        """Least and largest angle of each degree of freedom, rad: (39, 2)."""
        return np.array([(d.lower_rad, d.upper_rad) for d in self.message.dofs], dtype=np.float64)

    def dof(self, name: str) -> int:
        """Index of a degree of freedom by name."""
        try:
            return self.dofs.index(name)
        except ValueError:
            raise KeyError(f"no degree of freedom {name!r}; there are {', '.join(self.dofs)}") from None

    def segment(self, name: str) -> int:
        """Index of a segment by its name or its bone's."""
        names = self.bones if name in self.bones else self.segments
        try:
            return names.index(name)
        except ValueError:
            raise KeyError(f"no segment {name!r}; there are {', '.join(self.segments)}") from None

    @cached_property
    def meshes(self) -> tuple[Mesh, ...]:
        """Surfaces of the segments; empty ones if the body was fetched without geometry."""
        return tuple(
            Mesh(
                np.array(s.mesh_vertices_m, dtype=np.float64).reshape(-1, 3),
                np.array(s.mesh_triangles, dtype=np.int32).reshape(-1, 3),
            )
            for s in self.message.segments
        )

    def poses(self, root_pose: Floats, joint_rotations: Floats) -> Floats:
        """World poses of the segments, (18, 7): position (m), quaternion x, y, z, w.

        `root_pose` (7,): position (m) and quaternion of the pelvis in the world. `joint_rotations` (17, 4): quaternions
        of segments 1 to 17 in their parents.
        """
        rotations = np.asarray(joint_rotations, dtype=np.float64).reshape(-1, 4)
        out = np.empty((len(self.parents), 7))
        out[0] = root_pose
        for i, parent in enumerate(self.parents):
            if i > 0:
                out[i, :3] = out[parent, :3] + rotate(out[parent, 3:], _triple(self.message.joints[i].offset_m))
                out[i, 3:] = compose(out[parent, 3:], rotations[i - 1])
        return out


def _triple(v: types_pb2.Vector3) -> Floats:
    return np.array([v.x, v.y, v.z])
