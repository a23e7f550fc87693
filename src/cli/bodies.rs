//! `sinew bodies`: degrees of freedom, limits and strength of a body.

use super::args::{BodyArgs, sex_name};
use crate::sim::body::topology::{DOF_NAMES, SEGMENT_NAMES};
use crate::sim::body::{Body, DOF_COUNT};
use crate::sim::figure::StrengthScale;
use crate::sim::strength::Strength;
use anyhow::{Context, Result};
use serde_json::json;

/// Lists the segments and degrees of freedom of a body.
#[derive(Clone, Debug, clap::Args)]
pub struct BodiesArgs {
    /// Who the body stands for.
    #[command(flatten)]
    pub body: BodyArgs,
    /// Shows where every number of the strength comes from.
    #[arg(long)]
    pub sources: bool,
    /// Prints JSON.
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
///
/// # Errors
/// When the tables do not cover the profile.
pub fn run(args: &BodiesArgs) -> Result<()> {
    let body = args.body.build()?;
    let strength = Strength::for_body(&body);
    if args.json {
        let text = serde_json::to_string_pretty(&as_json(&body, &strength));
        println!("{}", text.context("the body cannot be written as JSON")?);
    } else {
        print!("{}", as_text(&body, &strength, args.sources));
    }
    Ok(())
}

/// Available torque of every DOF at rest in the zero pose, N·m.
fn at_rest(strength: &Strength) -> ([f64; DOF_COUNT], [f64; DOF_COUNT]) {
    let zero = [0.0; DOF_COUNT];
    let (mut lower, mut upper) = (zero, zero);
    strength.range(
        &zero,
        &zero,
        &StrengthScale::default(),
        &mut lower,
        &mut upper,
    );
    (lower, upper)
}

fn as_text(body: &Body, strength: &Strength, sources: bool) -> String {
    let p = body.profile;
    let mut out = format!(
        "{}, {} years, {:.2} m, {:.1} kg\n\n",
        sex_name(p.sex),
        p.age,
        p.height,
        p.mass
    );
    out += "segment         mass kg\n";
    for (name, s) in SEGMENT_NAMES.iter().zip(&body.segments) {
        out += &format!("{name:<15} {:>7.3}\n", s.mass);
    }
    out += "\nDOF                    limits deg         torque at rest, arms hanging, N·m\n";
    let (lower, upper) = at_rest(strength);
    for d in 0..DOF_COUNT {
        out += &format!(
            "{:<21} {:>7.1} … {:>6.1}   {:>8.1} … {:>6.1}\n",
            DOF_NAMES[d],
            body.lower[d].to_degrees(),
            body.upper[d].to_degrees(),
            lower[d],
            upper[d]
        );
        if sources {
            for s in strength.provenance(d) {
                let note = if s.note.is_empty() {
                    String::new()
                } else {
                    format!("; {}", s.note)
                };
                out += &format!(
                    "    {}: {} {:.4} {} ({}{note})\n",
                    s.action, s.quantity, s.value, s.unit, s.source
                );
            }
        }
    }
    out
}

fn as_json(body: &Body, strength: &Strength) -> serde_json::Value {
    let p = body.profile;
    let (lower, upper) = at_rest(strength);
    let dofs: Vec<_> = (0..DOF_COUNT)
        .map(|d| {
            let sources: Vec<_> = strength
                .provenance(d)
                .iter()
                .map(|s| {
                    json!({
                        "action": s.action, "quantity": s.quantity, "value": s.value, "unit": s.unit,
                        "source": s.source, "note": s.note,
                    })
                })
                .collect();
            json!({
                "name": DOF_NAMES[d],
                "lower_deg": body.lower[d].to_degrees(),
                "upper_deg": body.upper[d].to_degrees(),
                "torque_min_at_rest_nm": lower[d],
                "torque_max_at_rest_nm": upper[d],
                "armature_kgm2": body.armature[d],
                "sources": sources,
            })
        })
        .collect();
    let segments: Vec<_> = SEGMENT_NAMES
        .iter()
        .zip(&body.segments)
        .map(|(name, s)| json!({ "name": name, "mass_kg": s.mass, "com_m": s.com.to_array() }))
        .collect();
    json!({
        "sex": sex_name(p.sex), "age_years": p.age, "height_m": p.height, "mass_kg": p.mass,
        "segments": segments, "dofs": dofs,
    })
}
