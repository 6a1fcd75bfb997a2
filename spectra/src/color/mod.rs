//! Colour: tristimulus values, CIELAB, display RGB, and colour differences.
//!
//! XYZ is scaled so that the white has Y = 100. We compute white points from an illuminant and an
//! observer. Only the white points of RGB standards, e.g. sRGB, are constants, because the
//! standards define them.

mod xyz;
mod rgb;
mod difference;
mod whiteness;

pub use difference::{
    Cie94, Cmc, ColorDifferences, MetamerismError, ciede2000_metric, ciede2000_residuals,
    corrected_to_match, delta_e_cie76, delta_e_cie94, delta_e_ciede2000, delta_e_cmc,
    metamerism_index,
};
pub use rgb::{ColorCode, ColorCodeError, ColorValues, Rgb, RgbSpace};
pub use whiteness::{Whiteness, WhitenessError};
pub use xyz::{Adaptation, Lab, Lch, Luv, Matrix3, Xyy, Xyz, adapt};
