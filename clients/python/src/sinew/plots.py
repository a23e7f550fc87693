"""Pictures of recordings (matplotlib). They make figures of their own and leave pyplot's state alone, unless there is a notebook."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse, Patch

from sinew.body import quat_apply
from sinew.motion import Floats

if TYPE_CHECKING:
    from sinew.recording import Recording

INK, MUTED, GRID = "#1f2933", "#6b7785", "#e6eaee"
TORQUE, BAND, LIMIT = "#0b6fa4", "#dcebf3", "#c2410c"
EFFORT = LinearSegmentedColormap.from_list("effort", ["#b9c4cf", "#b9c4cf", "#e9b44c", "#c2410c"])
GHOST = "#a9cdea"


def words(dof: str) -> str:
    """`l_knee_flexion` as people say it."""
    side, _, rest = dof.partition("_")
    names = {"l": "left", "r": "right"}
    return (names[side] + " " + rest if side in names else dof).replace("_", " ")


def _write(plot: Figure, path: str | os.PathLike[str] | None) -> Figure:
    if path is not None:
        plot.savefig(path, dpi=144, facecolor="white")
    return plot


def spans(marks: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> list[tuple[int, int]]:
    """First and last index of each run of true."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], marks.astype(np.int8), [0]])))
    return [(int(a), int(b) - 1) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def _busiest(recording: Recording, count: int) -> list[int]:
    """DOFs at their limit the longest, then those that come nearest to it for a while; in the order of the body."""
    use = np.quantile(recording.utilisation, 0.9, axis=0)
    score = recording.saturated.mean(axis=0) * 10.0 + np.minimum(use, 1.0)
    # A wrist at its limit says less than a hip at the same: weigh by torque.
    score += 0.3 * np.abs(recording.torque).max(axis=0) / max(float(np.abs(recording.torque).max()), 1e-9)
    return sorted(int(i) for i in np.argsort(-score, kind="stable")[:count])


def torques(
    recording: Recording, path: str | os.PathLike[str] | None, *, dofs: Sequence[str] | int, title: str
) -> Figure:
    """See `Recording.plot_torques`."""
    chosen = _busiest(recording, dofs) if isinstance(dofs, int) else [recording.body.dof(d) for d in dofs]
    if not chosen:
        raise ValueError("dofs: at least one expected")
    time, torque, limits, saturated = recording.time_s, recording.torque, recording.torque_limits, recording.saturated
    columns = 1 if len(chosen) == 1 else 2 if len(chosen) < 7 else 3
    rows = -(-len(chosen) // columns)
    plot = Figure(figsize=(4.6 * columns + 0.6, 1.95 * rows + 1.25), layout="constrained")
    axes = plot.subplots(rows, columns, sharex=True, squeeze=False)
    heading = title or f"Torque of {recording.body.name.replace('-', ' ')}, within what the muscles could give"
    plot.suptitle(heading, x=0.01, ha="left", fontsize=12.5, color=INK, fontweight="bold")
    fell = recording.fell_at_s
    for at, (axis, dof) in enumerate(zip(axes.flat, chosen)):
        t, low, high, full = torque[:, dof], limits[:, 0, dof], limits[:, 1, dof], saturated[:, dof]
        axis.fill_between(time, low, high, color=BAND, linewidth=0)
        axis.plot(time, low, time, high, color="#9fc3d8", linewidth=0.8)
        axis.axhline(0, color=GRID, linewidth=0.8, zorder=1)
        axis.plot(time, t, color=TORQUE, linewidth=1.5, zorder=3)
        for a, b in spans(full):
            # Red and hatched, and thicker on the line: seen in grey as well. A single tick still gets a visible width.
            half = 0.5 / recording.rate_hz
            axis.axvspan(
                time[a] - half, time[b] + half, facecolor="#f6d5c5", edgecolor="#e2a184", hatch="////", linewidth=0, zorder=1.5,
                alpha=0.75,
            )
            axis.plot(time[a : b + 1], t[a : b + 1], color=LIMIT, linewidth=3.0, solid_capstyle="round", zorder=4)
        # Scaled to the torque and the nearer limit, so that a strong direction does not flatten the rest.
        reach = max(float(np.abs(t).max()), 1e-3)
        top = min(float(high.max()), max(1.9 * float(t.max()), 0.9 * reach))
        bottom = max(float(low.min()), min(1.9 * float(t.min()), -0.9 * reach))
        pad = 0.10 * (top - bottom)
        axis.set_ylim(bottom - pad, top + pad)
        held = float(full.sum()) / recording.rate_hz
        axis.set_title(words(recording.body.dofs[dof]), loc="left", fontsize=10, color=INK)
        if held > 0:
            axis.set_title(f"at its limit for {held:.2f} s", loc="right", fontsize=8.5, color=LIMIT)
        if fell is not None and time[0] <= fell <= time[-1]:
            axis.axvline(fell, color=INK, linewidth=1.0, linestyle=(0, (4, 3)), zorder=2)
            if at == 0:
                axis.annotate(
                    "fell", (fell, 1), xycoords=("data", "axes fraction"), xytext=(3, -10), textcoords="offset points",
                    fontsize=8, color=INK,
                )
        axis.set_xlim(float(time[0]), float(time[-1]))
        axis.tick_params(labelsize=8, colors=MUTED, length=3)
        for name, spine in axis.spines.items():
            spine.set_visible(name in ("left", "bottom"))
            spine.set_color("#c5ccd3")
    for axis in axes.flat[len(chosen) :]:
        axis.set_visible(False)
    for axis in axes[:, 0]:
        axis.set_ylabel("N·m", fontsize=9, color=MUTED)
    for column in range(columns):
        last = max(i for i in range(len(chosen)) if i % columns == column)
        axes.flat[last].set_xlabel("time, s", fontsize=9, color=MUTED)
        axes.flat[last].tick_params(labelbottom=True)
    legend = [
        Line2D([], [], color=TORQUE, linewidth=1.5, label="torque"),
        Patch(facecolor=BAND, edgecolor="#9fc3d8", label="what the muscles could give"),
        Patch(facecolor="#f6d5c5", edgecolor="#e2a184", hatch="////", linewidth=0, label="at the limit"),
    ]
    plot.legend(handles=legend, loc="outside lower left", ncols=3, frameon=False, fontsize=9, labelcolor=INK)
    return _write(plot, path)


def _shade(colour: Floats, light: Floats) -> Floats:
    out: Floats = np.clip(colour[None, :3] * light[:, None], 0.0, 1.0)
    return out


def strip(
    recording: Recording,
    path: str | os.PathLike[str] | None,
    *,
    frames: int,
    times_s: Sequence[float] | None,
    azimuth_deg: float,
    title: str,
) -> Figure:
    """See `Recording.strip`."""
    body = recording.body
    if not any(len(s.vertices) for s in body.segments):
        raise LookupError("the body came without geometry: take the recording with a Client, which asks for it")
    if times_s is None:
        if frames < 1:
            raise ValueError(f"frames: at least 1 expected, {frames} given")
        picks = np.linspace(0, len(recording) - 1, frames).round().astype(int)
    else:
        picks = np.array([int(np.argmin(np.abs(recording.time_s - t))) for t in times_s])
    # Where the viewer stands: `right` and `up` of the picture and the direction towards the viewer, world axes.
    turn, tilt = np.radians(azimuth_deg), np.radians(9.0)
    towards = np.array([np.cos(turn) * np.cos(tilt), np.sin(turn) * np.cos(tilt), np.sin(tilt)])
    right = np.array([-np.sin(turn), np.cos(turn), 0.0])
    up = np.cross(towards, right)
    sun = 0.35 * right + 0.75 * up + 0.55 * towards
    sun /= np.linalg.norm(sun)
    transforms, use = recording.segment_transforms, recording.utilisation
    saturated = recording.saturated
    drawn: list[tuple[Floats, Floats]] = []
    extent = 0.0
    for i in picks:
        origin = transforms[i, 0, :3].copy()
        origin[2] = 0.0
        drawn.append((transforms[i], origin))
        flat = (transforms[i, :, :3] - origin) @ right
        extent = max(extent, float(np.abs(flat).max()) + 0.22)
    pitch = 2.0 * max(extent, 0.34)
    ceiling = max(float((transforms[picks, :, 2]).max()) + 0.34, 1.2)
    width = pitch * len(picks)
    foot = 0.42
    scale = min(14.0 / width, 3.6 / (ceiling + foot))
    plot = Figure(figsize=(width * scale + 0.3, (ceiling + foot) * scale + 0.75), layout="constrained")
    axis = plot.add_subplot()
    axis.set_aspect("equal")
    axis.axis("off")
    axis.axhline(0.0, color="#d5dbe1", linewidth=1.0, zorder=0)
    limited: set[str] = set()
    for slot, (i, (pose, origin)) in enumerate(zip(picks, drawn, strict=True)):
        centre = np.array([(slot + 0.5) * pitch, 0.0])

        def flat(points: Floats, origin: Floats = origin, centre: Floats = centre) -> Floats:
            offset = points - origin
            out: Floats = np.stack([offset @ right, offset @ up], axis=-1) + centre
            return out

        axis.add_patch(Ellipse((centre[0], 0.0), 0.95, 0.17, facecolor="#e3e7eb", linewidth=0, zorder=0.5))
        frame = recording.frames[i]
        if frame.desired is not None and frame.desired.joint_rotations.size:
            ghost = body.place(frame.desired.root_pose, frame.desired.joint_rotations)
            shapes = [
                flat(quat_apply(ghost[k, 3:], s.vertices[s.triangles.ravel()]) + ghost[k, :3]).reshape(-1, 3, 2)
                for k, s in enumerate(body.segments)
                if len(s.triangles)
            ]
            axis.add_collection(PolyCollection(np.concatenate(shapes), facecolor=GHOST, edgecolor=GHOST, linewidth=1.0, zorder=1))
        triangles, colours, depths = [], [], []
        for k, s in enumerate(body.segments):
            if not len(s.triangles):
                continue
            mine = [d for d, owner in enumerate(body.dof_segment) if owner == k]
            effort = float(np.max(use[i, mine])) if mine else 0.0
            if any(saturated[i, d] for d in mine):
                effort = 1.0
                limited.update(words(body.dofs[d]) for d in mine if saturated[i, d])
            world = quat_apply(pose[k, 3:], s.vertices) + pose[k, :3]
            corners = world[s.triangles]
            normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            length = np.linalg.norm(normal, axis=1)
            normal /= np.maximum(length, 1e-12)[:, None]
            seen = (normal @ towards > 0) & (length > 0)
            light = 0.62 + 0.46 * np.clip(normal[seen] @ sun, 0, None)
            triangles.append(flat(corners[seen]))
            colours.append(_shade(np.array(EFFORT(min(effort, 1.0))), light))
            depths.append(corners[seen].mean(axis=1) @ towards)
        order = np.argsort(np.concatenate(depths), kind="stable")
        faces = np.concatenate(colours)[order]
        axis.add_collection(
            PolyCollection(np.concatenate(triangles)[order], facecolor=faces, edgecolor=faces, linewidth=0.4, zorder=2)
        )
        if frame.contacts is not None:
            for segment in np.unique(frame.contacts.segment):
                of = frame.contacts.segment == segment
                force = frame.contacts.force[of].sum(axis=0)
                strength = float(np.linalg.norm(force))
                if strength < 20.0:
                    continue
                weight = np.maximum(frame.contacts.force[of, 2], 0.0) + 1e-9
                place = np.average(frame.contacts.position[of], axis=0, weights=weight)
                start, tip = flat(place), flat(place + 0.45 * force / (body.mass_kg * 9.81))
                axis.annotate(
                    "", xy=(tip[0], tip[1]), xytext=(start[0], start[1]),
                    arrowprops={"arrowstyle": "-|>", "color": "#15803d", "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0}, zorder=4,
                )
        for load in frame.loads:
            where = flat(quat_apply(pose[load.segment, 3:], load.point_m) + pose[load.segment, :3])
            size = 0.062 * (max(load.mass_kg, 0.5) / 5.0) ** (1 / 3)
            axis.add_patch(Ellipse((where[0], where[1]), 2 * size, 2 * size, facecolor="#4b5563", edgecolor="white", zorder=5))
            axis.annotate(
                f"{load.mass_kg:g} kg", (where[0], where[1]), xytext=(0, -size - 0.025), textcoords="offset points",
                fontsize=7.5, color=INK, ha="center", va="center", zorder=6,
            ).xyann = (0, -14)
        axis.text(centre[0], -0.27, f"{recording.time_s[i]:.2f} s", ha="center", va="top", fontsize=9, color=MUTED)
    axis.set_xlim(0, width)
    axis.set_ylim(-foot, ceiling)
    heading = title or body.name.replace("-", " ")
    plot.suptitle(heading, x=0.01, ha="left", fontsize=12.5, color=INK, fontweight="bold")
    legend = [
        Patch(facecolor=GHOST, label="desired"),
        Patch(facecolor=EFFORT(0.3), label="at ease"),
        Patch(facecolor=EFFORT(0.7), label="hard at work"),
        Patch(facecolor=EFFORT(1.0), label="at the limit of strength"),
        Line2D([], [], color="#15803d", linewidth=1.6, label="force of the ground"),
    ]
    plot.legend(handles=legend, loc="outside lower left", ncols=5, frameon=False, fontsize=9, labelcolor=INK)
    return _write(plot, path)
