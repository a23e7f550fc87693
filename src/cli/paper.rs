//! `sinew paper`: repeats every experiment of the paper and writes a page with tables, plots and motion strips.

mod rows;

use super::args::short_name;
use super::compare;
use super::number::or_dash;
use super::page::{Page, progress};
use super::source::load;
use anyhow::Result;
use sinew_evaluate::experiments::compare::ComparedMotion;
use sinew_evaluate::experiments::fall::{
    DIRECTIONS, Fall, LOW, fall, fall_on_toes, leaning, pendulum, pendulum_about_the_balls,
};
use sinew_evaluate::experiments::lift::{Lift, lift, scene, weak_arm};
use sinew_evaluate::experiments::push::{Push, push, recovered};
use sinew_evaluate::experiments::statics::{HeldPosture, hold};
use sinew_evaluate::experiments::touching::{FRICTION, HandSupport, Prop, bump, hand_support};
use sinew_evaluate::experiments::{ControlPair, PlottedTick};
use sinew_evaluate::plot::Plot;
use sinew_evaluate::strip::View;
use sinew_physics::body::topology::DOF_NAMES;
use sinew_physics::body::{Body, Profile, Sex};
use sinew_physics::motion::builtin::{at_ease, builtin};
use sinew_physics::reference::RetargetOptions;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// Panels of a strip.
const PANELS: usize = 7;
/// Loads of the lift, kg: 1, 3 and 4 in the text of the paper, 1, 3 and 5 in the caption of its figure.
const LOADS: [f64; 4] = [1.0, 3.0, 4.0, 5.0];
/// Experiments, for the progress bar.
const STEPS: u64 = 10;
/// Built-in motions with which the controllers are compared, and those during which they are pushed.
const COMPARED: [&str; 5] = ["idle", "wave", "lift", "crate", "squat"];
const PUSHED: [&str; 2] = ["idle", "wave"];

/// Repeats the experiments of the paper and writes a page with the results.
#[derive(Clone, Debug, clap::Args)]
pub struct PaperArgs {
    /// Folder for the page (README.md), its plots and strips; files of the same names are replaced.
    #[arg(long, value_name = "FOLDER", default_value = "docs/paper")]
    pub out: PathBuf,
    /// Standing recordings (BVH) on which the controllers are compared: writes only that page (recorded.md). A
    /// recording called sit-stand is given a stool to sit on.
    #[arg(long, value_name = "FILES", num_args = 1..)]
    pub recordings: Vec<String>,
    /// Writes only the page of what the paper shows beyond its equations (rows.md).
    #[arg(long, conflicts_with = "recordings")]
    pub rows: bool,
}

