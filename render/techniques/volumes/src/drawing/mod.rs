//! The picture: a grey drawing into which volumes bring colour.
mod look;
mod shade;
mod shells;
mod reveal;

pub use look::{DrawingError, DrawingLook, GreyWeights, grey_of};
pub use reveal::{Inside, MOST_REGIONS, Region, checked_regions, reveal};
pub use shade::{shade, shade_apart};
pub use shells::{MOST_SHELLS, ShellError, Shells, TintTable};

pub(crate) use reveal::{FINISH, REGION};
pub(crate) use shade::SHADE;
