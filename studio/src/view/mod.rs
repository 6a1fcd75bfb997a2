//! The surfaces on the screen.

mod transform;

mod levels;

mod pipeline;

mod sheet;

mod texture;

mod outline;

mod head;

mod surface;

pub use head::HeadLook;
pub use outline::Outline;
pub use sheet::fill;
pub(crate) use sheet::set_format;
pub use surface::{Hand, Split, SurfaceView};
pub use texture::{Half, Picture};
pub use transform::{Placement, View};
