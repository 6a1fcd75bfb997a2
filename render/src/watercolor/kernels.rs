//! All kernels of watercolor, in one list.

use super::{color_mask, density, dry_brush, edges, morphology, sheet, toon, wobble};
use graphics::coherence;
use graphics::gpu::Kernel;

/// Every kernel that watercolor on a device runs.
#[must_use]
pub fn kernels() -> Vec<&'static Kernel> {
    vec![
        &toon::TOON,
        &morphology::CROSSING,
        &coherence::DEPTHS,
        &coherence::GATHER_SPLATS,
        &coherence::ANCHOR_TEXTURES,
        &density::DENSITY,
        &edges::EDGE_BLUR,
        &edges::EDGES,
        &wobble::WOBBLE,
        &dry_brush::DRY_BRUSH,
        &color_mask::COLOR_MASK,
        &sheet::SHEET,
    ]
}
