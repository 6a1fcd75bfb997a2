//! The pigments of a palette by name.

use calibrate::library::PigmentLibrary;
use render::paint::document::Slots;
use render::paint::palette::palette_slots;

use crate::failure::Result;

/// Slots of the pigments of `--palette`.
pub(crate) fn palette(names: &[String], library: &PigmentLibrary) -> Result<Slots> {
    Ok(palette_slots(names, library)?)
}
