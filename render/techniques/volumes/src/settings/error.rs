//! Errors of settings.

use documents::hint::{Explain, Fault, Hint};
use documents::similar_names;

use super::preset::Preset;
use crate::toml_text::TextError;

/// Settings cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum SettingsError {
    /// The text has a fault.
    #[error(transparent)]
    Text(#[from] TextError),
    /// There is no preset of this name.
    #[error("there is no preset `{name}`")]
    Preset {
        /// Name that was asked for.
        name: String,
    },
}

impl Explain for SettingsError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Text(error) => error.hint(),
            Self::Preset { name } => {
                let names = Preset::ALL.map(Preset::name);
                let similar = similar_names(name, names);
                let hint = match similar.is_empty() {
                    true => {
                        format!(
                            "presets are {}; a file of your own ends in .toml",
                            names.join(", ")
                        )
                    }
                    false => format!("did you mean {}?", similar.join(" or ")),
                };
                Some(Hint::verbatim(hint))
            }
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Text(error) => error.fault(),
            Self::Preset { .. } => Fault::Setting,
        }
    }
}
