"""The client against a real server."""

from __future__ import annotations

import asyncio
import threading
from pathlib import Path

import numpy as np
import pytest

import sinew


def lifted(server: sinew.Client, mass_kg: float) -> sinew.Recording:
    with server.create_world() as world:
        figure = world.add_figure("anna", body="adult-woman")
        figure.play("lift", reset=True)
        figure.carry(mass_kg, "r_hand", start_s=1.7)
        return figure.record(2.5)


@pytest.fixture(scope="module")
def recording(server: sinew.Client) -> sinew.Recording:
    return lifted(server, 12.0)


def test_a_recording_has_every_tick_and_obeys_strength(recording: sinew.Recording) -> None:
    assert recording.tick.tolist() == list(range(1, 151))
    np.testing.assert_allclose(recording.time_s, recording.tick / 60)
    assert recording.torque.shape == recording.joint_angles.shape == (150, 39)
    assert recording.segment_transforms.shape == (150, 18, 7)
    # Exactly, in each substep. Torques of frames are means of the tick, and limits those of its start.
    assert max(m.status.over_limit for m in recording.messages) <= 1e-12
    assert (np.median(recording.utilisation, axis=0) <= 1).all() and recording.utilisation.max() < 1.2
    assert recording.saturated[-1].any() and not recording.saturated[:90].any()
    assert recording.fell_at_s is None
    # Half a second before the load is there: the floor carries her weight.
    held = recording.contact_force[60:100, 2].mean()
    assert abs(held / (recording.body.mass_kg * 9.81) - 1) < 0.1
    first = recording.saturations(least_s=0.1)[0]
    assert 1.7 <= first.start_s + 1e-9 and first.dof in recording.body.dofs
    assert set(recording.hardest(3)) <= set(recording.body.dofs)


def test_forward_kinematics_agrees_with_the_server(server: sinew.Client) -> None:
    r = server.simulate("wave", duration_s=1.0, fields=["root_pose", "joint_rotations", "segment_transforms"])
    last = r.messages[-1].joint_rotations.f64
    made = r.body.poses(r.root_pose[-1], np.array(last))
    np.testing.assert_allclose(made[:, :3], r.segment_transforms[-1][:, :3], atol=1e-9)
    same = np.abs((made[:, 3:] * r.segment_transforms[-1][:, 3:]).sum(axis=1))
    np.testing.assert_allclose(same, 1.0, atol=1e-9)


def test_equal_inputs_give_equal_numbers(server: sinew.Client, recording: sinew.Recording) -> None:
    again = lifted(server, 12.0)
    assert (again.torque == recording.torque).all() and (again.root_pose == recording.root_pose).all()


def test_a_recording_survives_its_file(recording: sinew.Recording, tmp_path: Path) -> None:
    recording.save(tmp_path / "r.npz")
    back = sinew.Recording.load(tmp_path / "r.npz")
    assert (back.torque == recording.torque).all() and back.body.dofs == recording.body.dofs
    np.savez(tmp_path / "other.npz", x=np.zeros(3))
    with pytest.raises(ValueError, match="not a recording"):
        sinew.Recording.load(tmp_path / "other.npz")


def test_a_table_has_names_for_columns(recording: sinew.Recording) -> None:
    table = recording.to_pandas()
    assert len(table) == 150 and table.index.name == "time_s"
    elbow = recording.body.dof("r_elbow_flexion")
    assert (table["torque"]["r_elbow_flexion"].to_numpy() == recording.torque[:, elbow]).all()
    assert table["saturated"].to_numpy().any()


def test_what_was_not_recorded_says_how_to_get_it(server: sinew.Client) -> None:
    r = server.simulate("idle", duration_s=0.1, fields=["status"])
    with pytest.raises(AttributeError, match="fields="):
        _ = r.torque
    bare = server.simulate("idle", duration_s=0.1, fields=["torque", "torque_limits"])
    assert len(bare.plot_torques().axes) == 4
    none = server.simulate("idle", duration_s=0.1, fields=[])
    assert len(none) == 0 and none.summary is not None and none.summary.tick_count == 6
    with pytest.raises(ValueError, match="no frames"):
        none.plot_torques()


