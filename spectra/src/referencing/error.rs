//! Errors in computing reflectance from counts.

use crate::instrument::MeasuredQuantity;
use documents::hint::{Explain, Hint};

/// Readings of sample, white and dark that do not give a reflectance.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReferencingError {
    /// A reading is neither counts nor power.
    #[error("the {role} `{name}` must be counts or power to be referenced, found `{found}`")]
    Quantity {
        /// `sample`, `white` or `dark`.
        role: &'static str,
        /// Name of the reading.
        name: String,
        /// Quantity of the reading.
        found: MeasuredQuantity,
    },
    /// The white's own reflectance is given as another quantity.
    #[error("the tile `{name}` must be a reflectance, found `{found}`")]
    TileQuantity {
        /// Name of the tile's spectrum.
        name: String,
        /// Quantity of the spectrum.
        found: MeasuredQuantity,
    },
    /// Counts and power are mixed.
    #[error("the {role} `{name}` must be {expected} like the sample, found `{found}`")]
    Mixed {
        /// `white` or `dark`.
        role: &'static str,
        /// Name of the reading.
        name: String,
        /// Quantity of the sample.
        expected: MeasuredQuantity,
        /// Quantity of the reading.
        found: MeasuredQuantity,
    },
    /// Counts contain the signal of the detector without light, so they need a dark.
    #[error("counts of the {role} `{name}` need a dark reading")]
    NoDark {
        /// `sample` or `white`.
        role: &'static str,
        /// Name of the reading.
        name: String,
    },
    /// No dark was taken at the integration time of the reading.
    #[error(
        "the {role} `{name}` was integrated for {time_ms} ms, but no dark was; found `{found}`"
    )]
    DarkTime {
        /// `sample` or `white`.
        role: &'static str,
        /// Name of the reading.
        name: String,
        /// Integration time of the reading in ms.
        time_ms: f64,
        /// Integration times of the darks, as text.
        found: String,
    },
    /// There are several darks, and the reading does not state its integration time.
    #[error("cannot select one of {darks} darks for the {role}: no integration time in `{name}`")]
    UnknownTime {
        /// `sample` or `white`.
        role: &'static str,
        /// Name of the reading.
        name: String,
        /// Number of darks.
        darks: usize,
    },
    /// The detector is saturated.
    #[error("the {role} `{name}` is saturated at {nm} nm, at `{value}`")]
    Saturated {
        /// `sample` or `white`.
        role: &'static str,
        /// Name of the reading.
        name: String,
        /// Wavelength in nm.
        nm: f64,
        /// Value at which the detector saturates.
        value: f64,
    },
    /// The white has too little light to divide by.
    #[error(
        "the white `{name}` has too little light at {nm} nm: expected {least:.4} above its dark, found `{light:.4}`"
    )]
    Dim {
        /// Name of the white.
        name: String,
        /// Wavelength in nm.
        nm: f64,
        /// Signal of the white minus its dark.
        light: f64,
        /// The signal that it must exceed.
        least: f64,
    },
    /// A reading does not cover a wavelength of the sample.
    #[error("the {role} has no value at `{nm}` nm, where the sample has one")]
    Uncovered {
        /// `white`, `dark` or `tile`.
        role: &'static str,
        /// Wavelength in nm.
        nm: f64,
    },
    /// The sample is darker than its dark by more than noise.
    #[error("the sample `{name}` reads below its dark at {nm} nm: reflectance `{reflectance}`")]
    BelowDark {
        /// Name of the sample.
        name: String,
        /// Wavelength in nm.
        nm: f64,
        /// The negative reflectance that results.
        reflectance: f64,
    },
    /// The sample has no visible wavelength.
    #[error("the sample `{name}` has no wavelength from 380 to 730 nm")]
    Invisible {
        /// Name of the sample.
        name: String,
    },
    /// The white's own reflectance is out of range.
    #[error("the tile's reflectance must be above 0 and at most 1.2, found `{value}`")]
    Tile {
        /// Reflectance of the tile, as a fraction.
        value: f64,
    },
}

impl Explain for ReferencingError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::Quantity { .. } => {
                "export the raw counts, or leave [white_reading] and [dark_reading] out: reflectance needs neither"
            }
            Self::Mixed { .. } => "export sample, white and dark the same way",
            Self::NoDark { .. } => {
                "add [dark_reading=FILE] (the same integration time, light shut off), or [dark_reading=0] if the dark is subtracted already"
            }
            Self::DarkTime { .. } | Self::UnknownTime { .. } => {
                "a dark does not scale with time: take one at each integration time and give [dark_reading] for each"
            }
            Self::Saturated { .. } => {
                "measure again with a shorter integration time; if the detector was not saturated, give its largest count with [full_scale]"
            }
            Self::Dim { .. } => {
                "measure with more light there or a longer integration time, or lower [least_light]"
            }
            Self::Uncovered { .. } => "measure over all wavelengths of the sample",
            Self::BelowDark { .. } => "check that sample and dark were not interchanged",
            Self::Tile { .. } | Self::TileQuantity { .. } => {
                "give a fraction, such as [tile=0.99], or a file of its reflectance"
            }
            Self::Invisible { .. } => return None,
        }))
    }
}
