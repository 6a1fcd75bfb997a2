//! Grounds to paint on. You generate the relief from a seed or take it from a picture. The colour
//! is the colour of the priming.
//!
//! Heights are 0 or more, in mm above the plane of the canvas. Equal descriptions always give equal
//! grounds.

mod primer;
mod relief;
mod spec;

use documents::hint::Explain;
use graphics::field::Field;
use graphics::picture_formats::NAMES;

use crate::optics::Gloss;

pub use primer::{ColorPrimer, MeasuredPrimer, Primer, PrimerFilm, PrimerSpectrum, TonedPrimer};
pub use relief::{Linen, Panel, Paper, PaperFinish, PictureRelief, Wood};
pub use spec::{GroundKind, GroundRelief, GroundSpec, ParseGroundKindError};

/// Surface of a canvas or palette before any paint.
#[derive(Debug, Clone, PartialEq)]
pub struct Ground {
    /// Human-readable description, for example `linen, seed 1`.
    pub name: String,
    /// Height of each cell above the plane of the canvas, in quanta.
    pub height: Field<i32>,
    /// Measured reflectance, one value per wavelength of the library's grid, 0..1.
    pub reflectance: Vec<f64>,
    /// Gloss of the bare ground.
    pub gloss: Gloss,
}

/// A ground cannot be made as described.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum GroundError {
    /// A setting is out of its range.
    #[error("{name} of a ground is {least} to {most}{unit}, found `{value}`")]
    OutOfRange {
        /// Name of the setting, for example `relief_mm`.
        name: &'static str,
        /// Unit with a space before it. Empty for a plain number.
        unit: &'static str,
        /// Least value allowed.
        least: f64,
        /// Greatest value allowed.
        most: f64,
        /// Value that was found.
        value: f64,
    },
    /// The relief is higher than heights in quanta allow.
    #[error("a ground may be {highest_mm} mm high over cells of this size, found `{mm}`")]
    #[hint("use larger cells, or a lower ground")]
    TooHigh {
        /// Height found, in mm.
        mm: f64,
        /// Greatest height allowed, in mm.
        highest_mm: f64,
    },
    /// The colour is not written as `#rrggbb`.
    #[error("the colour of a ground is written #rrggbb, found `{0}`")]
    #[hint("or give a number 0 to 1, or {{\"spectrum\": {{..}}}}")]
    Color(String),
    /// The reflectance spectrum is invalid.
    #[error("reflectance of the ground: {0}")]
    Spectrum(#[from] spectra::SpectrumError),
    /// The reflectance spectrum cannot be resampled to the library's grid.
    #[error("reflectance of the ground: {0}")]
    Resampled(#[from] spectra::InterpolateError),
    /// The reflectance spectrum does not overlap the library's wavelengths.
    #[error("the ground is measured from {start_nm} to {end_nm} nm only")]
    #[hint("the library covers {library}")]
    Band {
        /// First wavelength of the spectrum, in nm.
        start_nm: f64,
        /// Last wavelength of the spectrum, in nm.
        end_nm: f64,
        /// The library's grid, for example `380 to 730 nm in steps of 10 nm`.
        library: String,
    },
    /// We cannot mix the paint that tones the ground.
    #[error("the film on the ground: {0}")]
    #[hint(inner)]
    #[fault(Input)]
    Recipe(#[from] pigment::library::RecipeError),
    /// We cannot read the picture of a relief.
    #[error("{path}: {reason}")]
    #[hint("the relief of a ground is a grey picture ({NAMES}), white the highest")]
    Picture {
        /// Path of the picture.
        path: String,
        /// Reason given by the system or the decoder.
        reason: String,
    },
}

/// Returns `value` if it lies within `range`, both ends included.
fn check_range(
    name: &'static str,
    unit: &'static str,
    value: f64,
    [least, most]: [f64; 2],
) -> Result<f64, GroundError> {
    if (least..=most).contains(&value) {
        Ok(value)
    } else {
        Err(GroundError::OutOfRange { name, unit, least, most, value })
    }
}
