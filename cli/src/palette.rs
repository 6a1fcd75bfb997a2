//! The pigments of a palette by name.

use calibrate::library::PigmentLibrary;
use render::paint::document::Slots;

use crate::failure::Refusal;

/// The pigments of a palette, each once.
pub(crate) fn palette(names: &[String], library: &PigmentLibrary) -> anyhow::Result<Slots> {
    let mut slots = Slots::default();
    if names.len() > slots.len() {
        return Err(Refusal::usage(
            format!("a palette has at most 8 pigments, found `{}`", names.len()),
            "leave --palette out to have the best eight chosen",
        ));
    }
    for (place, name) in names.iter().enumerate() {
        let index = library.find(name)?.index();
        if slots.contains(&Some(index)) {
            return Err(Refusal::usage(
                format!("--palette takes each pigment once, found `{name}` again"),
                "leave the second out",
            ));
        }
        slots[place] = Some(index);
    }
    Ok(slots)
}
