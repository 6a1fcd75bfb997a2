//! The depth of each pixel of a visibility buffer.

use crate::compute::{Compute, GpuCompute, GreyImage, Image, Plane};
use crate::field::Field;
use crate::gpu::{DeviceError, Kernel, Storage, layout};
use crate::surface::{Fragment, VisibilityBuffer};

/// The depth of each pixel: 0 at the near plane to 1 where no triangle is seen.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
///
/// # Panics
/// If another form of [`Compute`] made the image.
pub fn depths(compute: &mut Compute, visible: &Image<Fragment>) -> Result<GreyImage, DeviceError> {
    match compute {
        Compute::Cpu => Ok(depth_field(visible.host()).into()),
        Compute::Gpu(gpu) => depths_on_gpu(gpu, visible.plane()).map(Image::from),
    }
}

/// The depth of each pixel, as [`depths`] computes it on the processor.
#[must_use]
pub fn depth_field(visible: &VisibilityBuffer) -> Field<f32> {
    let depths = visible.values().iter().map(|fragment| fragment.depth);
    Field::from_values(visible.width(), visible.height(), depths.collect())
}

#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct DepthsParams {
    size: [u32; 2],
    spare: [u32; 2],
}

/// The kernel that copies the depth out of each fragment.
pub static DEPTHS: Kernel = Kernel {
    name: "depths",
    source: include_str!("depths.wgsl"),
    parameters: layout!(DepthsParams { size, spare }),
    structs: &[layout!(Fragment { triangle, second, third, depth })],
    storage: &[Storage::Read, Storage::Write],
};

fn depths_on_gpu(
    gpu: &mut GpuCompute,
    visible: &Plane<Fragment>,
) -> Result<Plane<f32>, DeviceError> {
    let (width, height) = visible.size();
    let depths = gpu.plane(width, height)?;
    let params = DepthsParams { size: [width as u32, height as u32], spare: [0; 2] };
    gpu.dispatch(&DEPTHS, &params, &[visible.buffer(), depths.buffer()], (width, height));
    Ok(depths)
}
