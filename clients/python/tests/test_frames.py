"""What a frame says of the centre of mass is of the state that the frame shows.

Method: masses and poses of the segments, and their velocities from the 45 numbers of `velocity` by rigid-body
kinematics written here.
"""

from __future__ import annotations

import numpy as np
import pytest

import sinew
from sinew.frames import Floats
from sinew.rotation import rotate
from sinew.v1 import body_pb2

EXACT = 1e-9
FIELDS = ("root_pose", "segment_transforms", "velocity", "balance", "status")


def triple(v: object) -> Floats:
    return np.array([v.x, v.y, v.z])  # type: ignore[attr-defined]


def segment_twists(body: sinew.Body, poses: Floats, velocity: Floats) -> tuple[Floats, Floats]:
    """Angular velocities and velocities of the origins of all segments, world axes, (18, 3) each."""
    spin, speed = np.zeros((18, 3)), np.zeros((18, 3))
    spin[0], speed[0] = velocity[:3], velocity[3:6]
    dofs = body.message.dofs
    for i, parent in enumerate(body.parents):
        if i == 0:
            continue
        own = [k for k, d in enumerate(dofs) if d.joint == i]
        spin[i] = spin[parent]
        for place, k in enumerate(own):
            # Ball joints turn about child axes. The first of two hinges turns about an axis of the parent, the
            # last about one of the child.
            ball = body.message.joints[i].type == body_pb2.JOINT_TYPE_BALL
            frame = parent if not ball and place == 0 else i
            spin[i] = spin[i] + velocity[6 + k] * rotate(poses[frame, 3:], triple(dofs[k].axis))
        speed[i] = speed[parent] + np.cross(spin[parent], poses[i, :3] - poses[parent, :3])
    return spin, speed


def centre_of_mass(r: sinew.Recording, row: int) -> tuple[Floats, Floats]:
    """Position and velocity of the centre of mass of a row, loads included: the sum over segments of mass times
    velocity, over the mass.
    """
    poses = r.segment_transforms[row]
    spin, speed = segment_twists(r.body, poses, r.velocity[row])
    points = [(i, triple(s.com_m), s.mass_kg) for i, s in enumerate(r.body.message.segments)] + r.loads(row)
    mass = sum(m for _, _, m in points)
    com, momentum = np.zeros(3), np.zeros(3)
    for i, local, m in points:
        arm = rotate(poses[i, 3:], local)
        com += m * (poses[i, :3] + arm) / mass
        momentum += m * (speed[i] + np.cross(spin[i], arm))
    return com, momentum / mass


def moved(server: sinew.Client, load_kg: float, **settings: float) -> sinew.Recording:
    with server.create_world(**settings) as world:  # type: ignore[arg-type]
        figure = world.add_figure("anna", body="adult-woman")
        figure.play("wave", reset=True)
        if load_kg:
            figure.carry(load_kg, "r_hand", start_s=0.3)
        figure.push((20.0, 10.0, 0.0), start_s=0.1)
        return figure.record(0.8, fields=FIELDS)


@pytest.mark.parametrize("load_kg", [0.0, 6.0])
def test_the_centre_of_mass_is_that_of_the_state_of_the_frame(server: sinew.Client, load_kg: float) -> None:
    r = moved(server, load_kg)
    assert np.linalg.norm(r.com_velocity, axis=1).max() > 0.15, "nothing moved"
    assert bool(load_kg) == any(r.loads(row) for row in range(len(r)))
    for row in range(len(r)):
        com, velocity = centre_of_mass(r, row)
        np.testing.assert_allclose(r.com[row], com, atol=EXACT, rtol=0, err_msg=f"row {row}")
        np.testing.assert_allclose(r.com_velocity[row], velocity, atol=EXACT, rtol=0, err_msg=f"row {row}")


