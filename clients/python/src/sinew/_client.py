"""The client for plain calls, made from `_async_client.py` by `clients/python/tools/unasync.py`: do not edit."""

from __future__ import annotations

import os
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import timedelta
from pathlib import Path
from types import TracebackType
from typing import Literal, TypeAlias

import numpy as np
from google.protobuf.field_mask_pb2 import FieldMask
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Self

from sinew import _requests as requests
from sinew._sync_support import Duplex, Method, Request, Response, Stream, call, call_all, open_channel, pause
from sinew._progress import Progress
from sinew.body import Body
from sinew.errors import (
    AbortedError,
    DeadlineError,
    NotFoundError,
    PreconditionError,
    SinewError,
    from_status,
    not_found,
    paused,
    with_names,
)
from sinew.frames import Beginning, Event, FigureState, Frame
from sinew.frames import frame as to_frame
from sinew.motion import Motion, Pose, bvh_source, is_file
from sinew.recording import RECORDED, Recording, Recordings, collect
from sinew.v1 import (
    access_pb2_grpc,
    body_pb2,
    body_pb2_grpc,
    checkpoint_pb2,
    checkpoint_pb2_grpc,
    control_pb2_grpc,
    figure_pb2,
    figure_pb2_grpc,
    frame_pb2,
    history_pb2,
    history_pb2_grpc,
    motion_pb2,
    motion_pb2_grpc,
    obstacle_pb2,
    obstacle_pb2_grpc,
    operation_pb2,
    operation_pb2_grpc,
    perturbation_pb2,
    perturbation_pb2_grpc,
    recording_pb2,
    recording_pb2_grpc,
    server_pb2,
    server_pb2_grpc,
    simulation_pb2,
    simulation_pb2_grpc,
    state_pb2,
    state_pb2_grpc,
    types_pb2,
    world_pb2,
    world_pb2_grpc,
)
from sinew.values import (
    Constraint,
    Controller,
    Disturbance,
    Encoding,
    Follow,
    Force,
    Load,
    Mobility,
    Paper,
    Profile,
    Push,
    Shape,
    Stepper,
    Strength,
    Vector,
    last,
    resource,
    shape_of,
)

__all__ = ["Client", "Clip", "Drive", "Events", "Figure", "Frames", "Obstacle", "ServerInfo", "World"]

PathLike: TypeAlias = "str | os.PathLike[str]"

# Ticks that are stepped before their frames are fetched; the server holds 64 unless told otherwise.
_CHUNK = 16
# Times that a figure is looked at until its drive is over.
_RELEASE_TRIES = 200
# A simulation may take its time.
_LONG_S = 600.0
# Longest wait of one call for an operation.
_WAIT_S = 60.0
# A watch that is silent for this long looks whether its world is paused.
_QUIET_S = 0.25


@dataclass(frozen=True)
class ServerInfo:
    """What a server is and can do."""

    version: str
    """Version of the server, which is that of the package that belongs to it."""
    flags: tuple[str, ...]
    """Names of the status flags, by bit."""
    view_fields: tuple[str, ...]
    """Fields that a view can ask for."""
    builtin_clips: tuple[str, ...]
    """Names of the motions that come with the server."""
    capabilities: tuple[str, ...]
    """What this server can do, by name."""
    limits: Mapping[str, int]
    """Limits of the configuration by name: counts, unless the name says a unit."""


