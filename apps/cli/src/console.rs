//! Where a verb prints: results, remarks and patches of colour. This also keeps standard error
//! clean of lines that graphics drivers and their libraries print there by themselves, for example
//! "XDG_RUNTIME_DIR is invalid or not set in the environment", and quotes command lines so that you
//! can type them again.

use std::io::Write;
use std::path::Path;

use calibrate::remark::{Remark, RemarkKind};
use serde_json::Value;
use spectra::color::Rgb;

use crate::failure::{Result, with_options};

/// Capabilities of the terminal that the output goes to.
#[derive(Debug, Clone, Copy, Default)]
pub struct Screen {
    /// Whether results may contain escape codes for colour.
    pub colors: bool,
    /// Whether remarks go to a terminal, so that a progress bar can be shown.
    pub progress: bool,
    /// Whether standard error is this program's own, so that we may catch the lines that graphics
    /// drivers print there. This is not so where other threads print at the same time, as in tests.
    pub owns_errors: bool,
}

/// How much a verb prints besides its results.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Voice {
    /// Only warnings and errors.
    Quiet,
    #[default]
    Usual,
    /// Also prints what was chosen and how long it took.
    Verbose,
}

/// Writers and terminal settings through which a verb prints.
pub(crate) struct Console<'a> {
    /// Writer of the results.
    pub(crate) out: &'a mut dyn Write,
    /// Writer of remarks, warnings and errors.
    pub(crate) err: &'a mut dyn Write,
    pub(crate) screen: Screen,
    /// Command line, quoted for a shell.
    pub(crate) command: String,
    pub(crate) voice: Voice,
    /// Whether a file went to the writer of the results, which then takes nothing else.
    pub(crate) streamed: bool,
}

impl Console<'_> {
    /// Writer of results. After a file was streamed to it, this is the writer of remarks.
    fn results(&mut self) -> &mut dyn Write {
        if self.streamed { &mut *self.err } else { &mut *self.out }
    }

    /// Prints one line of results.
    pub(crate) fn line(&mut self, text: impl AsRef<str>) -> Result<()> {
        if self.streamed && self.voice == Voice::Quiet {
            return Ok(());
        }
        writeln!(self.results(), "{}", text.as_ref())?;
        Ok(())
    }

    /// Prints a result as JSON.
    pub(crate) fn json(&mut self, value: &Value) -> Result<()> {
        write!(self.results(), "{}", calibrate::library::to_text(value))?;
        Ok(())
    }

    /// Prints results as they are.
    pub(crate) fn text(&mut self, text: &str) -> Result<()> {
        self.results().write_all(text.as_bytes())?;
        Ok(())
    }

    /// Sends the content of a file to the writer of the results.
    pub(crate) fn stream(&mut self, content: &[u8]) -> Result<()> {
        self.streamed = true;
        self.out.write_all(content)?;
        Ok(())
    }

    /// Says that we wrote a file or a folder.
    pub(crate) fn wrote(&mut self, path: &Path) -> Result<()> {
        self.remark(format!("Wrote {}", path.display()))
    }

    /// Prints one line of remarks.
    pub(crate) fn remark(&mut self, text: impl AsRef<str>) -> Result<()> {
        self.remark_at(Voice::Usual, text)
    }

    /// Prints one line that you see only with `--verbose`.
    pub(crate) fn detail(&mut self, text: impl AsRef<str>) -> Result<()> {
        self.remark_at(Voice::Verbose, text)
    }

    fn remark_at(&mut self, least: Voice, text: impl AsRef<str>) -> Result<()> {
        if self.voice >= least {
            writeln!(self.err, "{}", text.as_ref())?;
        }
        Ok(())
    }

    /// Prints remarks of a library, one per line, with settings written as options.
    pub(crate) fn remarks<'r>(
        &mut self,
        remarks: impl IntoIterator<Item = &'r Remark>,
    ) -> Result<()> {
        for remark in remarks {
            let mut line = Remark { hint: None, ..remark.clone() }.to_string();
            if let Some(hint) = &remark.hint {
                line += &format!("; {}", with_options(hint));
            }
            let least =
                if remark.kind == RemarkKind::Warning { Voice::Quiet } else { Voice::Usual };
            self.remark_at(least, line)?;
        }
        Ok(())
    }

    /// Prints warnings, one per line.
    pub(crate) fn warnings(&mut self, warnings: &[String]) -> Result<()> {
        for warning in warnings {
            self.remark_at(Voice::Quiet, format!("warning: {warning}"))?;
        }
        Ok(())
    }

    /// Whether a progress bar is shown.
    pub(crate) fn shows_progress(&self) -> bool {
        self.screen.progress && self.voice != Voice::Quiet
    }

    /// Returns the escape codes of a colour patch six columns wide and a space, or an empty string
    /// if the terminal shows no colours. The caller must print the colour as text too.
    pub(crate) fn patch(&self, color: Rgb) -> String {
        if !self.screen.colors {
            return String::new();
        }
        let [r, g, b] = color.to_bytes();
        format!("\x1b[48;2;{r};{g};{b}m      \x1b[0m ")
    }
}

