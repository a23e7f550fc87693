"""Frames: what a world looks like after one tick, as NumPy arrays."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from sinew.body import Body
from sinew.v1 import frame_pb2, state_pb2, types_pb2

__all__ = ["Contact", "Event", "FigureState", "Frame", "numbers"]

Floats = NDArray[np.float64]


def numbers(n: types_pb2.Numbers) -> Floats:
    """The numbers of a packed array, whatever their encoding."""
    if n.i16:
        return np.frombuffer(n.i16, dtype="<i2").astype(np.float64) * n.scale
    return np.array(n.f64 if n.f64 else n.f32, dtype=np.float64)


def bits(word: int, count: int) -> NDArray[np.bool_]:
    """The lowest `count` bits of a set."""
    word &= (1 << 64) - 1
    return np.array([word >> i & 1 for i in range(count)], dtype=np.bool_)


@dataclass(frozen=True)
class Contact:
    """One touching point: segment name, where (world, m), and the force on the figure (world, N)."""

    segment: str
    position: Floats
    force: Floats


@dataclass(frozen=True)
class Event:
    """Something that happened: `type` in lower case, for example `saturated`, `balance_lost`, `fell`, `load_slipped`."""

    type: str
    tick: int
    time_s: float
    figure: str = ""
    segment: str = ""
    dof: str = ""
    mass_kg: float = 0.0
    detail: str = ""

    @classmethod
    def of(cls, e: state_pb2.Event) -> Event:
        """From a message."""
        try:
            name = state_pb2.EventType.Name(e.type).removeprefix("EVENT_TYPE_").lower()
        except ValueError:  # of a newer server
            name = f"event_{e.type}"
        return cls(name, e.tick, e.time_s, e.figure, e.segment, e.dof, e.mass_kg, e.detail)


class FigureState:
    """One figure after one tick. A quantity that the view did not ask for raises `AttributeError`."""

    def __init__(self, message: frame_pb2.FigureFrame, name: str, body: Body) -> None:
        self.message = message
        """As it came."""
        self.name = name
        """Last part of the figure's name."""
        self.body = body
        """Names and order of the numbers."""

    def __repr__(self) -> str:
        return f"FigureState({self.name!r})"

    def _part(self, field: str) -> Floats:
        if not self.message.HasField(field):  # type: ignore[arg-type]
            raise AttributeError(f"the frame has no {field}: ask for it with fields=[..., {field!r}]")
        return numbers(getattr(self.message, field))

    def _need(self, field: str) -> None:
        if not self.message.HasField(field):  # type: ignore[arg-type]
            raise AttributeError(f"the frame has no {field}: ask for it with fields=[..., {field!r}]")

    @cached_property
    def root_pose(self) -> Floats:
        """Pelvis in the world: position (m), quaternion x, y, z, w."""
        return self._part("root_pose")

    @cached_property
    def joint_angles(self) -> Floats:
        """The 39 anatomical angles, rad."""
        return self._part("joint_angles")

    @cached_property
    def segment_transforms(self) -> Floats:
        """World pose of each segment, (18, 7)."""
        return self._part("segment_transforms").reshape(-1, 7)

    @cached_property
    def velocity(self) -> Floats:
        """Pelvis angular velocity and velocity (world axes), then the 39 joint rates: 45 numbers."""
        return self._part("velocity")

    @cached_property
    def torque(self) -> Floats:
        """Muscle torque of the 39 degrees of freedom, N·m, mean of the tick."""
        return self._part("torque")

    @cached_property
    def torque_limits(self) -> Floats:
        """Least and largest torque that the muscles could give, N·m: (2, 39)."""
        return self._part("torque_limits").reshape(2, -1)

    @cached_property
    def constraint_error(self) -> Floats:
        """What is missing of each constraint: distance (m) and angle (rad), (n, 2)."""
        return self._part("constraint_error").reshape(-1, 2)

    @property
    def saturated(self) -> tuple[str, ...]:
        """Names of the degrees of freedom at the limit of their strength."""
        self._need("status")
        at = bits(self.message.status.saturated, len(self.body.dofs))
        return tuple(n for n, s in zip(self.body.dofs, at) if s)

    @property
    def margin_m(self) -> float:
        """Distance of the zero-moment point inside the support polygon, m; negative outside, NaN in flight."""
        self._need("balance")
        b = self.message.balance
        return b.margin_m if b.HasField("margin_m") else float("nan")

    @property
    def com(self) -> Floats:
        """Centre of mass, loads included, world, m."""
        self._need("balance")
        return numbers(self.message.balance.com)

    @property
    def contacts(self) -> list[Contact]:
        """Touching points with their forces."""
        self._need("contacts")
        c = self.message.contacts
        where, force = numbers(c.position).reshape(-1, 3), numbers(c.force).reshape(-1, 3)
        return [Contact(self.body.segments[s], p, f) for s, p, f in zip(c.segment, where, force)]


@dataclass(frozen=True)
class Frame(Mapping[str, FigureState]):
    """A world after one tick: figures by name. `server_time_ns` is when the tick ended, by the server's clock."""

    tick: int
    time_s: float
    state_hash: int
    server_time_ns: int
    figures: Mapping[str, FigureState]

    def __getitem__(self, name: str) -> FigureState:
        return self.figures[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.figures)

    def __len__(self) -> int:
        return len(self.figures)


def frame(message: frame_pb2.WorldFrame, roster: state_pb2.Roster, bodies: Mapping[str, Body]) -> Frame:
    """A frame with names for indices; `bodies` by resource name."""
    known = {e.figure_index: e for e in roster.figures}
    figures = {}
    for f in message.figures:
        entry = known.get(f.figure_index)
        if entry is not None:
            figures[entry.figure] = FigureState(f, entry.figure, bodies[entry.body])
    return Frame(message.tick, message.time_s, message.state_hash, message.server_time_ns, figures)
