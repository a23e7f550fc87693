"""The synchronous client."""

from __future__ import annotations

import os
import queue
import threading
import time
from collections.abc import Iterable, Iterator, Sequence
from types import TracebackType
from typing import Literal, TypeVar, cast

import grpc
from google.protobuf.message import Message
from tqdm.auto import tqdm

from sinew import calls
from sinew.body import Body
from sinew.calls import Call, ClipSource, Feedback, ServerInfo, Source
from sinew.errors import InvalidArgumentError, UnavailableError, from_rpc
from sinew.frame import Event, FigureFrame, Frame, Roster
from sinew.motion import Clip, Floats, Motion
from sinew.recording import Recording
from sinew.v1 import motion_pb2
from sinew.values import Controller, Disturbance, Encoding, Force, Load, Profile, Push, Strength, Vector, last, resource

T = TypeVar("T")
R = TypeVar("R", bound=Message)
DEFAULT = "127.0.0.1:7463"
OPTIONS = [("grpc.max_receive_message_length", -1), ("grpc.max_send_message_length", -1)]
Place = tuple[float, float, float]
"""Where on the floor: x, y (m) and heading (rad)."""


def target(address: str) -> str:
    """An address as gRPC takes it; the `http://` that the server prints may stay."""
    return address.removeprefix("http://").rstrip("/")


class Client:
    """A connection to a server. Use it as a context manager, or call `close`.

    Every method raises `SinewError` when the server refuses; see `sinew.errors`. `timeout_s` bounds each call but streams.
    """

    def __init__(self, address: str = DEFAULT, *, timeout_s: float = 60.0) -> None:
        self.address = target(address)
        self.timeout_s = timeout_s
        self._channel = grpc.insecure_channel(self.address, options=OPTIONS)
        self._bodies: dict[str, Body] = {}

    def __enter__(self) -> Client:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"Client({self.address!r})"

    def close(self) -> None:
        """Ends the connection."""
        self._channel.close()

    def _do(self, call: Call[R, T]) -> T:
        method = self._channel.unary_unary(
            call.method, request_serializer=type(call.request).SerializeToString, response_deserializer=call.response.FromString
        )
        try:
            return call.result(cast(R, method(call.request, timeout=self.timeout_s)))
        except grpc.RpcError as e:
            raise from_rpc(e) from None

    def _stream(self, call: Call[R, T]) -> Iterator[T]:
        method = self._channel.unary_stream(
            call.method, request_serializer=type(call.request).SerializeToString, response_deserializer=call.response.FromString
        )
        stream = method(call.request)
        try:
            for message in stream:
                yield call.result(cast(R, message))
        except grpc.RpcError as e:
            raise from_rpc(e) from None
        finally:
            stream.cancel()

    # Server and bodies

    def info(self) -> ServerInfo:
        """Version, abilities and limits of the server."""
        return self._do(calls.server_info())

    def body(self, name: str) -> Body:
        """A body with its shapes; asked for once."""
        name = last(name)
        if name not in self._bodies:
            self._bodies[name] = self._do(calls.get_body(name, geometry=True))
        return self._bodies[name]

    def export_body(self, name: str, form: Literal["mjcf", "urdf"] = "mjcf") -> str:
        """A body as text for another simulator."""
        return self._do(calls.export_body(name, form))

    # Clips

    def create_clip(self, source: ClipSource, *, name: str = "", body: str = "") -> Clip:
        """Stores a motion: a BVH file (path or bytes), retargeted to `body`, or a `Motion`. Its `report` says how it was read."""
        return self._do(calls.create_clip(source, name, body))

    def clip(self, name: str) -> Clip:
        """One clip."""
        return self._do(calls.get_clip(name))

    def clips(self) -> list[Clip]:
        """All clips, built-in ones included."""
        found, token = self._do(calls.list_clips(""))
        while token:
            more, token = self._do(calls.list_clips(token))
            found += more
        return found

    def delete_clip(self, clip: str | Clip) -> None:
        """Forgets a clip."""
        self._do(calls.delete_clip(clip if isinstance(clip, str) else clip.name))

    # Simulation

    def simulate(
        self,
        source: Source,
        *,
        body: str | Profile | None = None,
        disturbances: Iterable[Disturbance] = (),
        strength: float | Strength | None = None,
        controller: Controller | None = None,
        assist: float = 0.0,
        fatigue_time_scale: float = 0.0,
        rate_hz: float = 0.0,
        duration_s: float = 0.0,
        loop: bool = False,
        fields: Sequence[str] | None = None,
        encoding: Encoding = "float",
        every: int = 1,
    ) -> Recording:
        """One figure tracks one motion, faster than real time, in no world.

        `source`: name of a clip (`"lift"`), a `Clip`, or a BVH file. `duration_s` 0: its length. `fields`: what is recorded of
        each tick (`info().fields` lists them); enough for plots and strips if not given. `every`: one frame for so many ticks.
        """
        figure = calls.settings(
            body=body, strength=strength, controller=controller, assist=assist, fatigue_time_scale=fatigue_time_scale
        )
        request, result = calls.simulate(
            source,
            figure=figure,
            disturbances=disturbances,
            rate_hz=rate_hz,
            duration_s=duration_s,
            loop=loop,
            frames=calls.view(fields=fields, encoding=encoding, every=every),
        )
        from sinew.v1 import simulation_pb2

        response = self._do(
            Call("/sinew.v1.SimulationService/SimulateClip", request, simulation_pb2.SimulateClipResponse, lambda r: r)
        )
        return result(response, self.body(calls.body_name(body)))

    def prepare(self, source: Source, *, body: str | Profile | None = None, rate_hz: float = 0.0) -> Motion:
        """A motion as arrays, prepared for a body: what `simulate` is asked to track. To look at, to change, or to stream."""
        return self.simulate(
            source, body=body, rate_hz=rate_hz, controller="motors", assist=1.0, fields=["desired"], encoding="double"
        ).desired()

    # Worlds

    def create_world(
        self,
        name: str = "",
        *,
        rate_hz: float = 60.0,
        substeps: int = 0,
        gravity_mps2: float | None = None,
        friction: float | None = None,
        speed: float = 0.0,
        paused: bool = False,
    ) -> World:
        """A new world. As a context manager it is deleted at the end."""
        message = self._do(
            calls.create_world(
                name,
                rate_hz=rate_hz,
                substeps=substeps,
                gravity_mps2=gravity_mps2,
                friction=friction,
                speed=speed,
                paused=paused,
            )
        )
        return World(self, message.name, message.rate_hz)

    def world(self, name: str) -> World:
        """A world that is there."""
        message = self._do(calls.get_world(name))
        return World(self, message.name, message.rate_hz)

    def worlds(self) -> list[World]:
        """All worlds."""
        found, token = self._do(calls.list_worlds(""))
        while token:
            more, token = self._do(calls.list_worlds(token))
            found += more
        return [World(self, w.name, w.rate_hz) for w in found]


