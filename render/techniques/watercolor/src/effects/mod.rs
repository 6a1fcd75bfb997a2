//! The effects of watercolor on a picture, one file each.
//!
//! Each effect is a function over [`graphics::compute::Compute`] with a form for the
//! processor, which is its specification, and a kernel that agrees with it to rounding.

mod density;
mod edges;
mod wobble;
mod color_mask;
mod dry_brush;
mod paper_shading;

pub use color_mask::{ColorRange, color_mask};
pub use density::{DensityLayer, apply_density};
pub use dry_brush::{DryBrushReach, apply_dry_brush};
pub use edges::edges;
pub use paper_shading::{PaperShading, shade_paper};
pub use wobble::wobble;

pub(super) use color_mask::COLOR_MASK;
pub(super) use density::DENSITY;
pub(super) use dry_brush::DRY_BRUSH;
pub(super) use edges::{EDGE_BLUR, EDGES, edges_on_cpu};
pub(super) use paper_shading::PAPER_SHADING;
pub(super) use wobble::WOBBLE;
