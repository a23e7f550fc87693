//! The motion is a sine of the right elbow, so that every answer has a closed form.

use super::*;
use crate::ingest::playout::{CATCH_UP, MOST_BEHIND, SHRINK};
use crate::ingest::time::{ScheduledTime, SourceTime};
use sinew_physics::plan::StreamPlan;
use sinew_wire::types::Delay;

const RATE: f64 = 60.0;
const TICK: f64 = 1.0 / 60.0;

fn settings(delay: Delay) -> DriveSettings {
    DriveSettings {
        rate_hz: RATE,
        delay,
        extrapolation: 0.1,
        hold: 0.5,
        grace: 5.0,
        reset: true,
        window: None,
    }
}

/// World time `t` of a world that keeps up.
fn at(time: f64) -> Now {
    Now {
        time: WorldTime(time),
        lost: 0.0,
    }
}

fn angle(t: f64) -> f64 {
    0.8 + 0.5 * (3.0 * t).sin()
}

fn frame(i: i64, with_velocity: bool) -> BufferedFrame {
    let t = i as f64 / RATE;
    let mut posture = Posture::default();
    posture.root_position.z = 0.9;
    posture.hinge[4] = angle(t);
    let mut v = Box::new([0.0; NV]);
    v[6 + 19] = 1.5 * (3.0 * t).cos();
    BufferedFrame {
        sequence: i,
        source: SourceTime((t * 1e9).round() as i64),
        posture,
        velocity: with_velocity.then_some(v),
        planted: None,
        guess: Cell::new(Some([true; 2])),
        arrival: Instant::now(),
    }
}

fn buffer(delay: Delay) -> JitterBuffer {
    let mut stand = Posture::default();
    stand.root_position.z = 0.9;
    let body = Arc::new(Body::adult_man());
    JitterBuffer::new(settings(delay), TICK, body, Target::still(stand), stand)
}

/// Each frame is shown once, by the tick that first uses it, with the time of its own arrival.
#[test]
fn a_frame_is_shown_once_with_its_arrival() {
    let mut b = buffer(Delay::Fixed(0.05));
    let (mut sent, mut shown) = (Vec::new(), Vec::new());
    for i in 0..30 {
        let t = i as f64 * TICK;
        let f = frame(i, true);
        sent.push(f.arrival);
        b.push(f, ScheduledTime(t));
        b.sample(at(t));
        shown.extend(b.take_shown());
        assert_eq!(b.take_shown(), None);
    }
    assert!(shown.len() >= 26 && shown.len() < 30, "{}", shown.len());
    assert_eq!(shown, sent[..shown.len()]);
    // Without anything new, nothing more is shown.
    let newest = *sent.last().unwrap();
    for i in 30..60 {
        b.sample(at(i as f64 * TICK));
        shown.extend(b.take_shown());
    }
    assert_eq!(shown.last(), Some(&newest));
    assert_eq!(shown, sent);
}

#[test]
fn frames_that_come_in_time_are_played_a_fixed_delay_later() {
    for with_velocity in [true, false] {
        let mut b = buffer(Delay::Fixed(0.05));
        let mut worst = [0.0f64; 3];
        for i in 0..240 {
            let t = i as f64 * TICK;
            b.push(frame(i, with_velocity), ScheduledTime(t));
            if let Some(pair) = b.sample(at(t)) {
                let p = t - 0.05;
                let e = [
                    pair.now.posture.hinge[4] - angle(p),
                    pair.now.velocity[6 + 19] - 1.5 * (3.0 * p).cos(),
                    pair.now.acceleration[6 + 19] + 4.5 * (3.0 * p).sin(),
                ];
                if i > 10 {
                    worst = std::array::from_fn(|k| worst[k].max(e[k].abs()));
                }
                assert_eq!(b.supply(), Supply::Present);
            }
        }
        assert_eq!(b.counts().ticks[0], 237);
        assert!(
            worst[0] < 1e-3 && worst[1] < 0.02 && worst[2] < 0.5,
            "{worst:?}"
        );
    }
}

