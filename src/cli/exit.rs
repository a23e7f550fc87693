//! How a command ends: its exit code, and the errors that have a code of their own.

use std::process::ExitCode;

/// How a command ended when nothing failed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ExitOutcome {
    /// Done.
    #[default]
    Done,
    /// Done; a figure fell, and `--fail-on-fall` was given.
    Fell,
}

impl From<()> for ExitOutcome {
    fn from((): ()) -> Self {
        Self::Done
    }
}

/// Exit codes of the `sinew` command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Code {
    /// The command did its work.
    Success = 0,
    /// A file, a motion, a connection or a request failed.
    Error = 1,
    /// The arguments are wrong; nothing was done. Also clap's code.
    Usage = 2,
    /// `sinew run --fail-on-fall`: a figure fell.
    Fall = 3,
}

/// The exit codes as `--help` shows them.
pub const EXIT_CODES: &str = "\
Exit codes:
  0  success; also when the reader of a pipe ended first (`sinew … | head`)
  1  error: a file, a motion, a connection or a request failed
  2  usage: the arguments are wrong, nothing was done
  3  fall: a figure fell and `sinew run --fail-on-fall` was given";

impl From<Code> for ExitCode {
    fn from(code: Code) -> Self {
        Self::from(code as u8)
    }
}

/// Arguments that are wrong although each has the right form: exit code 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct UsageError(pub String);

/// Turns any error into a usage error, with its causes in one sentence.
pub fn usage(error: impl Into<anyhow::Error>) -> anyhow::Error {
    UsageError(format!("{:#}", error.into())).into()
}

/// Checks the value of a flag; NaN is outside.
///
/// # Errors
/// [`UsageError`]: it is outside; names the flag.
pub fn within(flag: &str, value: f64, [low, high]: [f64; 2]) -> anyhow::Result<()> {
    if (low..=high).contains(&value) {
        Ok(())
    } else {
        Err(UsageError(format!("{flag} {value}: outside {low}…{high}")).into())
    }
}

/// The exit code of a finished command; an error is written to standard error.
pub fn code(done: anyhow::Result<ExitOutcome>) -> Code {
    match done {
        Ok(ExitOutcome::Done) => Code::Success,
        Ok(ExitOutcome::Fell) => Code::Fall,
        // The reader has closed the pipe on purpose.
        Err(error) if error.is::<super::terminal::OutputClosed>() => Code::Success,
        Err(error) => {
            super::terminal::note(&format!("error: {error:#}"));
            if error.is::<UsageError>() {
                Code::Usage
            } else {
                Code::Error
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::terminal::OutputClosed;
    use anyhow::Context as _;

    #[test]
    fn each_outcome_has_its_code() {
        assert_eq!(code(Ok(ExitOutcome::Done)), Code::Success);
        assert_eq!(code(Ok(ExitOutcome::Fell)), Code::Fall);
        assert_eq!(code(Err(OutputClosed.into())), Code::Success);
        let inner = anyhow::anyhow!("--strength 0: outside 0.01…100");
        assert_eq!(code(Err(usage(inner)).context("run")), Code::Usage);
        assert_eq!(code(Err(anyhow::anyhow!("cannot read"))), Code::Error);
    }

    #[test]
    fn help_lists_every_code() {
        for code in [Code::Success, Code::Error, Code::Usage, Code::Fall] {
            assert!(EXIT_CODES.contains(&format!("\n  {}  ", code as u8)));
        }
    }
}
