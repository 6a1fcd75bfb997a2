//! The three passes over all squares of a picture.

use graphics::compute::{Compute, GreyImage};
use graphics::field::Field;
use graphics::gpu::DeviceError;
use rayon::prelude::*;

use super::device_tones::ToneMemory;
use super::divided::Divide;
use super::gather::{Gather, Gathered};
use super::lists::{Lists, SIDE};
use super::passes_on_device::painted_on_device;
use super::settings::OverlapSettings;
use super::splat::StrokeSplat;
use super::square::Square;

/// A painted picture.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintedPicture {
    /// Encoded sRGB in 0..1, with the share of each pixel that strokes cover.
    pub color: Field<[f32; 4]>,
    /// Height of the brushwork over the canvas in mm; 0 for maps without relief.
    pub height_mm: Field<f32>,
}

impl PaintedPicture {
    /// A picture without strokes.
    pub(super) fn bare((width, height): (usize, usize)) -> Self {
        let color = Field::filled(width, height, [0.0; 4]);
        Self { color, height_mm: Field::filled(width, height, 0.0) }
    }
}

/// Paints splats over a mesh of this depth (0 near to 1, nothing). Each pixel sums the splats that
/// reach it in their order, so the picture does not depend on threads.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
///
/// # Panics
/// If another form of [`Compute`] made `depth` or `memory`.
pub(super) fn painted(
    compute: &mut Compute,
    (depth, splats): (&GreyImage, &[StrokeSplat]),
    divide: &Divide<'_>,
    memory: &ToneMemory,
    overlap: &OverlapSettings,
) -> Result<PaintedPicture, DeviceError> {
    match compute {
        Compute::Cpu => Ok(painted_on_cpu(depth.host(), splats, divide, overlap)),
        Compute::Gpu(gpu) => {
            let seen = (depth.plane(), splats);
            let (color, height) = painted_on_device(gpu, memory.device(), seen, divide, overlap)?;
            Ok(PaintedPicture { color: gpu.download(&color)?, height_mm: gpu.download(&height)? })
        }
    }
}

/// The specification of the passes.
fn painted_on_cpu(
    depth: &Field<f32>,
    splats: &[StrokeSplat],
    divide: &Divide<'_>,
    overlap: &OverlapSettings,
) -> PaintedPicture {
    let Divide { tones, coloring, .. } = *divide;
    let colored = coloring.of_model();
    let width = depth.width();
    let height = depth.height();
    let lists = Lists::new(width, height, splats);
    let mut color = Field::filled(width, height, [0.0; 4]);
    let mut relief = Field::filled(width, height, 0.0);
    let band = (SIDE * width).max(1);
    let bands =
        color.values_mut().par_chunks_mut(band).zip(relief.values_mut().par_chunks_mut(band));
    bands.enumerate().for_each_init(Gathered::new, |gathered, (band, (colors, heights))| {
        for column in 0..lists.across {
            let list = lists.of(band * lists.across + column);
            if list.is_empty() {
                continue;
            }
            let x = column * SIDE;
            let y = band * SIDE;
            let square = Square::new(depth, x, y);
            let squarings = overlap.sharpness.max(1).ilog2();
            let furrow = 1.0 - overlap.ridges;
            let into = &mut *gathered;
            let square = &square;
            let textured = true;
            let gather =
                Gather { square, list, splats, tones, squarings, furrow, colored, textured, into };
            graphics::lanes::vectorized(gather);
            if !gathered.on.any() && !gathered.before.any() {
                continue;
            }
            let columns = SIDE.min(width - x);
            let rows = colors.chunks_mut(width).zip(heights.chunks_mut(width)).enumerate();
            for (row, (colors, heights)) in rows {
                for column in 0..columns {
                    let (pixel, height) = {
                        let covered = square.depths[row][column] < 1.0;
                        divide.pixel(gathered, covered, (row, column))
                    };
                    colors[x + column] = pixel;
                    heights[x + column] = height;
                }
            }
        }
    });
    PaintedPicture { color, height_mm: relief }
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod device_tests;
