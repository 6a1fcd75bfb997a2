//! Pictures of maps: what a person looks at first.

mod overview;

#[cfg(feature = "files")]
mod stored_overview;
mod ramp;
mod encoded;
mod of_maps;

pub use encoded::{PictureError, picture_png};
pub use of_maps::{MapPictures, PigmentPictures};
pub use overview::{Overview, OverviewSums};
pub use ramp::Ramp;
