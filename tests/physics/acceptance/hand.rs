//! Goal: a figure that leans with a hand on a table, on a sloping desk or against a wall stands by means of it: part of
//! its weight goes through the arm, within friction and strength; without it the figure falls, and an arm that is too
//! weak gives way. Two figures that run into each other push equally. Method: statics of floor and hand; sums of the
//! forces on both.

use crate::common::man;
use sinew_evaluate::experiments::ControlPair;
use sinew_evaluate::experiments::touching::{
    ArmReach, HandSupport, Prop, ReachObstacle, bump, hand_support, reach,
};

fn pairs() -> [ControlPair; 3] {
    [
        ControlPair::modern(),
        ControlPair::paper_torque(),
        ControlPair::motors(),
    ]
}

fn say(what: &str, s: &HandSupport) -> String {
    let text = format!(
        "{what}: {}; hand {:.0} {:.0} {:.0} N, {:.0} N into the face, floor {:.0} + {:.0} of {:.0} N, touching {:.2}, \
         cone {:.4}",
        s.record.result(),
        s.force.x,
        s.force.y,
        s.force.z,
        s.pressed,
        s.floor,
        s.rest,
        s.weight,
        s.touching,
        s.cone
    );
    println!("{text}");
    text
}

#[test]
fn a_hand_carries_part_of_the_weight_within_friction_and_strength() {
    let body = man();
    for pair in pairs() {
        let name = pair.name;
        let alone = hand_support(&body, &pair, Prop::None, 1.0, 0);
        let text = say(&format!("{name}, nothing"), &alone);
        assert!(alone.record.fell_s.is_some(), "{text}");
        for prop in [Prop::Table, Prop::Desk, Prop::Wall] {
            let s = hand_support(&body, &pair, prop, 1.0, 0);
            let text = say(&format!("{name}, {prop:?}"), &s);
            assert!(s.record.fell_s.is_none(), "{text}");
            assert!(s.touching > 0.6 && s.pressed > 0.04 * s.weight, "{text}");
            assert!(
                (s.floor + s.rest - s.weight).abs() < 0.03 * s.weight,
                "{text}"
            );
            // It leans only on the hand.
            assert!((s.rest - s.force.z).abs() < 5.0, "{text}");
            // A part that lies over an edge has more than one normal in a tick: its mean force may use 1 % more.
            assert!(s.cone < 1.02 && s.record.over_limit < 1e-9, "{text}");
        }
    }
}

#[test]
fn an_arm_that_is_too_weak_lets_go() {
    let body = man();
    for pair in pairs() {
        for prop in [Prop::Table, Prop::Wall] {
            let strong = hand_support(&body, &pair, prop, 1.0, 0);
            let weak = hand_support(&body, &pair, prop, 0.03, 0);
            let text = say(&format!("{}, {prop:?}, weak arm", pair.name), &weak);
            // It lets go, or it lies on the table with a hand under it that carries almost nothing.
            let lies = weak.rest > 2.0 * strong.rest && weak.pressed < 0.1 * weak.rest;
            assert!(weak.pressed < 0.2 * strong.pressed || lies, "{text}");
            assert!(weak.record.over_limit < 1e-9, "{text}");
        }
    }
}

/// Figure 3 and equation (2) of the paper.
#[test]
fn the_ratio_of_the_hand_rises_towards_its_side() {
    let body = man();
    for prop in [Prop::Table, Prop::Desk] {
        let s = hand_support(&body, &ControlPair::paper_torque(), prop, 1.0, 0);
        let [(far, low), (near, high)] = s.ratio;
        let text = say(&format!("{prop:?}, {low} at {far}, {high} at {near}"), &s);
        assert!(near > far && high > low && low > 0.01, "{text}");
    }
}

/// Section 3 of the paper.
#[test]
fn an_arm_stays_where_it_touches_while_it_has_torque_and_parts_when_not() {
    let body = man();
    for against in [ReachObstacle::Wall, ReachObstacle::Other] {
        let [strong, weak] =
            [1.0, 0.15].map(|arm| reach(&body, &ControlPair::paper_staged(), against, arm, 0));
        for (r, what) in [(&strong, "strong"), (&weak, "weak")] {
            println!(
                "{against:?}, {what}: {}, met {:?}, {:.1?} N, overlap {:.1} mm, torques {:.2}",
                r.record.result(),
                r.met,
                r.force,
                1e3 * r.overlap,
                r.handed_over
            );
            assert!(r.overlap < 0.006 && r.unequal < 1e-9 && r.over_limit < 1e-9);
        }
        let touching = |r: &ArmReach| r.met.map_or(0.0, |m| m.1);
        assert_eq!(strong.record.fell_s, None);
        assert_eq!(strong.handed_over, 0.0, "accelerations move it throughout");
        assert!(touching(&strong) > 0.9 && touching(&weak) < 0.3);
    }
}

#[test]
fn figures_that_run_into_each_other_push_equally() {
    let body = man();
    for (pair, impulse) in pairs().iter().zip([80.0, 40.0, 40.0]) {
        let b = bump(&body, pair, impulse, 0);
        let text = format!(
            "{}: {}, at most {:.0} N at {:.2} s, {:.1} N·s, unequal by {:.1e}, overlap {:.1} mm",
            pair.name,
            b.record.result(),
            b.most.0,
            b.most.1,
            b.impulse,
            b.unequal,
            1e3 * b.overlap
        );
        println!("{text}");
        assert!(b.impulse > 10.0 && b.unequal < 1e-9, "{text}");
        assert!(b.overlap < 0.006, "{text}");
    }
}
