//! `rows.md`: results that the paper shows or promises beyond its equations, each with figures and strips.

mod second_hand;

use crate::number::or_dash;
use crate::page::Page;
use anyhow::Result;
use sinew_evaluate::experiments::ControlPair;
use sinew_evaluate::experiments::again::{Did, MARGIN, QUANTILE, again};
use sinew_evaluate::experiments::person::{
    BENDS, FOLDS, HELPS, LOADS, LiftTrial, TRACKED, candidates, search, trial,
};
use sinew_evaluate::experiments::touching::{Prop, ReachObstacle, hand_support, reach};
use sinew_evaluate::strip::View;
use sinew_physics::body::{Body, Profile, Sex};
use sinew_physics::motion::builtin::builtin;
use sinew_physics::motion::read;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::RetargetOptions;
use sinew_physics::support::sharing::{ALONG_REST, LEAST_WEIGHT};
use std::sync::Arc;

/// Panels of a strip.
const PANELS: usize = 7;
/// Number of candidates of the search to list.
const LISTED: usize = 6;

/// A motion with a flight, synthesised so that the truth is known: no built-in motion leaves the floor.
const JUMP: &str = "jump";
static JUMPING: &[u8] = include_bytes!("../../../tests/corpus/jump.vrm.bvh");

/// Writes the page.
pub fn write(mut page: Page, body: &Arc<Body>) -> Result<()> {
    page.say("# What the paper shows beyond its equations");
    page.say("`sinew paper --rows` wrote this page; nothing on it is edited by hand.");
    hands(&mut page, body)?;
    stages(&mut page, body)?;
    lifting(&mut page)?;
    strength(&mut page)?;
    second_hand::write(&mut page)?;
    page.finish_as("rows.md")
}

fn hands(page: &mut Page, body: &Arc<Body>) -> Result<()> {
    page.say("## A hand as a support");
    page.say(&format!(
        "Figure 3 of the paper: the figure leans further than its feet can balance, and a hand on a table, on a desk \
         with a slope of 20° or on a wall stops the rotation about the foot's edge. Equation (2) takes the normal of \
         each surface. Forces are means over the last of four seconds. *Ratio*: that of the hand, its mean over the \
         half of the time with the centre of mass far from the hand's side and over the other half. By (2) a hand \
         that is higher than the centre of mass, as on this wall, carries nothing: its ratio is 0. Statics says \
         otherwise. The paper's controller then gives it the least weight that a support has in the sharing (S2), {} \
         % in place of its ratio, and {} % of that for forces along the wall. The smallest forces in that norm which \
         have the total wrench of the reaction are what it counts on, and that wrench needs the hand. The modern \
         controller does not use (2): a wall's reaction of the last ticks is a given force to it, and against a table \
         it pushes as its convex problem finds.",
        100.0 * LEAST_WEIGHT,
        100.0 * ALONG_REST,
    ));
    let mut rows = Vec::new();
    let mut strips = Vec::new();
    for pair in [
        ControlPair::paper_torque(),
        ControlPair::modern(),
        ControlPair::motors(),
    ] {
        for (prop, name) in [
            (Prop::None, "nothing"),
            (Prop::Table, "table"),
            (Prop::Desk, "desk"),
            (Prop::Wall, "wall"),
        ] {
            let s = hand_support(body, &pair, prop, 1.0, PANELS);
            let [(far, low), (near, high)] = s.ratio;
            let other = s.rest - s.force.z;
            rows.push(vec![
                name.into(),
                pair.name.into(),
                s.record.result(),
                format!("{:.0}", s.pressed),
                format!("{:.0}", if other.abs() < 0.5 { 0.0 } else { other }),
                if far < near && prop != Prop::None {
                    format!("{low:.3} at {far:.3} m, {high:.3} at {near:.3} m")
                } else {
                    "–".into()
                },
            ]);
            if pair.name == "paper, torque" && prop != Prop::None {
                strips.push((
                    format!("rows-hand-{name}"),
                    s.record,
                    format!("a hand on a {name}, {}", pair.name),
                ));
            }
        }
    }
    page.table(
        &[
            "surface",
            "controller, stepper",
            "result",
            "normal force of the hand, N",
            "vertical force on other parts, N",
            "ratio of the hand, centre of mass",
        ],
        &rows,
    );
    page.strips(body, &strips)
}

