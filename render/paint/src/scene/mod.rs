//! Viewing of a painting at rest: the parameters of its [`Scene`](crate::optics::Scene), its
//! picture without a paint engine, and the exact spectrum of every cell.

mod appearance;
mod picture;
mod fine_picture;
mod spectral;

pub use appearance::{Appearance, scene};
pub use fine_picture::{PixelsPerCell, PixelsPerCellError, fine_picture};
pub use picture::{picture, picture_of_lowest};
pub use spectral::{SeenPaint, SpectralDocument, SpectralStack};
