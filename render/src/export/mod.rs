//! Pictures for others: PNG, OpenEXR, spectral OpenEXR, pigment maps.
//!
//! Functions here take plain data, or a painting at rest, and give bytes; who calls
//! them writes the files. The same data give the same bytes.

mod error;

mod exr_part;

mod linear_exr;

mod pigment_maps;

mod png;

mod spectral_exr;

mod painting;

pub use error::ExportError;
pub use linear_exr::{FloatBits, linear_exr};
pub use painting::{Bands, PictureFile, PictureFormat, painting_maps, picture_file, spectral_file};
pub use pigment_maps::{NamedFile, PigmentMap, pigment_maps};
pub use png::{Png, png8, png16};
pub use spectral_exr::spectral_exr;
