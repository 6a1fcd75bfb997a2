//! How lights render colours: the colour rendering index of CIE 13.3-1995, and fidelity and gamut of
//! ANSI/IES TM-30-18, whose fidelity index is that of CIE 224:2017.

mod samples;
mod reference_light;
mod rendering_index;
mod appearance;
mod fidelity;
mod of_light;

pub use fidelity::ColorFidelity;
pub use of_light::{ColorRendering, ColorRenderingError};
pub use rendering_index::RenderingIndex;