/// Calls `call` and catches the lines that it prints on standard error. With `--verbose` we print them
/// afterwards, one by one.
pub(crate) fn without_noise<T>(console: &mut Console<'_>, call: impl FnOnce() -> T) -> Result<T> {
    if !console.screen.owns_errors {
        return Ok(call());
    }
    let (result, noise) = caught::caught(call);
    for line in noise.lines().map(str::trim).filter(|line| !line.is_empty()) {
        console.detail(format!("graphics driver: {line}"))?;
    }
    Ok(result)
}

#[cfg(unix)]
mod caught {
    use std::fs::File;
    use std::io::{self, Read, Seek};
    use std::os::fd::OwnedFd;

    /// The original standard error. Dropping this puts it back.
    struct PutBack(OwnedFd);

    impl Drop for PutBack {
        fn drop(&mut self) {
            let _ = rustix::stdio::dup2_stderr(&self.0);
        }
    }

    /// The result of `call`, and what was printed to standard error meanwhile.
    pub(super) fn caught<T>(call: impl FnOnce() -> T) -> (T, String) {
        let Ok((before, mut file)) = redirected() else { return (call(), String::new()) };
        let result = call();
        drop(before);
        let mut noise = Vec::new();
        let read = file.rewind().and_then(|()| file.read_to_end(&mut noise));
        let noise = read.map_or_else(|_| String::new(), |_| String::from_utf8_lossy(&noise).into());
        (result, noise)
    }

    fn redirected() -> io::Result<(PutBack, File)> {
        let file = tempfile::tempfile()?;
        let before = PutBack(rustix::io::dup(io::stderr())?);
        rustix::stdio::dup2_stderr(&file)?;
        Ok((before, file))
    }
}

#[cfg(not(unix))]
mod caught {
    /// The result of `call` and an empty text, because we catch standard error on Unix only.
    pub(super) fn caught<T>(call: impl FnOnce() -> T) -> (T, String) {
        (call(), String::new())
    }
}

/// Joins the words of a command line with spaces, each quoted for a POSIX shell where needed.
pub(crate) fn command_line<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    let quoted: Vec<String> = words.into_iter().map(quoted).collect();
    quoted.join(" ")
}

/// Quotes `word` for a POSIX shell unless it holds only plain characters.
fn quoted(word: &str) -> String {
    if !word.is_empty()
        && word.chars().all(|c: char| c.is_ascii_alphanumeric() || "-_./,:+=@%".contains(c))
    {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn a_shell_reads_back_what_was_quoted() {
        for word in ["out/a.json", "Zinc White", "", "it's $HOME `x` \"y\" \\"] {
            let shell = std::process::Command::new("sh")
                .args(["-c", &format!("printf %s {}", quoted(word))])
                .output()
                .unwrap();
            assert_eq!(String::from_utf8(shell.stdout).unwrap(), word);
        }
    }
}
