//! The minimum or maximum of the pixels under a structuring element.

use super::extremum_on_cpu::extremum_into;
use super::structuring_element::{Extremum, StructuringElement};
use crate::compute::{ColorImage, Compute, GpuCompute, Image, Plane, assert_size};
use crate::field::Field;
use crate::gpu::{DeviceError, Kernel, Storage, layout};

/// The extremum of each channel under `element`, which is centred on each pixel in turn.
/// Pixels outside the picture are ignored. The memory of `spare`, an image of the same
/// size that is not needed any more, may be used for the result.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
///
/// # Panics
/// If `spare` has another size, or another form of [`Compute`] made an image.
pub fn extremum(
    compute: &mut Compute,
    color: &ColorImage,
    element: StructuringElement,
    which: Extremum,
    spare: Option<ColorImage>,
) -> Result<ColorImage, DeviceError> {
    if let Some(spare) = &spare {
        assert_size("spare memory", spare.size(), color.size());
    }
    match compute {
        Compute::Cpu => {
            let (width, height) = color.size();
            let mut result =
                spare.map_or_else(|| Field::filled(width, height, [0.0; 4]), Image::into_host);
            extremum_into(color.host(), element, which, &mut result);
            Ok(result.into())
        }
        Compute::Gpu(gpu) => extremum_on_gpu(gpu, color.plane(), element, which).map(Image::from),
    }
}

#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct ExtremumParams {
    size: [i32; 2],
    margin_in: i32,
    margin_out: i32,
    along: [i32; 2],
    across: [i32; 2],
    reach_along: i32,
    reach_across: i32,
    maximum: u32,
    spare: u32,
}

/// The kernel that takes the minimum or maximum on two segments that cross.
pub static EXTREMUM: Kernel = Kernel {
    name: "extremum",
    source: include_str!("extremum.wgsl"),
    parameters: layout!(ExtremumParams {
        size,
        margin_in,
        margin_out,
        along,
        across,
        reach_along,
        reach_across,
        maximum,
        spare,
    }),
    structs: &[],
    storage: &[Storage::Read, Storage::Write],
};

fn extremum_on_gpu(
    gpu: &mut GpuCompute,
    color: &Plane<[f32; 4]>,
    element: StructuringElement,
    which: Extremum,
) -> Result<Plane<[f32; 4]>, DeviceError> {
    let (width, height) = color.size();
    let crossings = element.crossings();
    // Intermediate results are needed outside the picture too.
    let margin = element.reach() as usize;
    let mut current = color.clone();
    let mut margin_in = 0;
    for (i, crossing) in crossings.iter().enumerate() {
        let margin_out = if i + 1 == crossings.len() { 0 } else { margin };
        let [out_width, out_height] = [width, height].map(|side| side + 2 * margin_out);
        let out = gpu.plane(out_width, out_height)?;
        let params = ExtremumParams {
            size: [width as i32, height as i32],
            margin_in: margin_in as i32,
            margin_out: margin_out as i32,
            along: crossing.along,
            across: crossing.across,
            reach_along: crossing.reach_along as i32,
            reach_across: crossing.reach_across as i32,
            maximum: u32::from(which == Extremum::Maximum),
            spare: 0,
        };
        let buffers = [current.buffer(), out.buffer()];
        gpu.dispatch(&EXTREMUM, &params, &buffers, (out_width, out_height));
        (current, margin_in) = (out, margin_out);
    }
    Ok(current)
}
