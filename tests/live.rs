//! Goal: streams that come while they are followed are prepared behind a window well enough to be walked, whatever the network and the
//! sender do to them.
//! Method: recordings as a capture system would send them (fitted to the body, nothing else), sample by sample, into a figure in torque
//! simulation; compared with the same recording prepared as a whole.
#![allow(clippy::unwrap_used)]

mod common;

use common::{figure, man, recorded, recorded_with};
use sinew::sim::body::{Body, Posture, State};
use sinew::sim::figure::{ControllerKind, Flags};
use sinew::sim::motion::consistency::{Consistency, consistency};
use sinew::sim::motion::live::{LiveMotion, RATE};
use sinew::sim::motion::{Clip, RetargetOptions, cycle};
use sinew::sim::world::{Drive, LivePlayback, World, WorldParams};
use std::sync::Arc;

/// A recording as it would be streamed.
fn bare(body: &Body, name: &str) -> Arc<Clip> {
    let options = RetargetOptions {
        lock_feet: false,
        balance: false,
        ends: false,
        ..RetargetOptions::default()
    };
    recorded_with(body, name, &options)
}

/// Everything that comes out of a stream, and when its feet stand.
fn prepared(
    body: &Arc<Body>,
    posture: impl Fn(f64) -> Posture,
    seconds: f64,
    window: f64,
) -> (Vec<Posture>, Vec<[bool; 2]>) {
    let mut live = LiveMotion::new(Arc::clone(body), window);
    let n = (seconds * RATE) as usize;
    let (mut out, mut label) = (Vec::new(), Vec::new());
    let mut next = 0;
    for i in 0..n {
        live.push(&posture(i as f64 / RATE), None);
        let t = (i as f64 + 1.0) / RATE - live.window();
        live.advance(t);
        while (next as f64) / RATE <= live.ready() && t >= 0.0 {
            let s = live.sample(next as f64 / RATE);
            out.push(s.posture);
            label.push(s.planted);
            next += 1;
        }
    }
    (out, label)
}

struct Followed {
    fell: Option<f64>,
    joints: f64,
    capture: f64,
    lag: f64,
}

/// Streams `posture` into a figure for `seconds`.
fn follow(
    body: &Arc<Body>,
    posture: impl Fn(f64) -> Posture,
    seconds: f64,
    window: f64,
) -> Followed {
    let mut world = World::new(WorldParams::default()).unwrap();
    let live = LiveMotion::new(Arc::clone(body), window);
    let window = live.window();
    let mut fed = 0;
    let mut playback = LivePlayback {
        motion: live,
        offset: -window,
    };
    // What has come before the figure begins.
    while fed as f64 / RATE <= window {
        playback.motion.push(&posture(fed as f64 / RATE), None);
        fed += 1;
    }
    playback.offset = 0.0;
    playback.motion.advance(1.0 / RATE);
    let first = playback.motion.sample(0.0);
    let key = world
        .add_figure(figure(
            body,
            ControllerKind::Modern,
            State {
                posture: first.posture,
                velocity: first.velocity,
            },
        ))
        .unwrap();
    world
        .figure_mut(key)
        .unwrap()
        .set_drive(Drive::Live(Box::new(playback)));
    let mut out = Followed {
        fell: None,
        joints: 0.0,
        capture: 0.0,
        lag: 0.0,
    };
    let n = (seconds * RATE) as usize;
    let mut count = 0;
    for i in 0..n {
        let f = world.figure_mut(key).unwrap();
        f.stream_mut()
            .unwrap()
            .motion
            .push(&posture(fed as f64 / RATE), None);
        fed += 1;
        world.step();
        let f = world.figure(key).unwrap();
        let r = f.report().unwrap();
        assert!(r.over_limit <= 1e-9 && !r.flags.has(Flags::QUARANTINED));
        if f.is_fallen() {
            out.fell = Some(i as f64 / RATE);
            break;
        }
        count += r.joint_error.len();
        out.joints += r.joint_error.iter().map(|e| e * e).sum::<f64>();
        let e = f.gait().capture().error;
        if std::env::var_os("SHOW").is_some() {
            let t = f.target();
            println!(
                "{:.3} planted {:?} capture {:.3} {:.3} lag {:.3} com {:.3} want {:.3} v {:.2} want {:.2} rms {:.1} landing {:?}",
                i as f64 / 60.0,
                t.next.planted,
                e[0],
                e[1],
                f.gait().lag(),
                r.com.x,
                r.com_desired.x,
                r.com_velocity.x,
                t.now.velocity[3],
                (r.joint_error.iter().map(|e| e * e).sum::<f64>() / 39.0)
                    .sqrt()
                    .to_degrees(),
                f.gait().landing()
            );
            let mut top: Vec<(f64, &str)> = r
                .joint_error
                .iter()
                .zip(sinew::sim::body::topology::DOF_NAMES)
                .map(|(e, n)| (e.to_degrees(), n))
                .collect();
            top.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
            println!("   capture {:?} {}", &top[..5], r.saturated.count_ones());
            for (k, s) in [
                sinew::sim::body::topology::L_FOOT,
                sinew::sim::body::topology::R_FOOT,
            ]
            .into_iter()
            .enumerate()
            {
                let want = sinew::sim::motion::leg_ik::forward(&body, &t.now.posture)[s.index()].0;
                let is =
                    sinew::sim::motion::leg_ik::forward(&body, &f.state().posture)[s.index()].0;
                println!(
                    "   capture foot {k} {:.3} {:.3} {:.3} want {:.3} {:.3} {:.3}",
                    is.x, is.y, is.z, want.x, want.y, want.z
                );
            }
        }
        out.capture = out.capture.max(e[0].hypot(e[1]));
        out.lag = out.lag.max(f.gait().lag());
    }
    out.joints = (out.joints / count.max(1) as f64).sqrt().to_degrees();
    out
}

