//! The font of the page.

use std::sync::Arc;

use eframe::egui::{FontData, FontDefinitions, FontFamily};
use epaint_default_fonts::UBUNTU_LIGHT;

/// One font for all text. The program's fonts for emoji and monospaced text would add 0.6 MB to the
/// download, and the digits of this font are equally wide too.
pub(crate) fn page_fonts() -> FontDefinitions {
    let name = "Ubuntu-Light";
    let mut fonts = FontDefinitions::empty();
    fonts.font_data.insert(name.to_owned(), Arc::new(FontData::from_static(UBUNTU_LIGHT)));
    for family in [FontFamily::Proportional, FontFamily::Monospace] {
        fonts.families.insert(family, vec![name.to_owned()]);
    }
    fonts
}
