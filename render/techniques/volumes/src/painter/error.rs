//! Errors of painting a scene with its volumes.

use documents::hint::{Explain, Fault, Hint};
use graphics::export::ExportError;
use graphics::gpu::DeviceError;
use graphics::mesh::MeshFault;

use crate::drawing::{DrawingError, ShellError};
use crate::pigments::FilmPaintError;

/// A scene with its volumes cannot be painted.
#[derive(Debug, thiserror::Error)]
pub enum PaintingError {
    /// The mesh has a fault.
    #[error("the scene has a fault: {0}")]
    Scene(#[from] MeshFault),
    /// The picture cannot be drawn.
    #[error(transparent)]
    Drawing(#[from] DrawingError),
    /// Shells or tints of a region cannot be used.
    #[error(transparent)]
    Shells(#[from] ShellError),
    /// The pigments cannot be used.
    #[error(transparent)]
    Films(#[from] FilmPaintError),
    /// The graphics device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The file cannot be written.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// The picture has no pixels, or too many.
    #[error("a picture has 1 to {most} pixels, found `{width} x {height}`")]
    Size {
        /// Greatest number of pixels.
        most: usize,
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
    },
    /// A volume belongs to a region that the painter does not have.
    #[error("a volume belongs to region {region}, and there are `{regions}`")]
    Region {
        /// Index of the region.
        region: usize,
        /// Number of regions.
        regions: usize,
    },
    /// There are no pigments to paint with.
    #[error("a painting needs a library of pigments")]
    NoPigments,
}

impl PaintingError {
    fn cause(&self) -> Option<&dyn Explain> {
        match self {
            Self::Drawing(error) => Some(error),
            Self::Shells(error) => Some(error),
            Self::Films(error) => Some(error),
            Self::Device(error) => Some(error),
            Self::Export(error) => Some(error),
            Self::Scene(_) | Self::Size { .. } | Self::Region { .. } | Self::NoPigments => None,
        }
    }
}

impl Explain for PaintingError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Size { .. } => Some(Hint::new("give a smaller [width] and [height]")),
            Self::Region { .. } => Some(Hint::new("give one style for each region")),
            Self::NoPigments => Some(Hint::new("add [pigments]")),
            _ => self.cause().and_then(Explain::hint),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Scene(_) => Fault::Input,
            _ => self.cause().map_or(Fault::Setting, Explain::fault),
        }
    }
}
