//! Errors of the libraries as exceptions of the package, and their remarks as tuples.

use std::error::Error;

use calibrate::{Remark, RemarkKind};
use documents::hint::{Explain, Fault, Hint};
use pyo3::prelude::*;

/// Exceptions that the package defines in `impasto/errors.py`.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Exception {
    /// Files of measurements that cannot be read.
    Reading,
    /// Names and parts that cannot be mixed or matched.
    Recipe,
    /// Fits, validations and plans that fail.
    Fit,
    /// Everything else.
    Other,
}

impl Exception {
    fn name(self, fault: Fault) -> &'static str {
        match (fault, self) {
            (Fault::Environment, _) => "FileError",
            (_, Self::Reading) => "ReadingError",
            (_, Self::Recipe) => "RecipeError",
            (_, Self::Fit) => "FitError",
            (_, Self::Other) => "Error",
        }
    }

    /// The exception for `error`: its message with the causes, and its hint.
    pub(crate) fn of(self, py: Python<'_>, error: &dyn Explain) -> PyErr {
        let hint = error.hint().map(|hint| hint_text(&hint));
        self.with(py, error.fault(), &message(error), hint.as_deref())
    }

    /// An exception with this message and hint.
    pub(crate) fn with(
        self,
        py: Python<'_>,
        fault: Fault,
        message: &str,
        hint: Option<&str>,
    ) -> PyErr {
        let errors = py.import("impasto.errors");
        let class = errors.and_then(|errors| errors.getattr(self.name(fault)));
        let error = class.and_then(|class| class.call1((message, hint)));
        error.map_or_else(|error| error, PyErr::from_value)
    }
}

/// The text of a hint, with settings named as arguments of the package.
pub(crate) fn hint_text(hint: &Hint) -> String {
    hint.with_settings(|name, value| {
        let argument = match name {
            "saunderson" => return "`surface=impasto.Surface(k1, k2)`".to_owned(),
            "percent" => return "`percent=True`".to_owned(),
            "fraction" => return "`percent=False`".to_owned(),
            "with" => "using",
            "least" => "least_share",
            "parts" => "whole_parts",
            "cost" | "costs" => "prices",
            "target_light" => "light",
            "output" => "out",
            other => other,
        };
        match value {
            Some(value) if value.parse::<f64>().is_ok() => format!("`{argument}={value}`"),
            Some(value) => format!("`{argument}=\"{}\"`", value.trim_matches('"')),
            None => format!("`{argument}`"),
        }
    })
}

/// The message of `error` and of its causes.
fn message(error: &dyn Explain) -> String {
    let mut message = error.to_string();
    let mut cause: Option<&dyn Error> = error.source();
    while let Some(error) = cause {
        let text = error.to_string();
        if !message.contains(&text) {
            message += ": ";
            message += &text;
        }
        cause = error.source();
    }
    message
}

/// Turns the error of a result into an exception.
pub(crate) trait Raised<T> {
    /// Turns the error into an exception of this class.
    fn raised(self, py: Python<'_>, exception: Exception) -> PyResult<T>;
}

impl<T, E: Explain> Raised<T> for Result<T, E> {
    fn raised(self, py: Python<'_>, exception: Exception) -> PyResult<T> {
        self.map_err(|error| exception.of(py, &error))
    }
}

/// Whether a remark is a warning, its sentence, and its hint.
pub(crate) type RemarkTuple = (bool, String, Option<String>);

pub(crate) fn remarks<'a>(remarks: impl IntoIterator<Item = &'a Remark>) -> Vec<RemarkTuple> {
    remarks
        .into_iter()
        .map(|remark: &Remark| {
            let hint = remark.hint.as_ref().map(hint_text);
            (remark.kind == RemarkKind::Warning, remark.text.clone(), hint)
        })
        .collect()
}