class Client:
    """A connection to one server. Use it in a `with` block, or `close` it.

    `address` is host and port, or the URL that the server prints. Calls raise `sinew.SinewError`; unary calls give up
    after `timeout_s` (s). A `NotFoundError` lists the names that there are.

    To a server with TLS: `address` begins with `https://`; `ca` is a PEM file with the roots that its certificate is
    checked with (those of the system if absent), `token` a bearer token, `certificate` the PEM files of the client's
    certificate and private key.
    """

    def __init__(
        self,
        address: str = f"127.0.0.1:{requests.PORT}",
        *,
        timeout_s: float = 60.0,
        token: str | None = None,
        ca: PathLike | None = None,
        certificate: tuple[PathLike, PathLike] | None = None,
    ) -> None:
        self.address = requests.address(address)
        self.timeout_s = timeout_s
        credentials = requests.credentials(address, token=token, ca=ca, certificate=certificate)
        self._channel = open_channel(self.address, requests.OPTIONS, credentials)
        self.worlds_stub = world_pb2_grpc.WorldServiceStub(self._channel)
        self.figures_stub = figure_pb2_grpc.FigureServiceStub(self._channel)
        self.bodies_stub = body_pb2_grpc.BodyServiceStub(self._channel)
        self.motions_stub = motion_pb2_grpc.MotionServiceStub(self._channel)
        self.perturbations_stub = perturbation_pb2_grpc.PerturbationServiceStub(self._channel)
        self.states_stub = state_pb2_grpc.StateServiceStub(self._channel)
        self.simulations_stub = simulation_pb2_grpc.SimulationServiceStub(self._channel)
        self.obstacles_stub = obstacle_pb2_grpc.ObstacleServiceStub(self._channel)
        self.operations_stub = operation_pb2_grpc.OperationServiceStub(self._channel)
        self.server_stub = server_pb2_grpc.ServerServiceStub(self._channel)
        self.access_stub = access_pb2_grpc.AccessServiceStub(self._channel)
        self.control_stub = control_pb2_grpc.ControlServiceStub(self._channel)
        self.checkpoints_stub = checkpoint_pb2_grpc.CheckpointServiceStub(self._channel)
        self.history_stub = history_pb2_grpc.HistoryServiceStub(self._channel)
        self.recordings_stub = recording_pb2_grpc.RecordingServiceStub(self._channel)
        self._bodies: dict[str, Body] = {}

    def __repr__(self) -> str:
        return f"Client({self.address!r})"

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Ends the connection."""
        self._channel.close()

    def info(self) -> ServerInfo:
        """Version, capabilities and limits."""
        r = self._ask(self.server_stub.GetServerInfo, server_pb2.GetServerInfoRequest())
        return ServerInfo(
            version=r.version,
            flags=tuple(r.flag_names),
            view_fields=tuple(r.view_fields),
            builtin_clips=tuple(last(n) for n in r.builtin_clips),
            capabilities=tuple(r.capabilities),
            limits={x.name: x.value for x in r.limits},
        )

    def _ask(
        self, method: Method[Request, Response], request: Request, timeout_s: float | None = None
    ) -> Response:
        """One call. The error of a name that is not there lists those that are."""
        try:
            return call(method, request, self.timeout_s if timeout_s is None else timeout_s)
        except NotFoundError as e:
            raise self._with_names(e) from None

    def _with_names(self, error: NotFoundError) -> NotFoundError:
        try:
            names = self._names(error)
        except SinewError:
            return error
        return error if names is None else with_names(error, names)

    def _names(self, error: NotFoundError) -> list[str] | None:
        """What there is of the kind that was not found; `None` if the client cannot know."""
        if error.kind == "body":
            return self.bodies()
        if error.kind == "clip":
            return [c.name for c in self.clips()]
        if error.kind == "world":
            return [w.name for w in self.worlds()]
        parts = error.resource.split("/")
        if len(parts) == 4 and parts[0] == "worlds":
            world = World(self, "/".join(parts[:2]), 60.0)
            if error.kind == "figure":
                return [f.name for f in world.figures()]
            if error.kind == "obstacle":
                return [o.name for o in world.obstacles()]
        return None

    # Bodies.

    def bodies(self) -> list[str]:
        """Names of the named bodies and of those in use."""
        out: list[str] = []
        token = ""
        while True:
            request = body_pb2.ListBodiesRequest(page_size=1000, page_token=token)
            r = self._ask(self.bodies_stub.ListBodies, request)
            out.extend(last(b.name) for b in r.bodies)
            token = r.next_page_token
            if not token:
                return out

    def body(self, name: str) -> Body:
        """One body with its surfaces (m, segment frames). Bodies never change; each is fetched once."""
        full = resource("bodies", name)
        if full not in self._bodies:
            request = body_pb2.GetBodyRequest(name=full, include_geometry=True)
            r = self._ask(self.bodies_stub.GetBody, request)
            self._bodies[full] = Body(r.body)
        return self._bodies[full]

    def export_body(self, name: str, form: str = "mjcf") -> str:
        """One body as text for another simulator, in SI units, z up: `mjcf` (exact) or `urdf` (ball joints as three
        hinges).

        Torque bounds (N·m) are the largest isometric torques of the average person over the range of each joint: MJCF
        has a motor for each degree of freedom, named after it, URDF `effort` and `velocity` (rad/s).
        """
        chosen = {"mjcf": body_pb2.EXPORT_FORMAT_MJCF, "urdf": body_pb2.EXPORT_FORMAT_URDF}
        if form not in chosen:
            raise ValueError(f"form {form!r} is none of mjcf, urdf")
        request = body_pb2.ExportBodyRequest(name=resource("bodies", name), format=chosen[form])
        return (self._ask(self.bodies_stub.ExportBody, request)).text

    # Clips.

    def clips(self) -> list[Clip]:
        """All clips, built-in ones included, without their reports."""
        out: list[Clip] = []
        token = ""
        while True:
            request = motion_pb2.ListClipsRequest(page_size=1000, page_token=token)
            r = self._ask(self.motions_stub.ListClips, request)
            out.extend(Clip(self, c) for c in r.clips)
            token = r.next_page_token
            if not token:
                return out

    def clip(self, name: str) -> Clip:
        """One clip."""
        request = motion_pb2.GetClipRequest(name=resource("clips", name))
        return Clip(self, (self._ask(self.motions_stub.GetClip, request)).clip)

    def upload_bvh(
        self,
        source: PathLike | bytes,
        *,
        name: str = "",
        body: str = "adult-man",
        unit_m: float | None = None,
        up_axis: str = "",
        rate_hz: float | None = None,
        fit_floor: bool = True,
        lock_feet: bool = True,
        cutoff_hz: float = 6.0,
        walk_runs: bool | None = None,
        follow: Follow | None = None,
        max_help_weights: float | None = None,
    ) -> Clip:
        """Stores a BVH file (path or bytes) as a clip; `Clip.report` says how it was understood.

        Unit (`unit_m`: metres per unit of the file) and up axis (`x`, `y` or `z`) are guessed unless given; `rate_hz`
        replaces the file's frame time. `fit_floor` puts the lowest sole on z = 0, `lock_feet` holds standing feet,
        `cutoff_hz` is that of the smoothing filter, Hz. Runs are slowed down to walks, which a body of measured
        strength can follow, unless the clip gets help; `walk_runs` decides. `follow` and `max_help_weights` are those
        with which the clip is played unless `Figure.play` says otherwise.
        """
        bvh = bvh_source(
            source,
            unit_m=unit_m,
            up_axis=up_axis,
            rate_hz=rate_hz,
            fit_floor=fit_floor,
            lock_feet=lock_feet,
            cutoff_hz=cutoff_hz,
            walk_runs=walk_runs,
        )
        display = "" if isinstance(source, bytes) else Path(source).name[:64]
        request = motion_pb2.CreateClipRequest(
            clip_id=name,
            display_name=display,
            body=resource("bodies", body),
            bvh=bvh,
            follow=requests.follow(follow),
            max_help_weights=max_help_weights,
        )
        return Clip(self, (self._ask(self.motions_stub.CreateClip, request)).clip)

    def upload_motion(self, motion: Motion, *, name: str = "", body: str = "adult-man") -> Clip:
        """Stores arrays (rad, m, world frame; see `Motion`) as a clip."""
        frames = [motion.pose(i).message() for i in range(len(motion))]
        request = motion_pb2.CreateClipRequest(
            clip_id=name,
            body=resource("bodies", body),
            frames=motion_pb2.FrameSource(rate_hz=motion.rate_hz, frames=frames),
        )
        return Clip(self, (self._ask(self.motions_stub.CreateClip, request)).clip)

    # Worlds.

    def create_world(
        self,
        name: str = "",
        *,
        paused: bool = True,
        rate_hz: float = 60.0,
        substeps: int = 2,
        gravity: float = 9.81,
        friction: float = 0.9,
        speed: float = 1.0,
        overrun: str = "skip",
        display_name: str = "",
        replace: bool = False,
    ) -> World:
        """Creates a world. Here it is paused unless told otherwise: `record` and `step` then move it as fast as it
        computes, and equal inputs give equal bits. `paused=False` starts its clock. `replace` deletes a world that has
        the name already.

        `rate_hz`: ticks per second of world time, 10 to 1000; `substeps` of the dynamics in each, 1 to 16. `gravity`
        m/s², downward, 0 to 30. `friction`: coefficient of the ground, 0.05 to 2. `speed`: world seconds per wall
        second, 0.01 to 10. `overrun`: what the clock does when a tick takes too long: `skip`, `catch_up` or `dilate`.
        """
        if replace and name:
            try:
                World(self, resource("worlds", name), rate_hz).delete()
            except NotFoundError:
                pass
        settings = world_pb2.World(
            display_name=display_name,
            rate_hz=rate_hz,
            substep_count=substeps,
            gravity_mps2=gravity,
            friction=friction,
            speed=speed,
            overrun_policy=requests.overrun(overrun),
        )
        request = world_pb2.CreateWorldRequest(world_id=name, world=settings, paused=paused)
        w = (self._ask(self.worlds_stub.CreateWorld, request)).world
        return World(self, w.name, w.rate_hz)

    def world(self, name: str) -> World:
        """A world that is there."""
        request = world_pb2.GetWorldRequest(name=resource("worlds", name))
        w = (self._ask(self.worlds_stub.GetWorld, request)).world
        return World(self, w.name, w.rate_hz)

    def fork_world(
        self, source: World | str | bytes, name: str = "", *, tick: int | None = None, paused: bool = True
    ) -> World:
        """Makes a new world that goes on bit for bit from a state: that of a world as it is now, or was at a `tick`
        that is held, of a checkpoint on the server by its resource name, or of the bytes of one.
        """
        request = checkpoint_pb2.ForkWorldRequest(world_id=name, paused=paused, tick=tick)
        if isinstance(source, World):
            request.world = source.resource
        elif isinstance(source, bytes):
            request.data = source
        else:
            request.checkpoint = source
        w = (self._ask(self.checkpoints_stub.ForkWorld, request)).world
        return World(self, w.name, w.rate_hz)

    def worlds(self) -> list[World]:
        """All worlds, by name."""
        out: list[World] = []
        token = ""
        while True:
            request = world_pb2.ListWorldsRequest(page_size=1000, page_token=token)
            r = self._ask(self.worlds_stub.ListWorlds, request)
            out.extend(World(self, w.name, w.rate_hz) for w in r.worlds)
            token = r.next_page_token
            if not token:
                return out

    # Without a world.

    def simulate(
        self,
        source: str | Clip | PathLike | bytes,
        *,
        body: str | Profile = "adult-man",
        disturbances: Iterable[Disturbance] = (),
        strength: float | Strength = 1.0,
        controller: Controller = "modern",
        stepper: Stepper = "torque",
        paper: Paper | None = None,
        fatigue_time_scale: float = 0.0,
        assist: float = 0.0,
        follow: Follow | None = None,
        max_help_weights: float | None = None,
        constraints: Iterable[Constraint] = (),
        protective_steps: bool = True,
        self_contact: bool = False,
        duration_s: float = 0.0,
        loop: bool = False,
        rate_hz: float = 60.0,
        substeps: int = 2,
        fields: Sequence[str] = RECORDED,
        encoding: Encoding = "double",
        rate_divisor: int = 1,
    ) -> Recording:
        """One clip (name, `Clip`), or one BVH file (path ending in `.bvh`, or bytes), tracked by one figure, faster
        than real time.

        `disturbances` begin at their `start_s` (s of the clip). `duration_s` (s) 0: the length of the clip. `strength`
        1 is that of the average person; `fatigue_time_scale` 0: no fatigue, 1: as measured; `assist` 0 to 1: share of
        the help from outside at the pelvis. `follow`: `strict`; `assisted`, with a force and a moment on the pelvis
        while the motion is being lost; `always`, with as much of it as the motion takes to its end. `max_help_weights`:
        that force at most, 0 to 2 times the weight; 0.3 with `assisted`, 1 with `always`. `rate_hz` and `substeps` as
        in `create_world`; `rate_divisor` n keeps one frame for every n ticks. With `fields=()` the recording has no
        frames, only `summary` and `events`.
        """
        figure = requests.figure(
            body=body,
            strength=strength,
            choice=controller,
            moved_by=stepper,
            paper=paper,
            fatigue_time_scale=fatigue_time_scale,
            assist=assist,
            follows=follow,
            max_help_weights=max_help_weights,
            constraints=constraints,
            protective_steps=protective_steps,
            self_contact=self_contact,
        )
        request = simulation_pb2.SimulateClipRequest(
            figure=figure,
            rate_hz=rate_hz,
            substep_count=substeps,
            duration_s=duration_s,
            loop=loop,
            perturbations=requests.timed(disturbances),
        )
        if isinstance(source, bytes) or is_file(source):
            request.bvh.CopyFrom(bvh_source(source))  # type: ignore[arg-type]
            named = "file"
        else:
            named = source.name if isinstance(source, Clip) else str(source)
            request.clip = resource("clips", named)
        if fields:
            request.view.CopyFrom(requests.view(fields, numbers=encoding, rate_divisor=rate_divisor))
        r = self._ask(self.simulations_stub.SimulateClip, request, max(self.timeout_s, _LONG_S))
        described = self._body_of(body)
        recordings = collect(r.frames, {0: (last(named), described)}, rate_hz)
        if recordings:
            out = next(iter(recordings.values()))
        else:
            none = np.zeros(0)
            out = Recording(last(named), described, rate_hz, none.astype(np.int64), none, [])
        out.events = [Event.of(e) for e in r.events]
        out.summary = r.summary
        out.report = r.report if r.HasField("report") else None
        return out

    # Long work that nobody waits for.

    def start(
        self, work: motion_pb2.CreateClipRequest | simulation_pb2.SimulateClipRequest, *, request_id: str = ""
    ) -> Operation:
        """Starts long work on the server and returns at once: storing a clip, or simulating one.

        It goes on without this client; `operation(name)` finds it again. A repeat under the same `request_id` starts
        nothing anew.
        """
        request = operation_pb2.StartOperationRequest(request_id=request_id)
        if isinstance(work, motion_pb2.CreateClipRequest):
            request.create_clip.CopyFrom(work)
        else:
            request.simulate_clip.CopyFrom(work)
        return Operation(self, (self._ask(self.operations_stub.StartOperation, request)).operation)

    def operation(self, name: str) -> Operation:
        """Long work that was started before, by this or another client of the same principal."""
        request = operation_pb2.GetOperationRequest(name=resource("operations", name))
        return Operation(self, (self._ask(self.operations_stub.GetOperation, request)).operation)

    def operations(self) -> list[Operation]:
        """All long work of this principal that the server still knows, in the order it was started, without results."""
        out: list[Operation] = []
        token = ""
        while True:
            request = operation_pb2.ListOperationsRequest(page_size=1000, page_token=token)
            r = self._ask(self.operations_stub.ListOperations, request)
            out.extend(Operation(self, o) for o in r.operations)
            token = r.next_page_token
            if not token:
                return out

    def _body_of(self, body: str | Profile) -> Body:
        if isinstance(body, str):
            return self.body(body)
        p = body.message()
        if not (p.height_m and p.mass_kg):
            # The server knows what is ordinary and says so in the body it makes.
            world = self.create_world(rate_hz=60.0)
            try:
                return (world.add_figure(body=body)).body()
            finally:
                world.delete()
        sex = "male" if p.sex == body_pb2.SEX_MALE else "female"
        return self.body(f"{sex}-{p.age_years:g}y-{p.height_m * 1e3:.0f}mm-{p.mass_kg * 1e3:.0f}g")

    def _learn(self, roster: state_pb2.Roster) -> None:
        for entry in roster.figures:
            self.body(entry.body)


class Operation:
    """Long work on the server."""

    def __init__(self, client: Client, message: operation_pb2.Operation) -> None:
        self._client = client
        self.message = message
        """As the server described it last."""

    def __repr__(self) -> str:
        return f"Operation({self.name!r}, {self.state}, {self.progress:.0%})"

    @property
    def name(self) -> str:
        """Last part of its resource name."""
        return last(self.message.name)

    @property
    def state(self) -> str:
        """How far it is: `queued`, `running`, `succeeded`, `failed` or `cancelled`."""
        return operation_pb2.OperationState.Name(self.message.state).removeprefix("OPERATION_STATE_").lower()

    @property
    def progress(self) -> float:
        """Share of the work that is done, 0 to 1."""
        return self.message.progress

    @property
    def done(self) -> bool:
        """Whether it has ended, in whatever way."""
        return self.message.HasField("end_time")

    def get(self) -> Self:
        """This object, with how far it is now."""
        request = operation_pb2.GetOperationRequest(name=self.message.name)
        self.message = (self._client._ask(self._client.operations_stub.GetOperation, request)).operation
        return self

    def result(
        self, timeout_s: float | None = None
    ) -> motion_pb2.CreateClipResponse | simulation_pb2.SimulateClipResponse:
        """What came of it; waits for its end for `timeout_s` (s), or as long as it takes.

        Raises what the call would have raised, `AbortedError` if it was cancelled, `DeadlineError` if it goes on.
        """
        end = None if timeout_s is None else time.monotonic() + timeout_s
        while not self.done or self.message.WhichOneof("result") is None:
            left = _WAIT_S if end is None else min(_WAIT_S, end - time.monotonic())
            request = operation_pb2.WaitOperationRequest(name=self.message.name)
            request.timeout.FromTimedelta(timedelta(seconds=max(left, 0.0)))
            stub = self._client.operations_stub
            answer = self._client._ask(stub.WaitOperation, request, self._client.timeout_s + _WAIT_S)
            self.message = answer.operation
            if self.state == "cancelled":
                raise AbortedError(f"operation {self.name!r} was cancelled", reason="CANCELLED")
            if not self.done and end is not None and time.monotonic() >= end:
                raise DeadlineError(f"operation {self.name!r} goes on after {timeout_s:g} s")
        kind = self.message.WhichOneof("result")
        if kind == "error":
            raise from_status(self.message.error)
        return self.message.create_clip if kind == "create_clip" else self.message.simulate_clip

    def cancel(self) -> None:
        """Gives it up, unless it has ended."""
        request = operation_pb2.CancelOperationRequest(name=self.message.name)
        self.message = (self._client._ask(self._client.operations_stub.CancelOperation, request)).operation

    def delete(self) -> None:
        """Forgets it with its result; it must have ended."""
        request = operation_pb2.DeleteOperationRequest(name=self.message.name)
        self._client._ask(self._client.operations_stub.DeleteOperation, request)


class Clip:
    """A stored desired motion."""

    def __init__(self, client: Client, message: motion_pb2.Clip) -> None:
        self._client = client
        self.message = message
        """As the server described it."""

    def __repr__(self) -> str:
        return f"Clip({self.name!r}, {self.duration_s:.2f} s at {self.rate_hz:g} Hz)"

    @property
    def name(self) -> str:
        """Last part of its resource name."""
        return last(self.message.name)

    @property
    def body(self) -> str:
        """Name of the body it was prepared for; on others it is prepared anew."""
        return last(self.message.body)

    @property
    def rate_hz(self) -> float:
        """Frames per second, Hz."""
        return self.message.rate_hz

    @property
    def duration_s(self) -> float:
        """Length, s."""
        return self.message.duration_s

    @property
    def report(self) -> types_pb2.RetargetReport | None:
        """How a BVH file was understood; `None` for other clips."""
        return self.message.report if self.message.HasField("report") else None

    @property
    def forecast(self) -> motion_pb2.Forecast | None:
        """Forecast for its body following it: verdict, reason and figures; `None` for built-in clips."""
        return self.message.forecast if self.message.HasField("forecast") else None

    def motion(self, *, body: str | Profile = "adult-man", rate_hz: float = 60.0) -> Motion:
        """The motion as arrays (rad, m, world frame) at `rate_hz`, as it is asked of a figure with this body:
        retargeted, smoothed, feet planted.
        """
        # What a figure is asked to do does not depend on whether it can.
        recording = self._client.simulate(
            self, body=body, controller="motors", rate_hz=rate_hz, fields=("desired",)
        )
        return Motion(recording.desired_joint_angles, recording.desired_root_pose, rate_hz)

    def delete(self) -> None:
        """Forgets it. Figures that play it go on."""
        request = motion_pb2.DeleteClipRequest(name=self.message.name)
        self._client._ask(self._client.motions_stub.DeleteClip, request)


class World:
    """One shared scene with a clock of its own. In a `with` block it is deleted at the end."""

    def __init__(self, client: Client, name: str, rate_hz: float) -> None:
        self.client = client
        self.resource = name
        """Resource name, `worlds/{world}`."""
        self.rate_hz = rate_hz
        """Ticks per second of world time."""

    def __repr__(self) -> str:
        return f"World({self.name!r}, {self.rate_hz:g} Hz)"

    @property
    def name(self) -> str:
        """Last part of its resource name."""
        return last(self.resource)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            self.delete()
        except NotFoundError:
            pass

    def get(self) -> world_pb2.World:
        """State, tick, settings, as they are now."""
        request = world_pb2.GetWorldRequest(name=self.resource)
        return (self.client._ask(self.client.worlds_stub.GetWorld, request)).world

    def delete(self) -> None:
        """Ends the world."""
        request = world_pb2.DeleteWorldRequest(name=self.resource)
        self.client._ask(self.client.worlds_stub.DeleteWorld, request)

    def pause(self) -> None:
        """Stops the clock."""
        request = world_pb2.PauseWorldRequest(name=self.resource)
        self.client._ask(self.client.worlds_stub.PauseWorld, request)

    def resume(self) -> None:
        """Starts the clock."""
        request = world_pb2.ResumeWorldRequest(name=self.resource)
        self.client._ask(self.client.worlds_stub.ResumeWorld, request)

    def checkpoint(self, name: str = "") -> str:
        """Keeps its state on the server. Returns the resource name, for `restore` and `Client.fork_world`."""
        request = checkpoint_pb2.CheckpointWorldRequest(name=self.resource, checkpoint_id=name)
        return (self.client._ask(self.client.checkpoints_stub.CheckpointWorld, request)).checkpoint.name

    def checkpoint_data(self, checkpoint: str) -> bytes:
        """The bytes of a checkpoint, for a server of the same version."""
        request = checkpoint_pb2.GetCheckpointRequest(name=checkpoint, return_data=True)
        return (self.client._ask(self.client.checkpoints_stub.GetCheckpoint, request)).data

    def delete_checkpoint(self, checkpoint: str) -> None:
        """Forgets a checkpoint."""
        request = checkpoint_pb2.DeleteCheckpointRequest(name=checkpoint)
        self.client._ask(self.client.checkpoints_stub.DeleteCheckpoint, request)

    def restore(self, checkpoint: str | bytes) -> None:
        """Puts it into the state of a checkpoint, by its resource name or its bytes. Drives end."""
        request = checkpoint_pb2.RestoreWorldRequest(name=self.resource)
        if isinstance(checkpoint, bytes):
            request.data = checkpoint
        else:
            request.checkpoint = checkpoint
        self.client._ask(self.client.checkpoints_stub.RestoreWorld, request)

    def history(self) -> tuple[int, int]:
        """The oldest and the newest tick that are held for `seek`, `replay` and `Client.fork_world`."""
        request = history_pb2.GetHistoryRequest(name=self.resource)
        held = self.client._ask(self.client.history_stub.GetHistory, request)
        return held.oldest_tick, held.newest_tick

    def read_history(
        self,
        *,
        first_tick: int | None = None,
        last_tick: int | None = None,
        figures: Iterable[str] = (),
        fields: Sequence[str] = RECORDED,
        encoding: Encoding = "double",
    ) -> Recordings:
        """What happened from one tick to another (`None`: as far as it is held), by figure; the world goes on
        meanwhile. Of those who came or went in that time there is what was there. To go on from there without a gap:
        `frames` with `resume_tick=last_tick`.
        """
        view = requests.view(fields, figures=figures, numbers=encoding)
        request = history_pb2.ReadHistoryRequest(
            name=self.resource, view=view, first_tick=first_tick, last_tick=last_tick
        )
        frames: list[frame_pb2.WorldFrame] = []
        roster = state_pb2.Roster()
        with Stream(self.client.history_stub.ReadHistory, request) as stream:
            for message in stream:
                if message.HasField("roster"):
                    roster.MergeFrom(message.roster)
                frames.extend(message.frames)
        self.client._learn(roster)
        names = {e.figure_index: (e.figure_id, self.client._bodies[e.body]) for e in roster.figures}
        return collect(frames, names, self.rate_hz)

    def seek(self, tick: int) -> None:
        """Goes back to a tick that is held; what came after it is dropped, and drives end."""
        request = history_pb2.SeekWorldRequest(name=self.resource, tick=tick)
        self.client._ask(self.client.history_stub.SeekWorld, request, max(self.client.timeout_s, _LONG_S))

    def replay(
        self, *, first_tick: int | None = None, last_tick: int | None = None
    ) -> history_pb2.ReplayWorldResponse:
        """Does a part of its past again beside it; `difference` of the answer is set if a state came out otherwise."""
        request = history_pb2.ReplayWorldRequest(name=self.resource, first_tick=first_tick, last_tick=last_tick)
        timeout_s = max(self.client.timeout_s, _LONG_S)
        return self.client._ask(self.client.history_stub.ReplayWorld, request, timeout_s)

    def start_recording(self, name: str = "", *, first_tick: int | None = None) -> str:
        """Keeps what happens from now on, or from a past tick that is held. Returns its resource name, for
        `stop_recording`, `export_recording` and `delete_recording`.
        """
        request = recording_pb2.StartRecordingRequest(parent=self.resource, recording_id=name, first_tick=first_tick)
        return (self.client._ask(self.client.recordings_stub.StartRecording, request)).recording.name

    def stop_recording(self, recording: str) -> recording_pb2.Recording:
        """Ends a recording; it is kept."""
        request = recording_pb2.StopRecordingRequest(name=recording)
        return (self.client._ask(self.client.recordings_stub.StopRecording, request)).recording

    def export_recording(
        self, recording: str, form: Literal["mcap", "bvh", "csv"] = "mcap", *, figure: str = ""
    ) -> bytes:
        """A recording as a file: MCAP of all frames; BVH or CSV of one figure."""
        number = recording_pb2.RecordingFormat.Value(f"RECORDING_FORMAT_{form.upper()}")
        request = recording_pb2.ExportRecordingRequest(name=recording, format=number, figure_id=last(figure))
        out = bytearray()
        with Stream(self.client.recordings_stub.ExportRecording, request) as stream:
            for piece in stream:
                out += piece.data
        return bytes(out)

    def delete_recording(self, recording: str) -> None:
        """Forgets a recording."""
        request = recording_pb2.DeleteRecordingRequest(name=recording)
        self.client._ask(self.client.recordings_stub.DeleteRecording, request)

    def set_speed(self, speed: float) -> None:
        """Sets how fast world time passes: `speed` is world seconds per wall second, 0.01 to 10."""
        request = world_pb2.SetWorldSpeedRequest(name=self.resource, speed=speed)
        self.client._ask(self.client.worlds_stub.SetWorldSpeed, request)

    def step(self, tick_count: int = 1) -> int:
        """Advances a paused world by ticks, as fast as they compute; returns the tick it is at."""
        request = world_pb2.StepWorldRequest(name=self.resource, tick_count=tick_count)
        timeout_s = max(self.client.timeout_s, _LONG_S)
        return (self.client._ask(self.client.worlds_stub.StepWorld, request, timeout_s)).tick

    # Figures.

    def add_figure(
        self,
        name: str = "",
        *,
        body: str | Profile = "adult-man",
        strength: float | Strength = 1.0,
        controller: Controller = "modern",
        stepper: Stepper = "torque",
        paper: Paper | None = None,
        position: tuple[float, float] = (0.0, 0.0),
        yaw: float = 0.0,
        fatigue_time_scale: float = 0.0,
        assist: float = 0.0,
        follow: Follow | None = None,
        max_help_weights: float | None = None,
        constraints: Iterable[Constraint] = (),
        protective_steps: bool = True,
        self_contact: bool = False,
        display_name: str = "",
    ) -> Figure:
        """Adds a figure, standing still at `position` (world x, y, m) and heading `yaw` (rad, 0 looks along x,
        counter-clockwise from above).

        `strength`: factor on the measured strength, or a `Strength`. `fatigue_time_scale`: 0 no fatigue, 1 as measured,
        larger is faster. `assist`: help from outside at the pelvis, 0 to 1. `follow` and `max_help_weights`: help while
        its motion is being lost, as in `Client.simulate`. `constraints`: where parts of it are wanted (m, world).
        `protective_steps`: it may step to keep its balance, and puts its arms out if it falls all the same.
        `self_contact`: limbs do not pass through the body and each other.
        """
        settings = requests.figure(
            body=body,
            strength=strength,
            choice=controller,
            moved_by=stepper,
            paper=paper,
            position=position,
            yaw=yaw,
            fatigue_time_scale=fatigue_time_scale,
            assist=assist,
            follows=follow,
            max_help_weights=max_help_weights,
            constraints=constraints,
            protective_steps=protective_steps,
            self_contact=self_contact,
            display_name=display_name,
        )
        request = figure_pb2.CreateFigureRequest(parent=self.resource, figure_id=name, figure=settings)
        f = (self.client._ask(self.client.figures_stub.CreateFigure, request)).figure
        return Figure(self, f)

    def figure(self, name: str) -> Figure:
        """A figure that is there."""
        request = figure_pb2.GetFigureRequest(name=f"{self.resource}/figures/{last(name)}")
        return Figure(self, (self.client._ask(self.client.figures_stub.GetFigure, request)).figure)

    def figures(self) -> list[Figure]:
        """All figures, in the order of their creation."""
        out: list[Figure] = []
        token = ""
        while True:
            request = figure_pb2.ListFiguresRequest(parent=self.resource, page_size=1000, page_token=token)
            r = self.client._ask(self.client.figures_stub.ListFigures, request)
            out.extend(Figure(self, f) for f in r.figures)
            token = r.next_page_token
            if not token:
                return out

    def apply(self, disturbances: Mapping[str, Disturbance | Sequence[Disturbance]]) -> int:
        """Disturbs figures by name: all of it or, if anything is wrong, nothing. `start_s` (s) of each counts from now.

        Returns the tick at whose start the request was taken.
        """
        now: int | None = None
        batch = []
        for name, given in disturbances.items():
            for what in given if isinstance(given, Sequence) else [given]:
                tick = None
                if what.start_s > 0:
                    if now is None:
                        now = (self.get()).tick
                    tick = now + round(what.start_s * self.rate_hz)
                batch.append(requests.perturbation(what, name, tick))
        request = perturbation_pb2.ApplyPerturbationsRequest(world=self.resource, perturbations=batch)
        return (self.client._ask(self.client.perturbations_stub.ApplyPerturbations, request)).tick

    # Obstacles.

    def add_obstacle(
        self,
        shape: Shape,
        name: str = "",
        *,
        position: Vector = (0.0, 0.0, 0.0),
        rotation: Sequence[float] | None = None,
        mobility: Mobility = "fixed",
        mass_kg: float = 0.0,
        friction: float | None = None,
        velocity: Vector = (0.0, 0.0, 0.0),
        angular_velocity: Vector = (0.0, 0.0, 0.0),
    ) -> Obstacle:
        """Puts a thing into the world that figures can touch: `Sphere`, `Capsule`, `Box` or `Plane`. A world holds at
        most 256.

        `position`: its centre in the world, m. `rotation`: quaternion x, y, z, w of its frame in the world; `None`: not
        turned. `mobility`: `fixed`; `led`, which moves with its velocity whatever it meets; or `free`, a rigid body of
        `mass_kg` (kg, 0.01 to 10000) under gravity. `velocity` (of its centre, m/s) and `angular_velocity` (rad/s),
        world axes, each component within ±100, are of no effect on fixed ones. `friction`: coefficient, 0.05 to 2; of
        two obstacles the smaller one counts; `None`: 0.6.
        """
        wanted = requests.obstacle(
            shape,
            position=position,
            rotation=rotation,
            mobility_name=mobility,
            mass_kg=mass_kg,
            friction=friction,
            velocity=velocity,
            angular_velocity=angular_velocity,
        )
        request = obstacle_pb2.CreateObstacleRequest(parent=self.resource, obstacle_id=name, obstacle=wanted)
        return Obstacle(self, (self.client._ask(self.client.obstacles_stub.CreateObstacle, request)).obstacle)

    def obstacles(self) -> list[Obstacle]:
        """All obstacles as they are now, in the order they were added."""
        out: list[Obstacle] = []
        token = ""
        while True:
            request = obstacle_pb2.ListObstaclesRequest(parent=self.resource, page_size=1000, page_token=token)
            r = self.client._ask(self.client.obstacles_stub.ListObstacles, request)
            out.extend(Obstacle(self, o) for o in r.obstacles)
            token = r.next_page_token
            if not token:
                return out

    def obstacle(self, name: str) -> Obstacle:
        """An obstacle that is there, as it is now."""
        request = obstacle_pb2.GetObstacleRequest(name=f"{self.resource}/obstacles/{last(name)}")
        return Obstacle(self, (self.client._ask(self.client.obstacles_stub.GetObstacle, request)).obstacle)

    # Frames.

    def frame(
        self, *, tick: int | None = None, fields: Sequence[str] = RECORDED, encoding: Encoding = "double"
    ) -> Frame:
        """One frame: the latest, or that of a `tick` which is still held. `fields`: names of frame fields
        (`sinew.RECORDED`, `"*"`: all).
        """
        request = state_pb2.GetWorldFrameRequest(
            world=self.resource, tick=tick, view=requests.view(fields, numbers=encoding)
        )
        r = self.client._ask(self.client.states_stub.GetWorldFrame, request)
        self.client._learn(r.roster)
        return to_frame(r.frame, r.roster, self.client._bodies)

    def frames(
        self,
        *,
        figures: Iterable[str] = (),
        fields: Sequence[str] = requests.VIEW,
        encoding: Encoding = "float",
        rate_divisor: int = 1,
        resume_tick: int | None = None,
        wait: bool = False,
    ) -> Frames:
        """Frames as they come; iterate over it. The first is that of the latest tick. A slow reader gets the latest,
        never a backlog.

        `figures` (names; all if empty) and `fields` choose what they hold. `rate_divisor` n sends one frame for every n
        ticks; `resume_tick` continues after a tick, also of the past, as far as the next ones are held.

        A paused world sends no more frames until it is resumed or stepped. Waiting for the next one then raises
        `WorldPausedError` after about half a second, also when the world is paused later on; the iteration can go on
        after `resume` or `step`. With `wait=True` it waits.
        """
        view = requests.view(fields, figures=figures, numbers=encoding, rate_divisor=rate_divisor)
        request = state_pb2.WatchWorldRequest(world=self.resource, view=view, resume_tick=resume_tick)
        return Frames(self, Stream(self.client.states_stub.WatchWorld, request), wait=wait)

    def events(self, *, figures: Iterable[str] = (), types: Iterable[str] = ()) -> Events:
        """Events as they come; iterate over it. `types` are names as in `Event.type`; all if empty. It waits while the
        world is paused.
        """
        request = state_pb2.WatchEventsRequest(
            world=self.resource, figure_ids=list(figures), types=requests.event_types(types)
        )
        return Events(Stream(self.client.states_stub.WatchEvents, request))

    def record(
        self,
        duration_s: float,
        *,
        figures: Iterable[str] = (),
        fields: Sequence[str] = RECORDED,
        encoding: Encoding = "double",
        progress: bool | None = None,
    ) -> Recordings:
        """What happens in the next `duration_s` seconds of world time, by figure.

        A paused world is stepped through them without a gap; a running one is watched as it goes, and
        `WorldPausedError` is raised if it is paused meanwhile. `progress` shows a bar; `None`: in a terminal or
        notebook.
        """
        ticks = max(round(duration_s * self.rate_hz), 1)
        view = requests.view(fields, figures=figures, numbers=encoding)
        state = self.get()
        frames: list[frame_pb2.WorldFrame] = []
        roster = state_pb2.Roster()
        with Progress(ticks / self.rate_hz, self.name, "s", progress) as bar:
            if state.state == world_pb2.WORLD_STATE_PAUSED:
                done = 0
                while done < ticks:
                    chunk = min(_CHUNK, ticks - done)
                    reached = self.step(chunk)
                    wanted = [
                        state_pb2.GetWorldFrameRequest(world=self.resource, tick=t, view=view)
                        for t in range(reached - chunk + 1, reached + 1)
                    ]
                    got = call_all(self.client.states_stub.GetWorldFrame, wanted, self.client.timeout_s)
                    frames.extend(r.frame for r in got)
                    roster.MergeFrom(got[-1].roster)
                    done += chunk
                    bar.add(chunk / self.rate_hz)
            else:
                request = state_pb2.WatchWorldRequest(world=self.resource, view=view)
                with Stream(self.client.states_stub.WatchWorld, request) as stream:
                    while not frames or frames[-1].tick - frames[0].tick < ticks - 1:
                        message = _next(self, stream)
                        if message.HasField("roster"):
                            roster.MergeFrom(message.roster)
                            continue
                        if frames:
                            bar.add((message.frame.tick - frames[-1].tick) / self.rate_hz)
                        frames.append(message.frame)
        self.client._learn(roster)
        names = {e.figure_index: (e.figure_id, self.client._bodies[e.body]) for e in roster.figures}
        return collect(frames, names, self.rate_hz)

    def drive(
        self,
        *figures: str,
        rate_hz: float = 60.0,
        driver_id: str = "",
        playout_delay_ms: float | None = None,
        window_ms: float | None = None,
        hold: bool = False,
        grace_ms: float | None = None,
        reset: bool = False,
        control_tokens: Iterable[str] = (),
    ) -> Drive:
        """Drives figures (by name) live: `with world.drive("a", "b") as drive: drive.send_all({"a": Pose(...), ...})`.

        `rate_hz`: postures per second that you send. `playout_delay_ms` (ms) `None` adapts to the jitter of the
        connection. `window_ms` (ms, 0 or 300 to 1000): how far behind the newest posture motion is prepared for the
        body, which streams that walk need; `None` takes what the server is set to. `hold` stays in the last posture
        at once when motion is late, instead of continuing its velocity for a moment. `grace_ms` (ms): how long a
        drive that has broken off keeps its figures. `reset` begins in the first posture that comes. `control_tokens`:
        of the leases of these figures, if they have any.
        """
        header = motion_pb2.DriveHeader(
            world=self.resource,
            figure_ids=[last(f) for f in figures],
            driver_id=driver_id,
            nominal_rate_hz=rate_hz,
            playout_delay_ms=playout_delay_ms,
            preparation_window_ms=window_ms,
            underrun=motion_pb2.UNDERRUN_HOLD if hold else motion_pb2.UNDERRUN_EXTRAPOLATE,
            grace_ms=grace_ms,
            reset=reset,
            control_tokens=control_tokens,
        )
        return Drive(self.client, header)


class Obstacle:
    """A thing in a world that figures can touch. Its properties are those of when this object was made, or last `get`
    or `update`.
    """

    def __init__(self, world: World, message: obstacle_pb2.Obstacle) -> None:
        self.world = world
        self.message = message
        """As the server described it."""

    def __repr__(self) -> str:
        return f"Obstacle({self.name!r}, {self.shape!r}, {self.mobility!r})"

    @property
    def name(self) -> str:
        """Last part of its resource name."""
        return last(self.message.name)

    @property
    def shape(self) -> Shape:
        """`Sphere`, `Capsule`, `Box` or `Plane`; lengths in m, in its own frame."""
        return shape_of(self.message)

    @property
    def mobility(self) -> Mobility:
        """`fixed`, `led` or `free`."""
        return requests.MOBILITIES.get(self.message.mobility, "fixed")

    @property
    def mass_kg(self) -> float:
        """Mass of a free one, kg; 0 for others."""
        return self.message.mass_kg

    @property
    def friction(self) -> float:
        """Coefficient of friction."""
        return self.message.friction

    @property
    def position(self) -> NDArray[np.float64]:
        """Its centre in the world, m, (3,)."""
        p = self.message.pose.position_m
        return np.array([p.x, p.y, p.z])

    @property
    def rotation(self) -> NDArray[np.float64]:
        """Quaternion x, y, z, w of its frame in the world, (4,)."""
        q = self.message.pose.rotation
        return np.array([q.x, q.y, q.z, q.w])

    @property
    def velocity(self) -> NDArray[np.float64]:
        """Velocity of its centre, world axes, m/s, (3,)."""
        v = self.message.velocity_mps
        return np.array([v.x, v.y, v.z])

    @property
    def angular_velocity(self) -> NDArray[np.float64]:
        """World axes, rad/s, (3,)."""
        w = self.message.angular_velocity_rad_s
        return np.array([w.x, w.y, w.z])

    def get(self) -> Self:
        """This object, with what the obstacle is like now."""
        self.message = (self.world.obstacle(self.name)).message
        return self

    def update(
        self,
        *,
        shape: Shape | None = None,
        position: Vector | None = None,
        rotation: Sequence[float] | None = None,
        mobility: Mobility | None = None,
        mass_kg: float | None = None,
        friction: float | None = None,
        velocity: Vector | None = None,
        angular_velocity: Vector | None = None,
    ) -> None:
        """Changes what is given, units and frames as in `World.add_obstacle`; the rest stays as it is now.

        To lead one along a path, give its `velocity` (m/s) before each step: it then pushes what it meets. A new
        `position` (m) is a jump.
        """
        wanted, paths = requests.obstacle_changes(
            shape=shape,
            position=position,
            rotation=rotation,
            mobility_name=mobility,
            mass_kg=mass_kg,
            friction=friction,
            velocity=velocity,
            angular_velocity=angular_velocity,
        )
        if "pose" in paths and (position is None or rotation is None):
            # Place and rotation are one field: the other half stays as it is now.
            now = (self.get()).message.pose
            if position is None:
                wanted.pose.position_m.CopyFrom(now.position_m)
            if rotation is None:
                wanted.pose.rotation.CopyFrom(now.rotation)
        wanted.name = self.message.name
        request = obstacle_pb2.UpdateObstacleRequest(obstacle=wanted, update_mask=FieldMask(paths=paths))
        client = self.world.client
        self.message = (client._ask(client.obstacles_stub.UpdateObstacle, request)).obstacle

    def remove(self) -> None:
        """Takes it out of its world."""
        request = obstacle_pb2.DeleteObstacleRequest(name=self.message.name)
        self.world.client._ask(self.world.client.obstacles_stub.DeleteObstacle, request)


class Figure:
    """One articulated body in a world."""

    def __init__(self, world: World, message: figure_pb2.Figure) -> None:
        self.world = world
        self.message = message
        """As the server described it when this object was made."""
        self._asked = -1

    def __repr__(self) -> str:
        return f"Figure({self.name!r}, body={last(self.message.body)!r})"

    @property
    def name(self) -> str:
        """Last part of its resource name."""
        return last(self.message.name)

    @property
    def _client(self) -> Client:
        return self.world.client

    def body(self) -> Body:
        """Its body: names, order, limits, shapes."""
        return self._client.body(self.message.body)

    def get(self) -> figure_pb2.Figure:
        """Settings, clip, the clip that waits, and driver, as they are now."""
        request = figure_pb2.GetFigureRequest(name=self.message.name)
        return (self._client._ask(self._client.figures_stub.GetFigure, request)).figure

    def delete(self) -> None:
        """Removes it."""
        request = figure_pb2.DeleteFigureRequest(name=self.message.name)
        self._client._ask(self._client.figures_stub.DeleteFigure, request)

    def reset(self, *, position: tuple[float, float] | None = None, yaw: float | None = None) -> None:
        """Puts it back: standing still, without loads; where it was created unless `position` (world x, y, m) and `yaw`
        (rad) are given.
        """
        request = figure_pb2.ResetFigureRequest(name=self.message.name, placement=requests.placement(position, yaw))
        self._client._ask(self._client.figures_stub.ResetFigure, request)

    def update(
        self,
        *,
        strength: float | Strength | None = None,
        controller: Controller | None = None,
        paper: Paper | None = None,
        fatigue_time_scale: float | None = None,
        assist: float | None = None,
        follow: Follow | None = None,
        max_help_weights: float | None = None,
        constraints: Sequence[Constraint] | None = None,
        protective_steps: bool | None = None,
        self_contact: bool | None = None,
        display_name: str | None = None,
    ) -> None:
        """Changes what is given, as in `World.add_figure`. `constraints` replaces all of them."""
        given = {
            "strength": strength,
            "controller": controller,
            "paper": paper,
            "fatigue_time_scale": fatigue_time_scale,
            "assist": assist,
            "follow": follow,
            "max_help_weights": max_help_weights,
            "constraints": constraints,
            "protective_steps": protective_steps,
            "self_contact": self_contact,
            "display_name": display_name,
        }
        settings = requests.figure(
            strength=strength,
            choice=controller,
            paper=paper,
            fatigue_time_scale=fatigue_time_scale,
            assist=assist,
            follows=follow,
            max_help_weights=max_help_weights,
            constraints=constraints,
            protective_steps=protective_steps,
            self_contact=self_contact,
            display_name=display_name,
        )
        settings.name = self.message.name
        request = figure_pb2.UpdateFigureRequest(figure=settings)
        request.update_mask.paths.extend(k for k, v in given.items() if v is not None)
        self.message = (self._client._ask(self._client.figures_stub.UpdateFigure, request)).figure

    def constrain(self, *constraints: Constraint) -> None:
        """Replaces all constraints by these, none takes them off.

        One on a part that was constrained before goes on from there; the others come and go within their `ease_s`.
        """
        self.update(constraints=constraints)

    # Motion.

    def play(
        self,
        clip: str | Clip,
        *,
        speed: float = 1.0,
        loop: bool = False,
        reset: bool = False,
        start_s: float | None = None,
        position: tuple[float, float] | None = None,
        yaw: float | None = None,
        follow: Follow | None = None,
        max_help_weights: float | None = None,
    ) -> Beginning:
        """Plays a clip from the next tick on, or from world time `start_s` (s); returns how and when it begins.

        A figure that walks goes over to it from step to step where the two motions are alike; else it finishes its step
        and stands first. The time is what is expected then, and until then `status.next_clip` of `get()` names the
        clip. `reset` puts the figure into the first posture at once; otherwise it moves there by itself. It begins
        where the figure is, unless `position` (world x, y, m) and `yaw` (rad) are given. A recording is prepared for
        its `speed` (0.5 to 2), which takes a moment the first time.

        `follow` says how far it may go so that the figure keeps to the clip: `strict`, `rehearsed`, `assisted` or
        `always`, else as the clip says; `max_help_weights` bounds the help. `FigureState.following` tells in which way
        the figure does.
        """
        named = clip.name if isinstance(clip, Clip) else clip
        request = motion_pb2.PlayClipRequest(
            figure=self.message.name,
            clip=resource("clips", named),
            speed=speed,
            loop=loop,
            start_time_s=start_s,
            reset=reset,
            placement=requests.placement(position, yaw),
            follow=requests.follow(follow),
            max_help_weights=max_help_weights,
        )
        return Beginning.of(self._client._ask(self._client.motions_stub.PlayClip, request))

    def stop(self) -> None:
        """Ends its clip and takes back one that waits.

        A figure that walks finishes its step and stands; any other holds the posture that is asked of it now.
        """
        request = motion_pb2.StopClipRequest(figure=self.message.name)
        self._client._ask(self._client.motions_stub.StopClip, request)

    def ask(self, pose: Pose | ArrayLike) -> None:
        """Asks for one posture now: a `Pose`, or 39 joint angles (rad, in the order of `body.dofs`). For control loops
        over a paused world: `figure.ask(...)`, `world.step()`, look, again. For streams in real time use `drive`.
        """
        wanted = pose if isinstance(pose, Pose) else Pose(angles=pose)
        now = (self.world.get()).tick
        # One frame per tick and none before the last.
        sequence = max(now, self._asked + 1)
        request = motion_pb2.PushMotionRequest(
            header=motion_pb2.DriveHeader(
                world=self.world.resource,
                figure_ids=[self.name],
                driver_id=f"ask-{self.name}"[:64],
                nominal_rate_hz=self.world.rate_hz,
                playout_delay_ms=0.0,
                grace_ms=60_000.0,
            ),
            batch=motion_pb2.MotionBatch(
                frames=[
                    motion_pb2.MotionFrame(
                        sequence=sequence,
                        source_time_ns=round(sequence * 1e9 / self.world.rate_hz),
                        figures=[wanted.message(self.name)],
                    )
                ]
            ),
        )
        self._client._ask(self._client.motions_stub.PushMotion, request)
        self._asked = sequence

    def drive(
        self,
        *,
        rate_hz: float = 60.0,
        driver_id: str = "",
        playout_delay_ms: float | None = None,
        window_ms: float | None = None,
        hold: bool = False,
        grace_ms: float | None = None,
        reset: bool = False,
        control_tokens: Iterable[str] = (),
    ) -> Drive:
        """Drives it live: `with figure.drive() as drive: drive.send(angles)` (39 angles, rad); settings as in
        `World.drive`.
        """
        return self.world.drive(
            self.name,
            rate_hz=rate_hz,
            driver_id=driver_id,
            playout_delay_ms=playout_delay_ms,
            window_ms=window_ms,
            hold=hold,
            grace_ms=grace_ms,
            reset=reset,
            control_tokens=control_tokens,
        )

    def stream(
        self,
        source: Motion | Clip | PathLike,
        *,
        window_ms: float | None = None,
        reset: bool = True,
        progress: bool | None = None,
    ) -> motion_pb2.DriveFeedback:
        """Streams a motion live at its own pace, as a capture system would: arrays, a clip, or a BVH file. One that
        walks needs a window, 500 ms for example (`World.drive`).

        Returns when the last frame is sent, with the last feedback. The world must run.
        """
        motion = self._motion(source)
        with self.drive(rate_hz=motion.rate_hz, window_ms=window_ms, reset=reset) as drive:
            began = time.monotonic()
            with Progress(motion.duration_s, self.name, "s", progress) as bar:
                for i in range(len(motion)):
                    t = i / motion.rate_hz
                    pause(max(began + t - time.monotonic(), 0.0))
                    drive.send(motion.pose(i), time_s=t)
                    bar.add(1 / motion.rate_hz if i else 0.0)
            feedback = drive.feedback
        return feedback

    def _motion(self, source: Motion | Clip | PathLike) -> Motion:
        if isinstance(source, Motion):
            return source
        body = last(self.message.body)
        if isinstance(source, Clip):
            return source.motion(body=body)
        if not is_file(source):
            return (self._client.clip(str(source))).motion(body=body)
        clip = self._client.upload_bvh(source, body=body)
        try:
            return clip.motion(body=body)
        finally:
            clip.delete()

    # Disturbances.

    def apply(self, *disturbances: Disturbance) -> int:
        """Loads (kg), pushes (N·s) and forces (N), world axes; `start_s` (s) of each counts from now. All of it or, if
        anything is wrong, nothing.

        Returns the tick at whose start the request was taken.
        """
        return self.world.apply({self.name: disturbances})

    def carry(
        self,
        mass_kg: float,
        segment: str = "r_hand",
        second_segment: str = "",
        *,
        start_s: float = 0.0,
        duration_s: float = 0.0,
        grip_newtons: float = 0.0,
        two_hands: str = "",
    ) -> int:
        """Gives it a load of `mass_kg` (kg) in the palm of one hand, or of two, half each; until `clear` unless
        `duration_s` (s) says otherwise. With `two_hands` `auto` the other hand helps while one arm is too weak for it.

        `start_s` (s) counts from now. Beyond `grip_newtons` (N) at one hand it slips; 0: never. A `Load` takes more:
        where in the segment, and how fast it moves. Returns the tick at whose start the request was taken.
        """
        return self.apply(
            Load(
                mass_kg=mass_kg,
                segment=segment,
                second_segment=second_segment,
                start_s=start_s,
                duration_s=duration_s,
                grip_newtons=grip_newtons,
                two_hands=two_hands,
            )
        )

    def push(
        self, impulse_newton_seconds: Vector, segment: str = "chest", *, start_s: float = 0.0, duration_s: float = 0.1
    ) -> int:
        """Pushes it: an impulse in N·s, world axes, at the segment's centre of mass, over `duration_s` (s), `start_s`
        (s) from now on.

        Returns the tick at whose start the request was taken.
        """
        return self.apply(
            Push(impulse_newton_seconds=impulse_newton_seconds, segment=segment, start_s=start_s, duration_s=duration_s)
        )

    def pull(
        self, force_newtons: Vector, segment: str = "pelvis", *, start_s: float = 0.0, duration_s: float = 0.0
    ) -> int:
        """A constant force in N, world axes, at the segment's centre of mass; until `clear` unless `duration_s` (s)
        says otherwise.

        `start_s` (s) counts from now. Returns the tick at whose start the request was taken.
        """
        return self.apply(
            Force(force_newtons=force_newtons, segment=segment, start_s=start_s, duration_s=duration_s)
        )

    def clear(self) -> None:
        """Takes all loads and forces off it."""
        request = perturbation_pb2.ClearPerturbationsRequest(figure=self.message.name)
        self._client._ask(self._client.perturbations_stub.ClearPerturbations, request)

    # What it does.

    def state(self, *, fields: Sequence[str] = RECORDED, encoding: Encoding = "double") -> FigureState:
        """It after the latest tick; units and frames are those of `FigureState`."""
        view = requests.view(fields, figures=[self.name], numbers=encoding)
        request = state_pb2.GetWorldFrameRequest(world=self.world.resource, view=view)
        r = self._client._ask(self._client.states_stub.GetWorldFrame, request)
        self._client._learn(r.roster)
        return to_frame(r.frame, r.roster, self._client._bodies)[self.name]

    def record(
        self,
        duration_s: float,
        *,
        fields: Sequence[str] = RECORDED,
        encoding: Encoding = "double",
        progress: bool | None = None,
    ) -> Recording:
        """What it does in the next `duration_s` seconds of world time, as `World.record`."""
        all_of_it = self.world.record(
            duration_s, figures=[self.name], fields=fields, encoding=encoding, progress=progress
        )
        return all_of_it[self.name]


def _next(
    world: World, stream: Stream[state_pb2.WatchWorldRequest, state_pb2.WatchWorldResponse], *, wait: bool = False
) -> state_pb2.WatchWorldResponse:
    """The next message of a watch. Unless it is to `wait`, raises when none comes because the world stands still."""
    stood: int | None = None
    while True:
        message = stream.within(_QUIET_S)
        if message is not None:
            return message
        if wait:
            continue
        now = world.get()
        if now.state == world_pb2.WORLD_STATE_FAILED:
            raise PreconditionError(
                f"world {last(now.name)!r} has failed at tick {now.tick} and sends no more frames: {now.failure}",
                reason="WORLD_FAILED",
            )
        if now.state != world_pb2.WORLD_STATE_PAUSED:
            stood = None
        elif stood == now.tick:
            # A second look: what was on its way after a step has come by now.
            raise paused(last(now.name), now.tick)
        else:
            stood = now.tick


class Frames:
    """Frames of a world as they come. Leaving its `with` block, or `close`, ends the stream."""

    def __init__(
        self,
        world: World,
        stream: Stream[state_pb2.WatchWorldRequest, state_pb2.WatchWorldResponse],
        *,
        wait: bool = False,
    ) -> None:
        self._world = world
        self._client = world.client
        self._stream = stream
        self._wait = wait
        self._roster = state_pb2.Roster()

    def __iter__(self) -> Self:
        return self

    def __next__(self) -> Frame:
        while True:
            message = _next(self._world, self._stream, wait=self._wait)
            if message.HasField("frame"):
                return to_frame(message.frame, self._roster, self._client._bodies)
            self._client._learn(message.roster)
            self._roster = message.roster

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Ends the stream."""
        self._stream.close()


