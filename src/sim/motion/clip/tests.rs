//! Goal: sampling yields a motion: rates are derivatives, loops close, displacements carry on.

use super::*;

/// A smooth tumbling motion in closed form.
fn tumble(t: f64) -> Posture {
    let wave = |k: usize| {
        let k = k as f64;
        0.6 * (t * (2.0 + 0.13 * k) + k).sin()
    };
    let mut p = Posture {
        root_position: Vec3 {
            x: 0.5 * t,
            y: wave(1),
            z: 1.0 + 0.1 * wave(2),
        },
        root_rotation: Quat::exp(Vec3 {
            x: wave(3),
            y: wave(4),
            z: 0.8 * t,
        }),
        ..Posture::default()
    };
    for b in 0..BALL_COUNT {
        p.ball[b] = Quat::exp(Vec3 {
            x: wave(5 + b),
            y: 2.0 * wave(9 + b),
            z: wave(13 + b),
        });
    }
    for h in 0..p.hinge.len() {
        p.hinge[h] = wave(20 + h);
    }
    p
}

fn clip(rate: f64, seconds: f64) -> Clip {
    let n = (rate * seconds) as usize + 1;
    let postures = (0..n).map(|i| tumble(i as f64 / rate)).collect();
    let planted = (0..n).map(|i| [i % 2 == 0, true]).collect();
    Clip::from_postures("tumble", rate, postures, planted).unwrap()
}

fn worst(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(x, y)| (x - y).abs())
        .fold(0.0, f64::max)
}

/// Velocity and acceleration against differences of posture and velocity.
fn check_derivatives(sample: impl Fn(f64) -> Target, t: f64) {
    let h = 1e-5;
    let (a, m, b) = (sample(t - h), sample(t), sample(t + h));
    // The root's part of `difference` is a world rotation vector about the later posture; halves on both sides cancel.
    let measured = a.posture.difference(&b.posture).map(|d| d / (2.0 * h));
    assert!(
        worst(&measured, &m.velocity) < 1e-6,
        "velocity at {t}: {:e}",
        worst(&measured, &m.velocity)
    );
    let measured: [f64; NV] = std::array::from_fn(|k| (b.velocity[k] - a.velocity[k]) / (2.0 * h));
    assert!(
        worst(&measured, &m.acceleration) < 2e-5,
        "acceleration at {t}: {:e}",
        worst(&measured, &m.acceleration)
    );
}

/// Section 3.2 of the paper.
#[test]
fn sampled_rates_are_derivatives_of_the_sampled_posture() {
    let clip = clip(60.0, 2.0);
    for i in 1..400 {
        check_derivatives(|t| clip.sample(t), 0.004_97 * f64::from(i));
    }
}

#[test]
fn large_steps_between_samples_keep_rates_consistent() {
    // 2 Hz: the tumbling turns by more than 90° from sample to sample.
    let clip = clip(2.0, 8.0);
    for i in 1..400 {
        check_derivatives(|t| clip.sample(t), 0.019_3 * f64::from(i));
    }
}

#[test]
fn samples_are_met_and_the_motion_between_is_close() {
    let clip = clip(60.0, 2.0);
    assert_eq!((clip.len(), clip.name()), (121, "tumble"));
    for i in 0..clip.len() {
        let at = clip.sample(i as f64 / 60.0);
        assert!(worst(&at.posture.difference(clip.posture(i)), &[0.0; NV]) < 1e-12);
    }
    for i in 0..150 {
        let t = 0.1 + 0.011_3 * f64::from(i);
        let off = clip.sample(t).posture.difference(&tumble(t));
        assert!(worst(&off, &[0.0; NV]) < 2e-6);
        // Rates against the closed form, to the order of the stencils.
        let h = 1e-4;
        let v = tumble(t - h)
            .difference(&tumble(t + h))
            .map(|d| d / (2.0 * h));
        assert!(worst(&v, &clip.sample(t).velocity) < 2e-4);
    }
}

/// Section 3.2 of the paper.
#[test]
fn outside_its_time_a_clip_stands_still() {
    let clip = clip(60.0, 1.0);
    let before = clip.sample(-0.1);
    let after = clip.sample(clip.duration() + 5.0);
    assert_eq!(before.posture, *clip.posture(0));
    assert_eq!(after.posture, *clip.posture(60));
    assert_eq!(clip.sample(f64::NAN).posture, *clip.posture(0));
    for target in [before, after, clip.sample(f64::INFINITY)] {
        assert_eq!(target.velocity, [0.0; NV]);
        assert_eq!(target.acceleration, [0.0; NV]);
    }
}