class World:
    """A scene with a clock of its own. Made by `Client.create_world` and `Client.world`."""

    def __init__(self, client: Client, name: str, rate_hz: float) -> None:
        self.client = client
        self.name = name
        self.rate_hz = rate_hz

    def __enter__(self) -> World:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            self.delete()
        except Exception:
            if error is None:  # else what went wrong first is worth more
                raise

    def __repr__(self) -> str:
        return f"World({self.name!r})"

    @property
    def paused(self) -> bool:
        """Whether its clock is stopped."""
        return calls.is_paused(self.client._do(calls.get_world(self.name)))

    @property
    def tick(self) -> int:
        """Ticks computed so far."""
        return self.client._do(calls.get_world(self.name)).tick

    def delete(self) -> None:
        """Ends it."""
        self.client._do(calls.delete_world(self.name))

    def pause(self) -> None:
        """Stops the clock."""
        self.client._do(calls.pause_world(self.name))

    def resume(self) -> None:
        """Starts the clock again."""
        self.client._do(calls.resume_world(self.name))

    def step(self, ticks: int = 1) -> int:
        """Advances a paused world; returns its tick."""
        return self.client._do(calls.step_world(self.name, ticks))

    def set_speed(self, speed: float) -> None:
        """World seconds per wall second."""
        self.client._do(calls.set_speed(self.name, speed))

    def create_figure(
        self,
        name: str = "",
        *,
        body: str | Profile | None = None,
        strength: float | Strength | None = None,
        controller: Controller | None = None,
        place: Place | None = None,
        assist: float = 0.0,
        fatigue_time_scale: float = 0.0,
        display_name: str = "",
    ) -> Figure:
        """Adds a figure, standing still. `place`: x, y (m) and heading (rad)."""
        settings = calls.settings(
            body=body,
            strength=strength,
            controller=controller,
            place=place,
            assist=assist,
            fatigue_time_scale=fatigue_time_scale,
            display_name=display_name,
        )
        made = self.client._do(calls.create_figure(self.name, name, settings))
        return Figure(self, made.name, last(made.body))

    def figure(self, name: str) -> Figure:
        """A figure that is there."""
        found = self.client._do(calls.get_figure(f"{self.name}/{resource('figures', last(name))}"))
        return Figure(self, found.name, last(found.body))

    def figures(self) -> list[Figure]:
        """All figures, in the order of their creation."""
        found, token = self.client._do(calls.list_figures(self.name, ""))
        while token:
            more, token = self.client._do(calls.list_figures(self.name, token))
            found += more
        return [Figure(self, f.name, last(f.body)) for f in found]

    def frame(
        self, tick: int | None = None, *, fields: Sequence[str] | None = None, encoding: Encoding = "float"
    ) -> Frame:
        """One frame: the latest, or one that the server still holds."""
        return self.client._do(calls.get_frame(self.name, tick, calls.view(fields=fields, encoding=encoding)))[1]

    def frames(
        self,
        *,
        fields: Sequence[str] | None = None,
        figures: Sequence[str] = (),
        encoding: Encoding = "float",
        every: int = 1,
        resume_tick: int | None = None,
    ) -> Iterator[Frame]:
        """Frames as they come, until you stop asking. If you are slow you get the latest, never a backlog."""
        view = calls.view(fields=fields, figures=figures, encoding=encoding, every=every)
        roster = Roster(self.rate_hz, {}, {})
        for message in self.client._stream(calls.watch_world(self.name, view, resume_tick)):
            roster, frame = calls.frames_of(message, roster)
            if frame is not None:
                yield frame

    def events(self, figures: Sequence[str] = ()) -> Iterator[Event]:
        """Events as they come, until you stop asking."""
        for events in self.client._stream(calls.watch_events(self.name, figures)):
            yield from events

    def record(
        self,
        duration_s: float,
        *,
        fields: Sequence[str] | None = None,
        encoding: Encoding = "float",
        progress: bool = False,
    ) -> dict[str, Recording]:
        """What each figure does for so long, by name.

        A paused world is stepped as fast as it computes, and no tick is missing; a running one is watched. `progress` shows a
        bar.
        """
        bodies = {last(f.name): self.client.body(f.body) for f in self.figures()}
        ticks = max(1, round(duration_s * self.rate_hz))
        rows: dict[str, list[tuple[int, float, FigureFrame]]] = {name: [] for name in bodies}
        taken = self._stepped(ticks, fields, encoding) if self.paused else self.frames(fields=fields, encoding=encoding)
        events: list[Event] = []
        listener = _Listener(self, events)
        try:
            with tqdm(total=ticks, unit="tick", desc=last(self.name), disable=not progress) as bar:
                first = None
                for frame in taken:
                    first = frame.tick if first is None else first
                    bar.update(frame.tick - first + 1 - bar.n)
                    for name, figure in frame.figures.items():
                        if name in rows:
                            rows[name].append((frame.tick, frame.time_s, figure))
                    if frame.tick - first + 1 >= ticks:
                        break
        finally:
            listener.close()
        return {
            name: Recording.of(
                r, body=bodies[name], rate_hz=self.rate_hz, events=[e for e in events if e.figure == name]
            )
            for name, r in rows.items()
        }

    def _stepped(self, ticks: int, fields: Sequence[str] | None, encoding: Encoding) -> Iterator[Frame]:
        for _ in range(ticks):
            yield self.frame(self.step(), fields=fields, encoding=encoding)

    def drive(
        self,
        figures: Sequence[str | Figure],
        *,
        rate_hz: float = 60.0,
        delay_ms: float | None = None,
        reset: bool = False,
        driver_id: str = "",
    ) -> Drive:
        """Drives figures live: a context manager whose `send` takes the desired postures as they arise.

        `delay_ms`: between arrival and use; adaptive if not given. `reset`: begin in the first posture instead of moving there.
        """
        names = [f if isinstance(f, str) else f.name for f in figures]
        header = calls.drive_header(
            self.name, names, rate_hz=rate_hz, delay_ms=delay_ms, reset=reset, driver_id=driver_id
        )
        return Drive(self.client, header, rate_hz)


