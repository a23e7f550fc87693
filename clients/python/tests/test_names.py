"""Wherever a name is wrong, the error lists those that are right."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

import sinew

SEGMENTS = ("pelvis", "chest", "r_hand", "l_toes")


@pytest.fixture
def world(server: sinew.Client) -> Iterator[sinew.World]:
    with server.create_world("names", replace=True) as world:
        world.add_figure("anna")
        world.add_figure("bea")
        yield world


RESOURCES: dict[str, tuple[Callable[[sinew.World], Any], tuple[str, ...]]] = {
    "body": (lambda w: w.client.body("giant"), ("adult-man", "child")),
    "body of a figure": (lambda w: w.add_figure(body="giant"), ("adult-man", "older-woman")),
    "body to export": (lambda w: w.client.export_body("giant"), ("adult-man", "child")),
    "body of a simulation": (lambda w: w.client.simulate("idle", body="giant"), ("adult-man", "child")),
    "clip": (lambda w: w.client.clip("moonwalk"), ("idle", "wave", "lift")),
    "clip to play": (lambda w: w.figure("anna").play("moonwalk"), ("idle", "wave", "lift")),
    "clip to simulate": (lambda w: w.client.simulate("moonwalk"), ("idle", "wave", "lift")),
    "world": (lambda w: w.client.world("nowhere"), ("names",)),
    "figure": (lambda w: w.figure("carl"), ("anna", "bea")),
    "figure to disturb": (lambda w: w.apply({"carl": sinew.Load(mass_kg=1.0)}), ("anna", "bea")),
    "figure to drive": (lambda w: w.drive("carl").__enter__(), ("anna", "bea")),
}


@pytest.mark.parametrize("what", RESOURCES)
def test_names_of_things_on_the_server(world: sinew.World, what: str) -> None:
    call, names = RESOURCES[what]
    with pytest.raises(sinew.NotFoundError) as error:
        call(world)
    for name in names:
        assert name in error.value.valid and name in str(error.value), str(error.value)
    assert "there are" in str(error.value) and error.value.resource and error.value.kind


FIELDS: dict[str, tuple[Callable[[sinew.World], Any], tuple[str, ...]]] = {
    "segment of a load": (lambda w: w.figure("anna").carry(1.0, "right_hand"), SEGMENTS),
    "second hand": (lambda w: w.figure("anna").carry(1.0, "r_hand", "left"), SEGMENTS),
    "segment of a push": (lambda w: w.figure("anna").push((1, 0, 0), "belly"), SEGMENTS),
    "segment of a constraint": (
        lambda w: w.figure("anna").constrain(sinew.Constraint(segment="tail", position=(0, 0, 1))),
        SEGMENTS,
    ),
    "DOF of a strength": (
        lambda w: w.add_figure(strength=sinew.Strength(dofs={"knee": 0.5})),
        ("l_knee_flexion", "neck_rotation"),
    ),
    "bone of a pose": (
        lambda w: w.figure("anna").ask(sinew.Pose(rotations={"paw": (0, 0, 0, 1)})),
        ("rightHand", "hips"),
    ),
}


@pytest.mark.parametrize("what", FIELDS)
def test_names_within_requests(world: sinew.World, what: str) -> None:
    call, names = FIELDS[what]
    with pytest.raises(sinew.InvalidArgumentError) as error:
        call(world)
    for name in names:
        assert name in error.value.problem and name in str(error.value), str(error.value)


CHOICES: dict[str, tuple[Callable[[sinew.World], Any], tuple[str, ...]]] = {
    "controller": (lambda w: w.add_figure(controller="best"), ("modern", "paper", "motors")),
    "stepper": (lambda w: w.add_figure(stepper="fast"), ("torque", "kinematic")),
    "sex": (lambda w: w.add_figure(body=sinew.Profile(sex="man")), ("male", "female")),
    "preset": (lambda w: w.add_figure(paper=sinew.Paper(preset="1999")), ("safeguarded", "2000")),
    "metric": (lambda w: w.add_figure(paper=sinew.Paper(metric="mass")), ("identity", "inertia", "torque")),
    "priority": (lambda w: w.add_figure(paper=sinew.Paper(priority="hand")), ("printed", "nested")),
    "share": (lambda w: w.add_figure(paper=sinew.Paper(share="half")), ("ratio", "balanced")),
    "frame field": (lambda w: w.frame(fields=["angles"]), ("joint_angles", "root_pose", "contacts")),
    "frame field of a watch": (lambda w: w.frames(fields=["angles"]), ("joint_angles", "touches")),
    "frame field of a recording": (lambda w: w.record(0.1, fields=["angles"]), ("joint_angles", "balance")),
    "encoding": (lambda w: w.frame(encoding="half"), ("float", "double", "fixed16")),
    "event type": (lambda w: w.events(types=["tripped"]), ("fell", "load_taken")),
    "overrun": (lambda w: w.client.create_world(overrun="wait"), ("skip", "catch_up", "dilate")),
    "form of an export": (lambda w: w.client.export_body("child", "sdf"), ("mjcf", "urdf")),
}


@pytest.mark.parametrize("what", CHOICES)
def test_names_that_the_client_knows(world: sinew.World, what: str) -> None:
    call, names = CHOICES[what]
    with pytest.raises(ValueError) as error:  # noqa: PT011
        call(world)
    for name in names:
        assert name in str(error.value), str(error.value)


def test_a_text_is_no_list_of_fields(world: sinew.World) -> None:
    with pytest.raises(TypeError, match=r"fields=\['torque'\]"):
        world.frame(fields="torque")


def test_names_within_what_came_back(world: sinew.World) -> None:
    world.step()
    with pytest.raises(KeyError, match="anna, bea"):
        world.frame()["carl"]
    with pytest.raises(KeyError, match="anna, bea"):
        world.record(0.1)["carl"]
    body = world.client.body("child")
    with pytest.raises(KeyError, match="l_knee_flexion"):
        body.dof("knee")
    with pytest.raises(KeyError, match="r_hand"):
        body.segment("right hand")
    assert np.isfinite(body.angle_limits).all()


def test_asyncio_lists_them_too(server: sinew.Client) -> None:
    async def everything() -> None:
        async with sinew.aio.Client(server.address) as client, await client.create_world() as world:
            figure = await world.add_figure("anna")
            with pytest.raises(sinew.NotFoundError, match="idle") as clip:
                await figure.play("moonwalk")
            assert "wave" in clip.value.valid
            with pytest.raises(sinew.NotFoundError, match="there are anna"):
                await world.figure("carl")

    asyncio.run(everything())
