//! Goal: a rehearsal has the same result on any number of threads and can be stopped; a figure in a world repeats its
//! rehearsal bit for bit; the hold exerts no force on its path, leads back to it, and lets go when the path is out of
//! reach; help keeps its bound. Method: short parts of built-in motions, searched with few samples.

use sinew_physics::body::topology::{CHEST, DOF_COUNT};
use sinew_physics::body::{Body, NV, State};
use sinew_physics::figure::motion::rehearsal_playback::{ENTRY_TIME, RehearsalEntry};
use sinew_physics::figure::motion::rehearsed::{JointOffset, RehearsalWorld};
use sinew_physics::figure::{ControllerKind, Perturbation, StrengthScale};
use sinew_physics::math::Vec3;
use sinew_physics::motion::Clip;
use sinew_physics::motion::builtin::builtin;
use sinew_physics::rehearsal::{Problem, ProblemError, Reference, Rehearsal, Settings, rehearse};
use sinew_physics::time::WorldTime;
use sinew_physics::world::{
    ClipPlayback, FigureKey, FigureSetup, MotionSource, RehearsedMotion, RehearsedPlayback, World,
    WorldParams,
};
use std::sync::{Arc, OnceLock};

/// Deviation from a path that the solver's tolerance of 1e-4 N·m·s per substep causes when a spring is solved along
/// with it, m and rad: hands turn with 1e-2 kg·m².
const SOLVED: f64 = 1e-3;
/// Help that this costs, N and N·m: a thousandth of the weight.
const SLIGHT: f64 = 0.75;

/// A search that takes a second.
fn few() -> Settings {
    let mut settings = Settings::default();
    let trials = &mut settings.trials;
    (trials.near.samples, trials.batch, trials.survivors) = (24, 12, 6);
    trials.far.samples = 24;
    (trials.polish.rounds, trials.patience, trials.budget) = (2, 2, 120);
    trials.least_budget = 0;
    settings
}

fn problem() -> Problem {
    let world = WorldParams::default();
    let stage = RehearsalWorld {
        dt: 1.0 / world.rate_hz,
        substeps: world.substeps,
        gravity: world.gravity,
    };
    let body = Arc::new(Body::adult_man());
    Problem::new(body, &StrengthScale::default(), world.friction, stage)
}

/// Half a second of the downward phase of a squat.
fn squat(body: &Body) -> Clip {
    let whole = builtin(body, "squat").unwrap();
    let at = |i: usize| whole.sample(0.8 + i as f64 / 60.0);
    let postures = (0..=30).map(|i| at(i).posture).collect();
    Clip::from_postures("squat", 60.0, postures, vec![[true; 2]; 31]).unwrap()
}

fn rehearsed() -> &'static Rehearsal {
    static ONE: OnceLock<Rehearsal> = OnceLock::new();
    ONE.get_or_init(|| {
        let p = problem();
        rehearse(&p, &squat(&p.body), &few(), 2, &mut |_| true).unwrap()
    })
}

/// The motion with or without a hold.
fn motion(hold: bool) -> Arc<RehearsedMotion> {
    let mut motion = rehearsed().motion.clone();
    if !hold {
        motion.hold.most = [0.0; 2];
    }
    Arc::new(motion)
}

/// A world with a figure that plays the motion from `state` on.
fn playing(motion: &Arc<RehearsedMotion>, state: State) -> (World, FigureKey) {
    let mut world = World::new(WorldParams::default()).unwrap();
    let body = Arc::new(Body::adult_man());
    let key = world
        .add_figure(FigureSetup::new(body, ControllerKind::Modern, state))
        .unwrap();
    let play = RehearsedPlayback::new(Arc::clone(motion), WorldTime(0.0));
    let figure = world.figure_mut(key).unwrap();
    figure.set_drive(MotionSource::Rehearsed(play));
    (world, key)
}

fn is_rehearsed(world: &World, key: FigureKey) -> bool {
    matches!(
        world.figure(key).unwrap().drive(),
        MotionSource::Rehearsed(_)
    )
}

#[test]
fn any_number_of_threads_finds_the_same() {
    let mut p = problem();
    p.most_help = 0.3;
    let clip = slide(&p.body);
    let of = |p: &Problem, threads| rehearse(p, &clip, &few(), threads, &mut |_| true).unwrap();
    let one = of(&p, 1);
    assert!(
        one.motion
            .offsets
            .iter()
            .any(|o| o.0.iter().any(|x| *x != 0.0))
    );
    for threads in [2, 3] {
        let other = of(&p, threads);
        assert!(other.states == one.states, "{threads} threads");
        assert!(other.motion == one.motion, "{threads} threads");
        assert_eq!(other.work, one.work, "{threads} threads");
    }
    p.seed = 2;
    assert!(of(&p, 2).states != one.states, "another seed");
}

