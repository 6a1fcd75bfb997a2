//! Pictures that are worked on, with the processor or on a graphics device.

mod backend;

mod on_cpu;

mod on_gpu;

mod models;

pub use backend::Backend;
pub use models::{CpuModel, GpuModel, Models};
pub use on_cpu::OnCpu;
pub use on_gpu::{OnGpu, Plane};
