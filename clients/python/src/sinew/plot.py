"""Torque over time within its limits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure as Drawing
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from sinew.recording import Recording

INK = "#33373d"
FAINT = "#777c84"
PAPER = "#fbfbf9"
GRID = "#dddbd4"
RANGE = "#dbe6f2"
EDGE = "#9db6d3"
TORQUE = "#1f5fa8"
LIMIT = "#d01f2e"
FALLEN = "#ecebe6"


def words(dof: str) -> str:
    """A name for people: `r_shoulder_flexion` is `right shoulder flexion`."""
    for short, long in (("l_", "left "), ("r_", "right ")):
        if dof.startswith(short):
            dof = long + dof[2:]
    return dof.replace("_", " ")


def plot_torques(recordings: Mapping[str, Recording], dofs: Sequence[str] | None, *, title: str | None) -> Drawing:
    """One column per recording, one row per degree of freedom."""
    if not recordings:
        raise ValueError("there is no recording to plot")
    for r in recordings.values():
        if not len(r):
            raise ValueError(f"the recording of {r.figure!r} has no frames")
    chosen = list(dofs) if dofs is not None else _hardest(list(recordings.values()))
    rows, columns = len(chosen), len(recordings)
    if not rows:
        raise ValueError("no degree of freedom is named")
    width = 8.0 if columns == 1 else min(3.6 * columns + 1.0, 20.0)
    height = 1.55 * rows + 1.35
    drawing = Drawing(figsize=(width, height), facecolor=PAPER)
    axes = drawing.subplots(rows, columns, sharex="col", sharey="row", squeeze=False)
    for column, (name, r) in enumerate(recordings.items()):
        for row, dof in enumerate(chosen):
            ax = axes[row, column]
            _panel(ax, r, dof)
            if column == 0:
                ax.set_title(words(dof), loc="left", fontsize=9.5, color=INK, pad=4)
                ax.set_ylabel("N·m", fontsize=8.5, color=FAINT)
            if row == rows - 1:
                ax.set_xlabel("time, s", fontsize=8.5, color=FAINT)
        if columns > 1:
            axes[0, column].annotate(
                name,
                xy=(0.5, 1.0),
                xytext=(0, 20),
                xycoords="axes fraction",
                textcoords="offset points",
                ha="center",
                fontsize=11,
                fontweight="bold",
                color=INK,
            )
    one = next(iter(recordings.values()))
    heading = f"Joint torques of {one.figure} ({one.body.name})" if columns == 1 else "Joint torques"
    if title is not None:
        heading = title
    inch = 1.0 / height
    drawing.text(0.02, 1 - 0.12 * inch, heading, fontsize=13, color=INK, fontweight="bold", va="top")
    drawing.legend(
        handles=[
            Line2D([], [], color=TORQUE, lw=1.8, label="torque"),
            Patch(facecolor=RANGE, edgecolor=EDGE, label="what the muscles could give"),
            Line2D([], [], color=LIMIT, lw=3.2, label="at the limit"),
            *([Patch(facecolor=FALLEN, edgecolor=GRID, hatch="////", label="fallen")] if _any_fell(recordings) else []),
        ],
        loc="upper left",
        bbox_to_anchor=(0.012, 1 - 0.36 * inch),
        ncols=4,
        frameon=False,
        fontsize=8.5,
        labelcolor=INK,
        handlelength=1.6,
        columnspacing=1.4,
    )
    top = 0.88 if columns == 1 else 1.1
    left = 0.72 / width
    drawing.subplots_adjust(
        left=left,
        right=1 - 0.18 / width,
        top=1 - top * inch,
        bottom=0.46 * inch,
        hspace=0.42,
        wspace=0.08,
    )
    return drawing


def _hardest(recordings: Sequence[Recording]) -> list[str]:
    """The four that matter most: the hardest of each in turn."""
    out: list[str] = []
    ranked = [r.hardest(8) for r in recordings]
    for place in range(8):
        for names in ranked:
            if names[place] not in out and len(out) < 4:
                out.append(names[place])
    return out


def _any_fell(recordings: Mapping[str, Recording]) -> bool:
    return any(r.has("status") and r.fallen.any() for r in recordings.values())


def _panel(ax: Axes, r: Recording, dof: str) -> None:
    d = r.body.dof(dof)
    t, torque = r.time_s, r.torque[:, d]
    lower, upper = r.torque_lower[:, d], r.torque_upper[:, d]
    ax.set_facecolor("white")
    ax.fill_between(t, lower, upper, color=RANGE, lw=0, zorder=1)
    for edge in (lower, upper):
        ax.plot(t, edge, color=EDGE, lw=0.9, zorder=2)
    ax.axhline(0, color=GRID, lw=0.8, zorder=1.5)
    if r.has("status"):
        down = r.fell_at_s
        if down is not None:
            ax.axvspan(down, t[-1], facecolor=FALLEN, edgecolor=GRID, hatch="////", lw=0, zorder=0.5, alpha=0.9)
        at = r.saturated[:, d]
        share = at.mean()
        if at.any():
            ax.fill_between(
                t,
                0,
                1,
                where=_widened(at),
                transform=ax.get_xaxis_transform(),
                color=LIMIT,
                alpha=0.10,
                lw=0,
                zorder=1.2,
            )
        ax.plot(t, torque, color=TORQUE, lw=1.6, zorder=3)
        ax.plot(t, np.where(_widened(at), torque, np.nan), color=LIMIT, lw=3.2, zorder=4, solid_capstyle="round")
        if at.any():
            ax.annotate(
                f"{share * len(t) / r.rate_hz:.1f} s at the limit",
                xy=(1, 1),
                xytext=(0, 4),
                xycoords="axes fraction",
                textcoords="offset points",
                ha="right",
                fontsize=8,
                color=LIMIT,
            )
    else:
        ax.plot(t, torque, color=TORQUE, lw=1.6, zorder=3)
    ax.set_xlim(t[0], t[-1] if len(t) > 1 else t[0] + 1 / r.rate_hz)
    ax.tick_params(labelsize=8, colors=FAINT, length=2.5)
    for side, spine in ax.spines.items():
        spine.set_visible(side in ("left", "bottom"))
        spine.set_color(GRID)


def _widened(at: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """A single tick is a point, which no line shows: it takes its neighbour in."""
    out = at.copy()
    out[1:] |= at[:-1]
    return out
