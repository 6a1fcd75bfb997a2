//! The graphics device: adapters, buffers, kernels, recorded commands and readback. This
//! folder has no code specific to paint, and no other folder uses wgpu directly.
//!
//! Kernels keep to what every WebGPU device has: 8 storage buffers, workgroups of 64 invocations
//! and 32-bit numbers. Buffers may be as large as the adapter allows.

mod error;
mod layout;
mod kernel;
mod raster;
mod stencil;
mod binding;
mod pipeline;
mod raster_pipeline;
mod stencil_pipeline;
mod rows;
mod adapter;
mod device;
mod choose;
mod target;
mod stencil_target;
mod recording;
mod transfer;
mod drawing;
mod stencil_drawing;
mod submission;

pub use adapter::{Adapter, BackendChoice, Kind, Limits, adapters, best};
pub use choose::choose;
pub use device::{Buffer, Device};
pub use error::DeviceError;
pub use kernel::{GROUP, Kernel, Storage, groups};
pub use layout::Layout;
pub use layout::layout;
pub use raster::RasterShader;
pub use recording::{Recording, TriangleList, Triangles};
pub use rows::Rows;
pub use stencil::{ScatterShader, StencilShader};
pub use stencil_target::StencilTarget;
pub use target::Target;
