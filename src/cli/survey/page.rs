//! `--page`: writes tables into a page that people maintain, with the command that reproduces them.

use crate::output::write;
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// `FILE#SECTION`: the text between the marks of a section is replaced.
#[derive(Clone, Debug, PartialEq)]
pub struct PageSpec {
    /// The page.
    pub file: PathBuf,
    /// Name of the section.
    pub section: String,
}

impl FromStr for PageSpec {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.rsplit_once('#') {
            Some((file, section))
                if !file.is_empty()
                    && !section.is_empty()
                    && section
                        .chars()
                        .all(|c| c.is_ascii_alphanumeric() || c == '-') =>
            {
                Ok(Self {
                    file: file.into(),
                    section: section.to_owned(),
                })
            }
            _ => Err(format!(
                "{text:?} is not of the form FILE#SECTION, with a section of letters, digits and hyphens"
            )),
        }
    }
}

impl PageSpec {
    /// Checks that the page has the section.
    ///
    /// # Errors
    /// It does not, or the page cannot be read.
    pub(super) fn check(&self) -> Result<()> {
        replaced(&self.text()?, &self.section, "", "").map(|_| ())
    }

    /// Puts `tables` into the section, under the command with these arguments.
    ///
    /// # Errors
    /// There is no such section, or the page cannot be written.
    pub(super) fn fill(&self, tables: &str, arguments: impl Iterator<Item = String>) -> Result<()> {
        let text = replaced(&self.text()?, &self.section, &command(arguments), tables)
            .with_context(|| format!("{}", self.file.display()))?;
        write(&self.file, text)
    }

    fn text(&self) -> Result<String> {
        std::fs::read_to_string(&self.file)
            .with_context(|| format!("cannot read {}", self.file.display()))
    }
}

/// The given command, without paths of this machine: of absolute paths only the last part is kept.
pub(super) fn command(arguments: impl Iterator<Item = String>) -> String {
    let mut words = vec!["sinew".to_owned()];
    for word in arguments.skip(1) {
        let (path, section) = word.split_once('#').unwrap_or((&word, ""));
        let last = Path::new(path)
            .file_name()
            .filter(|_| Path::new(path).is_absolute());
        let mut shown = last.map_or(path.to_owned(), |l| l.to_string_lossy().into_owned());
        if !section.is_empty() {
            shown = format!("{shown}#{section}");
        }
        // The command is inside a comment, which two hyphens and a bracket would end.
        let shown = shown.replace("-->", "");
        let plain = |c: char| c.is_alphanumeric() || "-_./:,@+#=".contains(c);
        words.push(if !shown.is_empty() && shown.chars().all(plain) {
            shown
        } else {
            format!("'{}'", shown.replace('\'', ""))
        });
    }
    words.join(" ")
}

/// `text` with the part between the marks of `section` replaced.
fn replaced(text: &str, section: &str, command: &str, tables: &str) -> Result<String> {
    let begin = format!("<!-- survey {section} begin");
    let end = format!("<!-- survey {section} end -->");
    let mark = text.match_indices(&begin).find(|(i, m)| {
        // The name must end here, so that `a` is not found in `a-b`.
        text[i + m.len()..].starts_with([':', ' '])
    });
    let Some((from, _)) = mark else {
        bail!("there is no mark {begin}: … -->");
    };
    let Some(to) = text[from..].find(&end).map(|i| from + i) else {
        bail!("the mark {end} is missing");
    };
    Ok(format!(
        "{}{begin}: {command} -->\n\n```sh\n{command}\n```\n\n{}\n\n{}",
        &text[..from],
        tables.trim(),
        &text[to..]
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "# Limits\n\n<!-- survey wide-2 begin: x -->\nkept\n<!-- survey wide-2 end -->\n\
        <!-- survey wide begin: old command -->\nold\ntable\n<!-- survey wide end -->\nafter\n";

    #[test]
    fn only_the_section_is_replaced_and_again() {
        let once = replaced(PAGE, "wide", "sinew survey a", "| t |\n").unwrap();
        assert!(once.starts_with("# Limits\n\n<!-- survey wide-2 begin: x -->\nkept\n"));
        assert!(once.ends_with(
            "<!-- survey wide begin: sinew survey a -->\n\n```sh\nsinew survey a\n```\n\n| t |\n\n\
             <!-- survey wide end -->\nafter\n"
        ));
        assert_eq!(
            replaced(&once, "wide", "sinew survey a", "| t |\n").unwrap(),
            once
        );
        assert!(replaced(PAGE, "none", "", "").is_err());
        assert!(replaced("<!-- survey a begin: -->", "a", "", "").is_err());
    }

    #[test]
    fn the_command_names_no_place_of_this_machine() {
        let words = [
            "/x/sinew",
            "survey",
            "/data/mocap",
            "tests/corpus",
            "--push",
            "10@chest@1:0,1,0",
            "--noise",
            "1mm, 0.2deg",
            "--page",
            "docs/limits.md#wide",
        ];
        assert_eq!(
            command(words.iter().map(|w| (*w).to_owned())),
            "sinew survey mocap tests/corpus --push 10@chest@1:0,1,0 --noise '1mm, 0.2deg' --page docs/limits.md#wide"
        );
    }

    #[test]
    fn a_page_is_a_file_and_a_section() {
        let p: PageSpec = "docs/a#b.md#wide-1".parse().unwrap();
        assert_eq!(
            (p.file, p.section),
            ("docs/a#b.md".into(), "wide-1".to_owned())
        );
        for bad in ["docs/limits.md", "#a", "a#", "a#b c"] {
            assert!(bad.parse::<PageSpec>().is_err(), "{bad}");
        }
    }
}
