//! Pictures of maps: what a person looks at first.

mod overview;

mod ramp;

mod encoded;

pub use encoded::{PictureError, picture_png};
pub use overview::Overview;
pub use ramp::Ramp;
