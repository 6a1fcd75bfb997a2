//! The layer panel: drying, and names, order, visibility, opacity and merging of layers.

mod thumbnails;
mod eye;
mod opacity;
mod stiffness;
mod pigments;
mod chosen;
mod naming;
mod order;
mod row;
mod panel;

pub use panel::{Layers, dry};
