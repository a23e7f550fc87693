//! Row 5: a ladder of loads with one hand, with two, and with the second hand helping as needed.

use crate::page::Page;
use anyhow::Result;
use sinew_evaluate::experiments::ControlPair;
use sinew_evaluate::experiments::second_hand::{LADDER, Rung, rung};
use sinew_evaluate::strip::View;
use sinew_physics::body::{Body, Profile, Sex};
use sinew_physics::figure::SecondHand;
use std::sync::Arc;

/// Panels of a strip.
const PANELS: usize = 8;
/// Loads to draw: for the man, the woman and the child, kg.
const DRAWN: [f64; 3] = [12.0, 8.0, 5.0];

/// Adds the section.
pub fn write(page: &mut Page) -> Result<()> {
    page.say("## The second hand");
    page.say(
        "The lift with the right hand, by people of median strength with the default controller. *One*: the right \
         hand alone. *Two*: the left one reaches for the load in any case (`two_hands: ALWAYS`). *Auto*: \
         it does so while the right arm needs more than its strength to hold the load still where the motion has it, \
         now or in the next 0.6 s (`two_hands: AUTO`, `--load 8@r_hand+auto`). *Need*: what the hardest joint of the \
         arm needs of its strength when the other hand takes hold, alone and with help. The last three columns are \
         means over the last of two seconds of holding.",
    );
    let people = [
        (Sex::Male, 30.0, "man"),
        (Sex::Female, 30.0, "woman"),
        (Sex::Female, 9.0, "child"),
    ];
    let mut rows = Vec::new();
    let mut strips = Vec::new();
    for ((sex, age, who), drawn) in people.into_iter().zip(DRAWN) {
        let profile = Profile::ordinary(sex, age);
        let body = Arc::new(Body::humanoid(profile).map_err(|e| anyhow::anyhow!("{e}"))?);
        for mass in LADDER {
            for (hands, when) in [
                ("one", None),
                ("two", Some(SecondHand::Always)),
                ("auto", Some(SecondHand::Auto)),
            ] {
                let r = rung(&body, &ControlPair::modern(), mass, when, PANELS);
                rows.push(row(&profile.name(), mass, hands, &r));
                if mass == drawn && hands != "two" {
                    let title = format!("{mass} kg, {}, {hands}", profile.name());
                    strips.push((body.clone(), format!("rows-hands-{who}-{hands}"), r, title));
                }
            }
        }
    }
    page.table(
        &[
            "person",
            "load",
            "hands",
            "result",
            "second hand holds from",
            "need alone, with help",
            "joint error, rms °",
            "share of the left hand",
            "hand below the motion, mm",
            "most that a joint of the arms uses",
        ],
        &rows,
    );
    for (body, name, r, title) in strips {
        page.strip(&name, &body, &r.record, View::Front, &title)?;
    }
    Ok(())
}

fn row(who: &str, mass: f64, hands: &str, r: &Rung) -> Vec<String> {
    let percent = |x: f64| format!("{:.0} %", 100.0 * x);
    let dash = || "–".to_owned();
    let stands = r.record.fell_s.is_none();
    let held = |text: String| if stands { text } else { dash() };
    vec![
        who.to_owned(),
        format!("{mass} kg"),
        hands.to_owned(),
        r.record.result(),
        r.shared.map_or_else(dash, |(t, _)| format!("{t:.1} s")),
        r.shared.map_or_else(dash, |(_, [alone, with])| {
            format!("{}, {}", percent(alone), percent(with))
        }),
        format!("{:.2}", r.record.rms_deg()),
        held(percent(r.share)),
        held(format!("{:.0}", 1e3 * r.below)),
        held(percent(r.arm_use)),
    ]
}
