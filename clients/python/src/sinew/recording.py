"""Recordings: what one figure did over many ticks, as arrays, plots, strips and tables."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from sinew._optional import needed
from sinew.body import Body
from sinew.errors import named
from sinew.frames import Contact, Event, bits, numbers
from sinew.v1 import body_pb2, frame_pb2, simulation_pb2, types_pb2

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure as Drawing

__all__ = ["RECORDED", "Recording", "Recordings", "Saturation"]

Floats = NDArray[np.float64]
PathLike: TypeAlias = "str | os.PathLike[str]"

RECORDED = (
    "root_pose",
    "joint_angles",
    "segment_transforms",
    "velocity",
    "torque",
    "torque_limits",
    "contacts",
    "balance",
    "desired",
    "status",
)
"""Fields of a recording unless others are asked for."""

_FALLEN = 1 << 6
_FORMAT = "sinew-recording-1"


@dataclass(frozen=True)
class Saturation:
    """An interval of world time (s) in which one degree of freedom (by name) was at the limit of its strength."""

    dof: str
    start_s: float
    end_s: float


@dataclass(repr=False, eq=False)
class Recording:
    """What one figure did. Rows of all arrays are ticks; a quantity that was not recorded raises `AttributeError`."""

    figure: str
    """Last part of the figure's name."""
    body: Body
    """Names, order and shape."""
    rate_hz: float
    """Ticks per second."""
    tick: NDArray[np.int64]
    """Ticks, (n,)."""
    time_s: Floats
    """World time, s, (n,)."""
    messages: Sequence[frame_pb2.FigureFrame]
    """The frames as they came."""
    events: list[Event] = field(default_factory=list)
    """What happened, where the call returns events (`Client.simulate`)."""
    summary: simulation_pb2.SimulationSummary | None = field(default=None)
    """Figures of merit (`Client.simulate`)."""
    report: types_pb2.RetargetReport | None = field(default=None)
    """How a motion capture file was understood (`Client.simulate` of a file)."""
    _cache: dict[str, Floats] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.time_s)

    def __repr__(self) -> str:
        return f"Recording({self.figure!r}, {self.body.name!r}, {len(self)} ticks at {self.rate_hz:g} Hz)"

    @property
    def duration_s(self) -> float:
        """From the first to the last tick, s."""
        return float(self.time_s[-1] - self.time_s[0]) if len(self) else 0.0

    def has(self, name: str) -> bool:
        """Whether a field of `FigureFrame` was recorded, for example `torque`."""
        return bool(self.messages) and self.messages[0].HasField(name)  # type: ignore[arg-type]

    def _need(self, name: str) -> None:
        if not self.has(name):
            raise AttributeError(f"the recording of {self.figure!r} has no {name}: record with fields=[..., {name!r}]")

    def _column(self, name: str) -> Floats:
        """One plain field of every frame, stacked."""
        if name not in self._cache:
            self._need(name)
            self._cache[name] = np.stack([numbers(getattr(m, name)) for m in self.messages])
        return self._cache[name]

    def _inner(self, outer: str, name: str, width: int) -> Floats:
        """One field of a part of every frame, NaN where it is empty."""
        key = f"{outer}.{name}"
        if key not in self._cache:
            self._need(outer)
            out = np.full((len(self), width), np.nan)
            for row, m in zip(out, self.messages):
                values = numbers(getattr(getattr(m, outer), name))
                if len(values):
                    row[:] = values
            self._cache[key] = out
        return self._cache[key]

    def _status(self) -> list[frame_pb2.Status]:
        self._need("status")
        return [m.status for m in self.messages]

    @property
    def root_pose(self) -> Floats:
        """Pelvis in the world: position (m), quaternion x, y, z, w; (n, 7)."""
        return self._column("root_pose")

    @property
    def joint_angles(self) -> Floats:
        """Anatomical angles in the order of `body.dofs`, rad, (n, 39)."""
        return self._column("joint_angles")

    @property
    def segment_transforms(self) -> Floats:
        """World pose of each segment, as in `body.segments`: position (m), quaternion x, y, z, w; (n, 18, 7)."""
        return self._column("segment_transforms").reshape(len(self), -1, 7)

    @property
    def velocity(self) -> Floats:
        """Velocity of the pelvis, then joint rates (rad/s), (n, 45).

        The first six: angular velocity (rad/s) and velocity of the pelvis origin (m/s), both in world axes.
        """
        return self._column("velocity")

    @property
    def acceleration(self) -> Floats:
        """Mean time derivative of `velocity` over each tick, rad/s² and m/s², (n, 45)."""
        return self._column("acceleration")

    @property
    def torque(self) -> Floats:
        """Muscle torque, N·m, mean of each tick, (n, 39)."""
        return self._column("torque")

    @property
    def torque_lower(self) -> Floats:
        """Least torque that the muscles could give (negative), N·m, (n, 39)."""
        return self._column("torque_limits")[:, : len(self.body.dofs)]

    @property
    def torque_upper(self) -> Floats:
        """Largest torque that the muscles could give, N·m, (n, 39)."""
        return self._column("torque_limits")[:, len(self.body.dofs) :]

    @property
    def utilisation(self) -> Floats:
        """Torque relative to what was available in its direction, (n, 39); 1 is the limit."""
        t = self.torque
        out: Floats = t / np.where(t >= 0, self.torque_upper, self.torque_lower)
        return out

    @property
    def saturated(self) -> NDArray[np.bool_]:
        """Which degrees of freedom were at the limit of their strength, (n, 39)."""
        return np.stack([bits(s.saturated, len(self.body.dofs)) for s in self._status()])

    @property
    def fallen(self) -> NDArray[np.bool_]:
        """In which ticks the figure counted as fallen, (n,)."""
        return np.array([bool(s.flags & _FALLEN) for s in self._status()])

    @property
    def fell_at_s(self) -> float | None:
        """When the figure first counted as fallen, s; `None` if it never did."""
        down = np.flatnonzero(self.fallen)
        return float(self.time_s[down[0]]) if len(down) else None

    @property
    def tracking_joint_rms_deg(self) -> Floats:
        """Root mean square of the joint angle errors at the start of each tick, degrees, (n,).

        Measured against the target, which is moved along with the feet after each step.
        """
        return np.array([np.degrees(s.tracking_joint_rms_rad) for s in self._status()], dtype=np.float64)

    @property
    def com(self) -> Floats:
        """Centre of mass after each tick, loads included, world, m, (n, 3)."""
        return self._inner("balance", "com", 3)

    @property
    def com_velocity(self) -> Floats:
        """Velocity of that centre of mass, world axes, m/s, (n, 3)."""
        return self._inner("balance", "com_velocity", 3)

    @property
    def zmp(self) -> Floats:
        """Zero-moment point, world, m, (n, 3); NaN in flight."""
        return self._inner("balance", "zmp", 3)

    @property
    def margin_m(self) -> Floats:
        """Distance of the zero-moment point inside the support polygon, m, (n,); negative outside, NaN in flight."""
        self._need("balance")
        return np.array([m.balance.margin_m if m.balance.HasField("margin_m") else np.nan for m in self.messages])

    @property
    def desired_root_pose(self) -> Floats:
        """Pelvis that was asked for, world: position (m), quaternion x, y, z, w; (n, 7)."""
        return self._inner("desired", "root_pose", 7)

    @property
    def desired_joint_angles(self) -> Floats:
        """Angles that were asked for, rad, (n, 39)."""
        return self._inner("desired", "joint_angles", len(self.body.dofs))

    @property
    def desired_joint_rotations(self) -> Floats:
        """Joint rotations asked for: quaternions x, y, z, w of segments 1 to 17 in their parents, (n, 17, 4)."""
        return self._inner("desired", "joint_rotations", 68).reshape(len(self), -1, 4)

    def contacts(self, row: int) -> list[Contact]:
        """Points that touch the ground in one tick, by row: world position (m) and force on the figure (N)."""
        self._need("contacts")
        c = self.messages[row].contacts
        where, force = numbers(c.position).reshape(-1, 3), numbers(c.force).reshape(-1, 3)
        return [Contact(self.body.segments[s], p, f) for s, p, f in zip(c.segment, where, force)]

    @property
    def contact_force(self) -> Floats:
        """Sum of all contact forces on the figure, world axes, N, (n, 3)."""
        self._need("contacts")
        return np.stack([numbers(m.contacts.force).reshape(-1, 3).sum(axis=0) for m in self.messages])

    def loads(self, row: int) -> list[tuple[int, Floats, float]]:
        """Loads carried at the end of one tick: index of the segment, point in its frame (m, (3,)), mass (kg)."""
        carried = self._status()[row].loads
        return [(c.segment, np.array([c.point_m.x, c.point_m.y, c.point_m.z]), c.mass_kg) for c in carried]

    def saturations(self, *, least_s: float = 0.0) -> list[Saturation]:
        """Intervals at the limit of strength that last at least `least_s` (s), by time."""
        at, dt = self.saturated, 1.0 / self.rate_hz
        out = []
        for d, name in enumerate(self.body.dofs):
            for first, final in _runs(at[:, d]):
                start, end = float(self.time_s[first]) - dt, float(self.time_s[final])
                if end - start >= least_s:
                    out.append(Saturation(name, start, end))
        return sorted(out, key=lambda s: (s.start_s, s.dof))

    def hardest(self, count: int = 4) -> list[str]:
        """The degrees of freedom that came closest to their limits, hardest first.

        Ordered by time at the limit, then by share of it.
        """
        stand = np.ones(len(self), dtype=np.bool_)
        score = np.zeros(len(self.body.dofs))
        if self.has("status"):
            # Ticks after a fall say nothing about the task.
            stand = stand if self.fallen.all() else ~self.fallen
            score += self.saturated[stand].sum(axis=0)
        share = np.nan_to_num(self.utilisation[stand], nan=0.0, posinf=0.0, neginf=0.0)
        score += np.clip(np.percentile(share, 98, axis=0), 0, 1)
        return [self.body.dofs[i] for i in np.argsort(-score, kind="stable")[:count]]

    def plot_torques(self, dofs: Sequence[str] | None = None, *, title: str | None = None) -> Drawing:
        """Torque over time within its limits, one panel per degree of freedom.

        The four hardest unless `dofs` names others. The range that the muscles could give is shaded; ticks at the limit
        are marked. Returns a matplotlib figure.
        """
        with needed("matplotlib", "plot", "plotting"):
            from sinew.plot import plot_torques
        return plot_torques({self.figure: self}, dofs, title=title)

    def strip(self, count: int = 7, *, view: str = "three-quarter", title: str | None = None) -> Drawing:
        """Evenly spaced instants side by side.

        Solid body, desired posture as a ghost, contact forces, joints at their limits. `view` is `three-quarter`,
        `side` or `front`. Returns a matplotlib figure.
        """
        with needed("matplotlib", "plot", "a strip"):
            from sinew.strip import strip
        return strip({self.figure: self}, count, view=view, title=title)

    def to_pandas(self) -> pandas.DataFrame:
        """A table indexed by time: columns (quantity, part), as `df["torque"]["r_elbow_flexion"]`. Needs pandas."""
        with needed("pandas", "pandas", "a table"):
            import pandas as pd
        parts: dict[tuple[str, str], Any] = {("tick", ""): self.tick}

        def add(quantity: str, names: Sequence[str], values: NDArray[Any]) -> None:
            for k, n in enumerate(names):
                parts[quantity, n] = values[:, k]

        dofs = self.body.dofs
        if self.has("root_pose"):
            add("root_pose", ("x", "y", "z", "qx", "qy", "qz", "qw"), self.root_pose)
        for name in ("joint_angles", "torque", "ligament_torque"):
            if self.has(name):
                add(name, dofs, self._column(name))
        if self.has("torque_limits"):
            add("torque_lower", dofs, self.torque_lower)
            add("torque_upper", dofs, self.torque_upper)
        if self.has("velocity"):
            add("joint_rates", dofs, self.velocity[:, 6:])
        if self.has("balance"):
            add("com", ("x", "y", "z"), self.com)
            add("com_velocity", ("x", "y", "z"), self.com_velocity)
            add("zmp", ("x", "y", "z"), self.zmp)
            parts["margin_m", ""] = self.margin_m
        if self.has("contacts"):
            add("contact_force", ("x", "y", "z"), self.contact_force)
        if self.has("status"):
            add("saturated", dofs, self.saturated)
            parts["tracking_joint_rms_deg", ""] = self.tracking_joint_rms_deg
            parts["fallen", ""] = self.fallen
        table = pd.DataFrame(parts, index=pd.Index(self.time_s, name="time_s"))
        table.columns = pd.MultiIndex.from_tuples(list(parts), names=("quantity", "part"))
        return table

    def save(self, path: PathLike) -> None:
        """Writes the frames and the body to one compressed `.npz` file that `Recording.load` reads."""
        raw = [m.SerializeToString() for m in self.messages]
        np.savez_compressed(
            path,
            format=np.array(_FORMAT),
            figure=np.array(self.figure),
            rate_hz=np.array(self.rate_hz),
            tick=self.tick,
            time_s=self.time_s,
            body=np.frombuffer(self.body.message.SerializeToString(), dtype=np.uint8),
            frames=np.frombuffer(b"".join(raw), dtype=np.uint8),
            lengths=np.array([len(r) for r in raw], dtype=np.int64),
        )

    @classmethod
    def load(cls, path: PathLike) -> Recording:
        """Reads what `save` wrote (without events and summary)."""
        with np.load(path, allow_pickle=False) as z:
            if "format" not in z or str(z["format"]) != _FORMAT:
                raise ValueError(f"{os.fspath(path)} is not a recording of sinew")
            data, ends = z["frames"].tobytes(), np.cumsum(z["lengths"])
            starts = ends - z["lengths"]
            messages = [frame_pb2.FigureFrame.FromString(data[a:b]) for a, b in zip(starts, ends)]
            body = Body(body_pb2.Body.FromString(z["body"].tobytes()))
            return cls(str(z["figure"]), body, float(z["rate_hz"]), z["tick"], z["time_s"], messages)


