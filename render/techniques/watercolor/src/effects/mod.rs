//! The effects of watercolor on a picture, one file each.
//!
//! Each effect is a function over [`graphics::compute::Compute`]. It has a form for the processor,
//! which is the specification, and a kernel that agrees with this form to rounding.

mod density;
mod edges;
mod dry_brush;
mod paper_shading;

pub use density::{DensityLayer, apply_density};
pub use dry_brush::{ColorRange, DryBrushReach, apply_dry_brush, color_mask};
pub use edges::{edges, wobble};
pub use paper_shading::{PaperShading, shade_paper};

pub(super) use density::DENSITY;
pub(super) use dry_brush::{COLOR_MASK, DRY_BRUSH};
pub(super) use edges::{EDGE_BLUR, EDGES, WOBBLE, edges_on_cpu};
pub(super) use paper_shading::PAPER_SHADING;
