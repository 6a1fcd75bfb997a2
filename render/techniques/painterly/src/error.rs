//! Why a subject cannot be painted.

use documents::hint::{Explain, Fault, Hint};
use glam::Vec3;
use graphics::gpu::DeviceError;
use graphics::mesh::{DirectionFault, MeshFault};
use paint::ground::GroundError;

use super::color_paint::ColorPaintError;
use super::joined_paint::PaintOfMapsError;
use super::regions::RegionsError;
use super::settings::SettingsError;

/// A model or a picture cannot be painted.
#[derive(Debug, thiserror::Error)]
pub enum PainterError {
    /// A setting is out of its range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// The mesh cannot be drawn.
    #[error(transparent)]
    Mesh(#[from] MeshFault),
    /// Directions cannot be found.
    #[error(transparent)]
    Directions(#[from] DirectionFault),
    /// The mesh cannot be held in memory.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// Regions do not fit the subject.
    #[error(transparent)]
    Regions(#[from] RegionsError),
    /// The paint of several maps cannot be joined.
    #[error(transparent)]
    Maps(#[from] PaintOfMapsError),
    /// No triangle of the mesh has an area.
    #[error("no triangle of the mesh has an area")]
    NoArea,
    /// The map has no tile.
    #[error("the art map has no tile")]
    NoTile,
    /// The map has no pigments, or the width of its texels is unknown.
    #[error("the art map has colours only")]
    NoPaint,
    /// The colours of the subject cannot be painted.
    #[error(transparent)]
    Colors(#[from] ColorPaintError),
    /// The ground cannot be made.
    #[error(transparent)]
    Ground(#[from] GroundError),
    /// The picture has no pixel, or too many.
    #[error("a picture of {width} x {height} pixels cannot be painted")]
    Size {
        /// Its width.
        width: usize,
        /// Its height.
        height: usize,
    },
    /// The time is no number.
    #[error("the time is `{seconds}` seconds")]
    Time {
        /// The time asked for.
        seconds: f64,
    },
    /// The camera looks nowhere.
    #[error("the camera at {eye} looks at {target}, with {up} upwards")]
    Camera {
        /// Its eye.
        eye: Vec3,
        /// Where it looks.
        target: Vec3,
        /// Its upwards direction.
        up: Vec3,
    },
}

impl PainterError {
    fn cause(&self) -> Option<&dyn Explain> {
        Some(match self {
            Self::Settings(error) => error,
            Self::Mesh(error) => error,
            Self::Directions(error) => error,
            Self::Device(error) => error,
            Self::Ground(error) => error,
            Self::Regions(error) => error,
            Self::Maps(error) => error,
            Self::Colors(error) => error,
            _ => return None,
        })
    }
}

impl Explain for PainterError {
    fn hint(&self) -> Option<Hint> {
        let text = match self {
            Self::NoArea => "the model is a line or a point: export it again",
            Self::NoTile => "build the map again from at least one sample",
            Self::NoPaint => "build a map of samples from an impasto painting or a painted style",
            Self::Size { .. } => "pictures have 1 to 268435456 pixels",
            Self::Time { .. } => "times are seconds from the start, for example 0.5",
            Self::Camera { .. } => {
                "place the eye away from its target, and let upwards point elsewhere than there"
            }
            _ => return self.cause()?.hint(),
        };
        Some(Hint::new(text))
    }

    fn fault(&self) -> Fault {
        match (self.cause(), self) {
            (Some(cause), _) => cause.fault(),
            (None, Self::NoArea | Self::NoTile | Self::NoPaint) => Fault::Input,
            _ => Fault::Setting,
        }
    }
}