class Recordings(Mapping[str, Recording]):
    """Recordings of several figures of one world over the same ticks, by name."""

    def __init__(self, recordings: Mapping[str, Recording]) -> None:
        self._recordings = dict(recordings)

    def __getitem__(self, name: str) -> Recording:
        try:
            return self._recordings[name]
        except KeyError:
            raise KeyError(f"no recording of {name!r}; {named(list(self._recordings))}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._recordings)

    def __len__(self) -> int:
        return len(self._recordings)

    def __repr__(self) -> str:
        return f"Recordings({', '.join(self)})"

    def plot_torques(self, dofs: Sequence[str] | None = None, *, title: str | None = None) -> Drawing:
        """As `Recording.plot_torques`: one column per figure, one row per degree of freedom."""
        with needed("matplotlib", "plot", "plotting"):
            from sinew.plot import plot_torques
        return plot_torques(self._recordings, dofs, title=title)

    def strip(self, count: int = 7, *, view: str = "three-quarter", title: str | None = None) -> Drawing:
        """As `Recording.strip`: one row per figure, at one scale."""
        with needed("matplotlib", "plot", "a strip"):
            from sinew.strip import strip
        return strip(self._recordings, count, view=view, title=title)

    def to_pandas(self) -> pandas.DataFrame:
        """The tables of all figures side by side: columns (figure, quantity, part)."""
        with needed("pandas", "pandas", "a table"):
            import pandas as pd
        return pd.concat({name: r.to_pandas() for name, r in self.items()}, axis=1, names=["figure"])


def _runs(at: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """First and last index of every run of `True`."""
    edges = np.diff(np.concatenate(([False], at, [False])).astype(np.int8))
    return list(zip(np.flatnonzero(edges == 1).tolist(), (np.flatnonzero(edges == -1) - 1).tolist()))


def collect(
    frames: Sequence[frame_pb2.WorldFrame],
    names: Mapping[int, tuple[str, Body]],
    rate_hz: float,
) -> Recordings:
    """Recordings from frames; `names` gives name and body by figure index."""
    rows: dict[int, list[tuple[int, float, frame_pb2.FigureFrame]]] = {}
    for f in frames:
        for m in f.figures:
            if m.figure_index in names:
                rows.setdefault(m.figure_index, []).append((f.tick, f.time_s, m))
    return Recordings(
        {
            names[i][0]: Recording(
                names[i][0],
                names[i][1],
                rate_hz,
                np.array([r[0] for r in rows[i]], dtype=np.int64),
                np.array([r[1] for r in rows[i]], dtype=np.float64),
                [r[2] for r in rows[i]],
            )
            for i in sorted(rows)
        }
    )
