//! A painting at rest as files for others: pictures, spectral OpenEXR, pigment maps.
//!
//! Functions here give bytes; who calls them writes the files. The same painting
//! gives the same bytes.

mod pigment_maps;

mod spectral_exr;

mod painting;

pub use painting::{Bands, PictureFile, PictureFormat, painting_maps, picture_file, spectral_file};
pub use pigment_maps::{NamedFile, PigmentMap, pigment_maps};
pub use spectral_exr::spectral_exr;
