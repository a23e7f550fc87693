"""The small values that calls take: profile of a body, its strength, its place, what disturbs it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, TypeAlias, Union

from sinew.v1 import body_pb2, figure_pb2, obstacle_pb2, perturbation_pb2, types_pb2

__all__ = [
    "Box",
    "Capsule",
    "Constraint",
    "Controller",
    "Disturbance",
    "Encoding",
    "Follow",
    "Force",
    "Load",
    "Mobility",
    "Paper",
    "Plane",
    "Profile",
    "Push",
    "Shape",
    "Sphere",
    "Stepper",
    "Strength",
    "Vector",
]

Vector: TypeAlias = Sequence[float]
"""Three numbers x, y, z: forward, left, up. In world axes unless it is said otherwise."""
Controller: TypeAlias = Literal["modern", "paper", "motors"]
"""Controllers: what computes the torques."""
Stepper: TypeAlias = Literal["torque", "kinematic", "staged"]
"""How a figure is moved: by its torques, or by its accelerations as they are demanded."""
Encoding: TypeAlias = Literal["float", "double", "fixed16"]
"""How numbers of frames travel: 32 bits, 64 bits, or 16 bits with a scale per array."""
Follow: TypeAlias = Literal["strict", "rehearsed", "assisted", "always"]
"""How far it may go so that a figure keeps to a clip: physics alone; a rehearsal by strength alone; help, too."""
Mobility: TypeAlias = Literal["fixed", "led", "free"]
"""How an obstacle moves: not at all; with its velocity, whatever it meets; or as a rigid body under gravity."""


def choice(keys: Iterable[str], prefix: str, name: str, what: str) -> str:
    """The enum value `prefix` + `name`; `ValueError` with the names that there are."""
    known = [k.removeprefix(prefix).lower() for k in keys if not k.endswith("UNSPECIFIED")]
    if name not in known:
        raise ValueError(f"{what} {name!r} is none of {', '.join(known)}")
    return prefix + name.upper()


def vector(v: Vector) -> types_pb2.Vector3:
    """Three numbers as a message."""
    if len(v) != 3:
        raise ValueError(f"a vector has 3 numbers x, y, z, got {len(v)}")
    x, y, z = (float(c) for c in v)
    return types_pb2.Vector3(x=x, y=y, z=z)


def resource(collection: str, name: str) -> str:
    """`name` with its collection before it, if it is not there already."""
    return name if name.startswith(collection + "/") else f"{collection}/{name}"


def last(name: str) -> str:
    """Last part of a resource name."""
    return name.rsplit("/", 1)[-1]


@dataclass(frozen=True, kw_only=True)
class Profile:
    """Person that a body represents: `age_years` 6 to 90, stature `height_m` (m) and body mass `mass_kg` (kg).

    A stature or mass of 0 is the ordinary one for sex and age.
    """

    sex: Literal["male", "female"]
    age_years: float = 30.0
    height_m: float = 0.0
    mass_kg: float = 0.0

    def message(self) -> body_pb2.BodyProfile:
        """As it is sent."""
        sex = body_pb2.Sex.Value(choice(body_pb2.Sex.keys(), "SEX_", self.sex, "sex"))
        return body_pb2.BodyProfile(sex=sex, age_years=self.age_years, height_m=self.height_m, mass_kg=self.mass_kg)


@dataclass(frozen=True, kw_only=True)
class Strength:
    """Scale of measured human strength.

    `all`: factor on every torque limit, 0.01 to 100. `dofs`: further factors by DOF name (`Body.dofs`). `percentile`:
    how strong among people of that sex, age and size, 5 to 95; 50 is the average. `effort`: share of the strength that
    is used, 0 to 1.
    """

    all: float = 1.0
    dofs: Mapping[str, float] = field(default_factory=dict)
    percentile: float = 50.0
    effort: float = 1.0

    def message(self) -> figure_pb2.StrengthScale:
        """As it is sent."""
        dofs = [figure_pb2.DofStrength(dof=k, factor=v) for k, v in self.dofs.items()]
        return figure_pb2.StrengthScale(all=self.all, dofs=dofs, percentile=self.percentile, effort=self.effort)


@dataclass(frozen=True, kw_only=True)
class Constraint:
    """Where a part of a figure is wanted while the rest of the body follows its motion.

    `segment` `None`: the centre of mass. `position` (m, world); `axes`: how much each of its axes counts, 0 to 1.
    `rotation`: quaternion x, y, z, w of the segment in the world, not for the centre of mass. At least one of the two.
    `point` in the segment's frame (m); `None`: the middle of a hand, else the segment's centre of mass. `weight` 0 to
    1. `ease_s`: time to come into force and to fade, s. `duration_s`: how long it holds, s; 0: until it is taken off.
    """

    segment: str | None = None
    position: Vector | None = None
    axes: Vector = (1.0, 1.0, 1.0)
    rotation: Sequence[float] | None = None
    point: Vector | None = None
    weight: float = 1.0
    ease_s: float = 0.5
    duration_s: float = 0.0

    def message(self) -> figure_pb2.Constraint:
        """As it is sent."""
        out = figure_pb2.Constraint(weight=self.weight, ease_s=self.ease_s, duration_s=self.duration_s)
        if self.segment is None:
            out.center_of_mass = True
        else:
            out.segment = self.segment
        if self.position is not None:
            out.position_m.CopyFrom(vector(self.position))
            out.position_axes.CopyFrom(vector(self.axes))
        if self.rotation is not None:
            x, y, z, w = (float(c) for c in self.rotation)
            out.rotation.CopyFrom(types_pb2.Quaternion(x=x, y=y, z=z, w=w))
        if self.point is not None:
            out.point_m.CopyFrom(vector(self.point))
        return out


@dataclass(frozen=True, kw_only=True)
class Paper:
    """Choices of the paper's controller, `controller="paper"`; what is `None` is as the preset has it.

    `alpha`: blend (0 to 1) of position and velocity demand in equation (4) per 1/30 s, where `horizon_s` is 0.
    `horizon_s`: time constant of the demand, s; 0: met within one step. `metric`: norm of equation (10). `priority`:
    how equation (12) orders centre of mass and hands. `share`: how supports share the ground reaction. `to_limit`:
    joints that equation (16) saturates go to their limit. `tilt`: torques of a tipping figure know that its support
    turns. `zmp_feasible`: the demand for the centre of mass stays within what the feet can give. `hand_over`: with the
    kinematic stepper, torques take over where accelerations cannot go on.
    """

    preset: Literal["safeguarded", "2000"] = "safeguarded"
    alpha: float | None = None
    horizon_s: float | None = None
    metric: Literal["identity", "inertia", "torque"] | None = None
    priority: Literal["printed", "nested"] | None = None
    share: Literal["ratio", "balanced"] | None = None
    to_limit: bool | None = None
    tilt: bool | None = None
    zmp_feasible: bool | None = None
    track_hands: bool | None = None
    track_com: bool | None = None
    hand_over: bool | None = None

    def message(self) -> figure_pb2.PaperOptions:
        """As it is sent."""
        out = figure_pb2.PaperOptions(
            preset=figure_pb2.PaperPreset.Value(
                choice(figure_pb2.PaperPreset.keys(), "PAPER_PRESET_", self.preset, "preset")
            ),
            alpha=self.alpha,
            horizon_s=self.horizon_s,
            to_limit=self.to_limit,
            tilt=self.tilt,
            zmp_feasible=self.zmp_feasible,
            track_hands=self.track_hands,
            track_com=self.track_com,
            hand_over=self.hand_over,
        )
        if self.metric is not None:
            known = figure_pb2.PaperMetric.keys()
            out.metric = figure_pb2.PaperMetric.Value(choice(known, "PAPER_METRIC_", self.metric, "metric"))
        if self.priority is not None:
            known = figure_pb2.PaperPriority.keys()
            out.priority = figure_pb2.PaperPriority.Value(choice(known, "PAPER_PRIORITY_", self.priority, "priority"))
        if self.share is not None:
            known = figure_pb2.PaperShare.keys()
            out.share = figure_pb2.PaperShare.Value(choice(known, "PAPER_SHARE_", self.share, "share"))
        return out


@dataclass(frozen=True, kw_only=True)
class Load:
    """A mass (`mass_kg`, kg) that a hand (or any segment) carries from `start_s` (s) on; `duration_s` (s) 0: until it
    is cleared.

    `point_m`: where, in the segment's frame (m); `None`: the middle of the palm of a hand, else the segment's centre
    of mass. With `second_segment` two hands share it, half each. `two_hands` `auto`: the other hand helps while one
    arm is too weak; `always`: as long as it is free; `never`; empty: as `second_segment` says. Taking it is perfectly
    inelastic: a load that moves (`velocity_mps`, world axes, m/s) jerks. Beyond `grip_newtons` newtons at one hand it
    slips; 0: never.
    """

    mass_kg: float
    segment: str = "r_hand"
    second_segment: str = ""
    point_m: Vector | None = None
    second_point_m: Vector | None = None
    velocity_mps: Vector | None = None
    grip_newtons: float = 0.0
    duration_s: float = 0.0
    start_s: float = 0.0
    two_hands: str = ""

    def message(self) -> perturbation_pb2.Perturbation:
        """As it is sent, without figure and tick."""
        load = perturbation_pb2.Load(
            segment=self.segment,
            mass_kg=self.mass_kg,
            duration_s=self.duration_s,
            second_segment=self.second_segment,
            grip_newtons=self.grip_newtons,
            point_m=vector(self.point_m) if self.point_m is not None else None,
            second_point_m=vector(self.second_point_m) if self.second_point_m is not None else None,
            velocity_mps=vector(self.velocity_mps) if self.velocity_mps is not None else None,
        )
        if self.two_hands:
            known = perturbation_pb2.TwoHands.keys()
            load.two_hands = perturbation_pb2.TwoHands.Value(choice(known, "TWO_HANDS_", self.two_hands, "two hands"))
        return perturbation_pb2.Perturbation(load=load)


@dataclass(frozen=True, kw_only=True)
class Push:
    """An impulse (N·s, world axes) on a segment, given as a constant force over `duration_s` (s), from `start_s` (s)
    on.

    `point_m`: where, in the segment's frame (m); `None`: its centre of mass.
    """

    impulse_newton_seconds: Vector
    segment: str = "chest"
    point_m: Vector | None = None
    duration_s: float = 0.1
    start_s: float = 0.0

    def message(self) -> perturbation_pb2.Perturbation:
        """As it is sent, without figure and tick."""
        impulse = perturbation_pb2.Impulse(
            segment=self.segment,
            impulse_newton_seconds=vector(self.impulse_newton_seconds),
            duration_s=self.duration_s,
            point_m=vector(self.point_m) if self.point_m is not None else None,
        )
        return perturbation_pb2.Perturbation(impulse=impulse)


@dataclass(frozen=True, kw_only=True)
class Force:
    """A constant force (N, world axes) on a segment from `start_s` (s) on; `duration_s` (s) 0: until it is cleared.

    `point_m`: where, in the segment's frame (m); `None`: its centre of mass.
    """

    force_newtons: Vector
    segment: str = "pelvis"
    point_m: Vector | None = None
    duration_s: float = 0.0
    start_s: float = 0.0

    def message(self) -> perturbation_pb2.Perturbation:
        """As it is sent, without figure and tick."""
        force = perturbation_pb2.Force(
            segment=self.segment,
            force_newtons=vector(self.force_newtons),
            duration_s=self.duration_s,
            point_m=vector(self.point_m) if self.point_m is not None else None,
        )
        return perturbation_pb2.Perturbation(force=force)


Disturbance: TypeAlias = Union[Load, Push, Force]
"""What may disturb a figure."""


@dataclass(frozen=True, kw_only=True)
class Sphere:
    """A ball around the obstacle's origin: `radius_m` 0.005 to 100 m."""

    radius_m: float

    def put(self, into: obstacle_pb2.Obstacle) -> None:
        """Into a message."""
        into.sphere.CopyFrom(obstacle_pb2.SphereShape(radius_m=self.radius_m))


