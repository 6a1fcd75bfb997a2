//! Reasons why there is no fit or no validation.

use documents::hint::{Explain, Fault, Hint};

use crate::calibration::CalibrationError;
use crate::measurement::MeasurementError;
use pigment::visible_band::BandError;

/// A fit or validation that cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FittingError {
    /// A sample or pigment is not among the readings.
    #[error("no {what} is called `{name}`")]
    UnknownName {
        /// `sample` or `pigment`.
        what: &'static str,
        /// Name that was looked up.
        name: String,
        /// Names that exist.
        known: Vec<String>,
    },
    /// No pigment can be guessed as the reference.
    #[error("no pigment is called white, so none can be the reference whose S is 1")]
    NoWhite {
        /// Name of the first pigment, for advice.
        first: String,
    },
    /// Every sample is excluded.
    #[error("every sample is excluded")]
    AllExcluded,
    /// Absolute amounts have no reference and a method of their own.
    #[error("absolute amounts take neither a reference white nor another method")]
    AbsoluteOptions,
    /// A validation of absolute amounts cannot be limited to pigments.
    #[error("a validation with certain pigments needs relative amounts")]
    AbsoluteWith,
    /// Films of absolute amounts do not hide, so that they have no residuals for maps.
    #[error("residuals of films that hide need relative amounts")]
    AbsoluteResiduals,
    /// A validation needs two groups or more.
    #[error("a validation in groups needs at least 2, found `{folds}`")]
    Folds {
        /// Number of groups that was given.
        folds: usize,
    },
    /// No mixture can be left out.
    #[error("{}", nothing_to_leave_out(needed))]
    NothingToLeaveOut {
        /// Mixtures without which a pigment would not be identified.
        needed: Vec<String>,
    },
    /// The readings have no visible wavelength.
    #[error(transparent)]
    Band(#[from] BandError),
    /// Readings cannot be used.
    #[error(transparent)]
    Measurement(#[from] MeasurementError),
    /// Readings cannot be used, or the fit failed.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
}

fn nothing_to_leave_out(needed: &[String]) -> String {
    if needed.is_empty() {
        return "there is no mixture to leave out".to_owned();
    }
    let needed = needed.join(", ");
    format!("no mixture can be left out: without it a pigment would not be identified ({needed})")
}

impl Explain for FittingError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::UnknownName { what, name, known } => {
                let question = documents::did_you_mean(name, known.iter().map(String::as_str));
                let question = question.map_or_else(String::new, |question| question + " ");
                return Some(Hint::verbatim(format!("{question}{what}s: {}", known.join(", "))));
            }
            Self::NoWhite { first } => format!("name it: [reference=\"{first}\"]"),
            Self::AllExcluded => "leave out some [exclude]".into(),
            Self::AbsoluteOptions => "leave out [reference] and [method]".into(),
            Self::AbsoluteWith => "leave out [with]".into(),
            Self::AbsoluteResiduals => "leave out [residuals]".into(),
            Self::Folds { .. } => "try [folds=10]".into(),
            Self::NothingToLeaveOut { .. } => {
                "measure more mixtures of each pigment (masstone, two tints, a shade)".into()
            }
            Self::Band(error) => return error.hint(),
            Self::Measurement(error) => return error.hint(),
            Self::Calibration(error) => return error.hint(),
        }))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::AbsoluteOptions
            | Self::AbsoluteWith
            | Self::AbsoluteResiduals
            | Self::Folds { .. } => Fault::Setting,
            Self::Measurement(error) => error.fault(),
            Self::Calibration(error) => error.fault(),
            _ => Fault::Input,
        }
    }
}
