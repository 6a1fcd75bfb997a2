//! Exports of a painting for other programs: pictures, layers, spectral OpenEXR and pigment maps.
//!
//! [`PaintingExports`] writes the files of a painting in progress. The other functions
//! encode a document in memory; the same document always gives the same bytes.

mod pigment_maps;
mod spectral_exr;
mod painting;
mod alpha;
mod layers;
mod save;

pub use layers::layers_file;
pub use painting::{SpectralBands, painting_maps, spectral_file};
pub use pigment_maps::{NamedFile, PigmentMap, pigment_maps};
pub use save::{PaintingExportError, PaintingExports, PutFile, save_files};
pub use spectral_exr::spectral_exr;