def test_the_velocity_of_the_centre_of_mass_is_its_change(server: sinew.Client) -> None:
    r = moved(server, 0.0, rate_hz=240.0, substeps=1)
    # A step moves the posture with the velocity that it ends with; half a step of the bias acceleration is the rest.
    com = np.array([centre_of_mass(r, row)[0] for row in range(len(r))])
    change = np.diff(com, axis=0) * r.rate_hz
    off = np.abs(change - r.com_velocity[1:]).max()
    late = np.abs(change - r.com_velocity[:-1]).max()
    assert off < 2e-3 and late > 4 * off, (off, late)


def test_a_state_and_a_recording_say_the_same(server: sinew.Client) -> None:
    with server.create_world() as world:
        figure = world.add_figure("anna")
        figure.push((20.0, 0.0, 0.0))
        r = figure.record(0.2)
        state = figure.state()
    assert (state.com_velocity == r.com_velocity[-1]).all() and (state.com == r.com[-1]).all()


def test_it_says_in_which_way_a_figure_follows_its_motion(server: sinew.Client) -> None:
    with server.create_world() as world:
        figure = world.add_figure("anna")
        world.step(2)
        assert figure.state().following == "", "there is nothing to follow"
        begins = figure.play("wave", follow="assisted")
        assert (begins.start, begins.rehearsed) == ("switch", False), "the clip begins in another stand"
        assert begins.time_s > 2 / 60
        world.step(30)
        state, status = figure.state(), figure.get().status
        with pytest.raises(ValueError, match="follow 'maybe' is none of strict, rehearsed, assisted"):
            figure.play("wave", follow="maybe")  # type: ignore[arg-type]
    assert (state.following, state.help_newton_seconds, state.help_ratio) == ("tracked", 0.0, 0.0)
    assert status.max_help_weights > 0.2


@pytest.mark.parametrize(("hand", "side"), [("l_hand", -1.0), ("r_hand", 1.0)])
def test_a_load_is_carried_in_the_palm(server: sinew.Client, hand: str, side: float) -> None:
    with server.create_world() as world:
        figure = world.add_figure("anna")
        figure.carry(2.0, hand)
        r = figure.record(0.1)
    ((segment, point, mass),) = r.loads(-1)
    assert (r.body.segments[segment], mass) == (hand, 2.0)
    described = r.body.message.segments[segment]
    # Between the wrist (the origin) and the knuckles (0.46 of the hand), on the palmar side, on the surface.
    assert 0.2 < point[2] / described.tip_m.z < 0.46
    near = r.body.meshes[segment].vertices
    near = near[np.abs(near[:, 2] - point[2]) < 0.03]
    assert 0.5 * (side * near[:, 1]).max() < side * point[1] <= (side * near[:, 1]).max() + 1e-9
    assert abs(point[0]) < 0.015


def test_a_load_of_two_hands_is_carried_in_both_palms(server: sinew.Client) -> None:
    with server.create_world() as world:
        figure = world.add_figure("anna")
        figure.carry(4.0, "r_hand", "l_hand")
        r = figure.record(0.1)
    (_, right, a), (_, left, b) = r.loads(-1)
    assert a == b == 2.0
    np.testing.assert_allclose(right * (1, -1, 1), left, atol=1e-12)
    assert right[1] > 0.005


def test_the_other_hand_helps_with_what_is_too_heavy_for_one_arm(server: sinew.Client) -> None:
    with server.create_world() as world:
        figure = world.add_figure("anna", body="adult-woman")
        figure.play("lift", reset=True)
        figure.carry(8.0, "r_hand", start_s=1.7, two_hands="auto")
        with world.events(types=["load_shared"]) as events:
            world.step(180)
            event = next(events)
        r = figure.record(0.1)
    assert (event.segment, event.other_segment, event.mass_kg) == ("r_hand", "l_hand", 8.0)
    alone, shared = event.need
    assert alone > 1.0 > shared
    masses = [mass for _, _, mass in r.loads(-1)]
    assert len(masses) == 2 and min(masses) > 2.0 and abs(sum(masses) - 8.0) < 1e-9
    with pytest.raises(ValueError, match="two hands 'maybe' is none of never, auto, always"):
        figure.carry(1.0, two_hands="maybe")
