"""A paused world sends no frames: who waits for one is told so, unless they want to wait."""

from __future__ import annotations

import asyncio
import threading
import time

import pytest

import sinew

# Far more than it takes to notice, far less than for ever.
PATIENCE_S = 20.0


def test_frames_of_a_paused_world_end_with_an_error_that_says_what_to_do(server: sinew.Client) -> None:
    with server.create_world("still") as world:
        world.add_figure("anna")
        began = time.monotonic()
        with world.frames() as frames:
            first = next(frames)
            assert first.tick == 0 and "anna" in first
            says = r"'still' is paused at tick 0.*resume\(\).*step\(\).*wait=True"
            with pytest.raises(sinew.WorldPausedError, match=says) as paused:
                next(frames)
        assert time.monotonic() - began < PATIENCE_S
        assert (paused.value.world, paused.value.tick, paused.value.reason) == ("still", 0, "WORLD_PAUSED")
        assert isinstance(paused.value, sinew.PreconditionError)


def test_the_iteration_goes_on_when_the_world_does(server: sinew.Client) -> None:
    with server.create_world() as world:
        world.add_figure("anna")
        with world.frames() as frames:
            assert next(frames).tick == 0
            # Stepping before each frame is how a control loop watches; nothing is raised.
            for tick in range(1, 6):
                world.step()
                assert next(frames).tick == tick
            with pytest.raises(sinew.WorldPausedError):
                next(frames)
            world.step(3)
            # Some or all of the three; a slow reader gets the latest.
            while (tick := next(frames).tick) < 8:
                assert tick > 5
            world.resume()
            assert next(frames).tick > 8


def test_a_world_that_is_paused_meanwhile_ends_the_iteration(server: sinew.Client) -> None:
    with server.create_world(paused=False) as world:
        world.add_figure("anna")
        seen = []
        with pytest.raises(sinew.WorldPausedError), world.frames() as frames:
            for frame in frames:
                seen.append(frame.tick)
                if len(seen) == 5:
                    world.pause()
        assert len(seen) >= 5 and seen == sorted(seen)
        assert seen[-1] == world.get().tick, "the last frame before the pause was not lost"


def test_a_divisor_that_skips_ticks_of_a_paused_world_does_not_wait_for_ever(server: sinew.Client) -> None:
    with server.create_world() as world, world.frames(rate_divisor=4) as frames:
        assert next(frames).tick == 0
        world.step()  # to tick 1, of which no frame is sent
        with pytest.raises(sinew.WorldPausedError) as paused:
            next(frames)
        assert paused.value.tick == 1
        world.step(3)
        assert next(frames).tick == 4


def test_who_wants_to_wait_waits(server: sinew.Client) -> None:
    with server.create_world() as world:
        world.add_figure("anna")
        ticks: list[int] = []
        with world.frames(wait=True) as frames:
            assert next(frames).tick == 0
            waiting = threading.Thread(target=lambda: ticks.append(next(frames).tick))
            waiting.start()
            # Longer than it takes to notice a pause.
            waiting.join(1.5)
            assert waiting.is_alive() and not ticks
            world.step(2)
            waiting.join(PATIENCE_S)
            assert ticks and ticks[0] in (1, 2)


def test_a_slow_world_is_not_taken_for_a_paused_one(server: sinew.Client) -> None:
    # One tick in two seconds.
    with server.create_world(paused=False, rate_hz=10.0, speed=0.05) as world, world.frames() as frames:
        first = next(frames).tick
        assert next(frames).tick > first


def test_a_recording_of_a_world_that_is_paused_meanwhile_ends(server: sinew.Client) -> None:
    with server.create_world(paused=False) as world:
        world.add_figure("anna")
        stop = threading.Timer(0.5, world.pause)
        stop.start()
        with pytest.raises(sinew.WorldPausedError):
            world.record(60.0)
        stop.join()


def test_closing_from_another_thread_ends_a_wait(server: sinew.Client) -> None:
    with server.create_world() as world:
        frames = world.frames(wait=True)
        assert next(frames).tick == 0
        rest: list[sinew.Frame] = []
        waiting = threading.Thread(target=lambda: rest.extend(frames))
        waiting.start()
        frames.close()
        waiting.join(PATIENCE_S)
        assert not waiting.is_alive() and not rest
    assert not [t for t in threading.enumerate() if t.name == "sinew-stream"]


def test_deleting_the_world_ends_a_wait(server: sinew.Client) -> None:
    world = server.create_world("gone")
    with world.frames(wait=True) as frames:
        assert next(frames).tick == 0
        world.delete()
        with pytest.raises(sinew.NotFoundError):
            next(frames)


def test_asyncio_is_told_as_well(server: sinew.Client) -> None:
    async def everything() -> None:
        async with sinew.aio.Client(server.address) as client:
            async with await client.create_world("still-too") as world, world.frames() as frames:
                assert (await frames.__anext__()).tick == 0
                with pytest.raises(sinew.WorldPausedError, match="'still-too' is paused at tick 0"):
                    await asyncio.wait_for(frames.__anext__(), PATIENCE_S)
                await world.step(2)
                assert (await frames.__anext__()).tick in (1, 2)
                await world.resume()
                seen = []
                with pytest.raises(sinew.WorldPausedError):
                    async for frame in frames:
                        seen.append(frame.tick)
                        if len(seen) == 5:
                            await world.pause()
                assert seen[-1] == (await world.get()).tick
                async with world.frames(wait=True) as patient:
                    await patient.__anext__()
                    waiting = asyncio.ensure_future(patient.__anext__())
                    await asyncio.sleep(1.2)
                    assert not waiting.done()
                    await world.step()
                    assert (await asyncio.wait_for(waiting, PATIENCE_S)).tick == seen[-1] + 1

    asyncio.run(everything())
