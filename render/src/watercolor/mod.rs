//! Watercolor from photographs and meshes.
//!
//! After Bousseau, Kaplan, Thollot and Sillion, "Interactive watercolor rendering
//! with temporal coherence and abstraction" (NPAR 2006). Two doors, photograph and
//! mesh, lead to one room, the [`Wash`]; effects then do the same to both.
//!
//! Colours are encoded sRGB in 0..1, as the paper has them: a change of density is
//! then about even to the eye.

mod wash;

mod backend;

mod on_cpu;

mod on_gpu;

mod segmentation;

mod octagon;

mod morphology;

mod photograph_door;

mod kernels;

pub use backend::Backend;
pub use kernels::kernels;
pub use morphology::Morphology;
pub use octagon::{Brush, Extreme};
pub use on_cpu::OnCpu;
pub use on_gpu::{OnGpu, Plane};
pub use photograph_door::{
    AbstractedPhotograph, PhotographDoorError, PhotographSettings, from_photograph,
};
pub use segmentation::{Segmentation, SegmentationError, SegmentationSettings, segment};
pub use wash::{Controls, Wash};
