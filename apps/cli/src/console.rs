//! Output of a verb: results, remarks and patches of colour.

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
    /// Whether standard error is this program's own, so that what graphics drivers print there may
    /// be caught. Not so where other threads print at the same time, as in tests.
    pub owns_errors: bool,
}

/// How much a verb tells beside its results.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Voice {
    /// Only warnings and errors.
    Quiet,
    #[default]
    Usual,
    /// Also what was chosen, and how long it took.
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
    /// Writer of results: of remarks once a file was streamed.
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

    /// Tells that a file or a folder was written.
    pub(crate) fn wrote(&mut self, path: &Path) -> Result<()> {
        self.remark(format!("Wrote {}", path.display()))
    }

    /// Prints one line of remarks.
    pub(crate) fn remark(&mut self, text: impl AsRef<str>) -> Result<()> {
        self.told(Voice::Usual, text)
    }

    /// Prints one line of what is told on request.
    pub(crate) fn detail(&mut self, text: impl AsRef<str>) -> Result<()> {
        self.told(Voice::Verbose, text)
    }

    fn told(&mut self, least: Voice, text: impl AsRef<str>) -> Result<()> {
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
            self.told(least, line)?;
        }
        Ok(())
    }

    /// Prints warnings, one per line.
    pub(crate) fn warnings(&mut self, warnings: &[String]) -> Result<()> {
        for warning in warnings {
            self.told(Voice::Quiet, format!("warning: {warning}"))?;
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
