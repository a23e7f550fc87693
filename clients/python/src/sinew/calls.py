"""Every request once: what is sent, to which method, and what is made of the answer.

The synchronous and the asynchronous client differ only in how they carry a `Call` out.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, Literal, TypeAlias, TypeVar, Union

import numpy as np
from google.protobuf.field_mask_pb2 import FieldMask
from google.protobuf.message import Message

from sinew.body import Body
from sinew.frame import Event, Frame, Roster
from sinew.motion import Clip, Floats, Motion
from sinew.recording import DRAWN, Recording
from sinew.v1 import (
    body_pb2,
    figure_pb2,
    motion_pb2,
    perturbation_pb2,
    server_pb2,
    simulation_pb2,
    state_pb2,
    types_pb2,
    world_pb2,
)
from sinew.values import Controller, Disturbance, Encoding, Profile, Strength, last, resource

T = TypeVar("T")
R = TypeVar("R", bound=Message)
Source: TypeAlias = Union[str, "os.PathLike[str]", bytes, Clip]
"""A motion: name of a clip of the server, path or bytes of a BVH file, or a `Clip`."""
ClipSource: TypeAlias = Union["os.PathLike[str]", str, bytes, Motion]
"""A motion to store: path or bytes of a BVH file, or arrays."""

_CONTROLLERS = {
    None: figure_pb2.CONTROLLER_UNSPECIFIED,
    "modern": figure_pb2.CONTROLLER_MODERN,
    "paper": figure_pb2.CONTROLLER_PAPER,
    "motors": figure_pb2.CONTROLLER_MOTORS,
}
_ENCODINGS = {
    "float": types_pb2.ENCODING_FLOAT,
    "double": types_pb2.ENCODING_DOUBLE,
    "fixed16": types_pb2.ENCODING_FIXED16,
}


@dataclass(frozen=True)
class Call(Generic[R, T]):
    """One request: method, message, type of the answer, what is made of it."""

    method: str
    request: Message
    response: type[R]
    result: Callable[[R], T]


def _call(method: str, request: Message, response: type[R], result: Callable[[R], T]) -> Call[R, T]:
    return Call(f"/sinew.v1.{method}", request, response, result)


def _nothing(_: Message) -> None:
    return None


def view(
    *, fields: Sequence[str] | None, encoding: Encoding, figures: Sequence[str] = (), every: int = 1
) -> state_pb2.View:
    """What of a world is sent."""
    mask = FieldMask(paths=list(fields if fields is not None else DRAWN))
    return state_pb2.View(figures=list(figures), fields=mask, encoding=_ENCODINGS[encoding], rate_divisor=every)


def settings(
    *,
    body: str | Profile | None = None,
    strength: float | Strength | None = None,
    controller: Controller | None = None,
    place: tuple[float, float, float] | None = None,
    assist: float = 0.0,
    fatigue_time_scale: float = 0.0,
    display_name: str = "",
) -> figure_pb2.Figure:
    """A figure as it is asked for."""
    figure = figure_pb2.Figure(
        display_name=display_name,
        controller=_CONTROLLERS[controller],
        assist=assist,
        fatigue_time_scale=fatigue_time_scale,
    )
    if isinstance(body, Profile):
        figure.profile.CopyFrom(body.message())
    elif body is not None:
        figure.body = resource("bodies", body)
    if strength is not None:
        scale = strength if isinstance(strength, Strength) else Strength(all=strength)
        figure.strength.CopyFrom(scale.message())
    if place is not None:
        figure.placement.CopyFrom(_placement(place))
    return figure


def _placement(place: tuple[float, float, float]) -> types_pb2.Placement:
    x, y, yaw = place
    return types_pb2.Placement(x_m=x, y_m=y, yaw_rad=yaw)


# ---------------------------------------------------------------------------------------------------------------- server


@dataclass(frozen=True)
class ServerInfo:
    """Version and abilities of a server."""

    version: str
    flag_names: tuple[str, ...]
    fields: tuple[str, ...]
    builtin_clips: tuple[str, ...]
    capabilities: tuple[str, ...]
    limits: dict[str, int]


def server_info() -> Call[server_pb2.GetServerInfoResponse, ServerInfo]:
    return _call(
        "ServerService/GetServerInfo",
        server_pb2.GetServerInfoRequest(),
        server_pb2.GetServerInfoResponse,
        lambda r: ServerInfo(
            version=r.version,
            flag_names=tuple(r.flag_names),
            fields=tuple(r.view_fields),
            builtin_clips=tuple(last(c) for c in r.builtin_clips),
            capabilities=tuple(r.capabilities),
            limits={x.name: x.value for x in r.limits},
        ),
    )


def get_body(name: str, *, geometry: bool) -> Call[body_pb2.GetBodyResponse, Body]:
    request = body_pb2.GetBodyRequest(name=resource("bodies", name), include_geometry=geometry)
    return _call("BodyService/GetBody", request, body_pb2.GetBodyResponse, lambda r: Body.of(r.body))


def export_body(name: str, form: Literal["mjcf", "urdf"]) -> Call[body_pb2.ExportBodyResponse, str]:
    kinds = {"mjcf": body_pb2.EXPORT_FORMAT_MJCF, "urdf": body_pb2.EXPORT_FORMAT_URDF}
    request = body_pb2.ExportBodyRequest(name=resource("bodies", name), format=kinds[form])
    return _call("BodyService/ExportBody", request, body_pb2.ExportBodyResponse, lambda r: r.text)


# ----------------------------------------------------------------------------------------------------------------- clips


def _bvh(source: str | os.PathLike[str] | bytes) -> motion_pb2.BvhSource:
    return motion_pb2.BvhSource(data=source if isinstance(source, bytes) else Path(source).read_bytes())


def create_clip(source: ClipSource, name: str, body: str) -> Call[motion_pb2.CreateClipResponse, Clip]:
    request = motion_pb2.CreateClipRequest(clip_id=last(name), body=resource("bodies", body) if body else "")
    if isinstance(source, Motion):
        request.frames.rate_hz = source.rate_hz
        request.frames.frames.extend(source.messages())
    else:
        request.bvh.CopyFrom(_bvh(source))
    return _call("MotionService/CreateClip", request, motion_pb2.CreateClipResponse, lambda r: Clip.of(r.clip))


def get_clip(name: str) -> Call[motion_pb2.GetClipResponse, Clip]:
    request = motion_pb2.GetClipRequest(name=resource("clips", name))
    return _call("MotionService/GetClip", request, motion_pb2.GetClipResponse, lambda r: Clip.of(r.clip))


def list_clips(page_token: str) -> Call[motion_pb2.ListClipsResponse, tuple[list[Clip], str]]:
    request = motion_pb2.ListClipsRequest(page_token=page_token, page_size=1000)
    return _call(
        "MotionService/ListClips",
        request,
        motion_pb2.ListClipsResponse,
        lambda r: ([Clip.of(c) for c in r.clips], r.next_page_token),
    )


def delete_clip(name: str) -> Call[motion_pb2.DeleteClipResponse, None]:
    request = motion_pb2.DeleteClipRequest(name=resource("clips", name))
    return _call("MotionService/DeleteClip", request, motion_pb2.DeleteClipResponse, _nothing)


def is_file(source: Source) -> bool:
    """Whether a source is a BVH file and not a clip that the server has."""
    return not isinstance(source, (str, Clip)) or (isinstance(source, str) and source.lower().endswith(".bvh"))


def simulate(
    source: Source,
    *,
    figure: figure_pb2.Figure,
    disturbances: Iterable[Disturbance],
    rate_hz: float,
    duration_s: float,
    loop: bool,
    frames: state_pb2.View,
) -> tuple[simulation_pb2.SimulateClipRequest, Callable[[simulation_pb2.SimulateClipResponse, Body], Recording]]:
    """The request, and how a recording is made of the answer once the body is known."""
    request = simulation_pb2.SimulateClipRequest(
        figure=figure, rate_hz=rate_hz, duration_s=duration_s, loop=loop, view=frames
    )
    if isinstance(source, Clip):
        request.clip = resource("clips", source.name)
    elif isinstance(source, str) and not is_file(source):
        request.clip = resource("clips", source)
    else:
        request.bvh.CopyFrom(_bvh(source))
    for d in disturbances:
        request.perturbations.add(start_s=d.start_s, perturbation=d.message())

    def result(response: simulation_pb2.SimulateClipResponse, body: Body) -> Recording:
        roster = Roster.alone(body.name, response.summary.rate_hz)
        taken = [Frame.of(f, roster) for f in response.frames]
        return Recording.of(
            [(f.tick, f.time_s, f.only()) for f in taken],
            body=body,
            rate_hz=response.summary.rate_hz,
            events=[Event.of(e) for e in response.events],
            summary=response.summary,
        )

    return request, result


# ---------------------------------------------------------------------------------------------------------------- worlds


def create_world(
    name: str,
    *,
    rate_hz: float,
    substeps: int,
    gravity_mps2: float | None,
    friction: float | None,
    speed: float,
    paused: bool,
) -> Call[world_pb2.CreateWorldResponse, world_pb2.World]:
    world = world_pb2.World(
        rate_hz=rate_hz, substeps=substeps, gravity_mps2=gravity_mps2, friction=friction, speed=speed
    )
    request = world_pb2.CreateWorldRequest(world_id=last(name), world=world, paused=paused)
    return _call("WorldService/CreateWorld", request, world_pb2.CreateWorldResponse, lambda r: r.world)


def get_world(name: str) -> Call[world_pb2.GetWorldResponse, world_pb2.World]:
    request = world_pb2.GetWorldRequest(name=resource("worlds", name))
    return _call("WorldService/GetWorld", request, world_pb2.GetWorldResponse, lambda r: r.world)


def list_worlds(token: str) -> Call[world_pb2.ListWorldsResponse, tuple[list[world_pb2.World], str]]:
    request = world_pb2.ListWorldsRequest(page_token=token, page_size=1000)
    return _call(
        "WorldService/ListWorlds", request, world_pb2.ListWorldsResponse, lambda r: (list(r.worlds), r.next_page_token)
    )


def delete_world(name: str) -> Call[world_pb2.DeleteWorldResponse, None]:
    request = world_pb2.DeleteWorldRequest(name=name)
    return _call("WorldService/DeleteWorld", request, world_pb2.DeleteWorldResponse, _nothing)


def pause_world(name: str) -> Call[world_pb2.PauseWorldResponse, None]:
    return _call(
        "WorldService/PauseWorld", world_pb2.PauseWorldRequest(name=name), world_pb2.PauseWorldResponse, _nothing
    )


def resume_world(name: str) -> Call[world_pb2.ResumeWorldResponse, None]:
    return _call(
        "WorldService/ResumeWorld", world_pb2.ResumeWorldRequest(name=name), world_pb2.ResumeWorldResponse, _nothing
    )


def step_world(name: str, ticks: int) -> Call[world_pb2.StepWorldResponse, int]:
    request = world_pb2.StepWorldRequest(name=name, tick_count=ticks)
    return _call("WorldService/StepWorld", request, world_pb2.StepWorldResponse, lambda r: r.tick)


def set_speed(name: str, speed: float) -> Call[world_pb2.SetWorldSpeedResponse, None]:
    request = world_pb2.SetWorldSpeedRequest(name=name, speed=speed)
    return _call("WorldService/SetWorldSpeed", request, world_pb2.SetWorldSpeedResponse, _nothing)


def get_frame(
    world: str, tick: int | None, frames: state_pb2.View
) -> Call[state_pb2.GetWorldFrameResponse, tuple[Roster, Frame]]:
    def result(r: state_pb2.GetWorldFrameResponse) -> tuple[Roster, Frame]:
        roster = Roster.of(r.roster)
        return roster, Frame.of(r.frame, roster)

    request = state_pb2.GetWorldFrameRequest(world=world, tick=tick, view=frames)
    return _call("StateService/GetWorldFrame", request, state_pb2.GetWorldFrameResponse, result)


def watch_world(
    world: str, frames: state_pb2.View, resume_tick: int | None
) -> Call[state_pb2.WatchWorldResponse, state_pb2.WatchWorldResponse]:
    request = state_pb2.WatchWorldRequest(world=world, view=frames, resume_tick=resume_tick)
    return _call("StateService/WatchWorld", request, state_pb2.WatchWorldResponse, lambda r: r)


def watch_events(
    world: str, figures: Sequence[str]
) -> Call[state_pb2.WatchEventsResponse, list[Event]]:
    request = state_pb2.WatchEventsRequest(world=world, figures=list(figures))
    return _call(
        "StateService/WatchEvents",
        request,
        state_pb2.WatchEventsResponse,
        lambda r: [Event.of(e) for e in r.events],
    )


# --------------------------------------------------------------------------------------------------------------- figures


def create_figure(
    world: str, name: str, figure: figure_pb2.Figure
) -> Call[figure_pb2.CreateFigureResponse, figure_pb2.Figure]:
    request = figure_pb2.CreateFigureRequest(parent=world, figure_id=last(name), figure=figure)
    return _call("FigureService/CreateFigure", request, figure_pb2.CreateFigureResponse, lambda r: r.figure)


def get_figure(name: str) -> Call[figure_pb2.GetFigureResponse, figure_pb2.Figure]:
    request = figure_pb2.GetFigureRequest(name=name)
    return _call("FigureService/GetFigure", request, figure_pb2.GetFigureResponse, lambda r: r.figure)


def list_figures(
    world: str, token: str
) -> Call[figure_pb2.ListFiguresResponse, tuple[list[figure_pb2.Figure], str]]:
    request = figure_pb2.ListFiguresRequest(parent=world, page_token=token, page_size=1000)
    return _call(
        "FigureService/ListFigures",
        request,
        figure_pb2.ListFiguresResponse,
        lambda r: (list(r.figures), r.next_page_token),
    )


def update_figure(
    name: str,
    *,
    strength: float | Strength | None,
    controller: Controller | None,
    assist: float | None,
    fatigue_time_scale: float | None,
) -> Call[figure_pb2.UpdateFigureResponse, None]:
    figure = settings(
        strength=strength,
        controller=controller,
        assist=assist or 0.0,
        fatigue_time_scale=fatigue_time_scale or 0.0,
    )
    figure.name = name
    given = {
        "strength": strength,
        "controller": controller,
        "assist": assist,
        "fatigue_time_scale": fatigue_time_scale,
    }
    mask = FieldMask(paths=[k for k, v in given.items() if v is not None])
    request = figure_pb2.UpdateFigureRequest(figure=figure, update_mask=mask)
    return _call("FigureService/UpdateFigure", request, figure_pb2.UpdateFigureResponse, _nothing)


def delete_figure(name: str) -> Call[figure_pb2.DeleteFigureResponse, None]:
    request = figure_pb2.DeleteFigureRequest(name=name)
    return _call("FigureService/DeleteFigure", request, figure_pb2.DeleteFigureResponse, _nothing)


def reset_figure(
    name: str, place: tuple[float, float, float] | None
) -> Call[figure_pb2.ResetFigureResponse, None]:
    request = figure_pb2.ResetFigureRequest(name=name, placement=_placement(place) if place else None)
    return _call("FigureService/ResetFigure", request, figure_pb2.ResetFigureResponse, _nothing)


def play(
    figure: str,
    clip: str | Clip,
    *,
    speed: float,
    loop: bool,
    start_time_s: float | None,
    reset: bool,
    place: tuple[float, float, float] | None,
) -> Call[motion_pb2.PlayClipResponse, float]:
    request = motion_pb2.PlayClipRequest(
        figure=figure,
        clip=resource("clips", clip if isinstance(clip, str) else clip.name),
        speed=speed,
        loop=loop,
        start_time_s=start_time_s,
        reset=reset,
        placement=_placement(place) if place else None,
    )
    return _call("MotionService/PlayClip", request, motion_pb2.PlayClipResponse, lambda r: r.start_time_s)


def stop(figure: str) -> Call[motion_pb2.StopClipResponse, None]:
    request = motion_pb2.StopClipRequest(figure=figure)
    return _call("MotionService/StopClip", request, motion_pb2.StopClipResponse, _nothing)


def perturb(
    world: str, figure: str, disturbances: Sequence[Disturbance], *, tick: int, rate_hz: float
) -> Call[perturbation_pb2.ApplyPerturbationsResponse, int]:
    request = perturbation_pb2.ApplyPerturbationsRequest(world=world)
    for d in disturbances:
        message = d.message()
        message.figure = last(figure)
        if d.start_s > 0:
            message.tick = tick + round(d.start_s * rate_hz)
        request.perturbations.append(message)
    return _call(
        "PerturbationService/ApplyPerturbations",
        request,
        perturbation_pb2.ApplyPerturbationsResponse,
        lambda r: r.tick,
    )


def clear(figure: str) -> Call[perturbation_pb2.ClearPerturbationsResponse, None]:
    request = perturbation_pb2.ClearPerturbationsRequest(figure=figure)
    return _call(
        "PerturbationService/ClearPerturbations", request, perturbation_pb2.ClearPerturbationsResponse, _nothing
    )


# ----------------------------------------------------------------------------------------------------------------- drive


def drive_header(
    world: str, figures: Sequence[str], *, rate_hz: float, delay_ms: float | None, reset: bool, driver_id: str
) -> motion_pb2.DriveFiguresRequest:
    header = motion_pb2.DriveHeader(
        world=world,
        figures=[last(f) for f in figures],
        driver_id=driver_id,
        nominal_rate_hz=rate_hz,
        playout_delay_ms=delay_ms,
        reset=reset,
    )
    return motion_pb2.DriveFiguresRequest(header=header)


def drive_frame(
    sequence: int, time_s: float, figures: dict[str, motion_pb2.FigureMotion]
) -> motion_pb2.DriveFiguresRequest:
    frame = motion_pb2.MotionFrame(sequence=sequence, source_time_ns=round(time_s * 1e9))
    for name, motion in figures.items():
        motion.figure = name
        frame.figures.append(motion)
    return motion_pb2.DriveFiguresRequest(batch=motion_pb2.MotionBatch(frames=[frame]))


DRIVE = "/sinew.v1.MotionService/DriveFigures"


@dataclass(frozen=True)
class Feedback:
    """How the live motion of one figure arrives: counts of ticks by how they were answered, delays in ms."""

    figure: str
    applied_sequence: int
    buffered_ms: float
    playout_delay_ms: float
    jitter_ms: float
    interpolated: int
    extrapolated: int
    held: int
    late: int
    refused_batches: int

    @classmethod
    def of(cls, message: motion_pb2.DriveFeedback) -> list[Feedback]:
        """One per driven figure."""
        return [
            cls(
                figure=f.figure,
                applied_sequence=f.applied_sequence,
                buffered_ms=f.buffered_ms,
                playout_delay_ms=f.playout_delay_ms,
                jitter_ms=f.jitter_ms,
                interpolated=f.interpolated_count + f.present_count,
                extrapolated=f.extrapolated_count,
                held=f.held_count,
                late=f.late_count,
                refused_batches=message.refused_batch_count,
            )
            for f in message.figures
        ]


def frames_of(response: state_pb2.WatchWorldResponse, roster: Roster) -> tuple[Roster, Frame | None]:
    """The roster that holds after a message of a watch, and the frame if it was one."""
    if response.WhichOneof("message") == "roster":
        return Roster.of(response.roster), None
    return roster, Frame.of(response.frame, roster)


def as_motion(source: Motion | Floats, rate_hz: float | None) -> Motion:
    """Arrays as a motion: `(n, 39)` joint angles, or `(n, 46)` with the pelvis pose before them."""
    if isinstance(source, Motion):
        return source
    return Motion.from_array(np.asarray(source, dtype=np.float64), rate_hz=rate_hz or 60.0)





def body_name(body: str | Profile | None) -> str:
    """Name of the body that a figure asked for like this has."""
    return body.name if isinstance(body, Profile) else last(body or "adult-man")


def is_paused(world: world_pb2.World) -> bool:
    """Whether its clock is stopped."""
    return world.state == world_pb2.WORLD_STATE_PAUSED
