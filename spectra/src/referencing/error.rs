//! Why counts give no reflectance.

use crate::hint::{Explain, Hint};
use crate::instrument::MeasuredQuantity;

/// What is wrong between a sample, its white and its dark.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReferencingError {
    /// A reading that is no light any more.
    #[error("the {role} `{name}` must be counts or power to be referenced, found `{found}`")]
    Quantity {
        /// Sample, white or dark.
        role: &'static str,
        /// The reading.
        name: String,
        /// What it is.
        found: MeasuredQuantity,
    },
    /// The white's own reflectance is given as something else.
    #[error("the tile `{name}` must be a reflectance, found `{found}`")]
    TileQuantity {
        /// The record.
        name: String,
        /// What it is.
        found: MeasuredQuantity,
    },
    /// Counts against power.
    #[error("the {role} `{name}` must be {wanted} as the sample is, found `{found}`")]
    Mixed {
        /// White or dark.
        role: &'static str,
        /// The reading.
        name: String,
        /// What the sample is.
        wanted: MeasuredQuantity,
        /// What the reading is.
        found: MeasuredQuantity,
    },
    /// Counts hold the detector's own signal.
    #[error("counts of the {role} `{name}` need a dark reading")]
    NoDark {
        /// Sample or white.
        role: &'static str,
        /// The reading.
        name: String,
    },
    /// The dark was taken at another integration time.
    #[error(
        "the {role} `{name}` was integrated for {time_ms} ms, and a dark of that time is wanted; found `{found}`"
    )]
    DarkTime {
        /// Sample or white.
        role: &'static str,
        /// The reading.
        name: String,
        /// Its integration time.
        time_ms: f64,
        /// The times of the darks.
        found: String,
    },
    /// Several darks, and no time to choose by.
    #[error(
        "which of {darks} darks belongs to the {role} is unknown: no integration time in `{name}`"
    )]
    UnknownTime {
        /// Sample or white.
        role: &'static str,
        /// The reading.
        name: String,
        /// How many darks there are.
        darks: usize,
    },
    /// The detector was full.
    #[error("the {role} `{name}` is saturated at {nm} nm, at `{value}`")]
    Saturated {
        /// Sample or white.
        role: &'static str,
        /// The reading.
        name: String,
        /// Where.
        nm: f64,
        /// The value at which it stops.
        value: f64,
    },
    /// Too little light to divide by.
    #[error(
        "the white `{name}` has too little light at {nm} nm: {least:.4} above its dark is wanted, found `{light:.4}`"
    )]
    Dim {
        /// The white.
        name: String,
        /// Where.
        nm: f64,
        /// White less dark.
        light: f64,
        /// What it must exceed.
        least: f64,
    },
    /// A reading that does not reach as far as the sample.
    #[error("the {role} has no value at `{nm}` nm, where the sample has one")]
    Uncovered {
        /// White, dark or tile.
        role: &'static str,
        /// Where.
        nm: f64,
    },
    /// Well below the dark.
    #[error("the sample `{name}` reads below its dark at {nm} nm: reflectance `{reflectance}`")]
    BelowDark {
        /// The sample.
        name: String,
        /// Where.
        nm: f64,
        /// What would come out.
        reflectance: f64,
    },
    /// Nothing that an eye sees.
    #[error("the sample `{name}` has no wavelength from 380 to 730 nm")]
    Invisible {
        /// The sample.
        name: String,
    },
    /// The white's own reflectance is none.
    #[error("the tile's reflectance must be above 0 and at most 1.2, found `{value}`")]
    Tile {
        /// The value, as a fraction.
        value: f64,
    },
}

impl Explain for ReferencingError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::Quantity { .. } => {
                "export the raw counts, or leave [white] and [dark] out: reflectance needs neither"
            }
            Self::Mixed { .. } => "export sample, white and dark the same way",
            Self::NoDark { .. } => {
                "add [dark=FILE] (the same integration time, light shut off), or [dark=0] if the dark is subtracted already"
            }
            Self::DarkTime { .. } | Self::UnknownTime { .. } => {
                "a dark does not scale with time: take one at each integration time and give [dark] for each"
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
