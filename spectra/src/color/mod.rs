//! Colour: tristimulus values, CIELAB, display RGB, and colour differences.
//!
//! XYZ is scaled so that the white has Y = 100. White points are computed from an illuminant
//! and an observer; only those of RGB standards are constants, because the standards define
//! them.

mod matrix;
mod xyz;
mod lab;
mod luv;
mod adaptation;
mod rgb;
mod gamut;
mod values;
mod code;
mod difference;
mod metamerism;
mod whiteness;

pub use adaptation::{Adaptation, adapt};
pub use code::{ColorCode, ColorCodeError};
pub use difference::{
    Cie94, Cmc, ColorDifferences, ciede2000_metric, ciede2000_residuals, delta_e_cie76,
    delta_e_cie94, delta_e_ciede2000, delta_e_cmc,
};
pub use lab::{Lab, Lch};
pub use luv::Luv;
pub use matrix::Matrix3;
pub use metamerism::{MetamerismError, corrected_to_match, metamerism_index};
pub use rgb::{Rgb, RgbSpace};
pub use values::ColorValues;
pub use whiteness::{Whiteness, WhitenessError};
pub use xyz::{Xyy, Xyz};
