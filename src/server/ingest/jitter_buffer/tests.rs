//! The motion is a sine of the right elbow, so that every answer has a closed form.

use super::*;
use crate::sim::plan::StreamPlan;

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

fn angle(t: f64) -> f64 {
    0.8 + 0.5 * (3.0 * t).sin()
}

fn frame(i: i64, with_velocity: bool) -> Frame {
    let t = i as f64 / RATE;
    let mut posture = Posture::default();
    posture.root_position.z = 0.9;
    posture.hinge[4] = angle(t);
    let mut v = Box::new([0.0; NV]);
    v[6 + 19] = 1.5 * (3.0 * t).cos();
    Frame {
        sequence: i,
        source_ns: (t * 1e9).round() as i64,
        posture,
        velocity: with_velocity.then_some(v),
        planted: None,
        guess: Cell::new(Some([true; 2])),
    }
}

fn buffer(delay: Delay) -> JitterBuffer {
    let mut stand = Posture::default();
    stand.root_position.z = 0.9;
    let body = Arc::new(Body::adult_man());
    JitterBuffer::new(settings(delay), TICK, body, Target::still(stand), stand)
}

#[test]
fn frames_that_come_in_time_are_played_a_fixed_delay_later() {
    for with_velocity in [true, false] {
        let mut b = buffer(Delay::Fixed(0.05));
        let mut worst = [0.0f64; 3];
        for i in 0..240 {
            let t = i as f64 * TICK;
            b.push(frame(i, with_velocity), t);
            if let Some(pair) = b.sample(t) {
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
            b.push(frame(arrivals[next].1, true), t);
            next += 1;
        }
        b.sample(t);
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
        b.push(frame(i, true), i as f64 * TICK);
        b.sample(i as f64 * TICK);
    }
    let mut seen = Vec::new();
    let mut previous: Option<Target> = None;
    for n in 30..300 {
        let pair = b.sample(n as f64 * TICK).unwrap();
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
            b.push(frame(n, true), t);
        }
        let pair = b.sample(t).unwrap();
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
    b.push(frame(5, true), 0.0);
    b.push(frame(5, true), 0.0);
    b.push(frame(3, true), 0.0);
    assert_eq!(b.counts().stale, 2);
    for i in 6..(6 + CAPACITY as i64) {
        b.push(frame(i, true), 0.0);
    }
    assert_eq!(b.counts().overflow, 1);
    // Hostile times do not overflow.
    let mut f = frame(10_000, true);
    f.source_ns = i64::MAX;
    b.push(f, 0.0);
    for n in 0..200 {
        let pair = b.sample(n as f64 * TICK);
        assert!(pair.is_none_or(|p| p.next.posture.is_finite()));
    }
    let mut b = buffer(Delay::Adaptive { most: 0.1 });
    for (i, ns) in [i64::MIN, 0, i64::MAX].into_iter().enumerate() {
        let mut f = frame(i as i64, false);
        f.source_ns = ns;
        b.push(f, i as f64 * TICK);
        assert!(
            b.sample(i as f64 * TICK)
                .is_none_or(|p| p.next.posture.is_finite())
        );
    }
}

/// Half a second ahead at 0.5 m/s, then the last posture again and again.
#[test]
fn a_posture_that_is_repeated_breaks_the_stream_off_and_is_no_news() {
    let walking = |i: i64, at: i64| {
        let mut f = frame(i, false);
        f.posture = frame(at, false).posture;
        f.posture.root_position.x = 0.5 * at as f64 / RATE;
        f
    };
    let mut b = buffer(Delay::Fixed(0.05));
    let body = std::sync::Arc::new(crate::sim::body::Body::adult_man());
    let mut motion = StreamPlan::new(body, 0.3);
    let (mut news, mut broken) = (Vec::new(), Vec::new());
    for i in 0..60 {
        let t = i as f64 * TICK;
        b.push(walking(i, i.min(30)), t);
        b.feed(t, (RATE, 0.3), |due| match due {
            Due::Sample(posture, planted) => motion.push(posture, planted),
            Due::Silence => panic!("it sends"),
        });
        news.push(b.has_news());
        broken.push(motion.breaks_off());
    }
    assert!(news[10..30].iter().all(|n| *n), "it moves");
    assert!(!news[40..].iter().any(|n| *n), "it does not");
    assert!(!broken[..36].iter().any(|b| *b), "not before 0.1 s");
    assert!(broken[45..].iter().all(|b| *b), "soon after");
    b.push(walking(60, 31), 1.0);
    assert!(b.has_news(), "it moves again");
}