/// Differences of two motions: joints, degrees rms, and pelvis, m rms.
fn apart(a: &[Posture], b: impl Fn(usize) -> Posture) -> (f64, f64) {
    let (mut joints, mut root) = (0.0, 0.0);
    for (i, p) in a.iter().enumerate() {
        let d = p.difference(&b(i));
        joints += d[6..].iter().map(|e| e * e).sum::<f64>() / 39.0;
        root += d[3..6].iter().map(|e| e * e).sum::<f64>();
    }
    let n = a.len().max(1) as f64;
    ((joints / n).sqrt().to_degrees(), (root / n).sqrt())
}

#[test]
fn windows_compared() {
    let body = man();
    println!(
        "| clip | window, s | joints from offline, deg | pelvis, mm | outside as it came, % | outside, % | rms, mm | offline, % | force lacking | stands, s | joints, deg | capture point, mm | behind, s |"
    );
    for name in ["walk", "turn", "walk-around", "wave", "idle", "dance"] {
        let (raw, whole) = (bare(&body, name), recorded(&body, name));
        let seconds = raw.duration();
        let stream = |t: f64| raw.sample(t).posture;
        let of = |postures: &[Posture], label: &[[bool; 2]]| -> Consistency {
            consistency(&body, postures, label, RATE)
        };
        for window in [0.3, 0.5, 1.0] {
            let (out, label) = prepared(&body, stream, seconds, window);
            let n = out.len();
            let at = |i: usize| i as f64 / RATE;
            let offline: Vec<Posture> = (0..n).map(|i| whole.sample(at(i)).posture).collect();
            let offline_label: Vec<[bool; 2]> =
                (0..n).map(|i| whole.sample(at(i)).planted).collect();
            let before: Vec<Posture> = (0..n).map(|i| stream(at(i))).collect();
            let (joints, root) = apart(&out, |i| offline[i]);
            let (a, b, c) = (
                of(&before, &label),
                of(&out, &label),
                of(&offline, &offline_label),
            );
            let f = follow(&body, stream, seconds, window);
            let g = follow(&body, |t| whole.sample(t).posture, seconds, window);
            println!(
                "offline streamed: {} {:.1} {:.0} |",
                g.fell.map_or("all".into(), |t| format!("{t:.1}")),
                g.joints,
                1e3 * g.capture
            );
            println!(
                "| {name} | {window} | {joints:.1} | {:.0} | {:.0} | {:.0} | {:.0} | {:.0} | {:.3} | {} | {:.1} | {:.0} | {:.2} |",
                1e3 * root,
                100.0 * a.outside,
                100.0 * b.outside,
                1e3 * b.distance.rms,
                100.0 * c.outside,
                b.force.rms,
                f.fell.map_or("all".into(), |t| format!("{t:.1}")),
                f.joints,
                1e3 * f.capture,
                f.lag
            );
            let letters: String = label
                .iter()
                .map(|l| match l {
                    [true, true] => 'D',
                    [true, false] => 'L',
                    [false, true] => 'R',
                    _ => '-',
                })
                .collect();
            if window == 0.5 {
                println!("{letters}");
                let o: String = offline_label
                    .iter()
                    .map(|l| match l {
                        [true, true] => 'D',
                        [true, false] => 'L',
                        [false, true] => 'R',
                        _ => '-',
                    })
                    .collect();
                println!("{o}");
            }
        }
    }
}

