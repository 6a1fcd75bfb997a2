//! Composes the picture from shaded samples. It is grey outside of all volumes, and shows the
//! colours of regions inside.
//!
//! ten Bosch 2005 copies alpha over the colour where the stencil is 0. Here the count of each
//! region selects a tint t, and we lay its colour over what is there: (1 - t) under + t inside. A
//! region may first stain what is there, which multiplies it by one colour. A region is a set of
//! volumes that we count together and that bring one colour.

use graphics::compute::{ColorImage, Compute, GpuCompute, Image, Plane, assert_size};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};
use graphics::surface::{Fragment, NO_TRIANGLE, VisibilityBuffer};
use rayon::prelude::*;

use super::look::{DrawingError, check_range};
use super::shells::TintTable;

/// Composes shaded samples to a picture. Every sample starts as its grey. Each region, in the
/// order given, mixes its colour over it by the tint of its count. Then we average the samples of
/// a pixel.
///
/// `shaded` is what [`super::shade`] made of `visible`. You get encoded sRGB, `samples` times
/// smaller each way. If you pass a `paper` colour (encoded sRGB in 0..1), you see it where the
/// scene is not, and the fourth value is 1. Without paper, the fourth value is the share of the
/// pixel that surfaces cover, and bare pixels are (1, 1, 1, 0).
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

/// Mixes `tint` parts of `inside` over `under`. This is exact at tints of 0 and 1.
#[inline(always)]
fn mixed(under: [f32; 3], inside: [f32; 3], tint: f32) -> [f32; 3] {
    std::array::from_fn(|i| under[i] * (1.0 - tint) + inside[i] * tint)
}

/// Multiplies a colour by a stain. This is exact for a stain of 1.
#[inline(always)]
fn stained(under: [f32; 3], stain: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|i| under[i] * stain[i])
}

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

/// Number of tints in the parameters of the kernel.
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

/// A picture has at most this many regions.
pub const MOST_REGIONS: usize = 64;

/// Colours that you see inside of the volumes of a region.
#[derive(Debug, Clone)]
pub enum Inside {
    /// The surface's own colour.
    OwnColors,
    /// A picture of the size of the shaded one, encoded sRGB. We do not use its fourth value. Use
    /// this for films of pigment.
    Picture(ColorImage),
}

/// A region of a picture.
#[derive(Debug, Clone)]
pub struct Region {
    /// Number of volumes and shells that hold the surface point of each sample. There are as many
    /// samples as pixels in the shaded picture.
    pub counts: Image<i32>,
    /// Share of the colour inside, by count.
    pub table: TintTable,
    /// Colours inside.
    pub inside: Inside,
    /// Where the count is above 0, we multiply what lies below by this colour, encoded sRGB in
    /// 0..1. Use [`Region::UNSTAINED`], or the one colour of a stained drawing.
    pub stain: [f32; 3],
}

impl Region {
    /// This stain leaves everything as it is.
    pub const UNSTAINED: [f32; 3] = [1.0; 3];
}

