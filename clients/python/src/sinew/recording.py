"""What a figure did, as arrays over time: plot it, tabulate it, keep it."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from sinew.body import Body
from sinew.frame import Event, FigureFrame
from sinew.motion import Floats, Motion
from sinew.v1 import simulation_pb2

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure as Plot

DRAWN: tuple[str, ...] = (
    "root_pose",
    "joint_angles",
    "segment_transforms",
    "torque",
    "torque_limits",
    "contacts",
    "balance",
    "desired",
    "status",
)
"""Fields that a recording has if nothing else is said: enough for plots, strips and tables."""


@dataclass(frozen=True)
class Recording:
    """One figure over `n` ticks. `frames` has each tick whole; the properties have the same as arrays, first axis time.

    A property whose field was not recorded raises `LookupError` and says which field to ask for.
    """

    body: Body
    rate_hz: float
    tick: npt.NDArray[np.int64]
    time_s: Floats
    frames: tuple[FigureFrame, ...]
    events: tuple[Event, ...] = ()
    summary: simulation_pb2.SimulationSummary | None = field(default=None, compare=False)

    @classmethod
    def of(
        cls,
        rows: Sequence[tuple[int, float, FigureFrame]],
        *,
        body: Body,
        rate_hz: float,
        events: Sequence[Event] = (),
        summary: simulation_pb2.SimulationSummary | None = None,
    ) -> Recording:
        """From ticks, times and frames."""
        return cls(
            body=body,
            rate_hz=rate_hz,
            tick=np.array([r[0] for r in rows], dtype=np.int64),
            time_s=np.array([r[1] for r in rows], dtype=np.float64),
            frames=tuple(r[2] for r in rows),
            events=tuple(events),
            summary=summary,
        )

    def __len__(self) -> int:
        return len(self.frames)

    def _stack(self, name: str) -> Floats:
        if not self.frames:
            raise LookupError("the recording is empty")
        values = [getattr(f, name) for f in self.frames]
        if any(v is None for v in values):
            raise LookupError(f"{name!r} was not recorded: ask for it with fields=[..., {name!r}]")
        return np.stack(values)

    @property
    def duration_s(self) -> float:
        """From the first tick to the last."""
        return float(self.time_s[-1] - self.time_s[0]) if len(self) else 0.0

    @property
    def root_pose(self) -> Floats:
        """`(n, 7)`: pelvis position, m, and rotation x, y, z, w."""
        return self._stack("root_pose")

    @property
    def joint_angles(self) -> Floats:
        """`(n, 39)`, rad."""
        return self._stack("joint_angles")

    @property
    def segment_transforms(self) -> Floats:
        """`(n, 18, 7)`: world pose of each segment."""
        return self._stack("segment_transforms")

    @property
    def velocity(self) -> Floats:
        """`(n, 45)`: pelvis rad/s and m/s in world axes, then joint rates, rad/s."""
        return self._stack("velocity")

    @property
    def torque(self) -> Floats:
        """`(n, 39)`: muscle torque, N·m."""
        return self._stack("torque")

    @property
    def torque_limits(self) -> Floats:
        """`(n, 2, 39)`: least and largest torque the muscles could give, N·m."""
        return self._stack("torque_limits")

    @property
    def utilisation(self) -> Floats:
        """`(n, 39)`: torque over the torque available in its direction; 1 is the limit."""
        torque, limits = self.torque, self.torque_limits
        available = np.where(torque < 0, -limits[:, 0], limits[:, 1])
        out: Floats = np.abs(torque) / np.maximum(available, 1e-9)
        return out

    @property
    def saturated(self) -> npt.NDArray[np.bool_]:
        """`(n, 39)`: at the limit of strength."""
        return self._stack("saturated").astype(np.bool_)

    @property
    def com(self) -> Floats:
        """`(n, 3)`: centre of mass, loads included, world, m."""
        if any(f.balance is None for f in self.frames):
            raise LookupError("'balance' was not recorded: ask for it with fields=[..., 'balance']")
        return np.stack([f.balance.com for f in self.frames if f.balance is not None])

    @property
    def margin_m(self) -> Floats:
        """`(n,)`: distance of the zero-moment point inside the support polygon, m; NaN in flight."""
        if any(f.balance is None for f in self.frames):
            raise LookupError("'balance' was not recorded: ask for it with fields=[..., 'balance']")
        margins = [f.balance.margin_m for f in self.frames if f.balance is not None]
        return np.array([np.nan if m is None else m for m in margins])

    @property
    def fell_at_s(self) -> float | None:
        """World time of the first fall, s, if there was one."""
        return next((e.time_s for e in self.events if e.type == "fell"), None)

    def desired(self) -> Motion:
        """The motion that was asked for, prepared for this body."""
        if any(f.desired is None for f in self.frames):
            raise LookupError("'desired' was not recorded: ask for it with fields=[..., 'desired']")
        asked = [f.desired for f in self.frames if f.desired is not None]
        return Motion(
            np.stack([d.joint_angles for d in asked]), np.stack([_unit(d.root_pose) for d in asked]), self.rate_hz
        )

    def motion(self) -> Motion:
        """The motion that came of it."""
        return Motion(self.joint_angles, np.stack([_unit(r) for r in self.root_pose]), self.rate_hz)

    def to_pandas(self) -> pandas.DataFrame:
        """One row per tick, indexed by time: `angle`, `torque`, `lower`, `upper`, `saturated` by DOF, and `root` by coordinate.

        Columns are pairs such as `("torque", "l_knee_flexion")`. What was not recorded is left out. Needs pandas.
        """
        import pandas as pd

        parts: dict[str, pd.DataFrame] = {}
        index = pd.Index(self.time_s, name="time_s")
        dofs = list(self.body.dofs)
        first = self.frames[0] if self.frames else FigureFrame()
        if first.root_pose is not None:
            names = ["x", "y", "z", "qx", "qy", "qz", "qw"]
            parts["root"] = pd.DataFrame(self.root_pose, index=index, columns=names)
        if first.joint_angles is not None:
            parts["angle"] = pd.DataFrame(self.joint_angles, index=index, columns=dofs)
        if first.torque is not None:
            parts["torque"] = pd.DataFrame(self.torque, index=index, columns=dofs)
        if first.torque_limits is not None:
            parts["lower"] = pd.DataFrame(self.torque_limits[:, 0], index=index, columns=dofs)
            parts["upper"] = pd.DataFrame(self.torque_limits[:, 1], index=index, columns=dofs)
        if first.saturated is not None:
            parts["saturated"] = pd.DataFrame(self.saturated, index=index, columns=dofs)
        return pd.concat(parts, axis=1) if parts else pd.DataFrame(index=index)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Arrays to a NumPy `.npz` file: `time_s`, `tick`, `dofs`, and each array that was recorded."""
        arrays: dict[str, npt.NDArray[np.generic]] = {
            "tick": self.tick,
            "time_s": self.time_s,
            "dofs": np.array(self.body.dofs),
            "rate_hz": np.array(self.rate_hz),
        }
        names = ("root_pose", "joint_angles", "segment_transforms", "velocity", "torque", "torque_limits", "saturated")
        for name in names:
            if self.frames and getattr(self.frames[0], name) is not None:
                arrays[name] = self._stack(name)
        np.savez_compressed(path, allow_pickle=False, **arrays)

    def plot_torques(
        self, path: str | os.PathLike[str] | None = None, *, dofs: Sequence[str] | int = 6, title: str = ""
    ) -> Plot:
        """Torques over time within what the muscles could give: limits shaded, saturation marked.

        `dofs`: names, or how many of the hardest-working to show. Written to `path` if given (PNG, SVG, PDF by its ending).
        """
        from sinew.plots import torques

        return torques(self, path, dofs=dofs, title=title)

    def strip(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        frames: int = 7,
        times_s: Sequence[float] | None = None,
        azimuth_deg: float = 55.0,
        title: str = "",
    ) -> Plot:
        """Postures side by side: bodies tinted by effort, the desired posture behind them, loads and ground forces.

        `azimuth_deg` is where the viewer stands: 0 in front of the figure, 90 at its left.
        """
        from sinew.plots import strip

        return strip(self, path, frames=frames, times_s=times_s, azimuth_deg=azimuth_deg, title=title)


def _unit(root_pose: Floats) -> Floats:
    out = root_pose.copy()
    out[3:] /= np.linalg.norm(out[3:])
    return out
