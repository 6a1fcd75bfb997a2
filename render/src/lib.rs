//! Painting techniques with calibrated pigments: photographs in strokes, and
//! watercolor of photographs and models.
//!
//! Techniques never know each other. What they share stands in the crates
//! `graphics` and `paint`, whose modules are here too, so that a program depends on
//! `render` alone.

pub use graphics::kernels as graphics_kernels;
pub use graphics::{
    camera, coherence, compute, distant_light, encoding, field, gpu, mesh, morphology, orientation,
    picture, segmentation, surface, tile, tones,
};
pub use paint::{self, amount, composite, layer, light, node_pigments, optics, separation, shade};

/// Files for others, of pictures and of paintings.
pub mod export {
    pub use graphics::export::*;
    pub use paint::export::*;
}

pub mod photograph;

pub mod watercolor;
