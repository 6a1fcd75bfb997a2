//! The picture from shaded samples: grey outside of all volumes, the colours of regions inside.
//!
//! ten Bosch 2005 copies alpha over the colour where the stencil is 0. Here the count of each
//! region selects a tint t, and its colour is laid over what is there: (1 - t) under + t inside.
//! A region may stain what is there first: under times one colour.

use rayon::prelude::*;

use graphics::compute::{ColorImage, Compute, GpuCompute, Image, Plane, assert_size};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};
use graphics::surface::{Fragment, NO_TRIANGLE, VisibilityBuffer};

use super::error::{DrawingError, check_range};
use super::regions::{Inside, Region, checked_regions};
use super::shells::TintTable;

/// Composes shaded samples to a picture. Every sample starts as its grey; each region, in the
/// order given, mixes its colour over it by the tint of its count. The samples of a pixel are
/// then averaged.
///
/// `shaded` is what [`super::shade`] made of `visible`. The result is encoded sRGB, `samples`
/// times smaller each way. With a `paper` colour (encoded sRGB in 0..1) that stands where nothing
/// is seen and the fourth value is 1; without, the fourth value is the share of the pixel that
/// surfaces cover, and bare pixels are (1, 1, 1, 0).
///
/// # Errors
/// [`DrawingError::Regions`] and [`DrawingError::Setting`] for regions or paper that cannot be
/// drawn; [`DrawingError::Device`] if a device has no memory left or was lost.
///
/// # Panics
/// If sizes differ or are no multiple of the samples, or another form of [`Compute`] made an
/// image.
pub fn reveal(
    compute: &mut Compute,
    shaded: &ColorImage,
    visible: &Image<Fragment>,
    regions: &[Region],
    paper: Option<[f32; 3]>,
    samples: usize,
) -> Result<ColorImage, DrawingError> {
    checked_regions(regions)?;
    for value in paper.unwrap_or_default() {
        check_range("paper", value, [0.0, 1.0])?;
    }
    let (width, height) = shaded.size();
    let whole = samples > 0 && width.is_multiple_of(samples) && height.is_multiple_of(samples);
    assert!(whole, "shaded samples of {width} x {height} for {samples} a pixel");
    assert_size("what is seen", visible.size(), (width, height));
    for region in regions {
        assert_size("the counts of a region", region.counts.size(), (width, height));
        if let Inside::Picture(picture) = &region.inside {
            assert_size("the inside of a region", picture.size(), (width, height));
        }
    }
    match compute {
        Compute::Cpu => {
            Ok(reveal_on_cpu(shaded.host(), visible.host(), regions, paper, samples).into())
        }
        Compute::Gpu(gpu) => {
            let planes = (shaded.plane(), visible.plane());
            Ok(reveal_on_gpu(gpu, planes, regions, paper, samples)?.into())
        }
    }
}

fn reveal_on_cpu(
    shaded: &Field<[f32; 4]>,
    visible: &VisibilityBuffer,
    regions: &[Region],
    paper: Option<[f32; 3]>,
    samples: usize,
) -> Field<[f32; 4]> {
    let [width, height] = [shaded.width(), shaded.height()].map(|side| side / samples);
    let stride = shaded.width();
    let composed = |sample: usize| -> Option<[f32; 3]> {
        if visible.values()[sample].triangle == NO_TRIANGLE {
            return None;
        }
        let [r, g, b, grey] = shaded.values()[sample];
        let under = [grey; 3];
        Some(regions.iter().fold(under, |under, region| {
            let count = region.counts.host().values()[sample];
            let under = if count > 0 { stained(under, region.stain) } else { under };
            let tint = region.table.tint(count);
            if tint <= 0.0 {
                return under;
            }
            let inside = match &region.inside {
                Inside::OwnColors => [r, g, b],
                Inside::Picture(picture) => {
                    let [r, g, b, _] = picture.host().values()[sample];
                    [r, g, b]
                }
            };
            mixed(under, inside, tint)
        }))
    };
    let finish = Finish { paper, samples };
    let mut picture = Field::filled(width, height, [0.0; 4]);
    picture.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        for (x, pixel) in row.iter_mut().enumerate() {
            let first = y * samples * stride + x * samples;
            *pixel = finish.pixel(|column, line| composed(first + line * stride + column));
        }
    });
    picture
}

/// Exact at tints of 0 and 1.
#[inline(always)]
fn mixed(under: [f32; 3], inside: [f32; 3], tint: f32) -> [f32; 3] {
    std::array::from_fn(|i| under[i] * (1.0 - tint) + inside[i] * tint)
}

