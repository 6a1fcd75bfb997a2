//! Errors of painting a scene with its volumes.

use documents::Cancelled;
use documents::hint::Explain;
use graphics::export::ExportError;
use graphics::gpu::DeviceError;
use graphics::mesh::MeshFault;

use crate::drawing::{DrawingError, ShellError};
use crate::pigments::FilmPaintError;

/// A scene with its volumes cannot be painted.
#[derive(Debug, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum PaintingError {
    /// The mesh has a fault.
    #[error("the scene has a fault: {0}")]
    #[fault(Input)]
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
    #[hint("give a smaller [width] and [height]")]
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
    #[hint("give one style for each region")]
    Region {
        /// Index of the region.
        region: usize,
        /// Number of regions.
        regions: usize,
    },
    /// There are no pigments to paint with.
    #[error("a painting needs a library of pigments")]
    #[hint("add [pigments]")]
    NoPigments,
    /// The work was asked to end.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
