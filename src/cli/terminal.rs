//! Standard output and standard error of the commands. Nothing here panics when the reader of a pipe has ended.

use anyhow::{Context as _, Result};
use std::ffi::OsStr;
use std::io::{ErrorKind, IsTerminal, Write};

/// The reader of standard output has ended, as `head` does: the command ends quietly.
#[derive(Debug, thiserror::Error)]
#[error("the reader of standard output has ended")]
pub struct OutputClosed;

/// Writes `text` to standard output at once.
///
/// # Errors
/// [`OutputClosed`] when nothing reads the pipe any more; any other failure by its own name (a full disk, for example).
pub fn print(text: &str) -> Result<()> {
    write_all(&mut std::io::stdout().lock(), text)
}

/// [`print`], and a line break after it.
///
/// # Errors
/// As [`print`].
pub fn print_line(text: &str) -> Result<()> {
    print(&format!("{text}\n"))
}

/// Writes a line to standard error: notes, warnings, errors. A standard error that nothing reads is no reason to stop.
pub fn note(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

fn write_all(out: &mut impl Write, text: &str) -> Result<()> {
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Err(OutputClosed.into()),
        other => other.context("cannot write to standard output"),
    }
}

/// Whether standard error shows colours: it is a terminal, and `NO_COLOR` is not set (<https://no-color.org>).
pub fn stderr_shows_colour() -> bool {
    shows_colour(
        std::io::stderr().is_terminal(),
        std::env::var_os("NO_COLOR").as_deref(),
    )
}

fn shows_colour(terminal: bool, no_color: Option<&OsStr>) -> bool {
    terminal && no_color.is_none_or(OsStr::is_empty)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io;

    struct Failing(ErrorKind);

    impl Write for Failing {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(self.0.into())
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_closed_pipe_is_told_apart_from_a_full_disk() {
        let closed = write_all(&mut Failing(ErrorKind::BrokenPipe), "a").expect_err("closed");
        assert!(closed.is::<OutputClosed>());
        let full = write_all(&mut Failing(ErrorKind::StorageFull), "a").expect_err("full");
        assert!(!full.is::<OutputClosed>());
    }

    #[test]
    fn colours_need_a_terminal_and_no_wish_against_them() {
        assert!(shows_colour(true, None));
        assert!(shows_colour(true, Some(OsStr::new(""))));
        assert!(!shows_colour(true, Some(OsStr::new("1"))));
        assert!(!shows_colour(false, None));
    }
}
