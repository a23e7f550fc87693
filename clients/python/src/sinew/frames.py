"""Frames: what a world looks like after one tick, as NumPy arrays."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from sinew.body import Body
from sinew.errors import named
from sinew.v1 import frame_pb2, motion_pb2, state_pb2, types_pb2

__all__ = ["Contact", "Event", "FigureState", "Frame", "ObstacleState", "Touch", "numbers"]

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
    """One point that touches the ground: segment name, where (world, m, (3,)), and the force on the figure (world axes,
    N, (3,)).
    """

    segment: str
    position: Floats
    force: Floats


@dataclass(frozen=True)
class Touch:
    """A part that touches another figure or an obstacle."""

    segment: str
    """Own segment, by name."""
    other: str
    """What it touches: `figures/{name}` or `obstacles/{name}`."""
    position: Floats
    """Where, world, m, (3,)."""
    force: Floats
    """Mean force on this figure over the tick, world axes, N, (3,)."""
    depth_m: float
    """Overlap, m."""


@dataclass(frozen=True)
class ObstacleState:
    """One obstacle after one tick."""

    name: str
    """Last part of its name."""
    position: Floats
    """Its centre in the world, m, (3,)."""
    rotation: Floats
    """Quaternion x, y, z, w of its frame in the world, (4,)."""
    velocity: Floats
    """Velocity of its centre, world axes, m/s, (3,)."""
    angular_velocity: Floats
    """World axes, rad/s, (3,)."""
    force: Floats
    """Mean force of contacts on it over the tick, world axes, N, (3,); zero unless it moves freely."""

    @classmethod
    def of(cls, message: frame_pb2.ObstacleFrame) -> ObstacleState:
        """From a message."""
        pose, velocity = numbers(message.pose), numbers(message.velocity)
        return cls(message.obstacle_id, pose[:3], pose[3:], velocity[3:], velocity[:3], numbers(message.force))


@dataclass(frozen=True)
class Beginning:
    """How a figure begins a clip, as far as is known when it is asked for."""

    time_s: float
    """World time at which the first frame plays, s."""
    start: str
    """`reset`: it was put into the first state; `at_once`: as it stands; `switch`: it ends what it does first, or steps
    into the clip; `led`: help leads it into the first state of a rehearsal."""
    rehearsed: bool
    """Whether it plays what was rehearsed."""

    @classmethod
    def of(cls, m: motion_pb2.PlayClipResponse) -> Beginning:
        """From a message."""
        try:
            start = motion_pb2.ClipStart.Name(m.start).removeprefix("CLIP_START_").lower()
        except ValueError:  # of a newer server
            start = f"start_{m.start}"
        return cls(m.start_time_s, start, m.rehearsed)


@dataclass(frozen=True)
class Event:
    """Something that happened: `type` in lower case, for example `saturated`, `balance_lost`, `fell`, `way_barred`.

    `tick` and `time_s` (world time, s) say when; `figure`, `segment` and `dof` are names, empty where they do not
    apply; `mass_kg` is that of a load, kg. Where the other hand helps with one (`load_shared`, `load_unshared`),
    `other_segment` is that hand, and `need` the share of its strength that the arm needs alone and with help.
    """

    type: str
    tick: int
    time_s: float
    figure: str = ""
    segment: str = ""
    dof: str = ""
    mass_kg: float = 0.0
    detail: str = ""
    other_segment: str = ""
    need: tuple[float, float] = (0.0, 0.0)

    @classmethod
    def of(cls, e: state_pb2.Event) -> Event:
        """From a message."""
        try:
            name = state_pb2.EventType.Name(e.type).removeprefix("EVENT_TYPE_").lower()
        except ValueError:  # of a newer server
            name = f"event_{e.type}"
        need = (e.need_alone, e.need_shared)
        who = (e.figure_id, e.segment, e.dof)
        return cls(name, e.tick, e.time_s, *who, e.mass_kg, e.detail, e.other_segment, need)


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
        """Pelvis in the world, (7,): position (m), quaternion x, y, z, w."""
        return self._part("root_pose")

    @cached_property
    def joint_angles(self) -> Floats:
        """The anatomical angles in the order of `body.dofs`, rad, (39,)."""
        return self._part("joint_angles")

    @cached_property
    def segment_transforms(self) -> Floats:
        """World pose of each segment in the order of `body.segments`, (18, 7): position (m), quaternion x, y, z, w."""
        return self._part("segment_transforms").reshape(-1, 7)

    @cached_property
    def velocity(self) -> Floats:
        """Pelvis angular velocity (rad/s) and velocity of its origin (m/s), world axes, then the 39 joint rates
        (rad/s): (45,).
        """
        return self._part("velocity")

    @cached_property
    def torque(self) -> Floats:
        """Muscle torque in the order of `body.dofs`, N·m, mean of the tick, (39,)."""
        return self._part("torque")

    @cached_property
    def torque_limits(self) -> Floats:
        """Least (negative) and largest torque that the muscles could give at the start of the tick, N·m: (2, 39)."""
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
    def following(self) -> str:
        """In which way it follows its motion: `tracked`, `rehearsed` or `helped`; empty if it has nothing to follow."""
        self._need("status")
        try:
            name = motion_pb2.FollowWay.Name(self.message.status.following)
        except ValueError:  # of a newer server
            return f"way_{self.message.status.following}"
        return name.removeprefix("FOLLOW_WAY_").removesuffix("UNSPECIFIED").lower()

    @property
    def help_newton_seconds(self) -> float:
        """Impulse of the help since its motion began, N·s."""
        self._need("status")
        return self.message.status.help_newton_seconds

    @property
    def help_newton_metre_seconds(self) -> float:
        """The same of its moment about the pelvis, N·m·s."""
        self._need("status")
        return self.message.status.help_newton_metre_seconds

    @property
    def help_ratio(self) -> float:
        """Impulse of the help over weight times time."""
        self._need("status")
        return self.message.status.help_ratio

    @property
    def margin_m(self) -> float:
        """Distance of the zero-moment point inside the support polygon, m; negative outside, NaN in flight."""
        self._need("balance")
        b = self.message.balance
        return b.margin_m if b.HasField("margin_m") else float("nan")

    @property
    def com(self) -> Floats:
        """Centre of mass after the tick, loads included, world, m, (3,)."""
        self._need("balance")
        return numbers(self.message.balance.com)

    @property
    def com_velocity(self) -> Floats:
        """Velocity of that centre of mass, world axes, m/s, (3,)."""
        self._need("balance")
        return numbers(self.message.balance.com_velocity)

    @property
    def touches(self) -> list[Touch]:
        """What it touches besides the ground: other figures and obstacles."""
        self._need("touches")
        t = self.message.touches
        where, force = numbers(t.position).reshape(-1, 3), numbers(t.force).reshape(-1, 3)
        parts = zip(t.segment, t.other, where, force, numbers(t.depth))
        return [Touch(self.body.segments[s], o, p, f, float(d)) for s, o, p, f, d in parts]

    @property
    def contacts(self) -> list[Contact]:
        """Points that touch the ground with their forces."""
        self._need("contacts")
        c = self.message.contacts
        where, force = numbers(c.position).reshape(-1, 3), numbers(c.force).reshape(-1, 3)
        return [Contact(self.body.segments[s], p, f) for s, p, f in zip(c.segment, where, force)]


@dataclass(frozen=True)
class Frame(Mapping[str, FigureState]):
    """A world after one tick: a mapping of figures by name.

    `time_s` is world time, s; `state_hash` is equal for equal inputs; `server_time_ns` is when the tick ended, by the
    server's clock, ns since 1970. `obstacles` holds all obstacles by name, in the order they were added.
    """

    tick: int
    time_s: float
    state_hash: int
    server_time_ns: int
    figures: Mapping[str, FigureState]
    obstacles: Mapping[str, ObstacleState]

    def __getitem__(self, name: str) -> FigureState:
        try:
            return self.figures[name]
        except KeyError:
            raise KeyError(f"no figure {name!r} in the frame; {named(list(self.figures))}") from None

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
            figures[entry.figure_id] = FigureState(f, entry.figure_id, bodies[entry.body])
    obstacles = {o.obstacle_id: ObstacleState.of(o) for o in message.obstacles}
    return Frame(message.tick, message.time_s, message.state_hash, message.server_time_ns, figures, obstacles)