@dataclass(frozen=True, kw_only=True)
class Capsule:
    """A cylinder with round ends along z of the obstacle's frame, around its origin.

    `radius_m` 0.005 to 100 m; `half_length_m`: half the length of the cylinder without its ends, 0 to 100 m.
    """

    radius_m: float
    half_length_m: float

    def put(self, into: obstacle_pb2.Obstacle) -> None:
        """Into a message."""
        into.capsule.CopyFrom(obstacle_pb2.CapsuleShape(radius_m=self.radius_m, half_length_m=self.half_length_m))


@dataclass(frozen=True, kw_only=True)
class Box:
    """A box around the obstacle's origin: `half_m` is half of its edges along x, y, z of the obstacle's frame, each
    0.005 to 1000 m.
    """

    half_m: Vector

    def put(self, into: obstacle_pb2.Obstacle) -> None:
        """Into a message."""
        into.box.CopyFrom(obstacle_pb2.BoxShape(half_m=vector(self.half_m)))


@dataclass(frozen=True, kw_only=True)
class Plane:
    """Everything below z = 0 of the obstacle's frame: a slope or a wall without end. It cannot move freely."""

    def put(self, into: obstacle_pb2.Obstacle) -> None:
        """Into a message."""
        into.plane.CopyFrom(obstacle_pb2.PlaneShape())


Shape: TypeAlias = Union[Sphere, Capsule, Box, Plane]
"""What an obstacle looks like; lengths in m, in the obstacle's own frame."""


def shape_of(message: obstacle_pb2.Obstacle) -> Shape:
    """The shape in a message."""
    kind = message.WhichOneof("shape")
    if kind == "sphere":
        return Sphere(radius_m=message.sphere.radius_m)
    if kind == "capsule":
        return Capsule(radius_m=message.capsule.radius_m, half_length_m=message.capsule.half_length_m)
    if kind == "box":
        h = message.box.half_m
        return Box(half_m=(h.x, h.y, h.z))
    return Plane()
