"""Instants of a motion side by side: the body as it is, as it should be, what holds it and what is at its limit."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure as Drawing
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Patch, Polygon
from numpy.typing import NDArray

from sinew.plot import INK, LIMIT, PAPER
from sinew.rotation import matrix, rotate

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from sinew.body import Body
    from sinew.recording import Recording

Floats = NDArray[np.float64]
_Flat: TypeAlias = Callable[[Floats], Floats]

GROUND = "#ecebe6"
SHADOW = "#d6d4cd"
GHOST = "#bfcddd"
LEFT = "#4f93dd"
RIGHT = "#f09345"
TRUNK = "#bdc2cb"
LOAD = "#8a6a4f"
FORCE = "#1f8f55"
FAINT = "#777c84"
NEAR_LIMIT = "#e0a100"

# Share of the strength above which a joint is marked as near its limit.
_NEAR = 0.8
# A force of the body's weight is drawn this long, m; impacts are many times that and end at the second number.
_WEIGHT_LENGTH, _LONGEST = 0.45, 1.0
# After a fall the desired motion goes on alone; a ghost farther off would stand in the next panel, m.
_GHOST_RANGE = 0.5
# Azimuth and elevation of the eye, degrees, relative to the heading of the figure in its first frame.
_VIEWS = {"three-quarter": (-38.0, 14.0), "side": (-90.0, 9.0), "front": (0.0, 9.0)}
_LAMP = np.array([-0.35, 0.55, 0.75]) / np.linalg.norm([-0.35, 0.55, 0.75])
_DENSITY = 700.0


@dataclass(frozen=True)
class _Camera:
    """An orthographic eye: right, up and towards it, world axes, as rows."""

    axes: Floats

    @classmethod
    def of(cls, view: str, heading: float) -> _Camera:
        if view not in _VIEWS:
            raise ValueError(f"{view!r} is none of {', '.join(_VIEWS)}")
        azimuth, elevation = np.radians(_VIEWS[view])
        azimuth += heading
        near = np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
        right = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
        return cls(np.stack([right, np.cross(near, right), near]))

    def __call__(self, points: Floats) -> Floats:
        """Right, up and nearness of world points (..., 3)."""
        return points @ self.axes.T


def strip(recordings: Mapping[str, Recording], count: int, *, view: str, title: str | None) -> Drawing:
    """One row per recording, `count` evenly spaced instants each, all at one scale."""
    if not recordings:
        raise ValueError("there is no recording to draw")
    if count < 1:
        raise ValueError(f"count must be at least 1, is {count}")
    for r in recordings.values():
        if not len(r):
            raise ValueError(f"the recording of {r.figure!r} has no frames")
    rows = [_Row(r, count, view) for r in recordings.values()]
    step = max(row.step for row in rows)
    spans = [row.span for row in rows]
    inch = 1.5  # inches per metre
    heights = [high - low for low, high in spans]
    panels = max(len(row.instants) for row in rows)
    names = len(rows) > 1
    width = max(panels * step * inch + 0.3, 6.5)
    gap, head, foot = 0.26, 0.36, 0.42
    height = sum(h * inch + gap for h in heights) + head + foot
    drawing = Drawing(figsize=(width, height), facecolor=PAPER)
    top = height - head
    for row, (low, high), name in zip(rows, spans, recordings):
        tall = (high - low) * inch
        ax = drawing.add_axes((0.0, (top - gap - tall) / height, 1.0, tall / height))
        ax.set_axis_off()
        middle = (len(row.instants) - 1) * step / 2
        half = width / inch / 2
        ax.set_xlim(middle - half, middle + half)
        ax.set_ylim(low, high)
        row.draw(ax, step)
        for k, i in enumerate(row.instants):
            label = f"{row.r.time_s[i]:.2f} s"
            ax.text(k * step, high, label, ha="center", va="bottom", fontsize=9, color=FAINT, clip_on=False)
        if names:
            drawing.text(0.02, (top - gap + 0.07) / height, name, fontsize=10.5, fontweight="bold", color=INK)
        top -= tall + gap
    one = next(iter(recordings.values()))
    heading = title if title is not None else (", ".join(recordings) if names else f"{one.figure} ({one.body.name})")
    drawing.text(0.02, 1 - 0.14 / height, heading, fontsize=13, fontweight="bold", color=INK, va="top")
    drawing.legend(
        handles=_legend(rows),
        loc="lower center",
        bbox_to_anchor=(0.5, 0.06 / height),
        ncols=7,
        frameon=False,
        fontsize=8.5,
        labelcolor=INK,
        handlelength=1.3,
        columnspacing=1.3,
        borderaxespad=0.0,
    )
    return drawing


def _legend(rows: list[_Row]) -> list[Line2D | Patch]:
    def ring(colour: str, label: str) -> Line2D:
        return Line2D([], [], ls="", marker="o", mfc="none", mec=colour, mew=1.8, ms=8, label=label)

    out: list[Line2D | Patch] = [Patch(color=LEFT, label="left"), Patch(color=RIGHT, label="right")]
    if any(row.r.has("desired") for row in rows):
        out.append(Patch(color=GHOST, label="as asked for"))
    if any(row.r.has("contacts") for row in rows):
        out.append(Line2D([], [], color=FORCE, lw=2.2, label="contact force"))
    if any(row.loaded for row in rows):
        out.append(Line2D([], [], ls="", marker="o", color=LOAD, ms=7, label="load"))
    out.append(ring(NEAR_LIMIT, f"joint above {_NEAR:.0%} of its strength"))
    out.append(ring(LIMIT, "joint at its limit"))
    return out


class _Row:
    """One figure over its instants."""

    def __init__(self, r: Recording, count: int, view: str) -> None:
        self.r = r
        self.instants = list(dict.fromkeys(np.linspace(0, len(r) - 1, count).round().astype(int).tolist()))
        q = r.root_pose[0, 3:]
        forward = rotate(q, np.array([1.0, 0.0, 0.0]))
        self.camera = _Camera.of(view, float(np.arctan2(forward[1], forward[0])))
        self.weight = r.body.mass_kg * 9.81
        self.loaded = r.has("status") and any(r.loads(i) for i in self.instants)
        points = [self.camera(p - self._centre(i)) for i in self.instants for p in self._corners(i)]
        cloud = np.concatenate(points)
        self.step = float(max(np.ptp(cloud[:, 0]) + 0.18, 0.85))
        self.span = (float(cloud[:, 1].min()) - 0.10, float(cloud[:, 1].max()) + 0.06)

    def _centre(self, i: int) -> Floats:
        """The point of the ground below the pelvis."""
        out = self.r.root_pose[i, :3].copy()
        out[2] = 0.0
        return out

    def _corners(self, i: int) -> list[Floats]:
        """What a panel must have room for."""
        out = [_skin(self.r.body, s, pose) for s, pose in enumerate(self.r.segment_transforms[i])]
        for s, point, mass in self.r.loads(i) if self.r.has("status") else []:
            pose = self.r.segment_transforms[i, s]
            at, radius = pose[:3] + rotate(pose[3:], point), _radius(mass)
            out.append(np.stack([at - radius, at + radius]))
        return out

    def draw(self, ax: Axes, step: float) -> None:
        """All instants."""
        for k, i in enumerate(self.instants):
            self._panel(ax, i, np.array([k * step, 0.0]), step)

    def _panel(self, ax: Axes, i: int, origin: Floats, step: float) -> None:
        r, centre = self.r, self._centre(i)
        half = 0.5 * (step - 0.06)

        def flat(points: Floats) -> Floats:
            return self.camera(points - centre)[..., :2] + origin

        # A tile of ground: as wide as the panel on the screen, whatever the eye's azimuth.
        right, away = self.camera.axes[0], np.cross(self.camera.axes[0], [0.0, 0.0, 1.0])
        tile = centre + np.array([a * half * right + b * 0.5 * away for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
        ax.add_patch(Polygon(flat(tile), facecolor=GROUND, edgecolor="none", zorder=0))
        poses = r.segment_transforms[i]
        self._shadow(ax, poses, flat)
        if r.has("desired"):
            desired = r.body.poses(r.desired_root_pose[i], r.desired_joint_rotations[i])
            if np.linalg.norm(desired[0, :3] - poses[0, :3]) < _GHOST_RANGE:
                self._solid(ax, desired, flat, centre, [], ghost=True)
        self._solid(ax, poses, flat, centre, r.loads(i) if r.has("status") else [], ghost=False)
        if r.has("contacts"):
            self._forces(ax, i, flat)
        if r.has("torque") and r.has("torque_limits"):
            self._rings(ax, i, poses, flat)

    def _shadow(self, ax: Axes, poses: Floats, flat: _Flat) -> None:
        for s, pose in enumerate(poses):
            points = _skin(self.r.body, s, pose)
            points = np.column_stack([points[:, :2], np.zeros(len(points))])
            ax.add_patch(Polygon(_hull(flat(points)), facecolor=SHADOW, edgecolor="none", zorder=1))

    def _solid(
        self,
        ax: Axes,
        poses: Floats,
        flat: _Flat,
        centre: Floats,
        loads: list[tuple[int, Floats, float]],
        *,
        ghost: bool,
    ) -> None:
        corners, depth, colours = [], [], []
        near = self.camera.axes[2]
        parts: list[tuple[Floats, NDArray[np.int32], str]] = []
        for s, pose in enumerate(poses):
            mesh = self.r.body.meshes[s]
            name = self.r.body.segments[s]
            colour = GHOST if ghost else LEFT if name.startswith("l_") else RIGHT if name.startswith("r_") else TRUNK
            parts.append((_skin(self.r.body, s, pose), mesh.triangles, colour))
        for s, point, mass in loads:
            vertices, triangles = _ball(_radius(mass))
            parts.append((vertices + poses[s, :3] + rotate(poses[s, 3:], point), triangles, LOAD))
        for points, triangles, colour in parts:
            faces = points[triangles]
            normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
            size = np.linalg.norm(normals, axis=1)
            normals /= np.maximum(size, 1e-12)[:, None]
            seen = (normals @ near > 0) & (size > 0)
            lamp = self.camera.axes.T @ _LAMP
            # The mean normal of a face's corners: a round limb looks round, whatever its triangles.
            smooth = _normals(points, triangles)[triangles[seen]].mean(axis=1)
            light = 0.70 + 0.36 * np.clip(smooth @ lamp, -0.3, 1) if not ghost else np.ones(int(seen.sum()))
            corners.append(flat(faces[seen]))
            depth.append((faces[seen] - centre).mean(axis=1) @ near)
            base = np.array([int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)])
            colours.append(np.clip(light[:, None] * base, 0, 1))
        order = np.argsort(np.concatenate(depth))
        paint = np.concatenate(colours)[order]
        ax.add_collection(
            PolyCollection(
                list(np.concatenate(corners)[order]),
                facecolors=list(map(tuple, paint)),
                edgecolors=list(map(tuple, paint)),  # closes the seams that antialiasing leaves
                linewidths=0.35,
                zorder=2 if ghost else 3,
            ),
            autolim=False,
        )

    def _forces(self, ax: Axes, i: int, flat: _Flat) -> None:
        gathered: dict[str, list[tuple[Floats, Floats]]] = {}
        for c in self.r.contacts(i):
            gathered.setdefault(c.segment, []).append((c.position, c.force))
        for touching in gathered.values():
            force = np.sum([f for _, f in touching], axis=0)
            size = float(np.linalg.norm(force))
            length = min(size / self.weight * _WEIGHT_LENGTH, _LONGEST)
            if length < 0.02:
                continue
            weights = np.array([np.linalg.norm(f) for _, f in touching])
            at = np.average([p for p, _ in touching], axis=0, weights=weights)
            start, end = flat(np.stack([at, at + force / size * length]))
            ax.annotate(
                "",
                xy=tuple(end),
                xytext=tuple(start),
                arrowprops={
                    "arrowstyle": "-|>",
                    "color": FORCE,
                    "lw": 1.8,
                    "shrinkA": 0,
                    "shrinkB": 0,
                    "mutation_scale": 8,
                },
                zorder=5,
            )

    def _rings(self, ax: Axes, i: int, poses: Floats, flat: _Flat) -> None:
        if self.r.has("status") and self.r.fallen[i]:
            return  # a body on the ground no longer does what was asked
        used = np.nan_to_num(self.r.utilisation[i])
        for s in range(1, len(poses)):
            dofs = [d for d, owner in enumerate(self.r.body.dof_segments) if owner == s]
            share = max(used[dofs])
            at_limit = self.r.has("status") and bool(self.r.saturated[i, dofs].any())
            if at_limit or share > _NEAR:
                colour = LIMIT if at_limit else NEAR_LIMIT
                place = tuple(flat(poses[s, :3]))
                ax.add_patch(Circle(place, 0.058, fill=False, edgecolor="white", lw=3.2, zorder=6))
                ax.add_patch(Circle(place, 0.058, fill=False, edgecolor=colour, lw=1.9, zorder=7))


def _skin(body: Body, segment: int, pose: Floats) -> Floats:
    """World vertices of one segment."""
    out: Floats = pose[:3] + body.meshes[segment].vertices @ matrix(pose[3:]).T
    return out


def _normals(points: Floats, triangles: NDArray[np.int32]) -> Floats:
    """Unit normals of the vertices, faces weighted by area."""
    faces = points[triangles]
    normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    out = np.zeros_like(points)
    for corner in range(3):
        np.add.at(out, triangles[:, corner], normals)
    out /= np.maximum(np.linalg.norm(out, axis=1), 1e-12)[:, None]
    return out


def _radius(mass_kg: float) -> float:
    """Of a ball of wood."""
    return float(np.cbrt(3 * mass_kg / (4 * np.pi * _DENSITY)))


def _ball(radius: float) -> tuple[Floats, NDArray[np.int32]]:
    rings, sectors = 10, 18
    t, p = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.arange(sectors) * 2 * np.pi / sectors, indexing="ij")
    vertices = radius * np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1).reshape(-1, 3)
    triangles = []
    for i in range(rings):
        for j in range(sectors):
            a, b = i * sectors + j, i * sectors + (j + 1) % sectors
            c, d = a + sectors, b + sectors
            triangles += [(a, c, b), (b, c, d)]
    return vertices, np.array(triangles, dtype=np.int32)


def _hull(points: Floats) -> Floats:
    """Corners of the convex hull in the plane (monotone chain)."""
    order = points[np.lexsort((points[:, 1], points[:, 0]))]

    def chain(sequence: Floats) -> list[Floats]:
        out: list[Floats] = []
        for p in sequence:
            while len(out) >= 2:
                a, b = out[-1] - out[-2], p - out[-2]
                if a[0] * b[1] - a[1] * b[0] > 0:
                    break
                out.pop()
            out.append(p)
        return out[:-1]

    return np.array(chain(order) + chain(order[::-1]))
