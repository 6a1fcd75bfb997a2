//! Where a verb writes: results, remarks, and swatches of colour.

use std::io::Write;

use calibrate::remark::Remark;
use serde_json::Value;
use spectra::color::Rgb;

use crate::failure::{Result, with_options};

/// What the terminal can do.
#[derive(Debug, Clone, Copy, Default)]
pub struct Screen {
    /// Whether results may carry colour.
    pub colors: bool,
    /// Whether remarks go to a terminal, where a progress bar makes sense.
    pub progress: bool,
}

/// A verb's way out.
pub(crate) struct Console<'a> {
    /// Results.
    pub(crate) out: &'a mut dyn Write,
    /// Everything else.
    pub(crate) err: &'a mut dyn Write,
    pub(crate) screen: Screen,
    /// The command line, to be typed again.
    pub(crate) command: String,
}

impl Console<'_> {
    /// A line of results.
    pub(crate) fn line(&mut self, text: impl AsRef<str>) -> Result<()> {
        writeln!(self.out, "{}", text.as_ref())?;
        Ok(())
    }

    /// A result for programs.
    pub(crate) fn json(&mut self, value: &Value) -> Result<()> {
        write!(self.out, "{}", calibrate::library::to_text(value))?;
        Ok(())
    }

    /// A line beside the results.
    pub(crate) fn remark(&mut self, text: impl AsRef<str>) -> Result<()> {
        writeln!(self.err, "{}", text.as_ref())?;
        Ok(())
    }

    /// Remarks of a library, one a line, with settings as options.
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

    /// Warnings, one a line.
    pub(crate) fn warnings(&mut self, warnings: &[String]) -> Result<()> {
        for warning in warnings {
            self.remark(format!("warning: {warning}"))?;
        }
        Ok(())
    }

    /// A patch of colour of six columns, where the terminal shows colours;
    /// otherwise nothing. The value in words must stand beside it.
    pub(crate) fn patch(&self, color: Rgb) -> String {
        if !self.screen.colors {
            return String::new();
        }
        let [r, g, b] = color.to_bytes();
        format!("\x1b[48;2;{r};{g};{b}m      \x1b[0m ")
    }
}
