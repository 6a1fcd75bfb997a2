//! State of the kept mixtures.

use session::swatches::SwatchBook;
use spectra::swatch_file::SwatchFile;

/// The kept mixtures, and what of them is in their file.
#[derive(Debug, Default)]
pub(super) struct SwatchList {
    /// Mixtures as the painter sees them.
    pub(super) book: SwatchBook,
    /// Mixtures in the file; `None` until it was read.
    pub(super) written: Option<SwatchBook>,
    /// Whether reading has begun.
    pub(super) asked: bool,
    /// Colours that were imported and not taken yet.
    pub(super) colors: Option<SwatchFile>,
}