/// Exact for a stain of 1.
#[inline(always)]
fn stained(under: [f32; 3], stain: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|i| under[i] * stain[i])
}

/// How the samples of a pixel become its colour.
struct Finish {
    paper: Option<[f32; 3]>,
    samples: usize,
}

impl Finish {
    #[inline(always)]
    fn pixel(&self, sample: impl Fn(usize, usize) -> Option<[f32; 3]>) -> [f32; 4] {
        let mut sum = [0.0_f32; 3];
        let mut seen = 0;
        for line in 0..self.samples {
            for column in 0..self.samples {
                if let Some(color) = sample(column, line) {
                    sum = std::array::from_fn(|i| sum[i] + color[i]);
                    seen += 1;
                }
            }
        }
        let all = (self.samples * self.samples) as f32;
        let seen = seen as f32;
        match self.paper {
            Some(paper) => {
                let [r, g, b]: [f32; 3] =
                    std::array::from_fn(|i| (sum[i] + paper[i] * (all - seen)) / all);
                [r, g, b, 1.0]
            }
            None if seen == 0.0 => [1.0, 1.0, 1.0, 0.0],
            None => [sum[0] / seen, sum[1] / seen, sum[2] / seen, seen / all],
        }
    }
}

/// Places for tints in the parameters of the kernel.
const TINTS: usize = super::shells::MOST_SHELLS + 1;

#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct RegionParams {
    size: [u32; 2],
    last: i32,
    first_region: u32,
    stain: [f32; 3],
    own_colors: u32,
    tints: [[f32; 4]; TINTS / 4],
}

pub(crate) static REGION: Kernel = Kernel {
    name: "volumes_region",
    source: include_str!("region.wgsl"),
    parameters: layout!(RegionParams { size, last, first_region, stain, own_colors, tints }),
    structs: &[],
    storage: &[Storage::Read, Storage::Read, Storage::Read, Storage::Write],
};

#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct FinishParams {
    paper: [f32; 3],
    has_paper: u32,
    size: [u32; 2],
    samples: u32,
    only_grey: u32,
}

pub(crate) static FINISH: Kernel = Kernel {
    name: "volumes_finish",
    source: include_str!("finish.wgsl"),
    parameters: layout!(FinishParams { paper, has_paper, size, samples, only_grey }),
    structs: &[Fragment::LAYOUT],
    storage: &[Storage::Read, Storage::Read, Storage::Write],
};

fn reveal_on_gpu(
    gpu: &mut GpuCompute,
    (shaded, visible): (&Plane<[f32; 4]>, &Plane<Fragment>),
    regions: &[Region],
    paper: Option<[f32; 3]>,
    samples: usize,
) -> Result<Plane<[f32; 4]>, DeviceError> {
    let (width, height) = shaded.size();
    let composed = gpu.plane::<[f32; 4]>(width, height)?;
    for (index, region) in regions.iter().enumerate() {
        let inside = match &region.inside {
            Inside::OwnColors => None,
            Inside::Picture(picture) => Some(picture.plane()),
        };
        let params = RegionParams {
            size: [width as u32, height as u32],
            last: region.table.tints().len() as i32 - 1,
            first_region: (index == 0).into(),
            stain: region.stain,
            own_colors: inside.is_none().into(),
            tints: packed(&region.table),
        };
        let inside = inside.unwrap_or(shaded).buffer();
        let counts = region.counts.plane().buffer();
        let buffers = [shaded.buffer(), counts, inside, composed.buffer()];
        gpu.dispatch(&REGION, &params, &buffers, (width, height));
    }
    let columns = width / samples;
    let rows = height / samples;
    let picture = gpu.plane(columns, rows)?;
    let params = FinishParams {
        paper: paper.unwrap_or_default(),
        has_paper: paper.is_some().into(),
        size: [columns as u32, rows as u32],
        samples: samples as u32,
        only_grey: regions.is_empty().into(),
    };
    let colors = if regions.is_empty() { shaded } else { &composed }.buffer();
    let buffers = [colors, visible.buffer(), picture.buffer()];
    gpu.dispatch(&FINISH, &params, &buffers, (columns, rows));
    Ok(picture)
}

fn packed(table: &TintTable) -> [[f32; 4]; TINTS / 4] {
    let mut tints = [0.0; TINTS];
    tints[..table.tints().len()].copy_from_slice(table.tints());
    bytemuck::cast(tints)
}

#[cfg(test)]
mod tests;
