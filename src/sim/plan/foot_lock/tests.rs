use super::stances::StancePieces;
use super::*;
use crate::plan::params::stance;

fn sole() -> Sole {
    Sole {
        side: 0,
        foot: vec![
            Vec3::from_array([-0.05, 0.04, -0.08]),
            Vec3::from_array([-0.05, -0.04, -0.08]),
            Vec3::from_array([0.13, 0.04, -0.08]),
            Vec3::from_array([0.13, -0.04, -0.08]),
        ],
        toes: vec![
            Vec3::from_array([0.0, 0.04, -0.02]),
            Vec3::from_array([0.07, -0.04, -0.02]),
        ],
        toe_joint: Vec3::from_array([0.13, 0.0, -0.06]),
        heel: Vec3::from_array([-0.05, 0.0, -0.08]),
        ankle_height: 0.08,
        toe_range: (-0.5, 1.0),
    }
}

#[test]
fn standing_turns_about_heel_or_toe_joint_and_is_continuous() {
    let s = sole();
    let anchor = Vec3::from_array([0.3, -0.2, 0.0]);
    let place = |pitch: f64, p: Vec3| {
        let f = s.stand(anchor, 0.4, pitch);
        f.ankle + f.rotation.rotate(p)
    };
    for pitch in [0.05, 0.2, 0.4] {
        assert!((place(pitch, s.heel) - place(0.0, s.heel)).norm() < 1e-12);
    }
    for pitch in [-0.05, -0.3, -0.7] {
        let d = place(pitch, s.toe_joint) - place(0.0, s.toe_joint);
        assert!(d.norm() < 1e-12, "{pitch}: {d:?}");
    }
    for pitch in [-0.8f64, -0.3, 0.0, 0.3] {
        let f = s.stand(anchor, 0.4, pitch);
        assert!((f.ankle.z + s.lowest(f.rotation, f.toe)).abs() < 1e-12);
    }
    let gap = s.stand(anchor, 0.4, 1e-9).ankle - s.stand(anchor, 0.4, -1e-9).ankle;
    assert!(gap.norm() < 1e-8);
}

#[test]
fn a_shuffled_step_is_locked_without_sliding_or_scraping() {
    let s = sole();
    let n = 360;
    let ankles: Vec<Vec3> = (0..n)
        .map(|i| {
            let t = f64::from(i) / 120.0;
            let u = ((t - 1.0) / 0.5).clamp(0.0, 1.0);
            let b = u * u * (3.0 - 2.0 * u);
            Vec3::from_array([
                0.5 * b + 0.01 * (3.0 * t).sin(),
                0.1,
                0.075 + 0.1 * b * (1.0 - b),
            ])
        })
        .collect();
    let rotations = vec![Quat::identity(); n as usize];
    let label: Vec<bool> = (0..n).map(|i| !(122..178).contains(&i)).collect();
    let (stances, f) = locked(&ankles, &rotations, &label, &vec![true; n as usize]);
    assert_eq!(stances.len(), 2);
    for k in 1..n as usize {
        let step = (f.poses[k].ankle - f.poses[k - 1].ankle).norm();
        if f.planted[k] && f.planted[k - 1] {
            assert!(step < 1e-12);
        }
        assert!(step < 0.03, "no jump at {k}: {step}");
        let low = f.poses[k].ankle.z + s.lowest(f.poses[k].rotation, f.poses[k].toe);
        assert!(low > -1e-3, "{low} at {k}");
    }
}

/// A foot that stays where it is, to the right of one that walks along x.
fn beside(n: usize) -> (Vec<Vec3>, Vec<Quat>) {
    let place = Vec3::from_array([0.0, -0.1, 0.08]);
    (vec![place; n], vec![Quat::identity(); n])
}

