//! Reasons why a picture cannot be drawn.

use documents::hint::{Explain, Fault, Hint};
use graphics::gpu::DeviceError;

/// A picture cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DrawingError {
    /// The graphics device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// A setting is out of its range, or no number.
    #[error("{name} is {least} to {most}, found `{found}`")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Least value.
        least: f32,
        /// Greatest value.
        most: f32,
        /// The value that was given.
        found: f32,
    },
    /// There are more regions than a picture can have.
    #[error("a picture has at most {most} regions, found `{found}`")]
    Regions {
        /// Greatest number of regions.
        most: usize,
        /// The number that was given.
        found: usize,
    },
}

impl Explain for DrawingError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Device(error) => error.hint(),
            Self::Setting { least, most, .. } => {
                Some(Hint::new(format!("give a number from {least} to {most}")))
            }
            Self::Regions { .. } => Some(Hint::new("let volumes of one colour share a region")),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Device(error) => error.fault(),
            Self::Setting { .. } | Self::Regions { .. } => Fault::Setting,
        }
    }
}

/// Checks that a setting lies in its range; NaN does not.
pub(super) fn check_range(
    name: &'static str,
    found: f32,
    [least, most]: [f32; 2],
) -> Result<(), DrawingError> {
    if (least..=most).contains(&found) {
        return Ok(());
    }
    Err(DrawingError::Setting { name, least, most, found })
}