/// Runs the command.
///
/// # Errors
/// Recordings that cannot be read, files that cannot be written.
pub fn run(args: &PaperArgs) -> Result<()> {
    let mut page = Page::new(&args.out)?;
    if !args.recordings.is_empty() {
        return recorded(args, page);
    }
    let body = Arc::new(Body::adult_man());
    if args.rows {
        return rows::write(page, &body);
    }
    let bar = progress("paper", STEPS);
    introduction(&mut page);
    let parts: [(&str, fn(&mut Page, &Arc<Body>) -> Result<()>); STEPS as usize] = [
        ("lifts", lifts),
        ("people", people),
        ("falls", falls),
        ("pushes", pushes),
        ("hand support", hands),
        ("collision", bumps),
        ("step size", step_size),
        ("equations as published", as_printed),
        ("comparison", comparison),
        ("time", time),
    ];
    for (name, part) in parts {
        bar.set_message(name);
        part(&mut page, &body)?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    page.finish()?;
    rows::write(Page::new(&args.out)?, &body)
}

/// The comparison on recordings: a separate page, because the recordings are not part of the repository.
fn recorded(args: &PaperArgs, mut page: Page) -> Result<()> {
    let body = Arc::new(Body::adult_man());
    let mut motions = Vec::new();
    for spec in &args.recordings {
        let source = load(spec, &body, &RetargetOptions::default())?;
        motions.push(ComparedMotion::new(&source.name, Arc::new(source.clip)));
    }
    let names: Vec<String> = motions.iter().map(|m| m.name.clone()).collect();
    let pushed: Vec<&str> = names
        .iter()
        .map(String::as_str)
        .filter(|n| PUSHED.contains(n))
        .collect();
    page.say("# Controllers compared on recordings");
    page.say(&format!(
        "The comparison of [the main page](README.md#the-controllers-compared) on recorded motion, written by `sinew \
         paper --recordings` with {}. The recordings are fitted to the same body without adjustments per clip. \
         `sit-stand` is given a stool of 0.34 × 0.34 × 0.35 m and ends when the person starts to walk away. Recordings \
         end in mid-motion: the errors include the abrupt stop and one second in the last posture.",
        names.join(", ")
    ));
    compare::section(&mut page, &body, &motions, &pushed);
    page.finish_as("recorded.md")
}

fn comparison(page: &mut Page, body: &Arc<Body>) -> Result<()> {
    page.say("## The controllers compared");
    page.say(
        "Every applicable pair of controller and stepper on the built-in motions that keep both feet in place. The \
         same comparison on recorded motion is in [recorded.md](recorded.md). *Modern, kinematic* is not included: the \
         kinematic stepper ignores the contact forces that the modern controller computes.",
    );
    let motions: Vec<ComparedMotion> = COMPARED
        .iter()
        .map(|name| {
            let clip = builtin(body, name).expect("built-in motions exist");
            ComparedMotion::new(name, Arc::new(clip))
        })
        .collect();
    compare::section(page, body, &motions, &PUSHED);
    Ok(())
}

fn introduction(page: &mut Page) {
    page.say("# The experiments of the paper, repeated");
    page.say(
        "The experiments of *Motion Tracking with Dynamic Simulation* (Oshita & Makinouchi, 2000), repeated with this \
         build. `sinew paper` wrote this page; nothing on it is edited by hand. [equations.md](../equations.md) lists \
         where each equation is implemented. The body is `adult-man` (30 years, 1.75 m, 75 kg) unless stated \
         otherwise.",
    );
    page.say(concat!(
        "- **paper, kinematic**: the paper's controller with the paper's stepper: accelerations are integrated \
         directly, and the support foot stays, tips about the minimum-moment point, or is in flight. When joints \
         saturate on a tipping support, torques take over.\n",
        "- **paper, torque**: the same controller with full rigid-body dynamics and contact.\n",
        "- **modern, torque**: one convex optimisation per tick; the default of Sinew.\n",
        "- **motors alone**: strength-limited joint motors that hold the posture, without balance control.\n",
        "- **paper2000**: the equations as published, 30 ticks per second, without the safeguards of Sinew."
    ));
    page.say(
        "In the motion strips a ring marks a joint at its torque limit (red) or near it (amber). The pale figure is \
         the target motion, arrows are contact forces, and the cross on the floor is the zero-moment point.",
    );
}

fn column(samples: &[PlottedTick], of: impl Fn(&PlottedTick) -> f64) -> Vec<[f64; 2]> {
    samples.iter().map(|s| [s.time_s, of(s)]).collect()
}

fn dof(name: &str) -> usize {
    DOF_NAMES
        .iter()
        .position(|n| *n == name)
        .expect("the DOF exists")
}

fn torque_plot(title: &str, samples: &[PlottedTick], dof: usize) -> Plot {
    let limits = samples.iter().map(|s| {
        let [_, low, high] = s.torque[dof];
        [s.time_s, low, high]
    });
    Plot {
        title: title.to_owned(),
        x: "time, s".into(),
        y: "torque, N·m".into(),
        ..Plot::default()
    }
    .band("available", limits)
    .curve("used", column(samples, |s| s.torque[dof][0]))
}

fn balance_plot(title: &str, samples: &[PlottedTick]) -> Plot {
    let polygon = samples.iter().filter_map(|s| {
        let [a, b, _, _] = s.polygon?;
        Some([s.time_s, a, b])
    });
    Plot {
        title: title.to_owned(),
        x: "time, s".into(),
        y: "forward, m".into(),
        range: Some([-0.25, 0.35]),
        ..Plot::default()
    }
    .band("support polygon", polygon)
    .curve("centre of mass", column(samples, |s| s.com.x))
    .curve(
        "zero-moment point",
        column(samples, |s| s.zmp.map_or(f64::NAN, |z| z.x)),
    )
    .dashed(
        "desired centre of mass",
        column(samples, |s| s.com_desired.x),
    )
}

/// Heads of the columns of [`lift_row`].
const LIFT_COLUMNS: [&str; 9] = [
    "load",
    "controller, stepper",
    "result",
    "joint error, rms °",
    "arm at torque limit, s",
    "error of hip, knee, ankle, back, °",
    "ZMP margin, cm",
    "torque change per tick / range",
    "fastest joint, rad/s",
];

fn lift_row(pair: &ControlPair, l: &Lift) -> Vec<String> {
    vec![
        format!("{} kg", l.mass),
        pair.name.into(),
        l.record.result(),
        format!("{:.2}", l.record.rms_deg()),
        format!("{:.2}", l.arm_saturated_s),
        format!("{:.1}", l.helpers_deg),
        or_dash(l.margin.map(|m| 100.0 * m), 1),
        format!("{:.4}", l.record.chatter()),
        format!("{:.1}", l.record.top_speed()),
    ]
}

fn lifts(page: &mut Page, body: &Arc<Body>) -> Result<()> {
    let clip = builtin(body, "lift").expect("there is a lift");
    let arm = weak_arm(body, &clip, 3.0);
    page.say("## Lifting with a weak arm");
    page.say(&format!(
        "From a semi-squat, the right hand grasps an object and raises it to shoulder height. The right arm has {:.0} \
         % of measured strength: 98 % of the strength needed to hold 3 kg in the most demanding posture of the motion. \
         The text of the paper lifts 1, 3 and 4 kg, the caption of its figure 1, 3 and 5 kg; all four are shown. \
         Result in the paper: 1 kg is lifted as desired; at 3 kg the shoulder reaches its torque limit, and back and \
         legs assist; the heaviest load bends the back, and the figure falls.",
        100.0 * arm
    ));
    let pairs = [
        ControlPair::paper_kinematic(),
        ControlPair::paper_torque(),
        ControlPair::modern(),
    ];
    let mut rows = Vec::new();
    let mut runs = Vec::new();
    for pair in &pairs {
        for mass in LOADS {
            let l = lift(body, pair, mass, arm, PANELS);
            rows.push(lift_row(pair, &l));
            runs.push((pair.clone(), l));
        }
    }
    page.table(&LIFT_COLUMNS, &rows);
    let shoulder = dof("r_shoulder_flexion");
    for (pair, l) in &runs {
        let paper = pair.name == "paper, kinematic";
        let modern = pair.name == "modern, torque" && l.mass == 5.0;
        if !paper && !modern {
            continue;
        }
        let name = format!(
            "lift-{}-{}kg",
            if paper { "paper" } else { "modern" },
            l.mass
        );
        page.say(&format!("### {} kg, {}", l.mass, pair.name));
        page.strip(
            &name,
            body,
            &l.record,
            View::Side,
            &format!("{} kg, {}", l.mass, pair.name),
        )?;
        let samples = &l.record.samples;
        let title = format!("right shoulder flexion, {} kg, {}", l.mass, pair.name);
        page.plot(
            &format!("{name}-torque"),
            &torque_plot(&title, samples, shoulder),
        )?;
        let title = format!("balance, {} kg, {}", l.mass, pair.name);
        page.plot(&format!("{name}-balance"), &balance_plot(&title, samples))?;
    }
    let mut plot = Plot {
        title: "joint error while lifting, paper's controller, kinematic".into(),
        x: "time, s".into(),
        y: "rms over DOFs, °".into(),
        ..Plot::default()
    };
    for (pair, l) in &runs {
        if pair.name == "paper, kinematic" {
            plot = plot.curve(
                &format!("{} kg", l.mass),
                column(&l.record.samples, |s| s.error.to_degrees()),
            );
        }
    }
    page.plot("lift-error", &plot)
}

/// Several bodies that lift the same loads.
fn crowd() -> Vec<Arc<Body>> {
    let person = |sex, age| {
        let profile = Profile::ordinary(sex, age);
        Arc::new(Body::humanoid(profile).expect("ordinary people exist"))
    };
    vec![
        Arc::new(Body::adult_man()),
        person(Sex::Female, 30.0),
        person(Sex::Male, 11.0),
        person(Sex::Male, 75.0),
        person(Sex::Female, 75.0),
    ]
}

fn people(page: &mut Page, _: &Arc<Body>) -> Result<()> {
    page.say("## The same loads with measured strength");
    page.say(
        "Largest load that can be held still in one hand, computed from measured strength without simulation, and the \
         lift with the default controller: largest fraction of the available right shoulder torque, and the result.",
    );
    let masses = [1.0, 3.0, 5.0, 8.0];
    let mut rows = Vec::new();
    for body in crowd() {
        let p = &body.profile;
        let (straight, most) = hold(&body, HeldPosture::StraightArm);
        let (_, curl) = hold(&body, HeldPosture::Curl);
        let mut row = vec![
            format!(
                "{}, {} y, {:.2} m, {:.0} kg",
                short_name(p),
                p.age,
                p.height,
                p.mass
            ),
            format!("{:.0} %", 100.0 * straight),
            format!("{most:.1} kg"),
            format!("{curl:.1} kg"),
        ];
        for mass in masses {
            let l = lift(&body, &ControlPair::modern(), mass, 1.0, 0);
            let result = l.record.fell_s.map_or("stands", |_| "falls");
            row.push(format!("{:.0} %, {result}", 100.0 * l.shoulder_use));
        }
        rows.push(row);
    }
    page.table(
        &[
            "body",
            "shoulder torque used, straight arm level, no load",
            "largest load, straight arm level",
            "largest load, elbow at 90°",
            "lifts 1 kg",
            "3 kg",
            "5 kg",
            "8 kg",
        ],
        &rows,
    );
    Ok(())
}

fn fall_row(direction: &str, pair: &ControlPair, strength: f64, f: &Fall) -> Vec<String> {
    let off = f.time_s.map(|t| 100.0 * (t / f.pendulum_s - 1.0));
    vec![
        direction.into(),
        pair.name.into(),
        format!("×{strength}"),
        format!("{:.3}", f.pendulum_s),
        or_dash(f.time_s, 3),
        off.map_or_else(|| "–".into(), |o| format!("{o:+.1}")),
        format!("{:+.1} … {:+.1}", 100.0 * f.energy[0], 100.0 * f.energy[1]),
        format!("{:.1}", f.off_course_deg),
        format!("{:.1}", f.bent_deg),
    ]
}

fn falls(page: &mut Page, body: &Arc<Body>) -> Result<()> {
    page.say("## Falling in four directions");
    page.say(&format!(
        "The figure stands, is tilted as a rigid body until its centre of mass is 3° beyond an edge of the support \
         polygon, and is released. A stiff figure is a physical pendulum about that edge. Times are from release until \
         the centre of mass is at a height of {LOW} m."
    ));
    let cases = [
        (ControlPair::paper_kinematic(), 20.0),
        (ControlPair::paper_kinematic(), 1.0),
        (ControlPair::paper_torque(), 1.0),
        (ControlPair::motors(), 20.0),
        (ControlPair::motors(), 1.0),
    ];
    let mut rows = Vec::new();
    for (name, direction) in DIRECTIONS {
        let start = leaning(body, at_ease(body), direction);
        let ideal = pendulum(body, &start);
        let mut plot = Plot {
            title: format!("falling {name}: height of the centre of mass"),
            x: "time, s".into(),
            y: "height, m".into(),
            range: Some([0.0, 1.1]),
            ..Plot::default()
        };
        let mut strips = Vec::new();
        for (pair, strength) in &cases {
            let f = fall(body, pair, direction, *strength, PANELS);
            rows.push(fall_row(name, pair, *strength, &f));
            plot = plot.curve(
                &format!("{} ×{strength}", pair.name),
                column(&f.record.samples, |s| s.com.z),
            );
            strips.push((pair.name, *strength, f));
        }
        plot = plot.dashed("pendulum", ideal);
        page.say(&format!("### {name}"));
        let view = if direction.x == 0.0 {
            View::Front
        } else {
            View::Side
        };
        for (pair, strength, f) in &strips {
            if *strength == 20.0 && pair.starts_with("paper") {
                let title = format!("{name}, {pair}, {strength} times human strength");
                page.strip(&format!("fall-{name}-stiff"), body, &f.record, view, &title)?;
            } else if *strength == 1.0 && pair.ends_with("torque") {
                let title = format!("{name}, {pair}, human strength");
                page.strip(&format!("fall-{name}-human"), body, &f.record, view, &title)?;
            }
        }
        page.plot(&format!("fall-{name}"), &plot)?;
    }
    page.table(
        &[
            "direction",
            "controller, stepper",
            "strength",
            "pendulum, s",
            "figure, s",
            "difference, %",
            "energy change, %",
            "deviation from the direction, °",
            "joint error, °",
        ],
        &rows,
    );
    page.say(
        "One tick is 0.017 s. At human strength, toes and ankles cannot hold a body that leans over its toes or heels: \
         the figure bends and is no longer a pendulum, and its muscles may add energy.",
    );
    toes(page, body);
    Ok(())
}

/// Why the forward fall ends early at human strength.
fn toes(page: &mut Page, body: &Arc<Body>) {
    let (name, forward) = DIRECTIONS[0];
    let start = leaning(body, at_ease(body), forward);
    let tips = pendulum(body, &start).last().map_or(0.0, |p| p[0]);
    let balls = pendulum_about_the_balls(body, &start);
    page.say(&format!("### Why the {name} fall is early"));
    page.say(&format!(
        "The front edge of the support polygon is at the tips of the toes. A fall about this edge requires that the \
         toes carry the whole body. If they yield, the body tips about the balls of the feet, which are further back, \
         and so starts further beyond balance. For a rigid body this takes {balls:.3} s instead of {tips:.3} s. The \
         same fall with stronger toes, everything else at human strength:"
    ));
    let mut rows = Vec::new();
    for factor in [0.5, 1.0, 2.0, 4.0, 8.0] {
        let mut row = vec![format!("×{factor}")];
        for pair in [ControlPair::paper_torque(), ControlPair::motors()] {
            let f = fall_on_toes(body, &pair, forward, [1.0, factor], 0);
            let off = f.time_s.map(|t| 100.0 * (t / tips - 1.0));
            row.push(or_dash(f.time_s, 3));
            row.push(off.map_or_else(|| "–".into(), |o| format!("{o:+.1}")));
            row.push(format!("{:.1}", f.bent_deg));
        }
        rows.push(row);
    }
    page.table(
        &[
            "strength of the toes",
            "paper, torque: s",
            "difference, %",
            "joint error, °",
            "motors alone: s",
            "difference, %",
            "joint error, °",
        ],
        &rows,
    );
}

fn pushes(page: &mut Page, body: &Arc<Body>) -> Result<()> {
    page.say("## Pushes");
    page.say(
        "A push of 0.1 s at the chest of a standing figure that takes no steps. The bound m ω d is the largest impulse \
         that a linear inverted pendulum can absorb. The table gives the largest impulse, in steps of 5 % of the \
         bound, up to which the figure does not fall.",
    );
    let pairs = [
        ControlPair::paper_kinematic(),
        ControlPair::paper_torque(),
        ControlPair::modern(),
    ];
    let mut rows = Vec::new();
    for (name, direction) in DIRECTIONS {
        let results: Vec<Push> = pairs
            .iter()
            .map(|p| recovered(body, p, direction))
            .collect();
        let mut row = vec![name.to_owned(), format!("{:.1}", results[0].bound)];
        for r in &results {
            row.push(format!(
                "{:.1} ({:.0} %)",
                r.impulse,
                100.0 * r.impulse / r.bound
            ));
        }
        rows.push(row);
    }
    page.table(
        &[
            "direction",
            "bound, N·s",
            "paper, kinematic",
            "paper, torque",
            "modern, torque",
        ],
        &rows,
    );
    let bound = recovered(body, &ControlPair::modern(), DIRECTIONS[0].1);
    let share = bound.impulse / bound.bound;
    for (share, what) in [(share, "recovered"), (1.5, "felled")] {
        let p = push(body, &ControlPair::modern(), DIRECTIONS[0].1, share, PANELS);
        let title = format!(
            "{:.0} N·s forward ({:.0} % of the bound), modern",
            p.impulse,
            100.0 * share
        );
        page.strip(&format!("push-{what}"), body, &p.record, View::Side, &title)?;
        let title = format!("balance, {:.0} N·s forward", p.impulse);
        let plot = balance_plot(&title, &p.record.samples);
        page.plot(&format!("push-{what}-balance"), &plot)?;
    }
    Ok(())
}

fn step_size(page: &mut Page, body: &Arc<Body>) -> Result<()> {
    page.say("## Step size");
    page.say("The lift and a fall at 30, 60 and 120 ticks per second.");
    let clip = builtin(body, "lift").expect("there is a lift");
    let arm = weak_arm(body, &clip, 3.0);
    let mut rows = Vec::new();
    for pair in [
        ControlPair::paper_kinematic(),
        ControlPair::paper_torque(),
        ControlPair::modern(),
    ] {
        for rate_hz in [30.0, 60.0, 120.0] {
            let pair = ControlPair {
                rate_hz,
                ..pair.clone()
            };
            let mut row = vec![pair.name.to_owned(), format!("{rate_hz}")];
            for mass in [1.0, 3.0] {
                let l = lift(body, &pair, mass, arm, 0);
                let result = l.record.fell_s.map_or("stands", |_| "falls");
                row.push(format!("{:.2}°, {result}", l.record.rms_deg()));
            }
            let strength = if pair.name == "paper, kinematic" {
                20.0
            } else {
                1.0
            };
            let f = fall(body, &pair, DIRECTIONS[2].1, strength, 0);
            row.push(format!(
                "{} (pendulum {:.3})",
                or_dash(f.time_s, 3),
                f.pendulum_s
            ));
            rows.push(row);
        }
    }
    page.table(
        &[
            "controller, stepper",
            "ticks/s",
            "1 kg: joint error rms",
            "3 kg: joint error rms",
            "fall to the left, s (kinematic: ×20 strength)",
        ],
        &rows,
    );
    page.say(
        "The modern controller keeps the soles flat as long as it can, so the figure is not expected to fall like a \
         pendulum.",
    );
    Ok(())
}

fn hands(page: &mut Page, body: &Arc<Body>) -> Result<()> {
    page.say("## Hand support on a table and a wall");
    page.say(&format!(
        "The figure leans further forward than its feet alone can balance, with the right hand on a table, on a desk \
         with a slope of 20° (8° in the ankles and 9° in the hips), or against a wall (9° in the ankles; coefficient \
         of friction {FRICTION}). It takes no steps. *Ratio*: support ratio (2) of the hand, its mean over the half \
         of the time with the centre of mass far from the hand's side and over the other half. Forces are means over \
         the last of four seconds; friction used is the largest of any tick, relative to the friction cone. *Weak*: \
         3 % of the strength in that arm."
    ));
    let props = [
        (Prop::None, "none"),
        (Prop::Table, "table"),
        (Prop::Desk, "desk"),
        (Prop::Wall, "wall"),
    ];
    let mut rows = Vec::new();
    let mut strips = Vec::new();
    for pair in [
        ControlPair::modern(),
        ControlPair::paper_torque(),
        ControlPair::motors(),
    ] {
        for (prop, name) in props {
            for arm in [1.0, 0.03] {
                if prop == Prop::None && arm < 1.0 {
                    continue;
                }
                let s = hand_support(body, &pair, prop, arm, PANELS);
                rows.push(vec![
                    if arm < 1.0 {
                        format!("{name}, weak")
                    } else {
                        name.into()
                    },
                    pair.name.into(),
                    s.record.result(),
                    format!("{:.0}", s.pressed),
                    format!("{:.0} + {:.0}", s.floor, s.rest),
                    ratio(&s),
                    if s.cone > 0.0 {
                        format!("{:.0} %", 100.0 * s.cone.min(1.0))
                    } else {
                        "–".into()
                    },
                ]);
                let drawn = match prop {
                    Prop::Table | Prop::Wall => pair.name != "motors alone",
                    _ => false,
                };
                if drawn && (arm == 1.0 || pair.name == "modern, torque") {
                    let who = if pair.name == "modern, torque" {
                        "modern"
                    } else {
                        "paper"
                    };
                    let weak = if arm < 1.0 { "-weak" } else { "" };
                    let title = format!("a hand on a {name}, {who}{}", weak.replace('-', ", "));
                    strips.push((format!("hand-{name}-{who}{weak}"), s.record, title));
                }
            }
        }
    }
    page.table(
        &[
            "surface",
            "controller, stepper",
            "result",
            "normal force of the hand, N",
            "floor + other vertical force, N",
            "ratio",
            "friction used",
        ],
        &rows,
    );
    page.strips(body, &strips)
}

/// Support ratio of the hand at both ends of the path of the centre of mass.
fn ratio(s: &HandSupport) -> String {
    let [(from, low), (to, high)] = s.ratio;
    if from >= to {
        "–".into()
    } else {
        format!("{low:.3} … {high:.3}")
    }
}

fn bumps(page: &mut Page, body: &Arc<Body>) -> Result<()> {
    page.say("## Collision of two figures");
    page.say(
        "Two figures face each other at a distance of 0.75 m; the left one is pushed in the back for 0.2 s. The \
         contact forces on both are equal and opposite up to rounding. The largest force is taken before either figure \
         has fallen.",
    );
    let mut rows = Vec::new();
    let mut strips = Vec::new();
    for (pair, impulse, who) in [
        (ControlPair::modern(), 80.0, "modern"),
        (ControlPair::paper_torque(), 40.0, "paper"),
        (ControlPair::motors(), 40.0, "motors"),
    ] {
        let b = bump(body, &pair, impulse, PANELS);
        rows.push(vec![
            pair.name.into(),
            format!("{impulse:.0}"),
            b.record.result(),
            b.other_fell_s
                .map_or_else(|| "stands".into(), |t| format!("falls at {t:.1} s")),
            format!("{:.0} at {:.2} s", b.most.0, b.most.1),
            format!("{:.1e}", b.unequal),
            format!("{:.1}", 1e3 * b.overlap),
        ]);
        strips.push((
            format!("bump-{who}"),
            b.record,
            format!("{impulse:.0} N·s in the back, {who}"),
        ));
    }
    page.table(
        &[
            "controller, stepper",
            "push, N·s",
            "pushed figure",
            "other figure",
            "largest force, N",
            "relative difference of the two forces",
            "penetration, mm",
        ],
        &rows,
    );
    page.strips(body, &strips)
}

fn as_printed(page: &mut Page, body: &Arc<Body>) -> Result<()> {
    page.say("## The equations as published");
    page.say(
        "Preset `paper2000`: dead-beat demand of equation (4), W = I, equations (12) and (2) as published, no support \
         tilt in the torques, no armature, no safeguards. Tracking is exact while strength suffices. Once a joint \
         saturates, the smallest change of acceleration does not relieve a static load: the demand grows from step to \
         step until all joints saturate.",
    );
    let clip = builtin(body, "lift").expect("there is a lift");
    let arm = weak_arm(body, &clip, 3.0);
    let pair = ControlPair::paper2000();
    let mut rows = Vec::new();
    let mut plot = Plot {
        title: "joint error while lifting, equations as published".into(),
        x: "time, s".into(),
        y: "rms over DOFs, °".into(),
        range: Some([0.0, 60.0]),
        ..Plot::default()
    };
    for mass in LOADS {
        let l = lift(body, &pair, mass, arm, PANELS);
        rows.push(lift_row(&pair, &l));
        plot = plot.curve(
            &format!("{mass} kg"),
            column(&l.record.samples, |s| s.error.to_degrees()),
        );
        if mass == 1.0 || mass == 3.0 {
            let title = format!("{mass} kg, equations as published");
            page.strip(
                &format!("printed-{mass}kg"),
                body,
                &l.record,
                View::Side,
                &title,
            )?;
        }
    }
    page.table(&LIFT_COLUMNS, &rows);
    page.plot("printed-error", &plot)
}

fn time(page: &mut Page, body: &Arc<Body>) -> Result<()> {
    page.say("## Computing time per step");
    page.say(
        "The paper reports 10 frames per second for one figure on two Pentium III processors at 600 MHz, with steps of \
         1/30 s. This build: one complete tick of the 3 kg lift on one core of the machine that wrote this page, \
         including motion sampling, dynamics, control, simulation and report.",
    );
    let clip = builtin(body, "lift").expect("there is a lift");
    let arm = weak_arm(body, &clip, 3.0);
    let mut rows = vec![vec!["the paper, 2000".into(), "100 000".into(), "1".into()]];
    for pair in [
        ControlPair::paper2000(),
        ControlPair::paper_kinematic(),
        ControlPair::paper_torque(),
        ControlPair::modern(),
    ] {
        let (mut world, _) = scene(body, &pair, 3.0, arm);
        // The first second warms caches; the paper's preset falls apart later, and that part should not be timed.
        let ticks = (2.4 * pair.rate_hz) as usize;
        let mut us = Vec::with_capacity(ticks);
        for _ in 0..ticks {
            let began = Instant::now();
            world.step();
            us.push(began.elapsed().as_secs_f64() * 1e6);
        }
        us.sort_by(f64::total_cmp);
        let median = us[ticks / 2];
        let mut factor = String::new();
        write!(factor, "{:.0}", 1e5 / median).expect("a string takes any text");
        rows.push(vec![pair.name.to_owned(), format!("{median:.0}"), factor]);
    }
    page.table(
        &[
            "controller, stepper",
            "median time per tick, µs",
            "speed-up",
        ],
        &rows,
    );
    Ok(())
}
