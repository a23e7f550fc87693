//! The truth of a motion, as JSON. The schema is described in tests/corpus/README.md.

use super::actor::{ANGLES, MASS_SHARE, SEGMENTS};
use super::dialect::Dialect;
use super::plan::Motion;
use super::tracks::DEG;
use std::fmt::Write;

/// Samples per second of the curves in the truth.
pub const RATE: f64 = 30.0;

/// A file of a motion.
pub struct File {
    pub name: String,
    pub dialect: Dialect,
    pub frames: usize,
}

fn number(x: f64, decimals: usize) -> String {
    let mut s = format!("{x:.decimals$}");
    if s.contains('.') {
        s.truncate(s.trim_end_matches('0').trim_end_matches('.').len());
    }
    if s == "-0" { "0".to_owned() } else { s }
}

fn list(values: &[f64], decimals: usize) -> String {
    let parts: Vec<String> = values.iter().map(|x| number(*x, decimals)).collect();
    format!("[{}]", parts.join(","))
}

/// Contact of one foot in the recording's time: side, from, until, x, y, yaw.
pub fn footholds(motion: &Motion) -> Vec<(usize, f64, f64, [f64; 3])> {
    let (start, end) = motion.script.window;
    let mut out = Vec::new();
    for side in 0..2 {
        for s in &motion.script.feet[side].stances {
            let (from, until) = (s.from.max(start), s.until.min(end));
            if until > from {
                out.push((side, from - start, until - start, [s.x, s.y, s.yaw]));
            }
        }
    }
    out.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    out
}

/// Times without a foot on the floor, with the height of the centre of mass at its highest; motions on the floor have
/// none.
pub fn flights(motion: &Motion) -> Vec<(f64, f64, f64)> {
    if motion.script.kind == "floor" {
        return Vec::new();
    }
    let mut stances: Vec<(f64, f64)> = footholds(motion).iter().map(|f| (f.1, f.2)).collect();
    stances.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut out = Vec::new();
    let mut covered = 0.0f64;
    let centre = |t: f64| motion.script.actor.centre(&motion.recorded(t)).z;
    let mut add = |from: f64, until: f64| {
        if until - from > 1e-6 {
            let apex = (0..=20)
                .map(|k| centre(from + (until - from) * f64::from(k) / 20.0))
                .fold(0.0, f64::max);
            out.push((from, until, apex));
        }
    };
    for (from, until) in stances {
        if from > covered {
            add(covered, from);
        }
        covered = covered.max(until);
    }
    if motion.duration() > covered {
        add(covered, motion.duration());
    }
    out
}

