//! The layer panel: drying, opacity and merging of layers.

mod thumbnails;

mod eye;

mod opacity;

mod stiffness;

mod panel;

pub use panel::{Layers, dry};