#[test]
fn an_adaptive_delay_covers_the_jitter_and_no_more() {
    let mut b = buffer(Delay::Adaptive { most: 0.2 });
    // Arrivals are 0…40 ms late, in order.
    let mut seed = 1u64;
    let mut arrivals = Vec::new();
    let mut last = 0.0f64;
    for i in 0..600 {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let late = (seed >> 40) as f64 / (1u64 << 24) as f64 * 0.04;
        last = last.max(i as f64 / RATE + late);
        arrivals.push((last, i));
    }
    let mut next = 0;
    for n in 0..600 {
        let t = n as f64 * TICK;
        while next < arrivals.len() && arrivals[next].0 <= t {
            b.push(frame(arrivals[next].1, true), ScheduledTime(t));
            next += 1;
        }
        b.sample(at(t));
    }
    let c = b.counts();
    assert!(c.ticks[3] == 0 && c.ticks[2] <= 6, "{c:?}");
    assert!((0.03..0.12).contains(&b.delay()), "{}", b.delay());
    assert!((0.02..0.07).contains(&b.jitter()), "{}", b.jitter());
}

#[test]
fn silence_is_extrapolated_then_held_then_relaxed() {
    let mut b = buffer(Delay::Fixed(0.0));
    for i in 0..30 {
        b.push(frame(i, true), ScheduledTime(i as f64 * TICK));
        b.sample(at(i as f64 * TICK));
    }
    let mut seen = Vec::new();
    let mut previous: Option<Target> = None;
    for n in 30..300 {
        let pair = b.sample(at(n as f64 * TICK)).unwrap();
        if let Some(last) = previous {
            let jump = last.posture.joint_difference(&pair.now.posture);
            assert!(
                jump.iter().all(|e| e.abs() < 1e-9),
                "continuous at tick {n}"
            );
        }
        previous = Some(pair.next);
        if seen.last() != Some(&b.supply()) {
            seen.push(b.supply());
        }
    }
    assert_eq!(seen, [Supply::Extrapolated, Supply::Held, Supply::Relaxed]);
    let end = previous.unwrap();
    assert!(end.posture.hinge[4].abs() < 1e-12, "stands quietly");
    assert_eq!(end.velocity[6 + 19], 0.0);
}

#[test]
fn motion_that_comes_back_is_blended_in() {
    let mut b = buffer(Delay::Fixed(0.0));
    let mut last: Option<Target> = None;
    for n in 0..240 {
        let t = n as f64 * TICK;
        if !(30..120).contains(&n) {
            b.push(frame(n, true), ScheduledTime(t));
        }
        let pair = b.sample(at(t)).unwrap();
        if let Some(last) = last {
            let e = (last.posture.hinge[4] - pair.now.posture.hinge[4]).abs();
            assert!(e < 0.03, "tick {n} jumps by {e} rad");
        }
        last = Some(pair.next);
    }
}

#[test]
fn old_and_surplus_frames_are_counted() {
    let mut b = buffer(Delay::Fixed(1.0));
    b.push(frame(5, true), ScheduledTime(0.0));
    b.push(frame(5, true), ScheduledTime(0.0));
    b.push(frame(3, true), ScheduledTime(0.0));
    assert_eq!(b.counts().stale, 2);
    for i in 6..(6 + CAPACITY as i64) {
        b.push(frame(i, true), ScheduledTime(0.0));
    }
    assert_eq!(b.counts().overflow, 1);
    // Hostile times do not overflow.
    let mut f = frame(10_000, true);
    f.source = SourceTime(i64::MAX);
    b.push(f, ScheduledTime(0.0));
    for n in 0..200 {
        let pair = b.sample(at(n as f64 * TICK));
        assert!(pair.is_none_or(|p| p.next.posture.is_finite()));
    }
    let mut b = buffer(Delay::Adaptive { most: 0.1 });
    for (i, ns) in [i64::MIN, 0, i64::MAX].into_iter().enumerate() {
        let mut f = frame(i as i64, false);
        f.source = SourceTime(ns);
        b.push(f, ScheduledTime(i as f64 * TICK));
        assert!(
            b.sample(at(i as f64 * TICK))
                .is_none_or(|p| p.next.posture.is_finite())
        );
    }
}