class _Listener:
    """Collects the events of a world while a recording is taken."""

    def __init__(self, world: World, into: list[Event]) -> None:
        call = calls.watch_events(world.name, [])
        method = world.client._channel.unary_stream(
            call.method, request_serializer=type(call.request).SerializeToString, response_deserializer=call.response.FromString
        )
        self._stream = method(call.request)
        # The first message is empty and says that the watch has begun: nothing after it is missed.
        try:
            next(self._stream)
        except grpc.RpcError as e:
            raise from_rpc(e) from None

        def listen() -> None:
            try:
                for message in self._stream:
                    into.extend(call.result(message))
            except grpc.RpcError:
                pass  # ended by `close`, or with the world; the frames say what else is wrong

        self._thread = threading.Thread(target=listen, daemon=True)
        self._thread.start()

    def close(self) -> None:
        time.sleep(0.05)  # the events of the last tick travel on a stream of their own
        self._stream.cancel()
        self._thread.join(timeout=5)


class Drive:
    """A live drive of one or more figures. `feedback` is how it fares, newest first known."""

    def __init__(self, client: Client, header: motion_pb2.DriveFiguresRequest, rate_hz: float) -> None:
        self.rate_hz = rate_hz
        self.feedback: list[Feedback] = []
        self._names = list(header.header.figures)
        self._sequence = 0
        self._queue: queue.Queue[motion_pb2.DriveFiguresRequest | None] = queue.Queue(maxsize=256)
        self._queue.put(header)
        self._failure: grpc.RpcError | None = None
        method = client._channel.stream_stream(
            calls.DRIVE,
            request_serializer=motion_pb2.DriveFiguresRequest.SerializeToString,
            response_deserializer=motion_pb2.DriveFiguresResponse.FromString,
        )
        self._stream = method(iter(self._queue.get, None))
        self._ready = threading.Event()
        self._thread = threading.Thread(target=self._listen, daemon=True)
        self._thread.start()
        self._timeout_s = client.timeout_s
        if not self._ready.wait(self._timeout_s):
            self._stream.cancel()
            raise UnavailableError("the server did not answer the drive", code=grpc.StatusCode.UNAVAILABLE)
        self._check()

    def _listen(self) -> None:
        try:
            for message in self._stream:
                self.feedback = Feedback.of(message.feedback)
                self._ready.set()
        except grpc.RpcError as e:
            self._failure = e
        finally:
            self._ready.set()

    def _check(self) -> None:
        if self._failure is not None:
            raise from_rpc(self._failure) from None

    def __enter__(self) -> Drive:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if error is None:
            self.close()
        else:
            self._stream.cancel()

    def send(
        self, postures: Motion | Floats | dict[str, Motion | Floats], *, frame: int = 0, time_s: float | None = None
    ) -> None:
        """The desired posture now: joint angles `(39,)`, pelvis pose and angles `(46,)`, or frame `frame` of a `Motion`; for
        several figures a dictionary by name. `time_s`: when it was captured, on your clock; counted from `rate_hz` if absent.
        """
        self._check()
        given = postures if isinstance(postures, dict) else {self._names[0]: postures}
        messages = {
            last(name): p.message(frame) if isinstance(p, Motion) else Motion.from_array(p[None, :], rate_hz=1.0).message(0)
            for name, p in given.items()
        }
        at = self._sequence / self.rate_hz if time_s is None else time_s
        try:
            self._queue.put(calls.drive_frame(self._sequence, at, messages), timeout=self._timeout_s)
        except queue.Full:
            raise UnavailableError("the server takes no more motion", code=grpc.StatusCode.UNAVAILABLE) from None
        self._sequence += 1

    def close(self) -> None:
        """Gives the figures back."""
        self._queue.put(None)
        self._thread.join(timeout=self._timeout_s)
        self._check()


