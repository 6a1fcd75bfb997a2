//! Reasons why a recipe cannot be mixed.

use documents::did_you_mean;
use documents::hint::{Explain, Hint};

/// A recipe that cannot be mixed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecipeError {
    /// No pigment has this name.
    #[error("the library has no pigment called `{name}`")]
    UnknownPigment {
        /// Name that was looked up.
        name: String,
        /// Names of all pigments of the library.
        known: Vec<String>,
    },
    /// Several pigments start with this name.
    #[error("{first} and {second} both start with `{name}`")]
    Ambiguous {
        /// Name that was looked up.
        name: String,
        /// Name of one pigment that matches.
        first: String,
        /// Name of another pigment that matches.
        second: String,
    },
    /// A part, or the sum of all parts, is out of range.
    #[error("parts are 0 to 1e12 and sum to 1e-12 or more, found `{parts}`")]
    Parts {
        /// The part or sum out of range.
        parts: f64,
    },
}

impl Explain for RecipeError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::UnknownPigment { name, known } => {
                let question = did_you_mean(name, known.iter().map(String::as_str));
                let question = question.map_or_else(String::new, |question| question + " ");
                Some(Hint::verbatim(format!("{question}pigments: {}", known.join(", "))))
            }
            Self::Ambiguous { .. } => Some(Hint::new("write more of the name")),
            Self::Parts { .. } => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_pigment_is_told_with_the_one_that_is_meant() {
        let known = ["Zinc White", "Viridian"].map(str::to_owned).to_vec();
        let hint = |name: &str| {
            let error = RecipeError::UnknownPigment { name: name.to_owned(), known: known.clone() };
            error.hint().unwrap().to_string()
        };
        assert_eq!(hint("Viridan"), "did you mean Viridian? pigments: Zinc White, Viridian");
        assert_eq!(hint("Umber"), "pigments: Zinc White, Viridian");
    }
}
