"""The small values that calls take: who a body is, how strong, where, what disturbs it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, TypeAlias, Union

from sinew.v1 import body_pb2, figure_pb2, perturbation_pb2, types_pb2

__all__ = [
    "Controller",
    "Disturbance",
    "Encoding",
    "Force",
    "Load",
    "Profile",
    "Push",
    "Strength",
    "Vector",
]

Vector: TypeAlias = Sequence[float]
"""Three numbers x, y, z: forward, left, up."""
Controller: TypeAlias = Literal["modern", "paper", "motors"]
"""Who computes the torques."""
Encoding: TypeAlias = Literal["float", "double", "fixed16"]
"""How numbers of frames travel."""


def vector(v: Vector) -> types_pb2.Vector3:
    """Three numbers as a message."""
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
    """Who a body stands for. `height_m` and `mass_kg` 0: ordinary for sex and age (6 to 90 years)."""

    sex: Literal["male", "female"]
    age_years: float = 30.0
    height_m: float = 0.0
    mass_kg: float = 0.0

    def message(self) -> body_pb2.BodyProfile:
        """As it is sent."""
        sex = body_pb2.SEX_MALE if self.sex == "male" else body_pb2.SEX_FEMALE
        return body_pb2.BodyProfile(sex=sex, age_years=self.age_years, height_m=self.height_m, mass_kg=self.mass_kg)


@dataclass(frozen=True, kw_only=True)
class Strength:
    """Scale of measured human strength: a factor on all, factors by DOF name, percentile of people, willing share."""

    all: float = 1.0
    dofs: Mapping[str, float] = field(default_factory=dict)
    percentile: float = 50.0
    effort: float = 1.0

    def message(self) -> figure_pb2.StrengthScale:
        """As it is sent."""
        dofs = [figure_pb2.DofStrength(dof=k, factor=v) for k, v in self.dofs.items()]
        return figure_pb2.StrengthScale(all=self.all, dofs=dofs, percentile=self.percentile, effort=self.effort)


@dataclass(frozen=True, kw_only=True)
class Load:
    """A mass that a hand (or any segment) carries from `start_s` on; `duration_s` 0: until it is cleared.

    With `second_segment` two hands share it. Taking it is perfectly inelastic: a load that moves (`velocity_mps`, world axes)
    jerks. Beyond `grip_n` newtons at one hand it slips; 0: never.
    """

    mass_kg: float
    segment: str = "r_hand"
    second_segment: str = ""
    point_m: Vector | None = None
    second_point_m: Vector | None = None
    velocity_mps: Vector | None = None
    grip_n: float = 0.0
    duration_s: float = 0.0
    start_s: float = 0.0

    def message(self) -> perturbation_pb2.Perturbation:
        """As it is sent, without figure and tick."""
        load = perturbation_pb2.Load(
            segment=self.segment,
            mass_kg=self.mass_kg,
            duration_s=self.duration_s,
            second_segment=self.second_segment,
            grip_n=self.grip_n,
            point_m=vector(self.point_m) if self.point_m is not None else None,
            second_point_m=vector(self.second_point_m) if self.second_point_m is not None else None,
            velocity_mps=vector(self.velocity_mps) if self.velocity_mps is not None else None,
        )
        return perturbation_pb2.Perturbation(load=load)


@dataclass(frozen=True, kw_only=True)
class Push:
    """An impulse (N·s, world axes) on a segment, given as a constant force over `duration_s`, from `start_s` on."""

    impulse_ns: Vector
    segment: str = "chest"
    point_m: Vector | None = None
    duration_s: float = 0.1
    start_s: float = 0.0

    def message(self) -> perturbation_pb2.Perturbation:
        """As it is sent, without figure and tick."""
        impulse = perturbation_pb2.Impulse(
            segment=self.segment,
            impulse_ns=vector(self.impulse_ns),
            duration_s=self.duration_s,
            point_m=vector(self.point_m) if self.point_m is not None else None,
        )
        return perturbation_pb2.Perturbation(impulse=impulse)


@dataclass(frozen=True, kw_only=True)
class Force:
    """A constant force (N, world axes) on a segment from `start_s` on; `duration_s` 0: until it is cleared."""

    force_n: Vector
    segment: str = "pelvis"
    point_m: Vector | None = None
    duration_s: float = 0.0
    start_s: float = 0.0

    def message(self) -> perturbation_pb2.Perturbation:
        """As it is sent, without figure and tick."""
        force = perturbation_pb2.Force(
            segment=self.segment,
            force_n=vector(self.force_n),
            duration_s=self.duration_s,
            point_m=vector(self.point_m) if self.point_m is not None else None,
        )
        return perturbation_pb2.Perturbation(force=force)


Disturbance: TypeAlias = Union[Load, Push, Force]
"""What may disturb a figure."""
