//! How far away each pixel is, wherever pictures live.

use super::sight::depth_of;
use crate::gpu::{DeviceError, Kernel, Storage, groups, layout};
use crate::image::Models;
use crate::image::OnCpu;
use crate::image::{OnGpu, Plane};
use crate::surface::Seen;

/// Tells depth from what is seen.
pub trait Depths: Models {
    /// The depth of every pixel: 0 near to 1, where nothing is seen.
    ///
    /// # Errors
    /// [`DeviceError`] if the device has no room or is lost; never on the processor.
    fn depths(&mut self, visible: &Self::Visible) -> Result<Self::Grey, DeviceError>;
}

impl Depths for OnCpu {
    fn depths(&mut self, visible: &Self::Visible) -> Result<Self::Grey, DeviceError> {
        Ok(depth_of(visible))
    }
}

/// What the kernel is told.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct DepthsNow {
    size: [u32; 2],
    spare: [u32; 2],
}

/// The kernel that brings depths from samples to pixels.
pub static DEPTHS: Kernel = Kernel {
    name: "watercolor_depths",
    source: include_str!("depths.wgsl"),
    parameters: layout!(DepthsNow { size, spare }),
    structs: &[layout!(Seen { triangle, second, third, depth })],
    storage: &[Storage::Read, Storage::Write],
};

impl Depths for OnGpu {
    fn depths(&mut self, visible: &Plane) -> Result<Plane, DeviceError> {
        let (width, height) = (visible.width(), visible.height());
        let depths = self.plane(width, height, size_of::<f32>())?;
        let now = DepthsNow { size: [width as u32, height as u32], spare: [0; 2] };
        let buffers = [visible.buffer(), depths.buffer()];
        self.recording.dispatch(&DEPTHS, &now, &buffers, [groups(width), groups(height), 1]);
        Ok(depths)
    }
}
