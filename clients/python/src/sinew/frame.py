"""Frames of a world and events, with arrays in place of messages."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from sinew.motion import DOF_COUNT, Floats
from sinew.v1 import frame_pb2, state_pb2, types_pb2
from sinew.values import last


def numbers(message: types_pb2.Numbers) -> Floats:
    """A packed array in whichever way it travelled."""
    if message.f64:
        return np.array(message.f64, dtype=np.float64)
    if message.i16:
        return np.frombuffer(message.i16, dtype="<i2").astype(np.float64) * float(message.scale)
    return np.array(message.f32, dtype=np.float64)


def bits(mask: int) -> npt.NDArray[np.bool_]:
    """A set of DOFs as 39 booleans."""
    return np.array([bool(mask >> i & 1) for i in range(DOF_COUNT)])


@dataclass(frozen=True)
class Roster:
    """Who is who in frames."""

    rate_hz: float
    names: dict[int, str]
    bodies: dict[str, str]

    @classmethod
    def of(cls, message: state_pb2.Roster) -> Roster:
        """From the protobuf message."""
        return cls(
            rate_hz=message.rate_hz,
            names={e.figure_index: e.figure for e in message.figures},
            bodies={e.figure: last(e.body) for e in message.figures},
        )

    @classmethod
    def alone(cls, body: str, rate_hz: float) -> Roster:
        """Of a simulation, which has one figure."""
        return cls(rate_hz=rate_hz, names={0: "figure"}, bodies={"figure": body})


@dataclass(frozen=True)
class Contacts:
    """Touching points: index of the segment `(k,)`, place `(k, 3)` in the world, m, and force on the figure `(k, 3)`, N."""

    segment: npt.NDArray[np.int64]
    position: Floats
    force: Floats

    @classmethod
    def of(cls, message: frame_pb2.Contacts | frame_pb2.AppliedForces) -> Contacts:
        """From the protobuf message."""
        return cls(
            segment=np.array(message.segment, dtype=np.int64),
            position=numbers(message.position).reshape(-1, 3),
            force=numbers(message.force).reshape(-1, 3),
        )


@dataclass(frozen=True)
class Balance:
    """Centre of mass and zero-moment point in the world, m (`None` in flight), distance inside the support polygon `(k, 2)`."""

    com: Floats
    com_velocity: Floats
    com_desired: Floats
    zmp: Floats | None
    margin_m: float | None
    polygon: Floats


@dataclass(frozen=True)
class Desired:
    """The posture that was asked for."""

    root_pose: Floats
    joint_angles: Floats
    joint_rotations: Floats


@dataclass(frozen=True)
class CarriedLoad:
    """A load on a segment: index, place in the segment's frame, m, and mass, kg."""

    segment: int
    point_m: Floats
    mass_kg: float


@dataclass(frozen=True)
class Audit:
    """The last substep as it was solved: `M v̇ + h = Sᵀ (torque + ligament_torque) + Σ Jᵀ f + assist` to rounding in "double"."""

    positions: Floats
    velocity: Floats
    acceleration: Floats
    torque: Floats
    ligament_torque: Floats
    contacts: Contacts
    applied: Contacts
    loads: tuple[CarriedLoad, ...]
    gravity_mps2: float
    assist: Floats