class Events:
    """Events of a world as they come. Leaving its `with` block, or `close`, ends the stream."""

    def __init__(self, stream: Stream[state_pb2.WatchEventsRequest, state_pb2.WatchEventsResponse]) -> None:
        self._stream = stream
        self._waiting: list[Event] = []
        self._began = False
        self.missed_count = 0
        """Messages that this reader was too slow for, so far."""

    def _more(self) -> None:
        message = self._stream.__next__()
        self._began = True
        self.missed_count = message.missed_count
        self._waiting.extend(Event.of(e) for e in message.events)

    def __iter__(self) -> Self:
        return self

    def __next__(self) -> Event:
        while not self._waiting:
            self._more()
        return self._waiting.pop(0)

    def __enter__(self) -> Self:
        # The first message says that the watch has begun: nothing that happens from here on is missed.
        if not self._began:
            self._more()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Ends the stream."""
        self._stream.close()


class Drive:
    """Live desired motion for one or more figures; open it with `with`. Ending it gives the figures back."""

    def __init__(self, client: Client, header: motion_pb2.DriveHeader) -> None:
        self._client = client
        self._header = header
        self._duplex: Duplex[motion_pb2.DriveFiguresRequest, motion_pb2.DriveFiguresResponse] | None = None
        self._sequence = 0
        self._began = 0.0

    def __enter__(self) -> Self:
        self._duplex = Duplex(self._client.motions_stub.DriveFigures)
        self._duplex.send(motion_pb2.DriveFiguresRequest(header=self._header))
        try:
            self._duplex.first(self._client.timeout_s)
        except NotFoundError as e:
            raise self._client._with_names(e) from None
        self._began = time.monotonic()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def send(self, pose: Pose | ArrayLike, *, time_s: float | None = None) -> None:
        """One instant of the only figure: a `Pose`, or 39 joint angles (rad). `time_s` is when it was captured (s, any
        origin); now if `None`.
        """
        wanted = pose if isinstance(pose, Pose) else Pose(angles=pose)
        self.send_all({self._header.figure_ids[0]: wanted}, time_s=time_s)

    def send_all(self, poses: Mapping[str, Pose], *, time_s: float | None = None) -> None:
        """One instant of several figures, by name. `time_s` is when it was captured (s, any origin); now if `None`."""
        if self._duplex is None:
            raise RuntimeError("open the drive with `with`")
        t = time.monotonic() - self._began if time_s is None else time_s
        frame = motion_pb2.MotionFrame(
            sequence=self._sequence,
            source_time_ns=round(t * 1e9),
            figures=[p.message(last(name)) for name, p in poses.items()],
        )
        self._sequence += 1
        self._duplex.send(motion_pb2.DriveFiguresRequest(batch=motion_pb2.MotionBatch(frames=[frame])))

    @property
    def feedback(self) -> motion_pb2.DriveFeedback:
        """The newest state of the drive: buffers, delays, counts."""
        newest = self._duplex.newest if self._duplex is not None else None
        return newest.feedback if newest is not None else motion_pb2.DriveFeedback()

    def close(self) -> None:
        """Ends the drive and waits until the figures are given back; raises what ended it, if the server did."""
        if self._duplex is None:
            return
        duplex, self._duplex = self._duplex, None
        duplex.close()
        duplex.check()
        newest = duplex.newest
        driver = newest.feedback.driver_id if newest is not None else ""
        for name in self._header.figure_ids:
            # They are given back at the start of the next tick, after whatever else comes before it.
            request = figure_pb2.GetFigureRequest(name=f"{self._header.world}/figures/{name}")
            for _ in range(_RELEASE_TRIES):
                try:
                    held = self._client._ask(self._client.figures_stub.GetFigure, request)
                except NotFoundError:
                    break
                if held.figure.status.driver_id != driver:
                    break
                pause(0.005)
