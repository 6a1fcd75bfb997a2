//! Patches of colour with rim and gamut mark.

use calibrate::palette::Appearance;

use crate::style::{Color, GRID, PAPER};
use crate::svg::Canvas;

/// Side of the notch in a patch, in px.
const NOTCH: f64 = 6.0;

/// Draws a patch of colour with its upper left corner `at`, in px. The upper right corner is cut
/// out if the colour is outside sRGB.
pub(super) fn patch(
    canvas: &mut Canvas,
    at: (f64, f64),
    size: (f64, f64),
    appearance: &Appearance,
) {
    canvas.rectangle(at, size, Color::from_rgb(appearance.srgb));
    if !appearance.srgb.in_gamut() {
        canvas.rectangle((at.0 + size.0 - NOTCH, at.1), (NOTCH, NOTCH), PAPER);
    }
}

/// Draws a patch like [`patch`], but cuts out the lower right corner.
pub(super) fn notched_below(
    canvas: &mut Canvas,
    at: (f64, f64),
    size: (f64, f64),
    appearance: &Appearance,
) {
    canvas.rectangle(at, size, Color::from_rgb(appearance.srgb));
    if !appearance.srgb.in_gamut() {
        let corner = (at.0 + size.0 - NOTCH, at.1 + size.1 - NOTCH);
        canvas.rectangle(corner, (NOTCH, NOTCH), PAPER);
    }
}

/// Draws a patch with a rim, so that white is visible on the paper.
pub(super) fn rimmed(
    canvas: &mut Canvas,
    at: (f64, f64),
    size: (f64, f64),
    appearance: &Appearance,
) {
    rim(canvas, at, size);
    patch(canvas, at, size, appearance);
}

/// Draws the rim of a patch; the patch is then drawn over it.
pub(super) fn rim(canvas: &mut Canvas, at: (f64, f64), size: (f64, f64)) {
    canvas.rectangle((at.0 - 1.0, at.1 - 1.0), (size.0 + 2.0, size.1 + 2.0), GRID);
}
