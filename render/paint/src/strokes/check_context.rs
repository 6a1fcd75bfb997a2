//! Location of a value that is checked, and errors about it.

use documents::hint::Hint;

use super::error::{InvalidValue, ValueLocation};

/// Result of a check.
pub(crate) type Checked = Result<(), Box<InvalidValue>>;

/// Action and sample that are being checked.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct CheckContext {
    /// Index of the action from 0, and its key; `None` for the header of a script and for
    /// an action that is in no script.
    action: Option<(usize, &'static str)>,
    sample: Option<usize>,
}

impl CheckContext {
    /// The action `index` of a script, whose key is `kind`.
    pub(super) fn action(index: usize, kind: &'static str) -> Self {
        Self { action: Some((index, kind)), sample: None }
    }

    /// The sample `index` of this stroke.
    pub(crate) fn sample(self, index: usize) -> Self {
        Self { sample: Some(index), ..self }
    }

    /// An error about `field` at this place.
    pub(crate) fn invalid(
        &self,
        field: &str,
        wanted: &str,
        found: &dyn std::fmt::Display,
        hint: Option<Hint>,
    ) -> Box<InvalidValue> {
        let action = self.action;
        let sample = self.sample;
        let location = ValueLocation { action, sample, field: field.to_owned() };
        Box::new(InvalidValue {
            location,
            wanted: wanted.to_owned(),
            found: found.to_string(),
            hint,
        })
    }

    /// Checks that `value` lies in `lowest..=highest`.
    pub(crate) fn range(&self, field: &str, value: f64, lowest: f64, highest: f64) -> Checked {
        if (lowest..=highest).contains(&value) {
            return Ok(());
        }
        // Large numbers have an exponent: written out, 1e300 would take 301 digits.
        let found = if value.abs() < 1e9 { value.to_string() } else { format!("{value:e}") };
        Err(self.invalid(field, &format!("{lowest} to {highest}"), &found, None))
    }

    /// Checks that `value` is above 0.
    pub(super) fn above_zero(&self, field: &str, value: f64) -> Checked {
        if value > 0.0 { Ok(()) } else { Err(self.invalid(field, "above 0", &value, None)) }
    }
}

/// "did you mean", with the names of `known` that are spelt like `name`.
pub(crate) fn did_you_mean<'a>(
    name: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Option<Hint> {
    documents::did_you_mean(name, known).map(Hint::new)
}