/// The truth of a motion and the files that hold it.
pub fn write(motion: &Motion, files: &[File]) -> Vec<u8> {
    let script = &motion.script;
    let mut o = String::new();
    let _ = writeln!(o, "{{");
    let _ = writeln!(o, " \"schema\": 1,");
    let _ = writeln!(o, " \"motion\": \"{}\",", script.name);
    let _ = writeln!(o, " \"kind\": \"{}\",", script.kind);
    let _ = writeln!(o, " \"about\": \"{}\",", script.about);
    let _ = writeln!(o, " \"duration_s\": {},", number(motion.duration(), 6));
    let lengths: Vec<String> = script
        .actor
        .lengths()
        .iter()
        .map(|(n, v)| format!("\"{n}\": {}", number(*v, 5)))
        .collect();
    let shares: Vec<String> = SEGMENTS
        .iter()
        .zip(MASS_SHARE)
        .map(|(n, v)| format!("\"{n}\": {}", number(v, 5)))
        .collect();
    let _ = writeln!(o, " \"actor\": {{");
    let _ = writeln!(o, "  \"name\": \"{}\",", script.actor.name);
    let _ = writeln!(o, "  \"lengths_m\": {{{}}},", lengths.join(", "));
    let _ = writeln!(o, "  \"mass_shares\": {{{}}}", shares.join(", "));
    let _ = writeln!(o, " }},");
    let files: Vec<String> = files
        .iter()
        .map(|f| {
            let d = &f.dialect;
            let f0 = &d.faults;
            format!(
                "  {{\"file\": \"{}\", \"dialect\": \"{}\", \"unit_m\": {}, \"up\": \"{}\", \
                 \"facing_deg\": {}, \"rate_hz\": {}, \"frames\": {}, \
                 \"first_frame\": {}, \"root_positions\": {}, \"noise_m\": {}, \
                 \"noise_deg\": {}, \"skate_m_per_s\": {}, \"floor_m\": {}}}",
                f.name,
                d.name,
                number(d.unit, 9),
                if d.z_up { "z" } else { "y" },
                number(d.facing, 3),
                number(d.rate, 3),
                f.frames,
                d.held,
                d.root.chars().any(char::is_uppercase),
                number(f0.noise.0, 5),
                number(f0.noise.1 / DEG, 3),
                number(f0.skate, 3),
                number(f0.floor, 4)
            )
        })
        .collect();
    let _ = writeln!(o, " \"files\": [\n{}\n ],", files.join(",\n"));
    let holds = footholds(motion);
    let mut contacts: Vec<String> = holds
        .iter()
        .map(|(side, from, until, _)| {
            format!(
                "  {{\"part\": \"{}\", \"from\": {}, \"until\": {}}}",
                ["l_foot", "r_foot"][*side],
                number(*from, 4),
                number(*until, 4)
            )
        })
        .collect();
    contacts.extend(script.touches.iter().map(|t| {
        format!(
            "  {{\"part\": \"{}\", \"from\": {}, \"until\": {}}}",
            t.part,
            number(t.from, 4),
            number(t.until, 4)
        )
    }));
    let _ = writeln!(o, " \"contacts\": [\n{}\n ],", contacts.join(",\n"));
    let holds: Vec<String> = holds
        .iter()
        .map(|(side, from, until, [x, y, yaw])| {
            format!(
                "  {{\"side\": \"{}\", \"from\": {}, \"until\": {}, \"x\": {}, \"y\": {}, \"yaw_deg\": {}}}",
                ["left", "right"][*side],
                number(*from, 4),
                number(*until, 4),
                number(*x, 5),
                number(*y, 5),
                number(*yaw / DEG, 3)
            )
        })
        .collect();
    let _ = writeln!(o, " \"footholds\": [\n{}\n ],", holds.join(",\n"));
    let flights: Vec<String> = flights(motion)
        .iter()
        .map(|(from, until, apex)| {
            format!(
                "{{\"from\": {}, \"until\": {}, \"apex_m\": {}}}",
                number(*from, 4),
                number(*until, 4),
                number(*apex, 4)
            )
        })
        .collect();
    let _ = writeln!(o, " \"flights\": [{}],", flights.join(", "));
    let _ = writeln!(o, " \"rate_hz\": {RATE},");
    let count = (motion.duration() * RATE + 1e-9).floor() as usize + 1;
    let (mut com, mut pelvis, mut angles) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..count {
        let pose = motion.recorded(i as f64 / RATE);
        com.push(list(&script.actor.centre(&pose).to_array(), 4));
        let (p, q) = (pose.place[0], pose.turn[0]);
        let flip = if q.w < 0.0 { -1.0 } else { 1.0 };
        pelvis.push(list(
            &[
                p.x,
                p.y,
                p.z,
                q.x * flip,
                q.y * flip,
                q.z * flip,
                q.w * flip,
            ],
            4,
        ));
        angles.push(list(&pose.angles.map(|a| a / DEG), 1));
    }
    let _ = writeln!(o, " \"com_m\": [{}],", com.join(","));
    let _ = writeln!(o, " \"pelvis\": [{}],", pelvis.join(","));
    let names: Vec<String> = ANGLES.iter().map(|n| format!("\"{n}\"")).collect();
    let _ = writeln!(o, " \"angle_names\": [{}],", names.join(", "));
    let _ = writeln!(o, " \"angles_deg\": [{}]", angles.join(","));
    let _ = writeln!(o, "}}");
    o.into_bytes()
}
