//! `sinew bodies`: the named bodies, or degrees of freedom, limits and strength of one.

use super::args::{BodyArgs, describe};
use super::exit::within;
use super::terminal::print;
use anyhow::{Context, Result};
use serde_json::json;
use sinew_physics::body::names::{NAMED_BODIES, sex_name};
use sinew_physics::body::topology::{DOF_NAMES, SEGMENT_NAMES};
use sinew_physics::body::{Body, DOF_COUNT, Profile};
use sinew_physics::strength::{MuscleScale, Provenance, Strength};

/// Lists the named bodies; with any option that chooses a body, its segments and degrees of freedom.
#[derive(Clone, Debug, clap::Args)]
pub struct BodiesArgs {
    /// Which body is shown.
    #[command(flatten)]
    pub body: BodyArgs,
    /// Percentile of strength in the population of that sex, age and size, 5 to 95 [default: 50].
    #[arg(long, value_name = "P")]
    pub percentile: Option<f64>,
    /// Shows the source of every mass, limit and strength value.
    #[arg(long)]
    pub sources: bool,
    /// Prints JSON on standard output.
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
///
/// # Errors
/// When the tables do not cover the profile.
pub fn run(args: &BodiesArgs) -> Result<()> {
    if args.body.is_default() && args.percentile.is_none() && !args.sources {
        return if args.json {
            print_json(&list_json())
        } else {
            print(&list())
        };
    }
    let body = args.body.build()?;
    let percentile = args.percentile.unwrap_or(50.0);
    within("--percentile", percentile, [5.0, 95.0])?;
    let strength = Strength::at_percentile(&body, percentile);
    if args.json {
        print_json(&as_json(&body, &strength))
    } else {
        print(&as_text(&body, &strength, args.sources))
    }
}

fn print_json(value: &serde_json::Value) -> Result<()> {
    let text = serde_json::to_string_pretty(value).context("the body cannot be written as JSON")?;
    print(&(text + "\n"))
}

fn named() -> impl Iterator<Item = (&'static str, Profile)> {
    let profile = |(name, sex, age): &(&'static str, _, _)| (*name, Profile::ordinary(*sex, *age));
    NAMED_BODIES.iter().map(profile)
}

fn list() -> String {
    let mut out = format!(
        "{:<12} {:>6} {:>9} {:>9} {:>7}\n",
        "name", "sex", "age years", "stature m", "mass kg"
    );
    for (name, p) in named() {
        out += &format!(
            "{name:<12} {:>6} {:>9} {:>9.2} {:>7}\n",
            sex_name(p.sex),
            p.age,
            p.height,
            p.mass
        );
    }
    out + "\nAny other body is named by its profile, SEX-AGEy-HEIGHTmm-MASSg, for example female-25y-1680mm-61500g.\n\
           `sinew bodies --body NAME` shows segments, joint limits and strength.\n"
}

fn profile_json(name: &str, p: &Profile) -> serde_json::Value {
    json!({
        "name": name, "sex": sex_name(p.sex), "age_years": p.age, "height_m": p.height, "mass_kg": p.mass,
    })
}

fn list_json() -> serde_json::Value {
    let all: Vec<_> = named().map(|(name, p)| profile_json(name, &p)).collect();
    json!({ "bodies": all })
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
    let mut out = format!("{}: {}\n\n", p.name(), describe(&p));
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
    out += "\nDOF                    limits deg         available torque at rest, arms down, N·m\n";
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
    let mut out = profile_json(&p.name(), &p);
    out["segments"] = segments.into();
    out["dofs"] = dofs.into();
    out
}