/// Half a second ahead at 0.5 m/s, then the last posture repeatedly.
#[test]
fn a_posture_that_is_repeated_breaks_the_stream_off_and_is_no_news() {
    let walking = |i: i64, at: i64| {
        let mut f = frame(i, false);
        f.posture = frame(at, false).posture;
        f.posture.root_position.x = 0.5 * at as f64 / RATE;
        f
    };
    let mut b = buffer(Delay::Fixed(0.05));
    let body = std::sync::Arc::new(sinew_physics::body::Body::adult_man());
    let mut motion = StreamPlan::new(body, 0.3);
    let (mut news, mut broken) = (Vec::new(), Vec::new());
    for i in 0..60 {
        let t = i as f64 * TICK;
        b.push(walking(i, i.min(30)), ScheduledTime(t));
        b.feed(at(t), (RATE, 0.3), |due| match due {
            DueSample::Sample(posture, planted) => motion.push(posture, planted),
            DueSample::Guess(posture, planted) => motion.push_guess(posture, planted),
            DueSample::Silence => panic!("it sends"),
        });
        news.push(b.has_news());
        broken.push(motion.breaks_off());
    }
    assert!(news[10..30].iter().all(|n| *n), "it moves");
    assert!(!news[40..].iter().any(|n| *n), "it does not");
    assert!(!broken[..36].iter().any(|b| *b), "not before 0.1 s");
    assert!(broken[45..].iter().all(|b| *b), "soon after");
    b.push(walking(60, 31), ScheduledTime(1.0));
    assert!(b.has_news(), "it moves again");
}

/// A driver at 60 Hz in real time, in a world that skips two ticks of three: the motion is slow, not fast; motion that
/// can no longer be played is skipped in one piece, and the driver is told.
#[test]
fn a_stream_in_an_overloaded_world_is_never_too_fast() {
    for delay in [Delay::Fixed(0.05), Delay::Adaptive { most: 0.1 }] {
        let mut b = buffer(delay);
        let (mut sent, mut pieces, mut last) = (0, Vec::new(), None::<f64>);
        for n in 0..600 {
            let now = Now {
                time: WorldTime(n as f64 * TICK),
                lost: 2.0 * n as f64 * TICK,
            };
            while sent as f64 / RATE <= now.scheduled().0 {
                b.push(frame(sent, true), ScheduledTime(sent as f64 / RATE));
                sent += 1;
            }
            b.sample(now);
            let played = b.pace.played.is_finite().then_some(b.pace.played.0);
            if let (Some(from), Some(to)) = (last, played) {
                let pace = (to - from) / TICK;
                assert!(
                    (-1e-9..=1.0 + CATCH_UP + 2.0 * SHRINK).contains(&pace),
                    "{pace} at tick {n}"
                );
            }
            assert!(b.delay() < MOST_BEHIND + 0.2 && b.behind() <= MOST_BEHIND);
            last = played;
            if let Some(why) = b.take_notice() {
                pieces.push(why);
            }
        }
        // 20 s were skipped, 2 s at a time.
        assert_eq!(pieces, [Resync::Behind; 9]);
        assert_eq!((b.counts().overflow, b.counts().stale), (0, 0));
    }
}

/// The stream catches up slowly after a hiccup of the world.
#[test]
fn a_stream_that_fell_behind_catches_up() {
    let mut b = buffer(Delay::Fixed(0.05));
    let (mut sent, mut behind) = (0, Vec::new());
    for n in 0..600 {
        let lost = if n < 100 { 0.0 } else { 0.1 };
        let time = n as f64 * TICK;
        while sent as f64 / RATE <= time + lost {
            b.push(frame(sent, true), ScheduledTime(sent as f64 / RATE));
            sent += 1;
        }
        b.sample(Now {
            time: WorldTime(time),
            lost,
        });
        behind.push(b.behind());
    }
    assert!(behind[99] == 0.0 && behind[100] > 0.099);
    assert!(
        behind[100..]
            .windows(2)
            .all(|w| w[0] - w[1] <= CATCH_UP * TICK + 1e-12)
    );
    assert_eq!(*behind.last().unwrap(), 0.0);
    assert_eq!(b.counts().resyncs, 0);
}

