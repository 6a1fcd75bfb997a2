//! Patches of colour with their rims and marks.

use calibrate::palette::Appearance;

use crate::style::{Color, GRID, PAPER};
use crate::svg::Canvas;

const NOTCH: f64 = 6.0;

/// A patch of a colour, `at` its upper left corner, in px; a corner is cut out
/// where sRGB cannot show the colour.
pub(super) fn patch(canvas: &mut Canvas, at: (f64, f64), size: (f64, f64), look: &Appearance) {
    canvas.rectangle(at, size, Color::shown(look.srgb));
    if !look.srgb.in_gamut() {
        canvas.rectangle((at.0 + size.0 - NOTCH, at.1), (NOTCH, NOTCH), PAPER);
    }
}

/// The same, the lower corner cut out.
pub(super) fn notched_below(
    canvas: &mut Canvas,
    at: (f64, f64),
    size: (f64, f64),
    look: &Appearance,
) {
    canvas.rectangle(at, size, Color::shown(look.srgb));
    if !look.srgb.in_gamut() {
        let corner = (at.0 + size.0 - NOTCH, at.1 + size.1 - NOTCH);
        canvas.rectangle(corner, (NOTCH, NOTCH), PAPER);
    }
}

/// A patch with a rim, so that white stands out from the paper.
pub(super) fn rimmed(canvas: &mut Canvas, at: (f64, f64), size: (f64, f64), look: &Appearance) {
    rim(canvas, at, size);
    patch(canvas, at, size, look);
}

/// The rim of a patch that is drawn next.
pub(super) fn rim(canvas: &mut Canvas, at: (f64, f64), size: (f64, f64)) {
    canvas.rectangle((at.0 - 1.0, at.1 - 1.0), (size.0 + 2.0, size.1 + 2.0), GRID);
}