#[test]
fn loops_are_smooth_and_carry_the_displacement() {
    let clip = clip(60.0, 1.5);
    let period = clip.duration();
    for i in -300..600 {
        let t = 0.010_07 * f64::from(i);
        // The third derivative jumps exactly at a seam, and a difference across it would see that.
        if i != 0 {
            check_derivatives(|t| clip.sample_looped(t), t);
        }
    }
    for seam in [-period, 0.0, period, 2.0 * period] {
        let (a, b) = (
            clip.sample_looped(seam - 1e-9),
            clip.sample_looped(seam + 1e-9),
        );
        assert!(worst(&a.posture.difference(&b.posture), &[0.0; NV]) < 1e-7);
        assert!(worst(&a.velocity, &b.velocity) < 1e-6);
        assert!(worst(&a.acceleration, &b.acceleration) < 1e-4);
    }
    // One round later the figure is displaced by that of one round, the same at every phase.
    let advance = clip.seam.as_ref().unwrap().advance;
    for i in 0..50 {
        let t = 0.03 * f64::from(i);
        let mut one = clip.sample_looped(t);
        advance.apply_to(&mut one);
        let two = clip.sample_looped(t + period);
        assert!(worst(&one.posture.difference(&two.posture), &[0.0; NV]) < 1e-9);
        assert!(worst(&one.velocity, &two.velocity) < 1e-7);
    }
    let far = clip.sample_looped(1e9);
    assert!(far.posture.is_finite());
    assert!(clip.sample_looped(f64::NAN).posture.is_finite());
}

#[test]
fn powers_of_a_planar_transform_are_repeated_application() {
    for yaw in [0.0, 1e-12, 1e-5, 0.3, -2.0, 3.1, std::f64::consts::TAU] {
        let step = PlanarTransform {
            x: 0.7,
            y: -0.2,
            yaw,
        };
        let mut sum = PlanarTransform::default();
        let p = Vec3 {
            x: 0.3,
            y: 1.0,
            z: 2.0,
        };
        for n in 0..40 {
            let (a, b) = (sum.point(p), step.power(f64::from(n)).point(p));
            assert!((a - b).norm() < 1e-9, "{yaw} {n}");
            let back = step.power(-f64::from(n)).point(a);
            assert!((back - p).norm() < 1e-8, "{yaw} {n}");
            sum = step.after(sum);
        }
    }
}

#[test]
fn short_clips_have_sensible_rates() {
    for n in 1..6 {
        let make = |i: usize| Posture {
            root_position: Vec3 {
                x: 0.1 * i as f64,
                y: 0.0,
                z: 1.0,
            },
            ..Posture::default()
        };
        let clip =
            Clip::from_postures("line", 10.0, (0..n).map(make).collect(), vec![[true; 2]; n])
                .unwrap();
        let target = clip.sample(0.05);
        assert!((target.velocity[3] - if n > 1 { 1.0 } else { 0.0 }).abs() < 1e-9);
        assert!(target.acceleration[3].abs() < 1e-9);
        let looped = clip.sample_looped(7.3);
        assert!((looped.posture.root_position.x - if n > 1 { 7.3 } else { 0.0 }).abs() < 1e-9);
    }
}

#[test]
fn bad_samples_are_refused_by_name() {
    let make = |edit: &dyn Fn(&mut Vec<Posture>), rate: f64, planted: usize| {
        let mut postures = vec![Posture::default(); 3];
        edit(&mut postures);
        Clip::from_postures("x", rate, postures, vec![[true; 2]; planted]).map(|c| c.len())
    };
    assert_eq!(make(&|_| {}, 60.0, 3), Ok(3));
    assert_eq!(make(&|p| p.clear(), 60.0, 0), Err(ClipError::Empty));
    assert!(matches!(
        make(&|_| {}, 60.0, 2),
        Err(ClipError::PlantedCount { .. })
    ));
    for rate in [0.5, 1000.5, f64::NAN, f64::INFINITY, -60.0] {
        assert!(matches!(
            make(&|_| {}, rate, 3),
            Err(ClipError::Rate { .. })
        ));
    }
    let text = |edit: &dyn Fn(&mut Vec<Posture>)| make(edit, 60.0, 3).unwrap_err().to_string();
    assert!(text(&|p| p[1].root_position.y = f64::NAN).contains("sample 1: root position"));
    assert!(text(&|p| p[2].root_position.y = 1e9).contains("sample 2"));
    assert!(text(&|p| p[1].ball[3].w = f64::INFINITY).contains("l_shoulder"));
    assert!(text(&|p| p[1].ball[3].x = 0.1).contains("length 1.00"));
    assert!(text(&|p| p[0].root_rotation = Quat::from_xyzw([0.0; 4])).contains("root"));
    assert!(text(&|p| p[0].hinge[11] = f64::NAN).contains("r_toe"));
    let many = vec![Posture::default(); MAX_SAMPLES + 1];
    let planted = vec![[true; 2]; MAX_SAMPLES + 1];
    assert!(matches!(
        Clip::from_postures("x", 60.0, many, planted),
        Err(ClipError::TooLong { .. })
    ));
}