#[test]
fn strength_does_a_squat_and_no_help_is_reported() {
    let r = rehearsed();
    assert!(r.completed() && r.errors.farthest < 0.1, "{:?}", r.errors);
    assert_eq!((r.help.impulse, r.help.most), (0.0, [0.0; 2]));
    assert_eq!(r.states.len(), r.motion.ticks() + 1);
    assert!(r.motion.is_valid());
}

#[test]
fn a_world_does_what_was_rehearsed_bit_for_bit() {
    let motion = motion(false);
    let (mut world, key) = playing(&motion, motion.start());
    for (k, wanted) in rehearsed().states.iter().enumerate().skip(1) {
        world.step();
        let figure = world.figure(key).unwrap();
        assert!(figure.state() == wanted, "after tick {k}");
        assert_eq!(figure.report().unwrap().assist, [0.0; 6]);
    }
}

#[test]
fn on_its_path_the_hold_gives_nothing() {
    let motion = motion(true);
    let (mut world, key) = playing(&motion, motion.start());
    for wanted in &rehearsed().states[1..] {
        world.step();
        let figure = world.figure(key).unwrap();
        let off = figure.state().posture.difference(&wanted.posture);
        assert!(off.iter().all(|x| x.abs() < SOLVED), "{off:?}");
        let help = figure.report().unwrap().assist;
        assert!(help.iter().all(|x| x.abs() < SLIGHT), "{help:?}");
    }
}

#[test]
fn the_hold_leads_back_to_the_path_within_its_bound() {
    let motion = motion(true);
    let mut state = motion.start();
    let mut off = [0.0; NV];
    (off[3], off[4]) = (0.004, -0.003);
    state.posture.integrate(&off, 1.0);
    let (mut world, key) = playing(&motion, state);
    let mut largest = 0.0f64;
    for _ in 0..motion.ticks() {
        world.step();
        let help = world.figure(key).unwrap().report().unwrap().assist;
        let force = Vec3::from_array([help[3], help[4], help[5]]).norm();
        assert!(force <= motion.hold.most[0] * (1.0 + 1e-9), "{force} N");
        largest = largest.max(force);
    }
    let end = world.figure(key).unwrap().state().posture.root_position;
    let left = (end - rehearsed().states.last().unwrap().posture.root_position).norm();
    assert!(largest > 1.0 && left < 0.004, "{largest} N, {left} m left");
}

#[test]
fn a_motion_that_is_over_is_left_for_a_stand() {
    let motion = motion(true);
    let (mut world, key) = playing(&motion, motion.start());
    for k in 0..motion.ticks() + 30 {
        assert_eq!(is_rehearsed(&world, key), k <= motion.ticks());
        world.step();
    }
    let figure = world.figure(key).unwrap();
    assert!(matches!(figure.drive(), MotionSource::Hold(_)) && !figure.is_fallen());
    assert_eq!(figure.report().unwrap().assist, [0.0; 6]);
}

#[test]
fn what_is_pushed_out_of_reach_falls_as_it_is() {
    let motion = motion(true);
    let (mut world, key) = playing(&motion, motion.start());
    let push = Perturbation::Force {
        segment: CHEST,
        point: Vec3::zero(),
        force: Vec3::X * 3000.0,
        from: 0.0,
        to: 0.3,
    };
    world.perturb(key, push).unwrap();
    let mut left = false;
    for k in 0..180 {
        world.step();
        left |= !is_rehearsed(&world, key) && k + 1 < motion.ticks();
    }
    let figure = world.figure(key).unwrap();
    assert!(left && figure.is_fallen() && figure.state().is_finite());
}

#[test]
fn a_world_of_another_stage_does_not_play_it() {
    let motion = motion(true);
    let state = motion.start();
    let params = WorldParams {
        substeps: 4,
        ..WorldParams::default()
    };
    let mut world = World::new(params).unwrap();
    let setup = FigureSetup::new(Arc::new(Body::adult_man()), ControllerKind::Modern, state);
    let key = world.add_figure(setup).unwrap();
    let play = RehearsedPlayback::new(Arc::clone(&motion), WorldTime(0.0));
    world
        .figure_mut(key)
        .unwrap()
        .set_drive(MotionSource::Rehearsed(play));
    world.step();
    assert!(!is_rehearsed(&world, key));
}

