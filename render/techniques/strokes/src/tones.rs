//! Fitting the tones of a photograph to those of paint.

use rayon::prelude::*;

use graphics::field::Field;
use graphics::picture::Picture;
use paint::ground::{ColorPrimer, Primer};
use spectra::color::Rgb;

/// Linear tone of the priming relative to the mean of the picture (chosen by eye).
const TONE: f64 = 0.4;

/// Raises the black of a photograph in linear sRGB to the luminance `black` (0..1) and keeps
/// its white, so that differences in shadows survive: black point compensation (ISO
/// 18619:2015).
///
/// The surface of paint alone reflects about 3 %, so no palette reaches a photograph's darkest
/// tones. `black` is [`Separation::black`](paint::separation::Separation::black) or, before
/// there is a palette, the surface reflection of the library.
#[must_use]
pub fn black_compensated(picture: &Picture, black: f32) -> Picture {
    let values = picture
        .values()
        .par_iter()
        .with_min_len(4096)
        .map(|rgb: &[f32; 3]| rgb.map(|value| black + (1.0 - black) * value))
        .collect();
    Field::from_values(picture.width(), picture.height(), values)
}

/// Priming in a dark tone of the mean colour of `picture`: what strokes leave open looks like a
/// shadow of the picture.
pub(super) fn toned_priming(picture: &Picture) -> Primer {
    let mut sum = [0.0; 3];
    for color in picture.values() {
        sum.iter_mut().zip(color).for_each(|(sum, value)| *sum += f64::from(*value));
    }
    let tone = Rgb(sum.map(|sum| TONE * sum / picture.values().len() as f64)).encoded();
    Primer::Color(ColorPrimer { rgb: tone.to_hex() })
}