class Figure:
    """One articulated body in a world. Made by `World.create_figure` and `World.figure`."""

    def __init__(self, world: World, name: str, body: str) -> None:
        self.world = world
        self.name = name
        self.body = body

    def __repr__(self) -> str:
        return f"Figure({self.name!r}, body={self.body!r})"

    def delete(self) -> None:
        """Removes it."""
        self.world.client._do(calls.delete_figure(self.name))

    def reset(self, place: Place | None = None) -> None:
        """Standing still again, without loads; where it was created, or at `place`."""
        self.world.client._do(calls.reset_figure(self.name, place))

    def update(
        self,
        *,
        strength: float | Strength | None = None,
        controller: Controller | None = None,
        assist: float | None = None,
        fatigue_time_scale: float | None = None,
    ) -> None:
        """Changes what is given."""
        self.world.client._do(
            calls.update_figure(
                self.name,
                strength=strength,
                controller=controller,
                assist=assist,
                fatigue_time_scale=fatigue_time_scale,
            )
        )

    def play(
        self,
        clip: str | Clip,
        *,
        speed: float = 1.0,
        loop: bool = False,
        start_time_s: float | None = None,
        reset: bool = False,
        place: Place | None = None,
    ) -> float:
        """Plays a clip; returns the world time at which it starts. `reset`: begin in its first posture."""
        return self.world.client._do(
            calls.play(
                self.name, clip, speed=speed, loop=loop, start_time_s=start_time_s, reset=reset, place=place
            )
        )

    def stop(self) -> None:
        """Holds the posture that is asked for now."""
        self.world.client._do(calls.stop(self.name))

    def apply(self, *disturbances: Disturbance) -> int:
        """Loads, pushes, forces, all or none; `start_s` counts from now. Returns the tick at which the request acted."""
        tick = self.world.tick if any(d.start_s > 0 for d in disturbances) else 0
        return self.world.client._do(
            calls.perturb(self.world.name, self.name, disturbances, tick=tick, rate_hz=self.world.rate_hz)
        )

    def load(self, mass_kg: float, segment: str = "r_hand", *, second_segment: str = "") -> int:
        """Puts a mass into a hand, or into two."""
        return self.apply(Load(mass_kg=mass_kg, segment=segment, second_segment=second_segment))

    def push(self, impulse_ns: Vector, segment: str = "chest", *, duration_s: float = 0.1) -> int:
        """Pushes with an impulse, N·s, world axes."""
        return self.apply(Push(impulse_ns=impulse_ns, segment=segment, duration_s=duration_s))

    def force(self, force_n: Vector, segment: str = "pelvis", *, duration_s: float = 0.0) -> int:
        """A constant force, N, world axes."""
        return self.apply(Force(force_n=force_n, segment=segment, duration_s=duration_s))

    def clear(self) -> int:
        """Takes all loads and forces off."""
        return self.world.client._do(calls.clear(self.name))

    def frames(
        self, *, fields: Sequence[str] | None = None, encoding: Encoding = "float", every: int = 1
    ) -> Iterator[FigureFrame]:
        """Its frames as they come."""
        name = last(self.name)
        for frame in self.world.frames(fields=fields, figures=[name], encoding=encoding, every=every):
            if name in frame.figures:
                yield frame.figures[name]

    def record(
        self,
        duration_s: float,
        *,
        fields: Sequence[str] | None = None,
        encoding: Encoding = "float",
        progress: bool = False,
    ) -> Recording:
        """What it does for so long; see `World.record`."""
        return self.world.record(duration_s, fields=fields, encoding=encoding, progress=progress)[last(self.name)]

    def stream(
        self,
        motion: Motion | Floats | str | os.PathLike[str],
        *,
        rate_hz: float | None = None,
        delay_ms: float | None = None,
        reset: bool = False,
        progress: bool = False,
    ) -> list[Feedback]:
        """Streams a motion live, at its own pace, and returns how it arrived.

        `motion`: a BVH file, which the server prepares for this body first, a `Motion`, joint angles `(n, 39)`, or pelvis poses and
        angles `(n, 46)` at `rate_hz` (60 if not given).
        """
        if isinstance(motion, (str, os.PathLike)):
            motion = self.world.client.prepare(motion, body=self.body)
        motion = calls.as_motion(motion, rate_hz)
        if not len(motion):
            raise InvalidArgumentError("motion: at least one frame expected", code=grpc.StatusCode.INVALID_ARGUMENT)
        with self.world.drive([self], rate_hz=motion.rate_hz, delay_ms=delay_ms, reset=reset) as drive:
            begin = time.monotonic()
            for i in tqdm(range(len(motion)), unit="frame", desc=last(self.name), disable=not progress):
                time.sleep(max(0.0, begin + i / motion.rate_hz - time.monotonic()))
                drive.send(motion, frame=i)
        return drive.feedback
