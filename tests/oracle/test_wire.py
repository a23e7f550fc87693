"""The main job seen from outside.

`sinew serve` runs, `sinew push` streams real motion capture into it, `sinew watch` and a Python client made from the
protos receive sixty frames a second, and what they receive satisfies the equations of motion of the exported body.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import threading
import time
from pathlib import Path

import grpc
import numpy as np
import pytest
from conftest import ROOT, build, target
from engines import NV, SEGMENTS, Mujoco, Pinocchio

CORPUS = ROOT / "tests" / "corpus"
WATCHED_S = 3.0
LEAST_RATE = 55.0
RESIDUAL = 1e-9


@pytest.fixture(scope="module")
def stubs():
    """Stubs of the Python package, which are those of the protos (clients/python/tests/test_generated.py)."""
    from sinew.v1 import body_pb2, body_pb2_grpc, state_pb2, state_pb2_grpc, types_pb2

    class Stubs:
        body, body_grpc, state, state_grpc, types = body_pb2, body_pb2_grpc, state_pb2, state_pb2_grpc, types_pb2

    return Stubs


@pytest.fixture(scope="module")
def server():
    """A server on a free port; yields its address."""
    build()
    process = subprocess.Popen(
        [target() / "sinew", "serve", "--listen", "127.0.0.1:0", "--no-demo"],
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        found = None
        for line in process.stdout:
            found = re.search(r"http://([0-9.]+:\d+)", line)
            if found:
                break
        assert found, "the server did not say where it serves"
        threading.Thread(target=process.stdout.read, daemon=True).start()
        yield found.group(1)
    finally:
        process.terminate()
        process.wait(timeout=20)


@pytest.fixture(scope="module")
def pushed(server):
    """A wave streamed as a live driver; yields the address once the world is there."""
    clip = CORPUS / "wave.vrm.bvh"
    process = subprocess.Popen([target() / "sinew", "push", server, clip, "--loop"], stdout=subprocess.DEVNULL)
    try:
        yield server
        assert process.poll() is None, "push ended before the test did"
    finally:
        process.terminate()
        process.wait(timeout=20)


class PythonWatch(threading.Thread):
    """Receives frames of the world for a while, noting when each came."""

    def __init__(self, address: str, stubs):
        super().__init__()
        self.address, self.stubs = address, stubs
        self.frames, self.times, self.roster, self.error = [], [], None, None

    def run(self) -> None:
        try:
            with grpc.insecure_channel(self.address) as channel:
                service = self.stubs.state_grpc.StateServiceStub(channel)
                view = self.stubs.state.View(encoding=self.stubs.types.ENCODING_DOUBLE)
                view.fields.paths.extend(["audit", "status"])
                request = self.stubs.state.WatchWorldRequest(world="worlds/demo", view=view)
                for message in watching(service, request):
                    if message.WhichOneof("message") == "roster":
                        self.roster = message.roster
                        continue
                    self.frames.append(message.frame)
                    self.times.append(time.monotonic())
                    if self.times[-1] - self.times[0] > WATCHED_S + 1:
                        return
        except Exception as e:  # handed to the test, which fails with it
            self.error = e


def watching(service, request):
    """The stream, from when the world is there."""
    deadline = time.monotonic() + 20
    while True:
        try:
            yield from service.WatchWorld(request, timeout=60)
            return
        except grpc.RpcError as e:
            if e.code() != grpc.StatusCode.NOT_FOUND or time.monotonic() > deadline:
                raise
            time.sleep(0.1)


def rate(times: list[float]) -> float:
    # The first second is the greeting: connecting, and what was buffered.
    kept = [t for t in times if t > times[0] + 1.0]
    assert kept and kept[-1] - kept[0] > WATCHED_S - 0.5, "frames stopped coming"
    return (len(kept) - 1) / (kept[-1] - kept[0])


@pytest.fixture(scope="module")
def watched(pushed, stubs):
    """What both watchers saw at the same time: the Python client, and when lines of `sinew watch --json` came."""
    python = PythonWatch(pushed, stubs)
    python.start()
    deadline = time.monotonic() + 25
    while not python.frames and python.is_alive() and time.monotonic() < deadline:
        time.sleep(0.05)
    assert python.frames, f"no frame: {python.error}"
    watch = subprocess.Popen([target() / "sinew", "watch", pushed, "demo", "--json"], stdout=subprocess.PIPE, text=True)
    lines = []
    try:
        for line in watch.stdout:
            lines.append((time.monotonic(), line))
            if lines[-1][0] - lines[0][0] > WATCHED_S + 1:
                break
    finally:
        watch.terminate()
        watch.wait(timeout=20)
    python.join(timeout=60)
    assert python.error is None, python.error
    return python, lines


def test_both_watchers_receive_sixty_frames_a_second(watched):
    python, lines = watched
    assert rate(python.times) >= LEAST_RATE
    ticks = [f.tick for f in python.frames]
    assert all(b > a for a, b in zip(ticks, ticks[1:]))
    assert all(isinstance(json.loads(line), dict) for _, line in lines)
    assert rate([t for t, _ in lines]) >= LEAST_RATE


def vectors(numbers) -> np.ndarray:
    return np.array(numbers.f64).reshape(-1, 3)


def residual(engine, audit) -> float:
    """Of `M v' + h = Sᵀτ + Σ Jᵀ f`, over the largest term."""
    engine.set(np.array(audit.positions.f64), np.array(audit.velocity.f64))
    left = engine.inverse(np.array(audit.acceleration.f64))
    right = np.zeros(NV)
    right[6:] = np.array(audit.torque.f64) + np.array(audit.ligament_torque.f64)
    scale = max(np.abs(left).max(), np.abs(right).max())
    for group in (audit.contacts, audit.applied):
        points, forces = vectors(group.position), vectors(group.force)
        assert len(group.segment) == len(points) == len(forces)
        for k, point, force in zip(group.segment, points, forces):
            where, _, J, _ = engine.segment(SEGMENTS[k])
            # Velocity of the point: that of the segment's origin, and its turning about it.
            term = J[3:].T @ force + J[:3].T @ np.cross(point - where, force)
            scale = max(scale, np.abs(term).max())
            right += term
    return float(np.abs(left - right).max() / scale)


@pytest.mark.parametrize("kind", [Pinocchio, Mujoco])
def test_frames_satisfy_the_equations_of_motion_of_the_exported_body(watched, pushed, stubs, tmp_path, kind):
    """Problem 14.3."""
    python, _ = watched
    with grpc.insecure_channel(pushed) as channel:
        service = stubs.body_grpc.BodyServiceStub(channel)
        body = python.roster.figures[0].body
        request = stubs.body.ExportBodyRequest(name=body, format=stubs.body.EXPORT_FORMAT_MJCF)
        text = service.ExportBody(request, timeout=20).text
    path = tmp_path / "body.mjcf"
    path.write_text(text)
    engine = kind(path)
    worst, pressed = 0.0, 0
    peopled = [f for f in python.frames if f.figures]  # the world is there a moment before its figure
    frames = peopled[:: max(1, len(peopled) // 40)]
    assert len(frames) >= 20
    for frame in frames:
        audit = frame.figures[0].audit
        assert len(audit.positions.f64) == 55 and len(audit.acceleration.f64) == NV
        assert not audit.loads and audit.gravity_mps2 == 9.81
        worst = max(worst, residual(engine, audit))
        pressed += len(audit.contacts.segment) > 0
    assert pressed > len(frames) / 2, "a waving figure stands on the ground"
    assert worst <= RESIDUAL
    # A check that cannot fail shows nothing: a torque off by a thousandth is seen.
    wrong = type(audit)()
    wrong.CopyFrom(audit)
    wrong.torque.f64[26] += 1e-3 * max(np.abs(audit.torque.f64))
    assert residual(engine, wrong) > 100 * RESIDUAL
