//! The option `--palette`: pigments of a library by name.

use calibrate::library::PigmentLibrary;
use render::paint::document::Slots;
use render::paint::palette::palette_slots;

use crate::failure::Result;

/// Finds the pigments that `--palette` names and puts them into the slots of a layer.
pub(crate) fn palette(names: &[String], library: &PigmentLibrary) -> Result<Slots> {
    Ok(palette_slots(names, library)?)
}