/// Locks a left foot at 120 samples a second. The right one stays where it is and is on the floor where `other` says
/// so.
fn locked(
    place: &[Vec3],
    turned: &[Quat],
    label: &[bool],
    other: &[bool],
) -> (Vec<Stance>, LockedFoot) {
    let still = vec![0.0; place.len()];
    let (right, ahead) = beside(place.len());
    let [stands, other] = stances(
        &[sole(), sole()],
        [
            RecordedFoot {
                ankles: place,
                rotations: turned,
            },
            RecordedFoot {
                ankles: &right,
                rotations: &ahead,
            },
        ],
        [label, other],
        120.0,
    );
    let f = lock_foot(
        &sole(),
        RecordedFoot {
            ankles: place,
            rotations: turned,
        },
        &stands,
        &other,
        &StanceTurns::none(still.len()),
        0,
        120.0,
    );
    (stands, f)
}

/// Both feet turn on the floor about the point between them, by `angle` rad from sample 120 on, in 96 samples.
fn spun(angle: f64, n: usize) -> [(Vec<Vec3>, Vec<Quat>); 2] {
    [0.1, -0.1].map(|y| {
        let turn = |i: usize| {
            let u = ((i as f64 - 120.0) / 96.0).clamp(0.0, 1.0);
            Quat::exp(Vec3::Z * (angle * u * u * (3.0 - 2.0 * u)))
        };
        let at = |i| turn(i).rotate(Vec3::from_array([0.0, y, 0.08]));
        ((0..n).map(at).collect(), (0..n).map(turn).collect())
    })
}

#[test]
fn feet_that_turn_together_step_in_turn_and_one_of_them_always_stands() {
    let (n, soles, label) = (340, [sole(), sole()], vec![true; 340]);
    for angle in [1.5, -2.5, 4.0] {
        let [l, r] = spun(angle, n);
        let steps = stances(
            &soles,
            [&l, &r].map(|f| RecordedFoot {
                ankles: &f.0,
                rotations: &f.1,
            }),
            [&label, &label],
            120.0,
        );
        let stands = |steps: &[StancePieces; 2], k: usize| {
            steps.iter().flatten().any(|&(i, j)| (i..j).contains(&k))
        };
        let tracks: [FootTrack; 2] = [
            FootTrack::new(&soles[0], &l.0, &l.1),
            FootTrack::new(&soles[1], &r.0, &r.1),
        ];
        // If each relies on the other's label, both leave the body unsupported.
        let alone: [StancePieces; 2] =
            std::array::from_fn(|s| tracks[s].pieces(&label, &label, 120.0));
        assert!((0..n).any(|k| !stands(&alone, k)), "{angle}: {alone:?}");
        let pieces: [StancePieces; 2] = steps.map(|s| s.iter().map(|s| (s.start, s.end)).collect());
        assert!((0..n).all(|k| stands(&pieces, k)), "{angle}: {pieces:?}");
        // A planted foot does not turn.
        for (s, (place, turned)) in [l, r].into_iter().enumerate() {
            assert!(pieces[s].len() > 1);
            let of: Vec<Stance> = pieces[s]
                .iter()
                .map(|&(start, end)| Stance { start, end })
                .collect();
            let others: Vec<Stance> = pieces[1 - s]
                .iter()
                .map(|&(start, end)| Stance { start, end })
                .collect();
            let still = vec![0.0; n];
            let f = lock_foot(
                &soles[s],
                RecordedFoot {
                    ankles: &place,
                    rotations: &turned,
                },
                &of,
                &others,
                &StanceTurns::none(still.len()),
                s,
                120.0,
            );
            for p in &of {
                let yaw = |k: usize| f.placements[k].yaw;
                assert!((p.start..p.end).all(|k| yaw(k) == yaw(p.start)));
            }
        }
    }
}

#[test]
fn a_foot_without_any_stance_stays_as_it_was_recorded() {
    let n = 240;
    // It shuffles along just above the floor, where a swing would be raised.
    let ankles: Vec<Vec3> = (0..n)
        .map(|i| Vec3::from_array([0.002 * f64::from(i), 0.1, 0.081]))
        .collect();
    let rotations: Vec<Quat> = (0..n)
        .map(|i| Quat::exp(Vec3::Z * (0.001 * f64::from(i))))
        .collect();
    let n = n as usize;
    let (stances, f) = locked(&ankles, &rotations, &vec![false; n], &vec![false; n]);
    assert!(stances.is_empty() && f.planted.iter().all(|on| !on));
    for (k, pose) in f.poses.iter().enumerate() {
        assert_eq!((pose.ankle, pose.rotation), (ankles[k], rotations[k]));
    }
    // The same foot is raised if the recording has a stance of the other one: it swings then.
    let (_, f) = locked(&ankles, &rotations, &vec![false; n], &vec![true; n]);
    assert!(f.poses[n / 2].ankle.z > ankles[n / 2].z + 0.005);
}

