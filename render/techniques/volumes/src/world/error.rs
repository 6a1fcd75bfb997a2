//! Errors of worlds.

use documents::hint::{Explain, Fault, Hint};
use glam::Vec3;
use graphics::gpu::DeviceError;

use crate::motion::MotionError;
use crate::wetting::WettingError;

/// Why something cannot be done to a world. Places are in the unit of the scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WorldError {
    /// The surface cannot be wetted.
    #[error(transparent)]
    Wetting(#[from] WettingError),
    /// The volumes cannot be moved.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The graphics device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// A number is out of its range.
    #[error("{key} is {range}, found `{found}`")]
    Number {
        /// Name of the number, for example `film_mm`.
        key: &'static str,
        /// Its range in words.
        range: &'static str,
        /// Its value.
        found: f64,
    },
    /// A recipe without paint, or with a share below 0.
    #[error("a recipe has shares of 0 or more and at least one above, found `{found:?}`")]
    Recipe {
        /// The shares: of eight slots, and at last of vehicle.
        found: Vec<f64>,
    },
    /// A place is too far from the surface.
    #[error("the place `{}, {}, {}` is {distance} from the surface, farther than {most}", place.x, place.y, place.z)]
    OffSurface {
        /// The place.
        place: Vec3,
        /// Its distance from the surface.
        distance: f32,
        /// Greatest distance.
        most: f32,
    },
    /// There are as many volumes as there can be.
    #[error("there is no room for more than {most} {what}")]
    Full {
        /// The things of which there are too many: volumes or particles.
        what: &'static str,
        /// Greatest number.
        most: usize,
    },
    /// There is no such volume, or it cannot be split.
    #[error("volume {index} of {count} {why}")]
    Volume {
        /// Index of the volume.
        index: usize,
        /// Number of volumes.
        count: usize,
        /// The fault.
        why: &'static str,
    },
}

impl Explain for WorldError {
    fn hint(&self) -> Option<Hint> {
        Some(match self {
            Self::Wetting(error) => return error.hint(),
            Self::Motion(error) => return error.hint(),
            Self::Device(error) => return error.hint(),
            Self::Number { .. } => return None,
            Self::Recipe { .. } => Hint::new("name a pigment with a share above 0"),
            Self::OffSurface { .. } => Hint::new("pour at a place of the model's surface"),
            Self::Full { .. } => Hint::verbatim("take larger cells (grid.cell), or fewer volumes"),
            Self::Volume { .. } => {
                Hint::new("name a wet volume; to be split, one for itself that holds surface")
            }
        })
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Wetting(error) => error.fault(),
            Self::Motion(error) => error.fault(),
            Self::Device(error) => error.fault(),
            Self::Number { .. } | Self::Full { .. } => Fault::Setting,
            Self::Recipe { .. } | Self::OffSurface { .. } | Self::Volume { .. } => Fault::Input,
        }
    }
}

/// Checks that a number lies in a range, which no NaN does.
pub(super) fn in_range(
    key: &'static str,
    found: f64,
    [least, most]: [f64; 2],
    range: &'static str,
) -> Result<(), WorldError> {
    match (least..=most).contains(&found) {
        true => Ok(()),
        false => Err(WorldError::Number { key, range, found }),
    }
}
