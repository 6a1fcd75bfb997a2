//! Wet and dry: drying, dry layers.

mod thumbnails;

mod eye;

mod opacity;

mod panel;

pub use panel::{Layers, dry};
