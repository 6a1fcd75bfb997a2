//! The columns of panels at both sides of the window: tabs in groups that are folded, resized
//! and dragged to other places.

mod panels;
mod table;
mod divider;
mod drop;
mod header;
mod dock;

pub(super) use divider::{Line, divider};
pub(super) use dock::Drawn;
pub use panels::{Panels, Tab};
