//! The pigments of a palette by name.

use calibrate::library::PigmentLibrary;
use render::paint::document::Slots;
use render::paint::palette::{PaletteError, palette_slots};
use spectra::hint::Explain;

use crate::failure::{Refusal, flags};

/// Slots of the pigments of `--palette`.
pub(crate) fn palette(names: &[String], library: &PigmentLibrary) -> anyhow::Result<Slots> {
    palette_slots(names, library).map_err(palette_refusal)
}

/// An unknown pigment is an error of the data; another error is one of the option.
pub(crate) fn palette_refusal(error: PaletteError) -> anyhow::Error {
    match error {
        PaletteError::Pigment(error) => error.into(),
        error => {
            let hint = error.hint().map(|hint| flags(&hint)).unwrap_or_default();
            Refusal::usage(error.to_string(), hint)
        }
    }
}
