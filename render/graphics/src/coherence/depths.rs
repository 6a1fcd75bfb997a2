//! Depths of a visibility buffer: of each pixel, and the nearest and farthest surface in squares
//! of pixels. The squares tell you what is hidden.

use rayon::prelude::*;

use crate::compute::{Compute, GpuCompute, GreyImage, Image, Plane};
use crate::field::Field;
use crate::gpu::{DeviceError, GROUP, Kernel, Storage, layout};
use crate::surface::{Fragment, VisibilityBuffer};

/// The depth of each pixel, from 0 at the near plane to 1 where no triangle is seen.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost, never on the processor.
///
/// # Panics
/// If another form of [`Compute`] made the image.
pub fn depths(compute: &mut Compute, visible: &Image<Fragment>) -> Result<GreyImage, DeviceError> {
    match compute {
        Compute::Cpu => Ok(depth_field(visible.host()).into()),
        Compute::Gpu(gpu) => depths_on_gpu(gpu, visible.plane()).map(Image::from),
    }
}

/// Computes the depth of each pixel on the processor, as [`depths`] does.
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

/// This kernel copies the depth out of each fragment.
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

pub(super) const SIDE: usize = GROUP as usize;

/// Farthest depth of a square that shows nothing. This puts every surface behind it.
const BARE: f32 = f32::NEG_INFINITY;

/// Depths of the surfaces in squares of 8 x 8 pixels, and in squares of squares.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DepthTiles {
    /// Least and greatest depth of the pixels of each square that show something, row by row.
    ranges: Vec<Option<[f32; 2]>>,
    across: usize,
    /// Greatest depths. The first level has one for each square, and each further level has squares
    /// twice as wide and high.
    levels: Vec<Level>,
}

#[derive(Debug, Clone, PartialEq)]
struct Level {
    across: usize,
    down: usize,
    farthest: Vec<f32>,
}

impl Level {
    fn coarser(&self) -> Self {
        let across = self.across.div_ceil(2);
        let down = self.down.div_ceil(2);
        let mut farthest = vec![BARE; across * down];
        for (row, depths) in self.farthest.chunks(self.across.max(1)).enumerate() {
            for (column, depth) in depths.iter().enumerate() {
                let own = &mut farthest[row / 2 * across + column / 2];
                *own = own.max(*depth);
            }
        }
        Self { across, down, farthest }
    }
}

/// Least and greatest depth of the pixels that show something. `None` if none does.
fn range(depths: impl Iterator<Item = f32>) -> Option<[f32; 2]> {
    let seen = depths.filter(|&depth| depth < 1.0);
    let range = seen.fold([1.0, 0.0], |[low, high]: [f32; 2], at| [low.min(at), high.max(at)]);
    (range[0] < 1.0).then_some(range)
}

impl DepthTiles {
    pub(super) fn new(depth: &Field<f32>) -> Self {
        let width = depth.width();
        let height = depth.height();
        let across = width.div_ceil(SIDE);
        let down = height.div_ceil(SIDE);
        let squares = (0..across * down).into_par_iter().map(|square| {
            let x = square % across * SIDE;
            let y = square / across * SIDE;
            let rows = y..height.min(y + SIDE);
            range(rows.flat_map(|y| depth.row(y, x, SIDE.min(width - x)).iter().copied()))
        });
        let ranges: Vec<_> = squares.collect();
        let farthest = ranges.iter().map(|range| range.map_or(BARE, |[_, high]| high)).collect();
        let mut levels = vec![Level { across, down, farthest }];
        while let Some(level) = levels.last().filter(|level| level.across.max(level.down) > 2) {
            levels.push(level.coarser());
        }
        Self { ranges, across, levels }
    }

    /// Least and greatest depth that a square shows. `None` if it shows nothing.
    pub(super) fn range(&self, column: usize, row: usize) -> Option<[f32; 2]> {
        self.ranges[row * self.across + column]
    }

