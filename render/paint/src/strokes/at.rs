//! Where a check is, and what it tells.

use super::error::{InvalidValue, ValueLocation};
use super::names::nearest;

/// Nothing is wrong, or this is.
pub(crate) type Checked = Result<(), Box<InvalidValue>>;

/// Where a check is.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct At {
    /// The action, counted from 0, with its key; none for one that is no part of
    /// a script.
    pub(super) action: Option<(usize, &'static str)>,
    pub(super) sample: Option<usize>,
}

impl At {
    /// At a sample of a stroke.
    pub(crate) fn sample(self, index: usize) -> Self {
        Self { sample: Some(index), ..self }
    }

    pub(super) fn action(index: usize, kind: &'static str) -> Self {
        Self { action: Some((index, kind)), sample: None }
    }

    pub(crate) fn fault(
        &self,
        field: &str,
        wanted: &str,
        found: &dyn std::fmt::Display,
        hint: Option<String>,
    ) -> Box<InvalidValue> {
        let place =
            ValueLocation { action: self.action, sample: self.sample, field: field.to_owned() };
        Box::new(InvalidValue { place, wanted: wanted.to_owned(), found: found.to_string(), hint })
    }

    pub(super) fn range(&self, field: &str, value: f64, least: f64, most: f64) -> Checked {
        if (least..=most).contains(&value) {
            return Ok(());
        }
        // Written out, 1e300 would be 301 digits.
        let found = if value.abs() < 1e9 { value.to_string() } else { format!("{value:e}") };
        Err(self.fault(field, &format!("{least} to {most}"), &found, None))
    }

    pub(super) fn above_zero(&self, field: &str, value: f64) -> Checked {
        if value > 0.0 { Ok(()) } else { Err(self.fault(field, "above 0", &value, None)) }
    }
}

/// "did you mean", if anything is near.
pub(crate) fn near<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let found = nearest(name, known);
    (!found.is_empty()).then(|| format!("did you mean {}?", found.join(" or ")))
}
