use super::*;
use crate::math::Quat;
use crate::plan::pelvis_shift::GroundWrench;

const RATE: f64 = 120.0;

#[test]
fn what_gravity_takes_in_flight_a_stance_gives() {
    // Flights of 16 samples around stances of 24; the first and the last stance are cut off.
    let air: Vec<bool> = (0..120).map(|i| i % 40 >= 24).collect();
    let push = pushes(&air, RATE);
    for (i, j, flies) in runs(&air) {
        let whole = i > 0 && j < air.len();
        assert!((i..j).all(|k| push[k].is_some() == (whole && !flies)));
        if whole && !flies {
            let gained: f64 = (i..j).map(|k| push[k].unwrap() / RATE).sum();
            let lost = GRAVITY * 16.0 / RATE;
            assert!((gained - lost).abs() < 1e-9, "{gained} {lost}");
            // The floor does not pull; the last push is a weak one.
            assert!((i..j).all(|k| push[k].unwrap() > -GRAVITY));
            assert!(push[j - 1].unwrap() < 0.5 * push[i + 8].unwrap());
        }
    }
}

#[test]
fn the_mass_of_a_runner_falls_freely_in_flight() {
    let n = 120;
    let air: Vec<bool> = (0..n).map(|i| (50..66).contains(&i)).collect();
    // A recording whose mass only dips and rises, smoothly, with half of gravity in flight.
    let com: Vec<Vec3> = (0..n)
        .map(|i| Vec3::Z * (0.95 + 0.02 * (i as f64 / 40.0 * std::f64::consts::TAU).sin()))
        .collect();
    let mut flights = FlightPhases {
        push: vec![None; n],
        plain: vec![0.0; n],
        air: air.clone(),
        rate_hz: RATE,
    };
    let track = MassTrack {
        zmp: vec![[0.0; 2]; n],
        omega2: vec![10.0; n],
        load: vec![1.0; n],
        wrench: vec![
            GroundWrench {
                force: Vec3::zero(),
                moment: Vec3::zero(),
            };
            n
        ],
        com,
    };
    flights.observe(&track, &vec![0.0; n]);
    let height = flights.heights(&vec![1.0; n]);
    let z = |i: usize| track.com[i].z + height[i] / balance::PELVIS_LEAD;
    for i in 51..65 {
        let a = (z(i - 1) - 2.0 * z(i) + z(i + 1)) * RATE * RATE;
        assert!((a + GRAVITY).abs() < 0.2, "{i}: {a}");
    }
    // The mean height does not change.
    let mean = height.iter().sum::<f64>() / n as f64;
    assert!(mean.abs() < 1e-3, "{mean}");
    // A leg that does not reach still holds the pelvis down.
    let mut most = vec![1.0; n];
    most[30] = -0.03;
    assert!(flights.heights(&most)[30] < -0.029);
}

#[test]
fn a_foot_rolls_over_its_toes_to_where_its_ankle_is() {
    let body = Body::adult_man();
    let sole = Sole::new(&body, 0);
    let at = FootPlacement {
        place: Vec3::zero(),
        yaw: 0.3,
        pitch: -0.8,
        tip: 0.0,
    };
    let tip_of = |at: &FootPlacement| {
        let pose = sole.stand_on_tip(at);
        let toes = pose.rotation * Quat::exp(Vec3::Y * -pose.toe);
        pose.ankle + pose.rotation.rotate(sole.toe_joint) + toes.rotate(sole.toe_tip())
    };
    // The tip stays where it is, and everything else comes off the floor.
    let rolled = FootPlacement { tip: 0.4, ..at };
    assert!((tip_of(&rolled) - tip_of(&at)).norm() < 1e-12);
    let low = |at: &FootPlacement| {
        let pose = sole.stand_on_tip(at);
        pose.ankle.z + sole.lowest(pose.rotation, pose.toe)
    };
    assert!(low(&rolled).abs() < 1e-3, "{}", low(&rolled));
    let (flat, up) = (sole.stand_on_tip(&at), sole.stand_on_tip(&rolled));
    assert!(up.ankle.z > flat.ankle.z + 0.02);
    // Both angles are found again from the ankle alone, and a foot that is already in place stays.
    let (heel, tip) = roll(&sole, &at, up.ankle);
    let found = sole.stand_on_tip(&FootPlacement {
        pitch: at.pitch - heel,
        tip,
        ..at
    });
    assert!((found.ankle - up.ankle).norm() < 0.02, "{heel} {tip}");
    assert_eq!(roll(&sole, &at, flat.ankle), (0.0, 0.0));
}