def test_plots_mark_limits(recording: sinew.Recording, tmp_path: Path) -> None:
    dofs = recording.hardest(2)
    plot = recording.plot_torques(dofs)
    assert len(plot.axes) == 2 and recording.saturated[:, recording.body.dof(dofs[0])].any()
    assert any("at the limit" in t.get_text() for t in plot.axes[0].texts)
    plot.savefig(tmp_path / "t.png")
    recording.strip(4).savefig(tmp_path / "s.png")
    assert (tmp_path / "t.png").stat().st_size > 10_000 and (tmp_path / "s.png").stat().st_size > 10_000
    for view in ("side", "front"):
        recording.strip(2, view=view)
    with pytest.raises(ValueError, match="three-quarter"):
        recording.strip(2, view="above")
    with pytest.raises(KeyError, match="tail_wag"):
        recording.plot_torques(["tail_wag"])


def test_errors_carry_what_was_wrong(server: sinew.Client) -> None:
    with pytest.raises(sinew.InvalidArgumentError) as invalid:
        server.create_world(rate_hz=5000)
    assert invalid.value.field == "world.rate_hz" and "10" in invalid.value.problem
    assert isinstance(invalid.value, ValueError) and invalid.value.reason == "INVALID_FIELD"
    with pytest.raises(sinew.NotFoundError) as unknown:
        server.world("none")
    assert unknown.value.resource == "worlds/none"
    with server.create_world("taken") as world:
        with pytest.raises(sinew.AlreadyExistsError):
            server.create_world("taken")
        figure = world.add_figure()
        with pytest.raises(sinew.InvalidArgumentError) as load:
            figure.apply(sinew.Push(impulse_newton_seconds=(1, 0, 0)), sinew.Load(mass_kg=float("nan")))
        assert load.value.field == "perturbations[1].load.mass_kg"
        with pytest.raises(sinew.InvalidArgumentError) as angles:
            figure.ask(np.zeros(38))
        assert angles.value.field == "batch.frames[0].figures[0].joint_angles_rad"
        with pytest.raises(sinew.ExpiredError) as expired:
            world.frame(tick=1000)
        assert expired.value.facts["newest_tick"] == "0"
        world.resume()
        with pytest.raises(sinew.PreconditionError) as running:
            world.step()
        assert running.value.reason == "WORLD_NOT_PAUSED"
    with pytest.raises(ValueError, match="modern"):
        server.simulate("idle", controller="best")  # type: ignore[arg-type]
    with sinew.Client("127.0.0.1:1", timeout_s=5.0) as nobody, pytest.raises(sinew.UnavailableError):
        nobody.info()


def test_a_world_goes_on_from_its_checkpoint(server: sinew.Client) -> None:
    with server.create_world() as world:
        figure = world.add_figure("anna")
        figure.play("walk", reset=True)
        world.step(120)
        checkpoint = world.checkpoint()
        data = world.checkpoint_data(checkpoint)
        with server.fork_world(data) as other, server.fork_world(world) as now:
            first, *others = (w.record(0.5)["anna"] for w in (world, other, now))
        assert np.ptp(first.root_pose[:, 0]) > 0.2
        world.restore(checkpoint)
        for again in (*others, world.record(0.5)["anna"]):
            assert (again.torque == first.torque).all() and (again.root_pose == first.root_pose).all()
        world.delete_checkpoint(checkpoint)
        with pytest.raises(sinew.NotFoundError):
            world.restore(checkpoint)


def test_the_past_of_a_world_is_gone_back_to_and_kept(server: sinew.Client) -> None:
    with server.create_world() as world:
        figure = world.add_figure("anna")
        figure.play("walk", reset=True)
        start = world.step(60)
        kept = world.start_recording("walk", first_tick=start)
        first = world.record(0.5)["anna"]
        oldest, newest = world.history()
        assert oldest <= start and newest >= start + 30
        past = world.read_history(first_tick=start + 1, last_tick=start + 30)["anna"]
        assert (past.torque == first.torque).all() and (past.root_pose == first.root_pose).all()
        with world.frames(fields=["root_pose"], resume_tick=start) as late:
            assert next(late).tick == start + 1
        with pytest.raises(sinew.InvalidArgumentError):
            world.read_history(first_tick=10_000)
        again = world.replay(first_tick=start)
        assert again.compared_tick_count >= 30 and not again.HasField("difference")
        assert world.stop_recording(kept).last_tick >= start + 30
        with server.fork_world(world, tick=start) as other:
            branch = other.record(0.5)["anna"]
        world.seek(start)
        for repeated in (branch, world.record(0.5)["anna"]):
            assert (repeated.torque == first.torque).all() and (repeated.root_pose == first.root_pose).all()
        assert world.export_recording(kept).startswith(b"\x89MCAP0\r\n")
        assert world.export_recording(kept, "bvh", figure="anna").startswith(b"HIERARCHY")
        assert world.export_recording(kept, "csv", figure="anna").count(b"\n") > 30
        world.delete_recording(kept)
        with pytest.raises(sinew.NotFoundError):
            world.export_recording(kept)
        with pytest.raises(sinew.ExpiredError):
            world.seek(10_000)


