//! Remarks of a computation to its user, beside the result.

use std::fmt;

use documents::hint::Hint;

/// Kind of a [`Remark`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RemarkKind {
    /// A choice that was made for the caller, or progress.
    Note,
    /// A warning about the result.
    Warning,
}

/// One sentence about a computation, for its user.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// Whether it is a note or a warning.
    pub kind: RemarkKind,
    /// The sentence, in lower case and without a full stop.
    pub text: String,
    /// How to choose otherwise, where a setting allows it.
    pub hint: Option<Hint>,
}

impl Remark {
    /// A note: something that was read or chosen.
    #[must_use]
    pub fn note(text: impl Into<String>) -> Self {
        Self { kind: RemarkKind::Note, text: text.into(), hint: None }
    }

    /// A warning about the result.
    #[must_use]
    pub fn warning(text: impl Into<String>) -> Self {
        Self { kind: RemarkKind::Warning, text: text.into(), hint: None }
    }

    /// The remark with a hint, whose settings stand in square brackets.
    #[must_use]
    pub fn with_hint(self, hint: impl Into<String>) -> Self {
        Self { hint: Some(Hint::new(hint)), ..self }
    }
}

impl fmt::Display for Remark {
    /// Writes the sentence, `warning: ` before a warning, and the hint behind a semicolon.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.kind == RemarkKind::Warning {
            f.write_str("warning: ")?;
        }
        f.write_str(&self.text)?;
        self.hint.as_ref().map_or(Ok(()), |hint| write!(f, "; {hint}"))
    }
}
