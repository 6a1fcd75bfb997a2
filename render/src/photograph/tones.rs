//! Fitting the tones of a photograph to those of paint.

use rayon::prelude::*;

use graphics::field::Field;
use graphics::picture::Picture;

/// Raises the black of a photograph in linear sRGB to the luminance `black` (0..1) and keeps
/// its white, so that differences in shadows survive: black point compensation (ISO
/// 18619:2015).
///
/// The surface of paint alone reflects about 3 %, so no palette reaches a photograph's darkest
/// tones. `black` is [`Separation::black`](paint::separation::Separation::black) or, before
/// there is a palette, the surface reflection of the library.
#[must_use]
pub fn black_compensated(picture: &Picture, black: f32) -> Picture {
    let raised = |rgb: &[f32; 3]| rgb.map(|value| black + (1.0 - black) * value);
    let values = picture.values().par_iter().with_min_len(4096).map(raised).collect();
    Field::from_values(picture.width(), picture.height(), values)
}