#[test]
fn it_plays_wherever_its_origin_lies() {
    let motion = motion(true);
    let mut play = RehearsedPlayback::new(Arc::clone(&motion), WorldTime(0.0));
    (play.origin.x, play.origin.y, play.origin.yaw) = (2.0, -1.0, 2.0);
    let state = play.sample(WorldTime(0.0)).state();
    let (mut world, key) = playing(&motion, state);
    let origin = play.origin;
    world
        .figure_mut(key)
        .unwrap()
        .set_drive(MotionSource::Rehearsed(play));
    for wanted in &rehearsed().states[1..] {
        world.step();
        let is = world.figure(key).unwrap().state().posture.root_position;
        let off = (is - origin.point(wanted.posture.root_position)).norm();
        assert!(off < 1e-3, "{off} m");
    }
}

#[test]
fn a_figure_that_stands_plays_a_clip_as_it_was_rehearsed() {
    let p = problem();
    let whole = builtin(&p.body, "squat").unwrap();
    let postures = (0..=45).map(|i| whole.sample(i as f64 / 60.0).posture);
    let clip = Clip::from_postures("down", 60.0, postures.collect(), vec![[true; 2]; 46]).unwrap();
    let found = rehearse(&p, &clip, &few(), 2, &mut |_| true).unwrap();
    assert!(found.completed(), "{:?}", found.errors);
    let (motion, clip) = (Arc::new(found.motion), Arc::new(clip));
    let played = |off: f64| {
        let mut play = ClipPlayback::new(Arc::clone(&clip), WorldTime(0.0));
        (play.origin.x, play.origin.y, play.origin.yaw) = (2.0, -1.0, 2.0);
        let mut state = State::at_rest(play.sample(WorldTime(0.0)).posture);
        state.posture.hinge[0] += off;
        let mut world = World::new(WorldParams::default()).unwrap();
        let setup = FigureSetup::new(Arc::clone(&p.body), ControllerKind::Modern, state);
        let key = world.add_figure(setup).unwrap();
        let figure = world.figure_mut(key).unwrap();
        let origin = play.origin;
        play.rehearsed = Some(Arc::clone(&motion));
        figure.play(play, false, WorldTime(0.0));
        world.step();
        let rehearsed = is_rehearsed(&world, key);
        (1..motion.ticks()).for_each(|_| world.step());
        let end = world.figure(key).unwrap().state().posture.root_position;
        let wanted = found.states.last().unwrap().posture.root_position;
        (rehearsed, (end - origin.point(wanted)).norm())
    };
    let (rehearsed, off) = played(0.0);
    assert!(rehearsed && off < 0.01, "{off} m");
    assert!(!played(1.0).0, "it does not stand as the motion begins");
}

/// Lets a figure that stands at ease play a clip that begins in motion, until 0.1 s after its rehearsal has begun.
fn begun_in_motion(found: &Rehearsal, clip: &Arc<Clip>, max_help: f64) -> Begun {
    let p = problem();
    let stand = builtin(&p.body, "idle").unwrap().sample(0.0).posture;
    let mut world = World::new(WorldParams::default()).unwrap();
    let setup = FigureSetup::new(
        Arc::clone(&p.body),
        ControllerKind::Modern,
        State::at_rest(stand),
    );
    let key = world.add_figure(setup).unwrap();
    let mut play = ClipPlayback::new(Arc::clone(clip), WorldTime(0.0));
    play.max_help = max_help;
    play.rehearsed = Some(Arc::new(found.motion.clone()));
    let figure = world.figure_mut(key).unwrap();
    let entry = figure.rehearsal_entry(&play);
    figure.play(play, false, WorldTime(0.0));
    let mut out = Begun {
        entry,
        plays: false,
        off: f64::INFINITY,
        most: 0.0,
    };
    let ticks = (ENTRY_TIME / world.dt()).round() as usize + 6;
    for _ in 0..ticks {
        world.step();
        let help = world.figure(key).unwrap().report().unwrap().assist;
        out.most = out
            .most
            .max(Vec3::from_array([help[3], help[4], help[5]]).norm());
    }
    let figure = world.figure(key).unwrap();
    if let MotionSource::Rehearsed(play) = figure.drive() {
        let wanted = play.origin.point(found.states[6].posture.root_position);
        out.plays = true;
        out.off = (figure.state().posture.root_position - wanted).norm();
    }
    out
}

/// A rehearsal of a motion that begins in motion.
struct Begun {
    entry: Option<RehearsalEntry>,
    plays: bool,
    /// Distance of the pelvis from its path, m.
    off: f64,
    /// Largest help, N.
    most: f64,
}

