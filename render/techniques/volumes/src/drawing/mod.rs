//! The picture: a grey drawing into which volumes bring colour.

mod error;
mod grey;
mod look;
mod shade;
mod shells;
mod regions;
mod reveal;

pub use error::DrawingError;
pub use grey::{GreyWeights, grey_of};
pub use look::DrawingLook;
pub use regions::{Inside, MOST_REGIONS, Region, checked_regions};
pub use reveal::reveal;
pub use shade::{shade, shade_apart};
pub use shells::{MOST_SHELLS, ShellError, Shells, TintTable};

pub(crate) use reveal::{FINISH, REGION};
pub(crate) use shade::SHADE;