/// Checks the number of regions and their colours.
///
/// # Errors
/// [`DrawingError::Regions`]; [`DrawingError::Setting`] for a colour that is out of 0..1 or NaN.
pub fn checked_regions(regions: &[Region]) -> Result<(), DrawingError> {
    if regions.len() > MOST_REGIONS {
        return Err(DrawingError::Regions { most: MOST_REGIONS, found: regions.len() });
    }
    for region in regions {
        for value in region.stain {
            check_range("stain of a region", value, [0.0, 1.0])?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    //! Tests of composing: exactness, order, samples, paper, and the twin on a device.

    use super::*;
    use crate::test_volumes::{device, far};
    use graphics::field::Field;

    #[test]
    fn too_many_regions_and_colours_that_are_none_are_refused() {
        fn region(stain: [f32; 3]) -> Region {
            Region {
                counts: Field::filled(1, 1, 0).into(),
                table: TintTable::hard(),
                inside: Inside::OwnColors,
                stain,
            }
        }
        let own = region(Region::UNSTAINED);
        assert_eq!(checked_regions(&vec![own.clone(); 64]), Ok(()));
        let error = checked_regions(&vec![own; 65]).unwrap_err();
        assert_eq!(error.to_string(), "a picture has at most 64 regions, found `65`");
        let error = checked_regions(&[region([0.5, f32::NAN, 0.1])]);
        assert!(matches!(error, Err(DrawingError::Setting { .. })));
    }

    fn field<T>(width: usize, height: usize, value: impl Fn(usize, usize) -> T) -> Field<T> {
        Field::from_values(
            width,
            height,
            (0..width * height).map(|i: usize| value(i % width, i / width)).collect(),
        )
    }

    fn shaded(width: usize, height: usize) -> Field<[f32; 4]> {
        field(width, height, |x, y| {
            [3, 29, 47, 61].map(|step: usize| ((x * step + y * 17) % 101) as f32 / 101.0)
        })
    }

    /// A surface everywhere except for a band of columns.
    fn visible(width: usize, height: usize) -> VisibilityBuffer {
        field(width, height, |x, _| match x % 5 {
            4 => Fragment::EMPTY,
            _ => Fragment { triangle: 0, ..Fragment::EMPTY },
        })
    }

    fn counts(width: usize, height: usize, step: usize) -> Field<i32> {
        field(width, height, |x, y| ((x * step + y) % 7) as i32 - 1)
    }

    fn region(counts: Field<i32>, tints: &[f32], inside: Inside) -> Region {
        let table = TintTable::new(tints.to_vec()).unwrap();
        Region { counts: counts.into(), table, inside, stain: Region::UNSTAINED }
    }

    fn picture(
        size: (usize, usize),
        regions: &[Region],
        paper: Option<[f32; 3]>,
    ) -> Field<[f32; 4]> {
        let (width, height) = size;
        let shaded = shaded(width, height).into();
        let visible = visible(width, height).into();
        let picture = reveal(&mut Compute::cpu(), &shaded, &visible, regions, paper, 1);
        picture.unwrap().into_host()
    }

    #[test]
    fn outside_is_grey_to_the_bit_and_inside_is_the_colour_to_the_bit() {
        let size = (67, 33);
        let counts = field(67, 33, |x, _| i32::from(x >= 30));
        let hard = region(counts, &[0.0, 1.0], Inside::OwnColors);
        let found = picture(size, &[hard], Some([1.0; 3]));
        let none = picture(size, &[], Some([1.0; 3]));
        let shaded = shaded(67, 33);
        let visible = visible(67, 33);
        for y in 0..33 {
            for x in 0..67 {
                let [r, g, b, grey] = shaded[(x, y)];
                let bare = visible[(x, y)].triangle == NO_TRIANGLE;
                let color = if x >= 30 { [r, g, b, 1.0] } else { [grey, grey, grey, 1.0] };
                assert_eq!(found[(x, y)], if bare { [1.0; 4] } else { color }, "{x} {y}");
                let grey = if bare { [1.0; 4] } else { [grey, grey, grey, 1.0] };
                assert_eq!(none[(x, y)], grey, "{x} {y}");
            }
        }
    }

    #[test]
    fn full_tint_everywhere_is_the_plain_colour_picture() {
        let counts = Field::filled(67, 33, 3);
        let all = region(counts, &[0.0, 0.3, 1.0], Inside::OwnColors);
        let found = picture((67, 33), &[all], None);
        for ((found, shaded), visible) in
            found.values().iter().zip(shaded(67, 33).values()).zip(visible(67, 33).values())
        {
            match visible.triangle == NO_TRIANGLE {
                true => assert_eq!(*found, [1.0, 1.0, 1.0, 0.0]),
                false => assert_eq!(*found, [shaded[0], shaded[1], shaded[2], 1.0]),
            }
        }
    }

    #[test]
    fn later_regions_lie_over_earlier_ones() {
        fn everywhere(tints: &[f32], color: [f32; 3]) -> Region {
            let inside = field(5, 1, |_, _| [color[0], color[1], color[2], 0.0]).into();
            region(Field::filled(5, 1, 1), tints, Inside::Picture(inside))
        }
        let red = [0.9, 0.1, 0.1];
        let blue = [0.1, 0.2, 0.8];
        let regions = [everywhere(&[0.0, 1.0], red), everywhere(&[0.0, 1.0], blue)];
        assert_eq!(picture((5, 1), &regions, None)[(0, 0)], [0.1, 0.2, 0.8, 1.0]);
        let regions = [everywhere(&[0.0, 1.0], red), everywhere(&[0.0, 0.25], blue)];
        let found = picture((5, 1), &regions, None)[(0, 0)];
        for i in 0..3 {
            assert!((found[i] - (0.75 * red[i] + 0.25 * blue[i])).abs() < 1e-6, "{found:?}");
        }
    }

    #[test]
    fn a_stained_region_multiplies_the_grey_and_shows_colours_at_its_core() {
        let stain = [0.5, 0.25, 1.0];
        let counts = field(4, 1, |x, _| x as i32);
        let own = region(counts.clone(), &[0.0, 0.0, 0.5, 1.0], Inside::OwnColors);
        let found = picture((4, 1), &[Region { stain, ..own.clone() }], None);
        let shaded = shaded(4, 1);
        for (x, share) in [0.0, 0.0, 0.5, 1.0].into_iter().enumerate() {
            let [r, g, b, grey] = shaded[(x, 0)];
            let under = stain.map(|stain| if x > 0 { grey * stain } else { grey });
            let wanted = [0, 1, 2].map(|i| under[i] * (1.0 - share) + [r, g, b][i] * share);
            assert_eq!(found[(x, 0)][..3], wanted, "{x}");
        }
        // Where a region was before, this stains its colours.
        let colored = region(Field::filled(4, 1, 1), &[0.0, 1.0], Inside::OwnColors);
        let over = Region { stain, ..region(counts, &[0.0, 0.0, 0.0], Inside::OwnColors) };
        let found = picture((4, 1), &[colored, over], None);
        let [r, g, b, _] = shaded[(3, 0)];
        assert_eq!(found[(3, 0)], [0.5 * r, 0.25 * g, b, 1.0]);
        assert!(r > 0.05 && g > 0.05, "{r} {g}");
    }

    #[test]
    fn the_samples_of_a_pixel_are_averaged() {
        let shaded = field(4, 2, |x, _| if x < 2 { [1.0, 0.0, 0.0, 0.2] } else { [0.5; 4] });
        // The left pixel is half inside. The right one shows its surface in a single sample.
        let counts = field(4, 2, |x, y| i32::from(x < 2 && y == 0));
        let visible = field(4, 2, |x, y| match (x, y) {
            (3, _) | (2, 0) => Fragment::EMPTY,
            _ => Fragment { triangle: 0, ..Fragment::EMPTY },
        });
        let regions = [region(counts, &[0.0, 1.0], Inside::OwnColors)];
        let [on_paper, bare] = [Some([0.9, 0.8, 0.7]), None].map(|paper| {
            let shaded = shaded.clone().into();
            let visible = visible.clone().into();
            let picture = reveal(&mut Compute::cpu(), &shaded, &visible, &regions, paper, 2);
            picture.unwrap().into_host()
        });
        assert!(
            (on_paper[(0, 0)][0] - 0.6).abs() < 1e-6 && (on_paper[(0, 0)][1] - 0.1).abs() < 1e-6
        );
        assert!((on_paper[(1, 0)][0] - 0.8).abs() < 1e-6, "{on_paper:?}");
        assert_eq!(bare[(1, 0)], [0.5, 0.5, 0.5, 0.25]);
    }

    #[test]
    fn numbers_that_are_none_are_refused() {
        let shaded = shaded(2, 2).into();
        let visible = visible(2, 2).into();
        let compute = &mut Compute::cpu();
        let refused = reveal(compute, &shaded, &visible, &[], Some([0.5, f32::NAN, 1.0]), 1);
        assert!(matches!(refused, Err(DrawingError::Setting { name: "paper", .. })));
        let own = region(Field::filled(2, 2, 1), &[0.0, 1.0], Inside::OwnColors);
        let region = Region { stain: [2.0, 0.0, 0.0], ..own };
        assert!(reveal(compute, &shaded, &visible, &[region], None, 1).is_err());
    }

    #[test]
    fn a_device_composes_the_same_picture() {
        let Some(mut gpu) = device() else { return };
        for (samples, width, height) in
            [(1, 1, 1), (1, 8, 8), (1, 67, 33), (2, 34, 18), (3, 201, 99)]
        {
            let steps: [(usize, &[f32]); 3] =
                [(3, &[0.0, 0.25, 0.5, 0.75, 1.0]), (5, &[0.0, 0.5]), (2, &[0.0, 0.0, 0.0, 0.6])];
            let inside = Field::from_values(width, height, shaded(height, width).values().to_vec());
            for paper in [None, Some([0.9, 0.85, 0.8])] {
                for count in [0, 1, 3] {
                    let computes = [&mut Compute::cpu(), &mut gpu];
                    let [wanted, found] = computes.map(|compute: &mut Compute| {
                        let mut all = steps.map(|(step, tints)| Region {
                            counts: compute.upload(&counts(width, height, step)).unwrap(),
                            table: TintTable::new(tints.to_vec()).unwrap(),
                            inside: Inside::OwnColors,
                            stain: [[0.4, 0.9, 0.7], Region::UNSTAINED][step % 2],
                        });
                        all[2].inside = Inside::Picture(compute.upload(&inside).unwrap());
                        let shaded = compute.upload(&shaded(width, height)).unwrap();
                        let visible = compute.upload(&visible(width, height)).unwrap();
                        let picture =
                            reveal(compute, &shaded, &visible, &all[..count], paper, samples)
                                .unwrap();
                        compute.download(&picture).unwrap()
                    });
                    let (most, _) = far(&wanted, &found);
                    assert!(most < 0.01 / 255.0, "{width} x {height}, {count}: {most}");
                }
            }
        }
    }
}
