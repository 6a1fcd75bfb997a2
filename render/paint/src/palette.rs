//! Pigments of a palette by name.

use documents::hint::{Explain, Fault, Hint};
use pigment::{PigmentLibrary, RecipeError};

use crate::document::Slots;
use crate::layer::SLOTS;

/// Slots of a palette with the pigments of these names (see [`PigmentLibrary::find`]), in
/// their order.
///
/// # Errors
/// [`PaletteError`] for more than eight names, an unknown name, and a pigment named twice.
pub fn palette_slots(names: &[String], library: &PigmentLibrary) -> Result<Slots, PaletteError> {
    if names.len() > SLOTS {
        return Err(PaletteError::TooMany { count: names.len() });
    }
    let mut slots = Slots::default();
    for (slot, name) in names.iter().enumerate() {
        let pigment = library.find(name)?;
        if slots.contains(&Some(pigment)) {
            return Err(PaletteError::Repeated { name: name.clone() });
        }
        slots[slot] = Some(pigment);
    }
    Ok(slots)
}

/// The names do not make a palette.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PaletteError {
    /// There are more pigments than slots.
    #[error("a palette has at most {SLOTS} pigments, found `{count}`")]
    TooMany {
        /// Number of names.
        count: usize,
    },
    /// Two names mean the same pigment.
    #[error("a palette takes each pigment once, found `{name}` again")]
    Repeated {
        /// The second name, as it was given.
        name: String,
    },
    /// The library has no pigment of this name, or several.
    #[error(transparent)]
    Pigment(#[from] RecipeError),
}

impl Explain for PaletteError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::TooMany { .. } => {
                Some(Hint::new("leave [palette] out to have the best eight chosen"))
            }
            Self::Repeated { .. } => Some(Hint::new("leave the second out")),
            Self::Pigment(error) => error.hint(),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::TooMany { .. } | Self::Repeated { .. } => Fault::Setting,
            Self::Pigment(error) => error.fault(),
        }
    }
}
