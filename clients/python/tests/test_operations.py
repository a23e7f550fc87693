"""Long work that nobody waits for."""

from __future__ import annotations

import pytest

import sinew
from sinew.v1 import motion_pb2, simulation_pb2, world_pb2


def work(duration_s: float = 0.5) -> simulation_pb2.SimulateClipRequest:
    return simulation_pb2.SimulateClipRequest(clip="clips/wave", duration_s=duration_s, loop=True)


def test_an_operation_gives_what_the_call_would_have(server: sinew.Client) -> None:
    started = server.start(work(), request_id="simulate-once")
    assert server.start(work(), request_id="simulate-once").name == started.name, "a repeat starts nothing"
    result = started.result(60.0)
    assert isinstance(result, simulation_pb2.SimulateClipResponse)
    assert result.summary.tick_count == 30
    assert (started.done, started.state, started.progress) == (True, "succeeded", 1.0)
    again = server.operation(started.name)
    assert again.result() == result
    assert started.name in [o.name for o in server.operations()]
    started.delete()
    with pytest.raises(sinew.NotFoundError):
        again.get()


def test_what_fails_raises_what_the_call_would_have(server: sinew.Client) -> None:
    started = server.start(motion_pb2.CreateClipRequest(clip_id="none", bvh=motion_pb2.BvhSource(data=b"no file")))
    with pytest.raises(sinew.InvalidArgumentError) as caught:
        started.result(60.0)
    assert caught.value.reason == "INVALID_FIELD"
    assert caught.value.field == "create_clip.bvh.data"
    assert started.state == "failed"


def test_one_that_goes_on_is_cancelled(server: sinew.Client) -> None:
    started = server.start(work(100.0))
    with pytest.raises(sinew.DeadlineError):
        started.result(0.0)
    started.cancel()
    with pytest.raises(sinew.AbortedError):
        started.result()
    assert started.state == "cancelled"


def test_a_stale_etag_is_told(server: sinew.Client) -> None:
    with server.create_world(paused=True) as world:
        before = world.get()
        change = world_pb2.UpdateWorldRequest(world=before)
        change.world.speed = 2.0
        server.worlds_stub.UpdateWorld(change)
        with pytest.raises(sinew.AbortedError) as caught:
            server._ask(server.worlds_stub.UpdateWorld, change)
        assert caught.value.reason == "ETAG_MISMATCH"
