"""Arguments of calls to messages; nothing here waits."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import grpc
from google.protobuf.field_mask_pb2 import FieldMask

from sinew.v1 import (
    figure_pb2,
    frame_pb2,
    motion_pb2,
    obstacle_pb2,
    perturbation_pb2,
    simulation_pb2,
    state_pb2,
    types_pb2,
    world_pb2,
)
from sinew.values import (
    Constraint,
    Controller,
    Disturbance,
    Encoding,
    Follow,
    Mobility,
    Paper,
    Profile,
    Shape,
    Stepper,
    Strength,
    Vector,
    choice,
    resource,
    vector,
)

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


def credentials(
    given: str,
    *,
    token: str | None,
    ca: str | os.PathLike[str] | None,
    certificate: tuple[str | os.PathLike[str], str | os.PathLike[str]] | None,
) -> grpc.ChannelCredentials | None:
    """What an address, a token, roots and a certificate of the client make of a channel; `None`: no encryption."""
    if not given.strip().startswith("https://") and ca is None and certificate is None:
        if token is not None:
            raise ValueError("a token is not sent without encryption: give an address with https://")
        return None
    roots = None if ca is None else Path(ca).read_bytes()
    chain, key = (None, None) if certificate is None else (Path(part).read_bytes() for part in certificate)
    tls = grpc.ssl_channel_credentials(roots, key, chain)
    if token is None:
        return tls
    return grpc.composite_channel_credentials(tls, grpc.access_token_call_credentials(token.strip()))


def controller(name: Controller) -> figure_pb2.Controller.ValueType:
    """A controller by name."""
    return figure_pb2.Controller.Value(choice(figure_pb2.Controller.keys(), "CONTROLLER_", name, "controller"))


def stepper(name: Stepper) -> figure_pb2.Stepper.ValueType:
    """A stepper by name."""
    return figure_pb2.Stepper.Value(choice(figure_pb2.Stepper.keys(), "STEPPER_", name, "stepper"))


def follow(name: Follow | None) -> motion_pb2.Follow.ValueType:
    """How far it may go, by name; the default if there is none."""
    if name is None:
        return motion_pb2.FOLLOW_UNSPECIFIED
    return motion_pb2.Follow.Value(choice(motion_pb2.Follow.keys(), "FOLLOW_", name, "follow"))


def encoding(name: Encoding) -> types_pb2.Encoding.ValueType:
    """An encoding by name."""
    return types_pb2.Encoding.Value(choice(types_pb2.Encoding.keys(), "ENCODING_", name, "encoding"))


def overrun(name: str) -> world_pb2.OverrunPolicy.ValueType:
    """An overrun policy by name."""
    known = world_pb2.OverrunPolicy.keys()
    return world_pb2.OverrunPolicy.Value(choice(known, "OVERRUN_POLICY_", name, "overrun"))


def mobility(name: Mobility) -> obstacle_pb2.ObstacleMobility.ValueType:
    """A mobility of an obstacle by name."""
    known = obstacle_pb2.ObstacleMobility.keys()
    return obstacle_pb2.ObstacleMobility.Value(choice(known, "OBSTACLE_MOBILITY_", name, "mobility"))


MOBILITIES: Mapping[int, Mobility] = {
    obstacle_pb2.OBSTACLE_MOBILITY_FIXED: "fixed",
    obstacle_pb2.OBSTACLE_MOBILITY_LED: "led",
    obstacle_pb2.OBSTACLE_MOBILITY_FREE: "free",
}


def event_types(names: Iterable[str]) -> list[state_pb2.EventType.ValueType]:
    """Event types by name."""
    known = state_pb2.EventType.keys()
    return [state_pb2.EventType.Value(choice(known, "EVENT_TYPE_", n, "event type")) for n in names]


# Fields of a figure's frame that a view can choose: those that follow the three that every frame has.
VIEW_FIELDS = tuple(f.name for f in frame_pb2.FigureFrame.DESCRIPTOR.fields)[3:]


def view(
    fields: Sequence[str],
    *,
    figures: Iterable[str] = (),
    numbers: Encoding = "double",
    rate_divisor: int = 1,
) -> state_pb2.View:
    """What of a world is sent."""
    if isinstance(fields, str):
        raise TypeError(f"fields is a list of names, got the text {fields!r}: write fields=[{fields!r}]")
    # A newer server may know more; an older one refuses what it does not know, with its own list.
    for name in fields:
        if name != "*" and name not in VIEW_FIELDS:
            raise ValueError(f"frame field {name!r} is none of {', '.join(VIEW_FIELDS)}, *")
    return state_pb2.View(
        figure_ids=list(figures),
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
    follows: Follow | None = None,
    max_help_weights: float | None = None,
    constraints: Iterable[Constraint] | None = None,
    protective_steps: bool | None = None,
    self_contact: bool | None = None,
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
    if follows is not None:
        out.follow = follow(follows)
    if max_help_weights is not None:
        out.max_help_weights = max_help_weights
    if constraints is not None:
        out.constraints.extend(c.message() for c in constraints)
    if protective_steps is not None:
        out.protective_steps = protective_steps
    if self_contact is not None:
        out.self_contact = self_contact
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
    out.figure_id = name
    if tick is not None:
        out.tick = tick
    return out


def timed(disturbances: Iterable[Disturbance]) -> list[simulation_pb2.TimedPerturbation]:
    """Disturbances in time of a clip."""
    return [simulation_pb2.TimedPerturbation(start_s=d.start_s, perturbation=d.message()) for d in disturbances]


def obstacle(
    shape: Shape,
    *,
    position: Vector,
    rotation: Sequence[float] | None,
    mobility_name: Mobility,
    mass_kg: float,
    friction: float | None,
    velocity: Vector,
    angular_velocity: Vector,
) -> obstacle_pb2.Obstacle:
    """An obstacle, without its name."""
    out = obstacle_pb2.Obstacle(
        mobility=mobility(mobility_name),
        mass_kg=mass_kg,
        friction=friction,
        velocity_mps=vector(velocity),
        angular_velocity_rad_s=vector(angular_velocity),
    )
    shape.put(out)
    out.pose.position_m.CopyFrom(vector(position))
    if rotation is not None:
        out.pose.rotation.CopyFrom(quaternion(rotation))
    return out


def obstacle_changes(
    *,
    shape: Shape | None,
    position: Vector | None,
    rotation: Sequence[float] | None,
    mobility_name: Mobility | None,
    mass_kg: float | None,
    friction: float | None,
    velocity: Vector | None,
    angular_velocity: Vector | None,
) -> tuple[obstacle_pb2.Obstacle, list[str]]:
    """What is to change of an obstacle, and the fields that name it; what is `None` is left out."""
    out = obstacle_pb2.Obstacle()
    paths = []
    if shape is not None:
        shape.put(out)
        paths.append(str(out.WhichOneof("shape")))
    if mobility_name is not None:
        out.mobility = mobility(mobility_name)
        paths.append("mobility")
    if mass_kg is not None:
        out.mass_kg = mass_kg
        paths.append("mass_kg")
    if friction is not None:
        out.friction = friction
        paths.append("friction")
    if position is not None:
        out.pose.position_m.CopyFrom(vector(position))
    if rotation is not None:
        out.pose.rotation.CopyFrom(quaternion(rotation))
    if out.HasField("pose"):
        paths.append("pose")
    if velocity is not None:
        out.velocity_mps.CopyFrom(vector(velocity))
        paths.append("velocity_mps")
    if angular_velocity is not None:
        out.angular_velocity_rad_s.CopyFrom(vector(angular_velocity))
        paths.append("angular_velocity_rad_s")
    return out, paths


def quaternion(q: Sequence[float]) -> types_pb2.Quaternion:
    """Four numbers as a message."""
    if len(q) != 4:
        raise ValueError(f"a rotation has 4 numbers x, y, z, w, got {len(q)}")
    x, y, z, w = (float(c) for c in q)
    return types_pb2.Quaternion(x=x, y=y, z=z, w=w)
