//! Arguments that were given but have no effect.

use super::args::RunArgs;
use crate::args::{ControllerArg, StepperArg};
use crate::number::seconds;
use crate::source::LoadedClip;
use crate::terminal::note;

/// Warns of them on standard error.
pub(super) fn warn(args: &RunArgs, sources: &[LoadedClip]) {
    let late = |s: &LoadedClip| {
        let texts = too_late(args, args.seconds(&s.clip)).into_iter();
        texts
            .map(|text| format!("{}: {text}", s.name))
            .collect::<Vec<_>>()
    };
    for text in not_read(args)
        .into_iter()
        .chain(sources.iter().flat_map(late))
    {
        note(&format!("warning: {text}"));
    }
}

/// Options that the controller or the stepper does not read.
fn not_read(args: &RunArgs) -> Vec<String> {
    let mut out = Vec::new();
    let controller = args.controller_kind();
    if args.help.most() > 0.0 && controller != ControllerArg::Modern {
        out.push(format!(
            "{} has no effect: it needs --controller modern",
            args.help.option()
        ));
    }
    if controller != ControllerArg::Paper {
        let of_paper = args.paper.of_paper_only();
        out.extend(of_paper.map(|o| format!("{o} has no effect: it needs --controller paper")));
    }
    if args.self_contact && args.stepper_kind() != StepperArg::Torque {
        // These steppers switch to torques where accelerations are not feasible.
        out.push(
            "--self-contact has no effect while accelerations move the body: it needs --stepper torque".to_owned(),
        );
    }
    out
}

/// Arguments that take effect only at the end of a run, s, or after it.
fn too_late(args: &RunArgs, end: f64) -> Vec<String> {
    let loads = args.load.iter().map(|l| ("--load", l.from_s));
    let pushes = args.push.iter().map(|p| ("--push", p.at_s));
    let goals = args.constrain.iter().map(|c| ("--constrain", c.from_s));
    let then = args.then.iter().map(|t| ("--then", t.at_s));
    let all = loads.chain(pushes).chain(goals).chain(then);
    let late = all.filter(|(_, at)| *at >= end);
    late.map(|(flag, at)| {
        format!(
            "{flag} at {at} s has no effect: the run ends at {}",
            seconds(end)
        )
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(clap::Parser)]
    struct TestCommand {
        #[command(flatten)]
        args: RunArgs,
    }

    fn run(options: &[&str]) -> RunArgs {
        let all = ["run", "builtin:idle", "--duration", "2"]
            .iter()
            .chain(options);
        <TestCommand as clap::Parser>::parse_from(all).args
    }

    #[test]
    fn options_that_are_not_read_are_named() {
        let quiet: [&[&str]; 4] = [
            &["--max-help", "0.1", "--self-contact", "--alpha", "0.5"],
            &["--controller", "paper", "--metric", "H"],
            &["--preset", "paper2000", "--tilt"],
            &[],
        ];
        for options in quiet {
            assert_eq!(not_read(&run(options)), [""; 0], "{options:?}");
        }
        let told: [(&[&str], &str); 5] = [
            (
                &["--max-help", "0.1", "--controller", "paper"],
                "--max-help ",
            ),
            (
                &["--max-help", "0.1", "--preset", "paper2000"],
                "--max-help ",
            ),
            (&["--metric", "H"], "--metric "),
            (&["--tilt=false", "--controller", "motors"], "--tilt "),
            (
                &["--self-contact", "--stepper", "kinematic"],
                "--self-contact ",
            ),
        ];
        for (options, says) in told {
            let all = not_read(&run(options));
            assert!(
                all.len() == 1 && all[0].starts_with(says),
                "{options:?}: {all:?}"
            );
        }
    }

    #[test]
    fn what_begins_after_the_run_is_named() {
        let within = run(&[
            "--push",
            "20@chest@1.9:1,0,0",
            "--load",
            "3@r_hand",
            "--then",
            "builtin:wave@1",
        ]);
        assert_eq!(too_late(&within, 2.0), [""; 0]);
        let after = run(&[
            "--push",
            "20@chest@99:1,0,0",
            "--load",
            "3@r_hand@2..3",
            "--then",
            "builtin:wave@99",
            "--constrain",
            "com@_,0.08,_@5..6",
        ]);
        assert_eq!(
            too_late(&after, 2.0),
            [
                "--load at 2 s has no effect: the run ends at 2.00 s",
                "--push at 99 s has no effect: the run ends at 2.00 s",
                "--constrain at 5 s has no effect: the run ends at 2.00 s",
                "--then at 99 s has no effect: the run ends at 2.00 s",
            ]
        );
    }
}