def test_the_paper_and_its_stepper_are_chosen(server: sinew.Client) -> None:
    as_printed = sinew.Paper(preset="2000", alpha=0.5, metric="inertia", hand_over=True)
    kinematic = server.simulate(
        "idle", controller="paper", stepper="kinematic", paper=as_printed, rate_hz=30.0, duration_s=0.5
    )
    usual = server.simulate("idle", controller="paper", rate_hz=30.0, duration_s=0.5)
    assert kinematic.summary.state_hash != usual.summary.state_hash
    with server.create_world() as world:
        figure = world.add_figure(controller="paper", stepper="kinematic", paper=as_printed)
        assert (figure.message.stepper, figure.message.paper.alpha, figure.message.paper.hand_over) == (2, 0.5, True)
        figure.update(paper=sinew.Paper(priority="nested", share="balanced"))
        assert figure.message.paper.priority == 2
        with pytest.raises(sinew.InvalidArgumentError) as wrong:
            figure.update(paper=sinew.Paper(alpha=2.0))
        assert wrong.value.field == "figure.paper.alpha"


def test_a_hand_and_the_centre_of_mass_are_constrained(server: sinew.Client) -> None:
    with server.create_world() as world:
        figure = world.add_figure(protective_steps=False)
        assert figure.message.protective_steps is False
        hand = sinew.Constraint(segment="r_hand", position=(0.35, -0.25, 1.1))
        figure.constrain(hand, sinew.Constraint(position=(0, 0.03, 0), axes=(0, 1, 0)))
        assert [c.segment for c in figure.get().constraints] == ["r_hand", ""]
        world.step(120)
        error = world.frame(fields=["constraint_error"])[figure.name].constraint_error
        assert error.shape == (2, 2) and error[:, 0].max() < 0.01
        figure.constrain()
        assert not figure.get().constraints
        with pytest.raises(sinew.InvalidArgumentError) as wrong:
            figure.constrain(sinew.Constraint(segment="tail", position=(0, 0, 1)))
        assert wrong.value.field == "figure.constraints[0].segment"


def test_a_running_world_is_watched(server: sinew.Client) -> None:
    with server.create_world(paused=False) as world:
        world.add_figure("a")
        world.add_figure("b", body="child", position=(0, 1))
        with world.frames(fields=["root_pose"], rate_divisor=2) as frames:
            ticks = [next(frames).tick for _ in range(5)]
            assert all(b > a for a, b in zip(ticks, ticks[1:]))
        both = world.record(0.5)
        assert list(both) == ["a", "b"] and both["b"].body.name == "child"
        assert len(both["a"]) > 15 and both.to_pandas().columns.nlevels == 3
        with world.events(types=["load_taken"]) as events:
            world.apply({"a": sinew.Load(mass_kg=2.0), "b": sinew.Load(mass_kg=1.0)})
            event = next(events)
        assert (event.type, event.figure, event.segment, event.mass_kg) == ("load_taken", "a", "r_hand", 2.0)


def test_a_control_loop_over_a_paused_world(server: sinew.Client) -> None:
    with server.create_world() as world:
        figure = world.add_figure()
        body = figure.body()
        elbow = body.dof("r_elbow_flexion")
        for i in range(60):
            angles = np.zeros(39)
            angles[elbow] = min(i / 40, 1.0)
            figure.ask(angles)
            world.step()
        assert abs(figure.state().joint_angles[elbow] - 1.0) < 0.05


