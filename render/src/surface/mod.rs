//! What of a mesh is seen, pixel by pixel.

mod visible;

pub use visible::{NOTHING, Seen, Visible};
