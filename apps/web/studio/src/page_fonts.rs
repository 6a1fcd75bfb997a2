//! The font of the page.

use std::sync::Arc;

use eframe::egui::{FontData, FontDefinitions, FontFamily};
use epaint_default_fonts::UBUNTU_LIGHT;

/// One font for all text. The program's fonts of emoji and of equal widths would be 0.6 MB of the
/// download; the digits of this one are equally wide too.
pub(crate) fn page_fonts() -> FontDefinitions {
    let name = "Ubuntu-Light";
    let mut fonts = FontDefinitions::empty();
    fonts.font_data.insert(name.to_owned(), Arc::new(FontData::from_static(UBUNTU_LIGHT)));
    for family in [FontFamily::Proportional, FontFamily::Monospace] {
        fonts.families.insert(family, vec![name.to_owned()]);
    }
    fonts
}
