//! A colour as a patch and a code, marked where the display cannot show it.

use spectra::color::{Rgb, RgbSpace};

use crate::console::Console;
use crate::failure::Result;

/// Mark behind the code of a colour that is outside its space, in tables.
const MARK: &str = "*";

impl Console<'_> {
    /// Patch and code of an sRGB colour, with a note if it is outside sRGB.
    pub(crate) fn srgb(&self, color: Rgb) -> String {
        format!("{}{}", self.patch(color), color.to_hex_with_note(RgbSpace::Srgb))
    }
}

/// Colours of a table: codes that are marked, and the note below that explains the mark.
#[derive(Debug)]
pub(crate) struct TableColors {
    space: RgbSpace,
    is_marked: bool,
}

impl TableColors {
    pub(crate) fn of(space: RgbSpace) -> Self {
        Self { space, is_marked: false }
    }

    /// Patch and code of a colour, 8 columns wide without the patch.
    pub(crate) fn cell(&mut self, color: Rgb, console: &Console<'_>) -> String {
        let outside = !color.in_gamut();
        self.is_marked |= outside;
        let mark = if outside { MARK } else { " " };
        format!("{}{}{mark}", console.patch(color), color.to_hex())
    }

    /// Prints what the mark means, if a colour has one.
    pub(crate) fn note(&self, indent: &str, console: &mut Console<'_>) -> Result<()> {
        if !self.is_marked {
            return Ok(());
        }
        console.line(format!("{indent}{MARK} {}", self.space.outside_note()))
    }
}
