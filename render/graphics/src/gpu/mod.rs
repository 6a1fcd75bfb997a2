//! The graphics device: adapters, buffers, kernels, recording, readback. Knows
//! nothing of paint; the only folder that names wgpu.
//!
//! Kernels keep to what every WebGPU device has: 8 storage buffers, groups of
//! 8 x 8, 32-bit numbers. Buffers may be as large as the adapter lends.

mod error;

mod layout;

mod kernel;

mod raster;

mod adapter;

mod device;

mod target;

mod recording;

mod transfer;

mod pipeline;

mod drawing;

pub use adapter::{Adapter, BackendChoice, Kind, Limits, adapters, best, choose};
pub use device::{Buffer, Device};
pub use error::DeviceError;
pub use kernel::{GROUP, Kernel, Storage, groups};
pub use layout::Layout;
pub use layout::layout;
pub use raster::RasterShader;
pub use recording::{Recording, Triangles};
pub use target::Target;
pub use transfer::Rows;