#[test]
fn a_figure_that_stands_is_led_into_a_motion_only_with_help_and_within_its_bound() {
    let mut p = problem();
    p.most_help = 0.3;
    let clip = Arc::new(slide(&p.body));
    let found = rehearse(&p, &clip, &few(), 2, &mut |_| true).unwrap();
    assert!(!found.motion.begins_at_rest());
    let weight = p.body.profile.mass * p.stage.gravity;
    let helped = begun_in_motion(&found, &clip, 1.0);
    assert_eq!(helped.entry, Some(RehearsalEntry::Led));
    assert!(helped.plays && helped.off < 0.08, "{} m", helped.off);
    assert!(helped.most > 0.1 * weight && helped.most <= weight * (1.0 + 1e-9));
    let strict = begun_in_motion(&found, &clip, 0.0);
    assert_eq!(
        (strict.entry, strict.plays, strict.most),
        (None, false, 0.0)
    );
    // Too little help to get there: the clip is tracked with what there is.
    let weak = begun_in_motion(&found, &clip, 0.01);
    assert_eq!((weak.entry, weak.plays), (Some(RehearsalEntry::Led), false));
}

#[test]
fn a_figure_is_put_into_a_motion_that_begins_in_motion() {
    let p = problem();
    let clip = slide(&p.body);
    let found = rehearse(&p, &clip, &few(), 2, &mut |_| true).unwrap();
    let mut motion = found.motion.clone();
    motion.hold.most = [0.0; 2];
    let motion = Arc::new(motion);
    let stand = builtin(&p.body, "idle").unwrap().sample(0.0).posture;
    for (kind, able) in [
        (ControllerKind::Modern, true),
        (ControllerKind::Paper, false),
    ] {
        let mut world = World::new(WorldParams::default()).unwrap();
        let setup = FigureSetup::new(Arc::clone(&p.body), kind, State::at_rest(stand));
        let key = world.add_figure(setup).unwrap();
        let play = RehearsedPlayback::new(Arc::clone(&motion), WorldTime(0.0));
        let done = world.figure_mut(key).unwrap().rehearse_from_start(play);
        assert_eq!((done, is_rehearsed(&world, key)), (able, able));
        for (k, wanted) in found.states.iter().enumerate().skip(1).take(20) {
            world.step();
            let same = world.figure(key).unwrap().state() == wanted;
            assert_eq!(same, able, "after tick {k}");
        }
    }
}

/// In each joint the offsets change by no more between two ticks than in half a window, shared out evenly.
#[test]
fn offsets_do_not_jump_between_windows() {
    let mut p = problem();
    p.most_help = 0.3;
    let motion = rehearse(&p, &slide(&p.body), &few(), 2, &mut |_| true);
    let motion = motion.unwrap().motion;
    assert!(motion.ramp >= motion.window.div_ceil(2));
    let share = 1.0 / motion.ramp as f64;
    let mut last = JointOffset::default();
    let mut moved = 0.0f64;
    for k in 0..motion.ticks() {
        let w = k / motion.window;
        let before = w
            .checked_sub(1)
            .map_or(JointOffset::default(), |w| motion.offsets[w]);
        let now = motion.offset(k);
        for j in 0..DOF_COUNT {
            let step = now.0[j] - last.0[j];
            let on_the_way = k % motion.window < motion.ramp;
            let wanted =
                if on_the_way { share } else { 0.0 } * (motion.offsets[w].0[j] - before.0[j]);
            assert!((step - wanted).abs() < 1e-12, "DOF {j}, tick {k}");
            moved = moved.max(step.abs());
        }
        last = now;
    }
    assert!(moved > 0.0);
}

#[test]
fn what_ends_at_rest_ends_with_a_stand_and_what_does_not_does_not() {
    let (p, settings) = (problem(), few());
    let still = squat(&p.body).posture(0).to_owned();
    let still = Clip::from_postures("still", 60.0, vec![still; 31], vec![[true; 2]; 31]).unwrap();
    let of = |clip: &Clip| Reference::new(&p, clip, &settings.rest).unwrap();
    let (stands, goes) = (of(&still), of(&slide(&p.body)));
    let ticks = |s: f64| (s * 60.0f64).round() as usize;
    let [before, after] = [settings.rest.times.settling, settings.rest.after].map(ticks);
    assert_eq!(stands.recorded, [before, before + 30]);
    assert_eq!(stands.ticks(), before + 30 + after);
    assert_eq!((goes.recorded, goes.ticks()), ([0, 40], 40));
    for end in [&stands.targets[0], stands.targets.last().unwrap()] {
        assert!(end.velocity.iter().all(|v| v.abs() < 1e-9));
    }
}

