//! Pictures for others: PNG, OpenEXR, spectral OpenEXR, pigment maps, animations.
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

mod frame;

mod colour_table;

mod animation;

mod sequence;

pub use animation::{Apng, Gif};
pub use colour_table::ColourTable;
pub use error::ExportError;
pub use frame::{Frame, FrameError, FrameRate, frame_of, frame_png, read_frame};
pub use linear_exr::{FloatBits, linear_exr};
pub use painting::{Bands, PictureFile, PictureFormat, painting_maps, picture_file, spectral_file};
pub use pigment_maps::{NamedFile, PigmentMap, pigment_maps};
pub use png::{Png, png8, png16};
pub use sequence::{Sequence, SequenceError, Shots};
pub use spectral_exr::spectral_exr;