def test_arrays_and_clips_are_streamed_live(server: sinew.Client) -> None:
    n = 45
    angles = np.zeros((n, 39))
    angles[:, 19] = np.linspace(0, 0.8, n)
    with server.create_world(paused=False) as world:
        figure = world.add_figure("a")
        root = figure.state().root_pose
        motion = sinew.Motion(angles, np.tile(root, (n, 1)), 60.0)
        feedback = figure.stream(motion)
        assert feedback.received_sequence == n - 1 or feedback.received_sequence > n - 20
        assert feedback.figures[0].figure_id == "a"
        with figure.drive() as drive:
            drive.send(np.zeros(39))
            with pytest.raises(sinew.PreconditionError) as taken:
                figure.play("idle")
            assert taken.value.reason == "FIGURE_CONTROLLED"
        with pytest.raises(sinew.InvalidArgumentError) as wrong, figure.drive() as drive:
            drive.send(np.zeros(7))
        assert wrong.value.field == "batch.frames[0].figures[0].joint_angles_rad"
    with pytest.raises(sinew.NotFoundError), world.drive("a"):
        pass


def test_mocap_becomes_a_clip_and_arrays(server: sinew.Client, corpus: Path) -> None:
    clip = server.upload_bvh(corpus / "wave.vrm.bvh", body="adult-woman")
    assert clip.report is not None and len(clip.report.mapped) > 10 and not clip.message.builtin
    motion = clip.motion(body="adult-woman")
    assert abs(motion.duration_s - clip.duration_s) < 0.1 and np.ptp(motion.angles, axis=0).max() > 0.5
    # What is asked does not depend on whether it can be done: motors alone do not balance.
    assert np.abs(np.diff(motion.root[:, :3], axis=0)).max() < 0.05
    stored = server.upload_motion(motion, body="adult-woman")
    assert stored.message.frame_count == len(motion) and stored.name in [c.name for c in server.clips()]
    clip.delete()
    stored.delete()
    with pytest.raises(sinew.InvalidArgumentError) as broken:
        server.upload_bvh(b"HIERARCHY\nROOT x\n{\n")
    assert broken.value.field == "bvh.data"
    with pytest.raises(FileNotFoundError):
        server.upload_bvh("there-is-none.bvh")


def test_bodies_are_people(server: sinew.Client) -> None:
    child, given = (
        server.body("child"),
        server.simulate("idle", body=sinew.Profile(sex="female", age_years=10), duration_s=0.1),
    )
    assert child.mass_kg < 50 and len(child.meshes[0].vertices) > 20
    assert given.body.message.profile.age_years == 10
    assert "<mujoco" in server.export_body("child")
    assert child.segment("rightHand") == child.segment("r_hand")


def test_asyncio_does_the_same(server: sinew.Client, recording: sinew.Recording) -> None:
    async def everything() -> None:
        async with sinew.aio.Client(server.address) as client:
            async with await client.create_world() as world:
                figure = await world.add_figure("anna", body="adult-woman")
                await figure.play("lift", reset=True)
                await figure.carry(12.0, "r_hand", start_s=1.7)
                same = await figure.record(2.5)
                assert (same.torque == recording.torque).all()
            with pytest.raises(sinew.NotFoundError):
                await world.get()
            async with await client.create_world(paused=False) as live:
                a = await live.add_figure("a")
                async with live.frames() as frames, a.drive() as drive:
                    for i in range(20):
                        await drive.send(np.zeros(39), time_s=i / 60)
                        frame = await frames.__anext__()
                    assert "a" in frame
                with pytest.raises(sinew.InvalidArgumentError) as wrong:
                    async with a.drive() as drive:
                        await drive.send(np.zeros(7))
                assert wrong.value.field == "batch.frames[0].figures[0].joint_angles_rad"
            both = await asyncio.gather(
                client.simulate("idle", duration_s=0.2), client.simulate("wave", duration_s=0.2)
            )
            assert [r.figure for r in both] == ["idle", "wave"]

    asyncio.run(everything())


def test_no_thread_is_left(server: sinew.Client) -> None:
    with server.create_world(paused=False) as world:
        figure = world.add_figure()
        with figure.drive() as drive:
            drive.send(np.zeros(39))
    assert not [t for t in threading.enumerate() if t.name == "sinew-drive"]


def test_progress_is_shown_when_asked(server: sinew.Client, capfd: pytest.CaptureFixture[str]) -> None:
    with server.create_world("bars") as world:
        world.add_figure()
        world.record(0.5)
        assert "bars" not in capfd.readouterr().err
        world.record(0.5, progress=True)
        assert "bars:" in capfd.readouterr().err
