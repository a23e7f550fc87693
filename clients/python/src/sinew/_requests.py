"""Arguments of calls to messages; nothing here waits."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from google.protobuf.field_mask_pb2 import FieldMask

from sinew.v1 import figure_pb2, perturbation_pb2, simulation_pb2, state_pb2, types_pb2, world_pb2
from sinew.values import Constraint, Controller, Disturbance, Encoding, Paper, Profile, Stepper, Strength, resource

PORT = 7463
OPTIONS = [
    ("grpc.max_receive_message_length", -1),  # a simulation comes back in one message
    ("grpc.keepalive_time_ms", 30_000),
]
VIEW = ("root_pose", "joint_angles", "torque", "status")


def address(given: str) -> str:
    """Host and port of an address that may be written as a URL or without a port."""
    out = re.sub(r"^(https?://)?([^/]*).*$", r"\2", given.strip())
    if not out:
        raise ValueError(f"no address: {given!r}")
    return out if re.search(r":\d+$", out) else f"{out}:{PORT}"


def controller(name: Controller) -> figure_pb2.Controller.ValueType:
    """A controller by name."""
    return figure_pb2.Controller.Value(_choice(figure_pb2.Controller.keys(), "CONTROLLER_", name))


def stepper(name: Stepper) -> figure_pb2.Stepper.ValueType:
    """A stepper by name."""
    return figure_pb2.Stepper.Value(_choice(figure_pb2.Stepper.keys(), "STEPPER_", name))


def encoding(name: Encoding) -> types_pb2.Encoding.ValueType:
    """An encoding by name."""
    return types_pb2.Encoding.Value(_choice(types_pb2.Encoding.keys(), "ENCODING_", name))


def overrun(name: str) -> world_pb2.OverrunPolicy.ValueType:
    """An overrun policy by name."""
    return world_pb2.OverrunPolicy.Value(_choice(world_pb2.OverrunPolicy.keys(), "OVERRUN_POLICY_", name))


def event_types(names: Iterable[str]) -> list[state_pb2.EventType.ValueType]:
    """Event types by name."""
    return [state_pb2.EventType.Value(_choice(state_pb2.EventType.keys(), "EVENT_TYPE_", n)) for n in names]


def _choice(keys: Iterable[str], prefix: str, name: str) -> str:
    known = [k.removeprefix(prefix).lower() for k in keys if not k.endswith("UNSPECIFIED")]
    if name not in known:
        raise ValueError(f"{name!r} is none of {', '.join(known)}")
    return prefix + name.upper()


def view(
    fields: Sequence[str],
    *,
    figures: Iterable[str] = (),
    numbers: Encoding = "double",
    rate_divisor: int = 1,
) -> state_pb2.View:
    """What of a world is sent."""
    return state_pb2.View(
        figures=list(figures),
        fields=FieldMask(paths=list(fields)),
        encoding=encoding(numbers),
        rate_divisor=rate_divisor,
    )


def figure(
    *,
    body: str | Profile | None = None,
    strength: float | Strength | None = None,
    choice: Controller | None = None,
    moved_by: Stepper | None = None,
    paper: Paper | None = None,
    position: tuple[float, float] | None = None,
    yaw: float | None = None,
    fatigue_time_scale: float | None = None,
    assist: float | None = None,
    constraints: Iterable[Constraint] | None = None,
    protective_steps: bool | None = None,
    display_name: str | None = None,
) -> figure_pb2.Figure:
    """Settings of a figure; what is `None` is left out."""
    out = figure_pb2.Figure()
    if isinstance(body, Profile):
        out.profile.CopyFrom(body.message())
    elif body is not None:
        out.body = resource("bodies", body)
    if strength is not None:
        scale = strength if isinstance(strength, Strength) else Strength(all=float(strength))
        out.strength.CopyFrom(scale.message())
    if choice is not None:
        out.controller = controller(choice)
    if moved_by is not None:
        out.stepper = stepper(moved_by)
    if paper is not None:
        out.paper.CopyFrom(paper.message())
    place = placement(position, yaw)
    if place is not None:
        out.placement.CopyFrom(place)
    if fatigue_time_scale is not None:
        out.fatigue_time_scale = fatigue_time_scale
    if assist is not None:
        out.assist = assist
    if constraints is not None:
        out.constraints.extend(c.message() for c in constraints)
    if protective_steps is not None:
        out.protective_steps = protective_steps
    if display_name is not None:
        out.display_name = display_name
    return out


def placement(position: tuple[float, float] | None, yaw: float | None) -> types_pb2.Placement | None:
    """A place on the ground; `None` if nothing is given."""
    if position is None and yaw is None:
        return None
    x, y = position if position is not None else (0.0, 0.0)
    return types_pb2.Placement(x_m=float(x), y_m=float(y), yaw_rad=float(yaw or 0.0))


def perturbation(what: Disturbance, name: str, tick: int | None) -> perturbation_pb2.Perturbation:
    """A disturbance of a figure at a tick."""
    out = what.message()
    out.figure = name
    if tick is not None:
        out.tick = tick
    return out


def timed(disturbances: Iterable[Disturbance]) -> list[simulation_pb2.TimedPerturbation]:
    """Disturbances in time of a clip."""
    return [simulation_pb2.TimedPerturbation(start_s=d.start_s, perturbation=d.message()) for d in disturbances]