    /// A depth that no surface between these pixels exceeds. You can skip what lies behind it: it
    /// is hidden. Columns and rows are distances from the left and upper edge in pixels.
    pub(super) fn farthest(&self, columns: [f32; 2], rows: [f32; 2]) -> f32 {
        fn squares(limits: [f32; 2], count: usize) -> Option<[usize; 2]> {
            let [from, to] = limits.map(|at| at / SIDE as f32);
            let inside = count > 0 && to >= 0.0 && from < count as f32;
            let last = count.saturating_sub(1);
            inside.then(|| [from, to].map(|at| (at as usize).min(last)))
        }
        let Some(finest) = self.levels.first() else { return BARE };
        let (Some([left, right]), Some([top, bottom])) =
            (squares(columns, finest.across), squares(rows, finest.down))
        else {
            return BARE;
        };
        // The level at which at most two squares lie side by side.
        let wide = (right - left).max(bottom - top);
        let level = (usize::BITS - wide.leading_zeros()).saturating_sub(1) as usize;
        let level = level + usize::from(wide >> level > 1);
        let level = level.min(self.levels.len() - 1);
        let Level { across, farthest, .. } = &self.levels[level];
        let mut depth = BARE;
        for row in top >> level..=bottom >> level {
            for column in left >> level..=right >> level {
                depth = depth.max(farthest[row * across + column]);
            }
        }
        depth
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Depths of a picture with bare corners, each pixel different.
    fn depths(width: usize, height: usize) -> Field<f32> {
        Field::from_values(
            width,
            height,
            (0..width * height)
                .map(|i: usize| match (i % width, i / width) {
                    (x, y) if x + y < 20 => 1.0,
                    _ => 0.2 + 0.6 * ((i * 7919) % 1009) as f32 / 1009.0,
                })
                .collect(),
        )
    }

    #[test]
    fn no_pixel_between_the_limits_is_farther_and_one_near_them_is_as_far() {
        for (width, height) in [(93, 61), (8, 8), (300, 5), (1, 1)] {
            let depth = depths(width, height);
            let tiles = DepthTiles::new(&depth);
            for i in 0..400 {
                let scattered = [(31, width), (17, height), (13, 60), (41, 60)];
                let [x, y, across, down] = scattered.map(|(k, size): (usize, usize)| {
                    ((i * k) % 97) as f32 / 97.0 * (size as f32 + 40.0) - 20.0
                });
                let right = x + across.abs();
                let bottom = y + down.abs();
                let found = tiles.farthest([x, right], [y, bottom]);
                // All pixels that the limits touch, and all pixels of the squares around them.
                let within = |around: f32| {
                    let seen = (0..width * height).filter(|i| {
                        let column = (i % width) as f32;
                        let row = (i / width) as f32;
                        column + 1.0 > x - around
                            && column <= right + around
                            && row + 1.0 > y - around
                            && row <= bottom + around
                    });
                    let seen = seen.map(|i| depth.values()[i]).filter(|&depth| depth < 1.0);
                    seen.fold(BARE, f32::max)
                };
                assert!(found >= within(-1.0), "{width} {i}: {found}");
                let wide = (right - x).max(bottom - y) + 16.0;
                assert!(found <= within(2.0 * wide), "{width} {i}: {found}");
            }
        }
    }

    #[test]
    fn empty_pictures_and_places_beside_them_hide_everything() {
        let tiles = DepthTiles::new(&depths(50, 40));
        assert_eq!(tiles.farthest([-30.0, -1.0], [0.0, 40.0]), BARE);
        assert_eq!(tiles.farthest([0.0, 50.0], [41.0, 90.0]), BARE);
        assert_eq!(tiles.range(0, 0), None);
        assert!(tiles.range(3, 3).is_some_and(|[low, high]| low < high && high < 0.81));
        let none = DepthTiles::new(&Field::filled(0, 0, 0.0));
        assert_eq!(none.farthest([-1.0, 1.0], [-1.0, 1.0]), BARE);
    }
}