@dataclass(frozen=True)
class FigureFrame:
    """One figure after one tick. What was not asked for is `None`.

    Units: m, rad, N·m, N, s. `torque_limits` `(2, 39)`: least, then largest. `saturated` `(39,)`: at the limit of strength.
    """

    root_pose: Floats | None = None
    joint_angles: Floats | None = None
    joint_rotations: Floats | None = None
    segment_transforms: Floats | None = None
    velocity: Floats | None = None
    acceleration: Floats | None = None
    torque: Floats | None = None
    ligament_torque: Floats | None = None
    torque_limits: Floats | None = None
    positions: Floats | None = None
    fatigue: Floats | None = None
    assist: Floats | None = None
    contacts: Contacts | None = None
    balance: Balance | None = None
    desired: Desired | None = None
    audit: Audit | None = None
    saturated: npt.NDArray[np.bool_] | None = None
    flags: int | None = None
    joint_rms_rad: float | None = None
    loads: tuple[CarriedLoad, ...] = ()

    @classmethod
    def of(cls, m: frame_pb2.FigureFrame) -> FigureFrame:
        """From the protobuf message."""
        def array(name: str, *shape: int) -> Floats | None:
            if not m.HasField(name):  # type: ignore[arg-type]  # a name of the message, but not a literal
                return None
            values = numbers(getattr(m, name))
            return values.reshape(shape) if shape else values

        status = m.status if m.HasField("status") else None
        return cls(
            root_pose=array("root_pose"),
            joint_angles=array("joint_angles"),
            joint_rotations=array("joint_rotations", -1, 4),
            segment_transforms=array("segment_transforms", -1, 7),
            velocity=array("velocity"),
            acceleration=array("acceleration"),
            torque=array("torque"),
            ligament_torque=array("ligament_torque"),
            torque_limits=array("torque_limits", 2, -1),
            positions=array("positions"),
            fatigue=array("fatigue", 2, -1),
            assist=array("assist"),
            contacts=Contacts.of(m.contacts) if m.HasField("contacts") else None,
            balance=_balance(m.balance) if m.HasField("balance") else None,
            desired=_desired(m.desired) if m.HasField("desired") else None,
            audit=_audit(m.audit) if m.HasField("audit") else None,
            saturated=bits(status.saturated) if status else None,
            flags=status.flags if status else None,
            joint_rms_rad=status.joint_rms_rad if status else None,
            loads=_loads(status.loads) if status else (),
        )


def _loads(messages: object) -> tuple[CarriedLoad, ...]:
    return tuple(
        CarriedLoad(x.segment, np.array([x.point_m.x, x.point_m.y, x.point_m.z]), x.mass_kg)
        for x in messages  # type: ignore[attr-defined]  # a repeated field, whose class has no public name
    )


def _balance(m: frame_pb2.Balance) -> Balance:
    zmp = numbers(m.zmp)
    return Balance(
        com=numbers(m.com),
        com_velocity=numbers(m.com_velocity),
        com_desired=numbers(m.com_desired),
        zmp=zmp if zmp.size else None,
        margin_m=m.margin_m if m.HasField("margin_m") else None,
        polygon=numbers(m.polygon).reshape(-1, 2),
    )


def _desired(m: frame_pb2.DesiredPosture) -> Desired:
    return Desired(
        root_pose=numbers(m.root_pose),
        joint_angles=numbers(m.joint_angles),
        joint_rotations=numbers(m.joint_rotations).reshape(-1, 4),
    )


def _audit(m: frame_pb2.Audit) -> Audit:
    assist = numbers(m.assist)
    return Audit(
        positions=numbers(m.positions),
        velocity=numbers(m.velocity),
        acceleration=numbers(m.acceleration),
        torque=numbers(m.torque),
        ligament_torque=numbers(m.ligament_torque),
        contacts=Contacts.of(m.contacts),
        applied=Contacts.of(m.applied),
        loads=_loads(m.loads),
        gravity_mps2=m.gravity_mps2,
        assist=assist if assist.size else np.zeros(6),
    )


@dataclass(frozen=True)
class Frame:
    """A world after one tick: its figures by name."""

    tick: int
    time_s: float
    state_hash: int
    figures: dict[str, FigureFrame] = field(default_factory=dict)

    @classmethod
    def of(cls, message: frame_pb2.WorldFrame, roster: Roster) -> Frame:
        """From the protobuf message."""
        named = {roster.names.get(f.figure_index, str(f.figure_index)): FigureFrame.of(f) for f in message.figures}
        return cls(message.tick, message.time_s, message.state_hash & (1 << 64) - 1, named)

    def only(self) -> FigureFrame:
        """The figure, where there is exactly one."""
        if len(self.figures) != 1:
            raise LookupError(f"one figure expected, there are {len(self.figures)}")
        return next(iter(self.figures.values()))


@dataclass(frozen=True)
class Event:
    """Something that happened after a tick, for example type "saturated" with its `dof`, or "fell"."""

    type: str
    tick: int
    time_s: float
    figure: str = ""
    segment: str = ""
    dof: str = ""
    mass_kg: float = 0.0
    detail: str = ""

    @classmethod
    def of(cls, m: state_pb2.Event) -> Event:
        """From the protobuf message."""
        try:
            kind = state_pb2.EventType.Name(m.type).removeprefix("EVENT_TYPE_").lower()
        except ValueError:  # of a newer server
            kind = str(m.type)
        return cls(kind, m.tick, m.time_s, m.figure, m.segment, m.dof, m.mass_kg, m.detail)