fn stages(page: &mut Page, body: &Arc<Body>) -> Result<()> {
    page.say("## Collisions in two stages");
    page.say(
        "Section 3 of the paper, as `--stepper staged`: a linear system over both bodies changes the velocities, \
         then inverse kinematics of least change corrects angles until nothing overlaps, and the reaction counts in \
         the inverse dynamics of the next tick. Contacts have no friction there. An arm is raised against a wall, or \
         against somebody, that is 6 cm nearer than the hand reaches. With *kinematic* torques take over before \
         something is met, and the convex solver of the torque stepper meets it.",
    );
    let mut rows = Vec::new();
    let mut strips = Vec::new();
    for pair in [
        ControlPair::paper_staged(),
        ControlPair::paper_kinematic(),
        ControlPair::paper_torque(),
        ControlPair::modern(),
    ] {
        for (against, name) in [
            (ReachObstacle::Wall, "wall"),
            (ReachObstacle::Other, "figure"),
        ] {
            for arm in [1.0, 0.15] {
                let r = reach(body, &pair, against, arm, PANELS);
                rows.push(vec![
                    name.into(),
                    format!("×{arm}"),
                    pair.name.into(),
                    r.record.result(),
                    or_dash(r.met.map(|m| 100.0 * m.1), 0),
                    format!("{:.0}", r.force.1),
                    format!("{:.1}", 1e3 * r.overlap),
                    format!("{:.1e}", r.unequal),
                    format!("{:.0}", 100.0 * r.handed_over),
                ]);
                if pair.name == "paper, staged" {
                    let weak = if arm < 1.0 { "-weak" } else { "" };
                    strips.push((
                        format!("rows-staged-{name}{weak}"),
                        r.record,
                        format!("an arm against a {name}, staged{}", weak.replace('-', ", ")),
                    ));
                }
            }
        }
    }
    page.table(
        &[
            "against",
            "strength of the arm",
            "controller, stepper",
            "result",
            "touches after the first touch, % of the time",
            "largest force in a tick, N",
            "largest overlap, mm",
            "relative difference of the two forces",
            "moved by torques, % of the ticks",
        ],
        &rows,
    );
    page.say(
        "With its own strength the arm stays in contact. With 15 % of it, there is no torque to press it on, and it \
         parts.",
    );
    page.strips(body, &strips)
}

fn lifting(page: &mut Page) -> Result<()> {
    page.say("## The lift by a named person");
    page.say(&format!(
        "A search over {} people and postures: both sexes, 11 ages from 7 to 80 years, five percentiles of strength \
         from 5 to 95, four ends of the lift (share of the semi-squat that is kept, reach of the hand on the \
         reference body). Strength is that of the tables. Run are those whose arm needs 0.9 to 1.8 times its \
         strength to hold 3 kg still, and less than 0.95 times to hold 1 kg; who does not show one of the first two \
         things is not given heavier loads. What the paper shows: 1 kg is tracked (error below {TRACKED}° rms); with \
         3 kg knees, hips and back help (at least {HELPS}° each) and it stands; 4 or 5 kg bends the back by at least \
         {BENDS}° before balance is lost; what falls folds (hips, knees and back together bent by at least \
         {FOLDS}°).",
        candidates().count()
    ));
    let pair = ControlPair::paper_kinematic();
    let found = search(&pair);
    let rows: Vec<Vec<String>> = found.iter().take(LISTED).map(listed).collect();
    page.say(&format!("{} were run; the best:", found.len()));
    page.table(
        &[
            "person",
            "percentile",
            "semi-squat kept, reach",
            "arm strength needed for 1, 3, 4, 5 kg",
            "1 kg tracked",
            "3 kg helped",
            "4 or 5 kg bends, then falls",
            "falls folded",
        ],
        &rows,
    );
    let Some(best) = found.first() else {
        page.say("Nobody was worth a run.");
        return Ok(());
    };
    let Some(best) = trial(&best.candidate, &pair, PANELS) else {
        return Ok(());
    };
    let c = &best.candidate;
    page.say(&format!(
        "### {}, percentile {}",
        c.profile.name(),
        c.percentile
    ));
    let rows: Vec<Vec<String>> = (best.results.iter())
        .map(|r| {
            vec![
                format!("{} kg", r.mass),
                r.record.result(),
                format!("{:.2}", r.rms),
                format!("{:.1}, {:.1}, {:.1}", r.helps[0], r.helps[1], r.helps[2]),
                format!("{:.1}", r.bends),
                format!("{:.1}", r.jerk),
                r.fell_s
                    .map_or_else(|| "–".into(), |_| format!("{:.0}", r.folds)),
            ]
        })
        .collect();
    page.table(
        &[
            "load",
            "result",
            "joint error, rms °",
            "knees, hips, back deviate, °",
            "back bends forward, °",
            "largest jerk, 1000 rad/s³, rms of the joints",
            "hips, knees and back at the fall, °",
        ],
        &rows,
    );
    let body = Body::humanoid(c.profile).map_err(|e| anyhow::anyhow!("{e}"))?;
    for r in &best.results {
        let name = format!("rows-lift-{}kg", r.mass);
        let title = format!("{} kg, {}, paper, kinematic", r.mass, c.profile.name());
        page.strip(&name, &body, &r.record, View::Side, &title)?;
    }
    Ok(())
}