#[test]
fn a_step_of_which_the_label_saw_only_the_middle_takes_the_time_that_it_needs() {
    let (n, first, last) = (360, 172, 188);
    // A quarter of a metre in 0.36 s, close to the floor; the label covers 0.13 s of it.
    let place: Vec<Vec3> = (0..n)
        .map(|i| {
            let u = ((f64::from(i) - 158.4) / 43.2).clamp(0.0, 1.0);
            let s = u * u * (3.0 - 2.0 * u);
            Vec3::from_array([0.25 * s, 0.1, 0.08])
        })
        .collect();
    let n = n as usize;
    let label: Vec<bool> = (0..n).map(|i| !(first..last).contains(&i)).collect();
    let swing = |other: &[bool]| {
        let (stances, _) = locked(&place, &vec![Quat::identity(); n], &label, other);
        assert_eq!(stances.len(), 2);
        (stances[0].end, stances[1].start)
    };
    let needed = ((0.25f64 / stance::SWING_ACCELERATION).sqrt() * 120.0).ceil() as usize;
    assert!(needed > last - first);
    let (end, start) = swing(&vec![true; n]);
    assert!(end < first && start > last && start - end == needed);
    // The other foot is not planted before: all the time is taken from after, at most half of it.
    let after: Vec<bool> = (0..n).map(|i| i >= last).collect();
    assert_eq!(swing(&after), (first, first + needed));
    let little: Vec<bool> = (0..n).map(|i| (last..last + 4).contains(&i)).collect();
    assert_eq!(swing(&little), (first, last + 2));
    // The other foot is never planted: this one stays as it is.
    assert_eq!(swing(&vec![false; n]), (first, last));
}

#[test]
fn a_foot_that_begins_to_turn_away_no_longer_stands() {
    let n = 240;
    let turned: Vec<Quat> = (0..n)
        .map(|i| Quat::exp(Vec3::Z * (0.05 * (f64::from(i) - 150.0).max(0.0))))
        .collect();
    let n = n as usize;
    let place = vec![Vec3::from_array([0.0, 0.1, 0.08]); n];
    let label: Vec<bool> = (0..n).map(|i| i < 160).collect();
    let end = |other: bool| {
        let (stances, _) = locked(&place, &turned, &label, &vec![other; n]);
        assert_eq!(stances.len(), 1);
        stances[0].end
    };
    // 0.05 rad a sample: it strays from the fourth sample on, if the other foot holds the body.
    assert_eq!(end(true), 154);
    assert_eq!(end(false), 160);
}

#[test]
fn stances_too_short_to_split_that_slide_are_kept_or_cut_but_never_lost() {
    for (end, held) in [(3, 0), (5, 2), (12, 6), (30, 10), (60, 40)] {
        let n = end + 20;
        // A metre per second from the first sample on; the other foot is down at the start, or at the end.
        let ankles: Vec<Vec3> = (0..n)
            .map(|i| Vec3::from_array([0.1 * i as f64, 0.1, 0.08]))
            .collect();
        let label: Vec<bool> = (0..n).map(|i| i < end).collect();
        for early in [false, true] {
            let other: Vec<bool> = (0..n).map(|i| (i < held) == early).collect();
            let (stances, f) = locked(&ankles, &vec![Quat::identity(); n], &label, &other);
            assert!(!stances.is_empty());
            assert!(stances.iter().all(|s| s.start < s.end && s.end <= end));
            assert!(f.planted.iter().zip(&label).all(|(p, l)| *l || !*p));
        }
    }
}
