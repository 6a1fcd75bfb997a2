//! The tones of a photograph within those of paint.

use rayon::prelude::*;

use graphics::field::Field;
use graphics::picture::Picture;

/// A photograph with its black raised to the luminance `black` and its white
/// kept: black point compensation (ISO 18619:2015), so that its shadows keep
/// their differences.
///
/// Paint's surface alone reflects some 3 %, so no palette reaches a photograph's
/// darkest tones. `black` is [`Separation::black`] or, before there is a
/// palette, the floor of the library's surface.
#[must_use]
pub fn black_compensated(picture: &Picture, black: f32) -> Picture {
    let raised = |rgb: &[f32; 3]| rgb.map(|value| black + (1.0 - black) * value);
    let values = picture.values().par_iter().with_min_len(4096).map(raised).collect();
    Field::from_values(picture.width(), picture.height(), values)
}
