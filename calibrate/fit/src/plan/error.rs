//! Reasons why there is no plan.

use documents::Cancelled;
use documents::hint::{Explain, Fault, Hint};
use pigment::RecipeError;

/// A plan that cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// A name cannot head a pigment's column of a measurement file.
    #[error("a measurement file would not read this as a pigment's name: `{name}`")]
    Name {
        /// Name of the paint.
        name: String,
    },
    /// Two paints have one name.
    #[error("each paint is named once, found twice `{name}`")]
    Twice {
        /// Name of both paints.
        name: String,
    },
    /// There is no paint besides the white.
    #[error("a plan needs a pigment beside the white")]
    NoColor,
    /// The number of swatches is out of range.
    #[error("{paints} paints are planned with {least} to {most} swatches, found `{swatches}`")]
    Swatches {
        /// Number of paints.
        paints: usize,
        /// Least number of swatches: one for each unknown of a wavelength.
        least: usize,
        /// Greatest number of swatches: every recipe that can be weighed.
        most: usize,
        /// Number of swatches that was requested.
        swatches: usize,
    },
    /// The mass of a swatch is too small for the balance: a tint of 1 to 4 cannot be weighed.
    #[error(
        "a tint of 1 to 4 needs {needed} g a swatch on a balance that shows {resolution} g, found `{grams}`"
    )]
    Grams {
        /// Least mass of a swatch in grams.
        needed: f64,
        /// Step of the balance in grams.
        resolution: f64,
        /// Mass of a swatch that was requested, in grams.
        grams: f64,
    },
    /// A number is not above 0.
    #[error("{what} must be above 0 and finite, found `{value}`")]
    NotPositive {
        /// Name of the quantity.
        what: &'static str,
        /// Value that was given.
        value: f64,
    },
    /// Expected errors are out of range.
    #[error(
        "expected noise is two errors from 0 to below 1, one of them above 0, found `{constant}` and `{even}`"
    )]
    Noise {
        /// Error of the instrument that was given.
        constant: f64,
        /// Error of weighing and mixing that was given.
        even: f64,
    },
    /// The swatches would not identify every pigment.
    #[error("these swatches would not identify `{}`", paints.join(", "))]
    Unidentified {
        /// Names of the paints that would not be identified.
        paints: Vec<String>,
    },
    /// A name does not denote one pigment of the prior library.
    #[error(transparent)]
    Prior(#[from] RecipeError),
    /// The search was asked to end before its time.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Explain for PlanError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::Name { .. } => {
                "use a word that is none of the file's own columns (sample, film, backing, thickness_mm, replicate) and no number".into()
            }
            Self::Twice { .. } => "remove one, or give the second paint another name".into(),
            Self::NoColor => {
                "name the pigments: impasto plan \"Cobalt Blue\" [white=\"Titanium White\"]".into()
            }
            Self::Swatches { least, most, swatches, .. } => {
                if swatches < least {
                    format!("try [swatches={least}] or more; K of every paint and S of all but the white are unknown")
                } else {
                    format!("try [swatches={most}] or fewer; [replicates] repeat one swatch")
                }
            }
            Self::Grams { needed, .. } => format!("try [grams={needed}], or a finer [balance]"),
            Self::NotPositive { .. } => "give grams, such as [grams=10] [balance=0.01]".into(),
            Self::Noise { .. } => "try 0.002 of the instrument and 0.01 of weighing and mixing".into(),
            Self::Unidentified { .. } => "give more [swatches]".into(),
            Self::Prior(error) => return error.hint(),
            Self::Cancelled(error) => return error.hint(),
        }))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Unidentified { .. } | Self::Prior(_) => Fault::Input,
            Self::Cancelled(error) => error.fault(),
            _ => Fault::Setting,
        }
    }
}
