//! The graphics device: adapters, buffers, kernels, recorded commands and readback. This folder
//! has no code specific to paint, and no other folder uses wgpu directly.
//!
//! You can run our kernels on every WebGPU device: they need 8 storage buffers, workgroups of 64
//! invocations and 32-bit numbers. Buffers may be as large as the adapter allows.
mod pipelines;
mod adapter;
mod device;
mod target;
mod recording;
mod submission;

pub use adapter::{Adapter, BackendChoice, DeviceError, Kind, Limits, adapters, best};
pub use device::{Buffer, Device, choose};
pub use pipelines::{
    GROUP, Kernel, Layout, RasterShader, ScatterShader, StencilShader, Storage, groups, layout,
};
pub use recording::{Recording, TriangleList, Triangles};
pub use target::{Rows, StencilTarget, Target};
