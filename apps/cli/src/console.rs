//! Where a verb prints: results, remarks and patches of colour. This also keeps standard error
//! clean of lines that graphics drivers and their libraries print there by themselves, for example
//! "XDG_RUNTIME_DIR is invalid or not set in the environment", and quotes command lines so that you
//! can type them again.

use std::io::Write;
use std::path::Path;

use calibrate::remark::{Remark, RemarkKind};
use documents::printable;
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

    /// Prints one line of results. Nothing in it but our patches of colour reaches the terminal as a command.
    pub(crate) fn line(&mut self, text: impl AsRef<str>) -> Result<()> {
        if self.streamed && self.voice == Voice::Quiet {
            return Ok(());
        }
        let text = self.shown(text.as_ref());
        writeln!(self.results(), "{text}")?;
        Ok(())
    }

    /// Prints results of several lines.
    pub(crate) fn lines(&mut self, text: impl AsRef<str>) -> Result<()> {
        text.as_ref().lines().try_for_each(|line| self.line(line))
    }

    /// `text` as the terminal can show it, with our patches of colour.
    fn shown(&self, text: &str) -> String {
        if !self.screen.colors {
            return printable(text).into_owned();
        }
        let mut shown = String::new();
        // Start of the text that is not shown yet, and the place where we search.
        let (mut start, mut from) = (0, 0);
        while let Some(found) = text[from..].find(PATCH_START) {
            let at = from + found;
            from = at + PATCH_START.len();
            if let Some(length) = patch_length(&text[at..]) {
                shown += &printable(&text[start..at]);
                shown += &text[at..at + length];
                start = at + length;
                from = start;
            }
        }
        shown + &printable(&text[start..])
    }

    /// Prints a result as JSON. Characters that a terminal would obey are escaped as JSON does it, so that a program
    /// reads them as they were.
    pub(crate) fn json(&mut self, value: &Value) -> Result<()> {
        let mut text = calibrate::library::to_text(value);
        if text.contains(is_obeyed) {
            let letters = text.chars().map(|c| match is_obeyed(c) {
                true => c.encode_utf16(&mut [0; 2]).iter().map(|u| format!("\\u{u:04x}")).collect(),
                false => c.to_string(),
            });
            text = letters.collect();
        }
        write!(self.results(), "{text}")?;
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
            writeln!(self.err, "{}", printable(text.as_ref()))?;
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
        format!("{PATCH_START}{r};{g};{b}{PATCH_END}")
    }
}

/// Whether we escape `c` in JSON, because a terminal would obey it. Line breaks stay: JSON has several lines.
fn is_obeyed(c: char) -> bool {
    c != '\n' && documents::is_hidden(c)
}

/// Escape codes before the three numbers of a patch of colour.
const PATCH_START: &str = "\x1b[48;2;";
/// Blanks and escape codes after the three numbers.
const PATCH_END: &str = "m      \x1b[0m ";

/// Length in bytes of the patch of colour at the start of `text`.
fn patch_length(text: &str) -> Option<usize> {
    let numbers = text.strip_prefix(PATCH_START)?;
    let end = numbers.find(|c: char| !(c.is_ascii_digit() || c == ';'))?;
    let whole = end <= "255;255;255".len() && numbers[end..].starts_with(PATCH_END);
    whole.then_some(PATCH_START.len() + end + PATCH_END.len())
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
    use super::*;

    #[test]
    fn only_patches_of_colour_reach_the_terminal_as_commands() {
        let (mut out, mut err) = (Vec::new(), Vec::new());
        for colors in [false, true] {
            let screen = Screen { colors, ..Screen::default() };
            let mut console = Console {
                out: &mut out,
                err: &mut err,
                screen,
                command: String::new(),
                voice: Voice::Usual,
                streamed: false,
            };
            let patch = console.patch(Rgb([1.0, 0.5, 0.0]));
            let line = format!("\x1b[48;2;1m{patch}\x1b]0;owned\x07 {patch}Red\u{202e}\nerror: no");
            console.line(&line).unwrap();
            console.remark("Wrote \u{9b}31m.json").unwrap();
            console.json(&serde_json::json!({"name": "\u{9b}\u{202e}\u{e0041}"})).unwrap();
        }
        let patch = "\x1b[48;2;255;128;0m      \x1b[0m ";
        let text = |patch: &str| {
            let line = format!(
                "\\u{{1b}}[48;2;1m{patch}\\u{{1b}}]0;owned\\u{{7}} {patch}Red\\u{{202e}}\\u{{a}}error: no\n"
            );
            line + "{\n  \"name\": \"\\u009b\\u202e\\udb40\\udc41\"\n}\n"
        };
        assert_eq!(String::from_utf8(out).unwrap(), text("") + &text(patch));
        assert_eq!(String::from_utf8(err).unwrap(), "Wrote \\u{9b}31m.json\n".repeat(2));
    }

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
