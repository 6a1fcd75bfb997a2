//! Output of a verb: results, remarks and patches of colour.

use std::io::Write;

use calibrate::remark::Remark;
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
}

impl Console<'_> {
    /// Prints one line of results.
    pub(crate) fn line(&mut self, text: impl AsRef<str>) -> Result<()> {
        writeln!(self.out, "{}", text.as_ref())?;
        Ok(())
    }

    /// Prints a result as JSON.
    pub(crate) fn json(&mut self, value: &Value) -> Result<()> {
        write!(self.out, "{}", calibrate::library::to_text(value))?;
        Ok(())
    }

    /// Prints one line of remarks.
    pub(crate) fn remark(&mut self, text: impl AsRef<str>) -> Result<()> {
        writeln!(self.err, "{}", text.as_ref())?;
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
            self.remark(line)?;
        }
        Ok(())
    }

    /// Prints warnings, one per line.
    pub(crate) fn warnings(&mut self, warnings: &[String]) -> Result<()> {
        for warning in warnings {
            self.remark(format!("warning: {warning}"))?;
        }
        Ok(())
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
