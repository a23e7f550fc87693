"""Obstacles from Python: every shape, every mobility, and what figures do with them."""

from __future__ import annotations

import asyncio

import numpy as np
import pytest
from conftest import ROOT

import sinew

SHAPES: list[sinew.Shape] = [
    sinew.Sphere(radius_m=0.11),
    sinew.Capsule(radius_m=0.05, half_length_m=0.4),
    sinew.Box(half_m=(0.2, 0.3, 0.4)),
    sinew.Plane(),
]


@pytest.mark.parametrize("shape", SHAPES, ids=lambda s: type(s).__name__)
def test_obstacles_come_back_as_they_were_added(server: sinew.Client, shape: sinew.Shape) -> None:
    turned = (0.0, 0.0, np.sin(0.3), np.cos(0.3))
    with server.create_world() as world:
        made = world.add_obstacle(shape, "thing", position=(2.0, 1.0, 0.5), rotation=turned, friction=0.8)
        (there,) = world.obstacles()
        for o in (made, there, world.obstacle("thing")):
            assert (o.name, o.shape, o.mobility, o.friction) == ("thing", shape, "fixed", 0.8)
            np.testing.assert_allclose(o.position, (2.0, 1.0, 0.5), atol=1e-12)
            np.testing.assert_allclose(o.rotation, turned, atol=1e-12)
        there.remove()
        assert world.obstacles() == []
        with pytest.raises(sinew.NotFoundError):
            made.remove()


def test_a_free_ball_falls_and_a_led_box_goes_its_way(server: sinew.Client) -> None:
    with server.create_world() as world:
        small = sinew.Sphere(radius_m=0.1)
        ball = world.add_obstacle(small, "ball", position=(0, 0, 3.0), mobility="free", mass_kg=2.0)
        box = world.add_obstacle(
            sinew.Box(half_m=(0.1, 0.1, 0.1)),
            "box",
            position=(4, 0, 1.0),
            mobility="led",
            velocity=(0.6, 0, 0),
            angular_velocity=(0, 0, 0.5),
        )
        world.step(30)
        frame = world.frame()
        assert list(frame.obstacles) == ["ball", "box"]
        t = frame.time_s
        # Half a second of free fall; the step is first order in its length.
        assert abs(frame.obstacles["ball"].position[2] - (3.0 - 0.5 * 9.81 * t * t)) < 0.05
        np.testing.assert_allclose(frame.obstacles["ball"].velocity, (0, 0, -9.81 * t), atol=1e-6)
        np.testing.assert_allclose(frame.obstacles["box"].position, (4 + 0.6 * t, 0, 1.0), atol=1e-9)
        np.testing.assert_allclose(frame.obstacles["box"].angular_velocity, (0, 0, 0.5), atol=1e-12)
        assert abs(ball.get().position[2] - frame.obstacles["ball"].position[2]) < 1e-9 and ball.mass_kg == 2.0
        # Along a path: the velocity of each step.
        box.update(velocity=(0, 0.6, 0), angular_velocity=(0, 0, 0))
        np.testing.assert_allclose(box.position, (4 + 0.6 * t, 0, 1.0), atol=1e-9)
        world.step(30)
        np.testing.assert_allclose(box.get().position, (4 + 0.6 * t, 0.6 * t, 1.0), atol=1e-9)
        assert box.shape == sinew.Box(half_m=(0.1, 0.1, 0.1)) and box.mobility == "led"


def test_a_figure_is_pushed_by_what_is_led_into_it(server: sinew.Client) -> None:
    with server.create_world() as world:
        figure = world.add_figure("anna")
        world.add_obstacle(
            sinew.Box(half_m=(0.05, 0.5, 0.5)), "wall", position=(-1.0, 0, 1.2), mobility="led", velocity=(1.5, 0, 0)
        )
        before = figure.state().root_pose[0]
        touched = []
        for _ in range(12):
            world.step(5)
            touched += figure.state(fields=["touches"]).touches
        assert {t.other for t in touched} == {"obstacles/wall"}
        assert all(t.segment in figure.body().segments for t in touched)
        assert max(t.force[0] for t in touched) > 10.0
        assert figure.state().root_pose[0] > before + 0.05


def test_the_example_of_the_documentation_runs(server: sinew.Client, capsys: pytest.CaptureFixture[str]) -> None:
    page = (ROOT / "docs" / "python.md").read_text()
    code = page.split("## Obstacles", 1)[1].split("```python\n", 1)[1].split("```", 1)[0]
    exec(code, {"client": server, "sinew": sinew, "np": np})
    said = capsys.readouterr().out
    assert "obstacles/ball" in said and said.rstrip().endswith("['slope', 'ball', 'door']")


def test_what_is_wrong_is_named(server: sinew.Client) -> None:
    with server.create_world() as world:
        with pytest.raises(ValueError, match="fixed, led, free"):
            world.add_obstacle(sinew.Plane(), mobility="flying")  # type: ignore[arg-type]
        with pytest.raises(sinew.InvalidArgumentError) as small:
            world.add_obstacle(sinew.Sphere(radius_m=0.0))
        assert small.value.field == "obstacle.sphere.radius_m"
        with pytest.raises(sinew.InvalidArgumentError) as massless:
            world.add_obstacle(sinew.Sphere(radius_m=0.1), mobility="free")
        assert massless.value.field == "obstacle.mass_kg"
        with pytest.raises(sinew.InvalidArgumentError) as falling:
            world.add_obstacle(sinew.Plane(), mobility="free", mass_kg=1.0)
        assert falling.value.field == "obstacle.mobility"
        for bad in ({"position": (0, 0)}, {"rotation": (0, 0, 1)}, {"velocity": (0, 0, 0, 0)}):
            with pytest.raises(ValueError, match="numbers x, y, z"):
                world.add_obstacle(sinew.Plane(), **bad)  # type: ignore[arg-type]
        world.add_obstacle(sinew.Plane(), "floor", position=(0, 0, -1.0))
        with pytest.raises(sinew.AlreadyExistsError):
            world.add_obstacle(sinew.Plane(), "floor")
        with pytest.raises(sinew.NotFoundError, match="there are floor") as missing:
            world.obstacle("roof")
        assert missing.value.valid == ("floor",)


def test_asyncio_has_obstacles(server: sinew.Client) -> None:
    async def everything() -> None:
        async with sinew.aio.Client(server.address) as client, await client.create_world() as world:
            shape = sinew.Sphere(radius_m=0.2)
            ball = await world.add_obstacle(shape, "ball", position=(1, 0, 2), mobility="free", mass_kg=1.0)
            await world.step(6)
            assert (await ball.get()).position[2] < 2.0
            await ball.update(position=(1, 0, 5), velocity=(0, 0, 0))
            assert [o.name for o in await world.obstacles()] == ["ball"] and ball.position[2] == 5.0
            await ball.remove()
            assert not await world.obstacles()

    asyncio.run(everything())