#[test]
fn a_long_walk() {
    let body = man();
    let walk = cycle(&body, &recorded(&body, "walk")).unwrap();
    for window in [0.3, 0.5, 1.0] {
        let (out, label) = prepared(&body, |t| walk.sample_looped(t).posture, 8.0, window);
        let given: Vec<Posture> = (0..out.len())
            .map(|i| walk.sample_looped(i as f64 / RATE).posture)
            .collect();
        let glabel: Vec<[bool; 2]> = (0..out.len())
            .map(|i| walk.sample_looped(i as f64 / RATE).planted)
            .collect();
        println!(
            "walk {:?}\nwalk {:?}\nwalk {:?} {:?}",
            consistency(&body, &given, &glabel, RATE),
            consistency(&body, &out, &label, RATE),
            apart(&out, |i| given[i]),
            apart(&out[..out.len() - 1], |i| out[i + 1])
        );
        let f = follow(&body, |t| walk.sample_looped(t).posture, 20.0, window);
        println!(
            "walk {window}: fell {:?}, joints {:.2}, capture {:.0} mm, lag {:.2}",
            f.fell,
            f.joints,
            1e3 * f.capture,
            f.lag
        );
    }
}

#[test]
fn show_one() {
    let body = man();
    let name = std::env::var("CLIP").unwrap();
    let w: f64 = std::env::var("WIN").unwrap().parse().unwrap();
    let (raw, whole) = (bare(&body, &name), recorded(&body, &name));
    let whole = if std::env::var_os("OFF").is_some() {
        whole
    } else {
        raw
    };
    let (out, label) = prepared(&body, |t| whole.sample(t).posture, whole.duration(), w);
    for k in 0..out.len() / 10 {
        let from = (k * 10usize).saturating_sub(2);
        let to = (k * 10 + 12).min(out.len());
        let c = consistency(&body, &out[from..to], &label[from..to], RATE);
        let z: Vec<String> = (k * 10..k * 10 + 10)
            .map(|i| format!("{:.3}", out[i].root_position.z))
            .collect();
        println!(
            "piece {:.2} {:?} force {:.3} outside {:.3} {} {}",
            k as f64 / 6.0,
            label[k * 10],
            c.force.max,
            c.distance.max,
            z.join(" "),
            0
        );
    }
    println!(
        "planted {}",
        label
            .iter()
            .map(|l| match l {
                [true, true] => 'D',
                [true, false] => 'L',
                [false, true] => 'R',
                _ => '-',
            })
            .collect::<String>()
    );
    println!(
        "planted {}",
        (0..label.len())
            .map(|i| match whole.sample(i as f64 / 60.0).planted {
                [true, true] => 'D',
                [true, false] => 'L',
                [false, true] => 'R',
                _ => '-',
            })
            .collect::<String>()
    );
    follow(&body, |t| whole.sample(t).posture, whole.duration(), w);
}