/// The frames of a driver whose clock is set, or that was restarted.
#[test]
fn a_clock_that_starts_again_is_followed_within_a_second() {
    let hour = 3_600_000_000_000;
    let later = |mut f: BufferedFrame, by: i64| {
        f.source.0 += by;
        f
    };
    let cases: [(&str, Box<dyn Fn(i64) -> BufferedFrame>); 4] = [
        (
            "clock back",
            Box::new(move |i| later(frame(i, true), -hour)),
        ),
        (
            "clock ahead",
            Box::new(move |i| later(frame(i, true), hour)),
        ),
        (
            "sequence",
            Box::new(|i| BufferedFrame {
                sequence: i - 120,
                ..frame(i, true)
            }),
        ),
        ("both", Box::new(|i| frame(i - 120, true))),
    ];
    for (name, second) in cases {
        for delay in [Delay::Fixed(0.05), Delay::Adaptive { most: 0.1 }] {
            let mut b = buffer(delay);
            let (mut notices, mut followed) = (Vec::new(), None);
            for i in 0..240 {
                let t = i as f64 * TICK;
                let f = if i < 120 { frame(i, true) } else { second(i) };
                let (sequence, ns) = (f.sequence, f.source.0);
                b.push(f, ScheduledTime(t));
                let pair = b.sample(at(t));
                assert!(pair.is_none_or(|p| p.next.posture.is_finite()));
                notices.extend(b.take_notice());
                let acts = b.applied().is_some_and(|(s, t)| {
                    sequence - s < 12 && ns - t.0 < 200_000_000 && sequence >= s
                });
                if i >= 120 && acts {
                    followed.get_or_insert(i);
                }
            }
            assert_eq!(notices, [Resync::Clock], "{name}");
            let within = followed.unwrap() - 120;
            assert!(within < 60, "{name}: {within} ticks");
            assert!(b.counts().stale <= 20, "{name}: {:?}", b.counts());
            assert!(matches!(b.supply(), Supply::Present | Supply::Interpolated));
        }
    }
}

/// Frames that are sent again, for safety or after a lost connection, do not restart the stream.
#[test]
fn frames_that_come_again_are_no_new_beginning() {
    let mut b = buffer(Delay::Fixed(0.05));
    for i in 0..240 {
        let t = i as f64 * TICK;
        for j in (i - 5).max(0)..=i {
            b.push(frame(j, true), ScheduledTime(t));
        }
        b.sample(at(t));
    }
    for j in 0..240 {
        b.push(frame(j, true), ScheduledTime(4.0));
    }
    assert_eq!(b.counts().resyncs, 0);
    assert!(b.counts().stale > 1000);
}

/// A stream in which all joints turn at once, at times that are never quite regular, without velocities.
fn lively(frames: i64) -> JitterBuffer {
    let mut b = buffer(Delay::Fixed(0.0));
    for i in 0..frames {
        let t = i as f64 / 75.0 + 0.003 * (17.0 * i as f64).sin();
        let mut f = frame(i, false);
        f.source = SourceTime((t * 1e9) as i64);
        let v = std::array::from_fn(|k| 0.7 * (2.0 * t + k as f64).sin());
        f.posture.integrate(&v, 1.0);
        b.push(f, ScheduledTime(t));
    }
    b
}

#[test]
fn velocities_that_are_known_already_are_those_that_would_be_found() {
    let b = lively(40);
    let bits = |a: &MotionAnswer| {
        let mut posture: Vec<u64> = a.target.posture.hinge.map(f64::to_bits).to_vec();
        let turns = a.target.posture.ball.iter().flat_map(|q| q.to_xyzw());
        posture.extend(turns.map(f64::to_bits));
        let rates = a.target.velocity.iter().chain(&a.target.acceleration);
        posture.extend(rates.map(|x| x.to_bits()));
        (posture, a.supply, a.frame, a.feet)
    };
    for step in [0.001, 1.0 / 75.0, TICK, 0.05] {
        let mut velocities = Velocities::default();
        for n in -3..(0.9 / step) as i64 {
            let p = PlayoutTime(n as f64 * step);
            let known = bits(&b.at_with(p, &mut velocities));
            assert_eq!(known, bits(&b.at(p)), "{p:?} in steps of {step} s");
        }
    }
}