fn listed(t: &LiftTrial) -> Vec<String> {
    let c = &t.candidate;
    let need: Vec<String> = t
        .need
        .iter()
        .map(|n| format!("{:.0} %", 100.0 * n))
        .collect();
    debug_assert_eq!(need.len(), LOADS.len());
    let mut row = vec![
        c.profile.name(),
        format!("{}", c.percentile),
        format!("{:.0} %, {:.2} m", 100.0 * c.end.squat, c.end.reach),
        need.join(", "),
    ];
    row.extend(t.shows().map(|s| if s { "yes" } else { "no" }.to_owned()));
    row
}

fn strength(page: &mut Page) -> Result<()> {
    page.say("## Strength from motion");
    page.say(&format!(
        "The future work of the paper, as `sinew strength`: inverse dynamics of prepared motion (low-passed at 6 \
         Hz), with the forces of the floor, torques as means over 0.1 s; of each direction of each DOF the {} \
         quantile of torque over strength counts, and muscles that needed more than their curves say get {MARGIN} \
         times that. Below, people of the 5th percentile do motions with loads in the right hand, by the tables and \
         by what the motion needs, with the default controller. The jump is `tests/corpus/jump.vrm.bvh`, fitted to \
         each of them.",
        QUANTILE
    ));
    let mut rows = Vec::new();
    let mut strips = Vec::new();
    for (sex, age) in [(Sex::Female, 75.0), (Sex::Male, 75.0), (Sex::Female, 10.0)] {
        let profile = Profile::ordinary(sex, age);
        let body = Arc::new(Body::humanoid(profile).map_err(|e| anyhow::anyhow!("{e}"))?);
        let motions = [
            ("walk", 0.0),
            ("squat", 0.0),
            ("squat", 3.0),
            ("lift", 5.0),
            (JUMP, 0.0),
        ];
        for (name, mass) in motions {
            let clip = if name == JUMP {
                prepare_recording(&read(JUMPING)?, &body, &RetargetOptions::default())?.clip
            } else {
                builtin(&body, name).expect("built-in motions exist")
            };
            let clip = Arc::new(clip);
            let a = again(&body, 5.0, &Did { clip, mass }, PANELS);
            let of = |k: usize| format!("{}, {:.2}°", a.runs[k].result(), a.runs[k].rms_deg());
            rows.push(vec![
                profile.name(),
                if mass > 0.0 {
                    format!("{name}, {mass} kg")
                } else {
                    name.into()
                },
                format!("{} {:.0} %", a.hardest.0, 100.0 * a.hardest.1),
                format!("{}, up to ×{:.2}", a.raised.0, a.raised.1),
                of(0),
                of(1),
            ]);
            let drawn = match (name, sex) {
                ("lift", Sex::Female) if age > 70.0 => "lift, 5 kg",
                (JUMP, Sex::Male) => JUMP,
                _ => continue,
            };
            for (run, by) in a.runs.into_iter().zip(["tables", "motion"]) {
                let file = format!("rows-again-{name}-{by}");
                strips.push((body.clone(), file, run, format!("{drawn}, by the {by}")));
            }
        }
    }
    page.table(
        &[
            "person",
            "motion",
            "hardest DOF",
            "DOFs scaled up",
            "by the tables: result, joint error",
            "by the motion: result, joint error",
        ],
        &rows,
    );
    for (body, name, run, title) in strips {
        page.strip(&name, &body, &run, View::Side, &title)?;
    }
    Ok(())
}