#[test]
fn a_search_that_is_stopped_has_the_best_so_far() {
    let p = problem();
    let (mut asked, mut ticks) = (0, 0);
    let r = rehearse(&p, &squat(&p.body), &few(), 1, &mut |progress| {
        assert!(progress.ticks >= ticks && progress.reached[0] <= progress.reached[1]);
        (asked, ticks) = (asked + 1, progress.ticks);
        asked < 3
    });
    let r = r.unwrap();
    assert_eq!(asked, 3);
    assert!(r.work.stopped && !r.completed() && r.motion.is_valid());
}

#[test]
fn a_search_that_does_not_get_beyond_its_first_window_asks_and_gives_up() {
    let mut p = problem();
    p.most_help = 0.3;
    let hopeless = Settings { kept: 0.0, ..few() };
    let mut asked = 0;
    let r = rehearse(&p, &squat(&p.body), &hopeless, 1, &mut |_| {
        asked += 1;
        true
    });
    let work = r.unwrap().work;
    assert_eq!(work.reached[0], 0);
    // In each of three stages.
    assert_eq!(work.rounds, 3 * hopeless.trials.patience);
    assert_eq!(asked, work.rounds);
    let r = rehearse(&p, &squat(&p.body), &hopeless, 1, &mut |_| false);
    assert_eq!(r.unwrap().work.rounds, 1);
}

#[test]
fn taking_help_away_can_be_stopped() {
    let mut p = problem();
    p.most_help = 2.0;
    let settings = few();
    let r = rehearse(
        &p,
        &moved(&p.body, Vec3::Z),
        &settings,
        1,
        &mut |progress| progress.polished < settings.trials.polish.rounds,
    );
    let r = r.unwrap();
    assert!(r.work.stopped && r.work.reached[0] == r.work.reached[1]);
    assert!(r.help.impulse > 0.0 && r.motion.is_valid());
}

/// A body that slides on its soles, faster than it could walk: which no strength can do.
fn slide(body: &Body) -> Clip {
    moved(body, Vec3::X)
}

/// A stiff body that moves in a direction.
fn moved(body: &Body, direction: Vec3) -> Clip {
    let stand = builtin(body, "idle").unwrap().sample(0.0).posture;
    let postures = (0..=40).map(|i| {
        let mut p = stand;
        p.root_position += direction * (1.5 * f64::from(i) / 60.0);
        p
    });
    Clip::from_postures("moved", 60.0, postures.collect(), vec![[false; 2]; 41]).unwrap()
}

#[test]
fn help_is_taken_only_where_it_is_allowed_and_within_its_bound() {
    let mut p = problem();
    let clip = slide(&p.body);
    let strict = rehearse(&p, &clip, &few(), 2, &mut |_| true).unwrap();
    assert_eq!(strict.help.impulse, 0.0);
    p.most_help = 0.3;
    let helped = rehearse(&p, &clip, &few(), 2, &mut |_| true).unwrap();
    let weight = p.body.profile.mass * p.stage.gravity;
    assert!(
        helped.help.most[0] <= 0.3 * weight * (1.0 + 1e-9),
        "{:?}",
        helped.help
    );
    let nearer = helped.errors.lost_at.is_none() || helped.errors.lost_at > strict.errors.lost_at;
    assert!(strict.errors.lost_at.is_none() || nearer);
    assert!(helped.motion.is_valid());
}

#[test]
fn clips_without_length_and_motions_that_cannot_be_are_refused() {
    let p = problem();
    let stand = builtin(&p.body, "idle").unwrap().sample(0.0).posture;
    let one = Clip::from_postures("one", 60.0, vec![stand], vec![[true; 2]]).unwrap();
    let refused = rehearse(&p, &one, &few(), 1, &mut |_| true);
    assert!(matches!(refused, Err(ProblemError::Length { .. })));

    let good = &rehearsed().motion;
    let wrong: [fn(&mut RehearsedMotion); 6] = [
        |m| m.path.truncate(3),
        |m| m.offsets.clear(),
        |m| m.window = 0,
        |m| m.hold.frequency = f64::NAN,
        |m| m.stage.substeps = 0,
        |m| m.desired[1].velocity[3] = f64::INFINITY,
    ];
    for (i, change) in wrong.into_iter().enumerate() {
        let mut bad = good.clone();
        change(&mut bad);
        assert!(!bad.is_valid(), "{i}");
    }
}
