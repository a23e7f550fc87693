//! `sinew bodies`: degrees of freedom, limits and strength of a body.

use super::args::{BodyArgs, person_name, sex_name};
use crate::sim::body::topology::{DOF_NAMES, SEGMENT_NAMES};
use crate::sim::body::{Body, DOF_COUNT};
use crate::sim::strength::{MuscleScale, Provenance, Strength};
use anyhow::{Context, Result, ensure};
use serde_json::json;

/// Lists the segments and degrees of freedom of a body.
#[derive(Clone, Debug, clap::Args)]
pub struct BodiesArgs {
    /// Who the body stands for.
    #[command(flatten)]
    pub body: BodyArgs,
    /// Percentile of strength among people of that sex, age and size, 5 to 95.
    #[arg(long, value_name = "P", default_value_t = 50.0)]
    pub percentile: f64,
    /// Shows where every mass, limit and number of the strength comes from.
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
    ensure!(
        (5.0..=95.0).contains(&args.percentile),
        "--percentile {}: outside 5…95",
        args.percentile
    );
    let strength = Strength::at_percentile(&body, args.percentile);
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
        &MuscleScale::default(),
        &mut lower,
        &mut upper,
    );
    (lower, upper)
}

fn as_text(body: &Body, strength: &Strength, sources: bool) -> String {
    let p = body.profile;
    let mut out = format!(
        "{}, {} years, {:.2} m, {:.1} kg\n\n",
        person_name(&p),
        p.age,
        p.height,
        p.mass
    );
    out += "segment         mass kg\n";
    for (i, (name, s)) in SEGMENT_NAMES.iter().zip(&body.segments).enumerate() {
        out += &format!("{name:<15} {:>7.3}\n", s.mass);
        if sources {
            for p in body.segment_provenance(i) {
                out += &format!(
                    "    {} {:.4} {} [{}] ({}; {})\n",
                    p.quantity, p.value, p.unit, p.tag, p.source, p.note
                );
            }
        }
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
            for s in body
                .limit_provenance(d)
                .iter()
                .chain(strength.provenance(d))
            {
                let note = if s.note.is_empty() {
                    String::new()
                } else {
                    format!("; {}", s.note)
                };
                out += &format!(
                    "    {}: {} {:.4} {} [{}] ({}{note})\n",
                    s.action, s.quantity, s.value, s.unit, s.tag, s.source
                );
            }
        }
    }
    out
}

fn source_json(p: &Provenance) -> serde_json::Value {
    json!({
        "action": p.action, "quantity": p.quantity, "value": p.value, "unit": p.unit,
        "source": p.source, "tag": p.tag, "note": p.note,
    })
}

fn as_json(body: &Body, strength: &Strength) -> serde_json::Value {
    let p = body.profile;
    let (lower, upper) = at_rest(strength);
    let dofs: Vec<_> = (0..DOF_COUNT)
        .map(|d| {
            let limits = body.limit_provenance(d);
            let all = limits.iter().chain(strength.provenance(d));
            let sources: Vec<_> = all.map(source_json).collect();
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
        .enumerate()
        .map(|(i, (name, s))| {
            let sources = body.segment_provenance(i);
            let sources: Vec<_> = sources.iter().map(source_json).collect();
            json!({ "name": name, "mass_kg": s.mass, "com_m": s.com.to_array(), "sources": sources })
        })
        .collect();
    json!({
        "sex": sex_name(p.sex), "age_years": p.age, "height_m": p.height, "mass_kg": p.mass,
        "segments": segments, "dofs": dofs,
    })
}
