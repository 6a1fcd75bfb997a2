//! The three passes over all squares of a picture. You run them on the processor, or as one kernel
//! on a graphics device with an invocation for each pixel.
//!
//! We make lists of splats on the processor for both forms, and every pixel sums in their order.
//! Amounts of paint in mm are weighted means with the same weights as the colours.

use graphics::compute::{Compute, GpuCompute, GreyImage, Plane};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};
use paint::layer::SLOTS;
use pulp::Simd;
use rayon::prelude::*;

use super::gather::{Divide, Gather, Gathered, LOST, Sums, shown};
use super::paint_tones::{Amounts, PackedSums, PaintTones};
use super::settings::OverlapSettings;
use super::splats::{Lists, SIDE, Square, StrokeSplat};
use super::tones::{DeviceTones, ToneMemory, Tones};

/// A painted picture.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintedPicture {
    /// Encoded sRGB in 0..1, with the share of each pixel that strokes cover.
    pub color: Field<[f32; 4]>,
    /// Height of the brushwork over the canvas in mm, 0 for maps without relief.
    pub height_mm: Field<f32>,
}

impl PaintedPicture {
    pub(super) fn bare((width, height): (usize, usize)) -> Self {
        let color = Field::filled(width, height, [0.0; 4]);
        Self { color, height_mm: Field::filled(width, height, 0.0) }
    }
}

/// Paints splats over a mesh of this depth (0 near, 1 where there is nothing). Each pixel sums the
/// splats that reach it in their order, so the picture does not depend on threads.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost, never on the processor.
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
mod device_tests {
    //! We compare the device's form with the processor's, which is the specification.

    use artmap::map::{ArtMap, Between};
    use documents::hint::Explain;
    use glam::Vec3;
    use graphics::gpu::{BackendChoice, Device, adapters, best};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::super::coloring::{Coloring, SubjectKind};
    use super::super::gather::THIN;
    use super::super::settings::{ColorSettings, ColorSource, ColorSpace};
    use super::super::test_scenes::{device, differences};
    use super::super::test_scenes::{map, splat};
    use super::super::tones::Tones;
    use super::*;

    /// A map laid out for painting.
    struct Laid {
        tones: Tones,
        coloring: Coloring,
    }

    impl Laid {
        fn new(map: &ArtMap, from: ColorSource, space: ColorSpace) -> Self {
            let colors = [(Vec3::new(0.6, 0.3, 0.2), 1.0), (Vec3::new(0.1, 0.4, 0.7), 2.0)];
            let settings = ColorSettings { from, space, ..ColorSettings::default() };
            let coloring = Coloring::new(&[map], &colors, &settings, SubjectKind::Model);
            Self { tones: Tones::new(&[map], Between::Blend, &coloring), coloring }
        }

        fn usual() -> Self {
            Self::new(&map(3), ColorSource::Map, ColorSpace::Cielab)
        }

        fn paint(
            &self,
            compute: &mut Compute,
            (depth, splats): (&Field<f32>, &[StrokeSplat]),
            thin: f32,
            overlap: &OverlapSettings,
        ) -> PaintedPicture {
            let Self { tones, coloring } = self;
            let divide = Divide { tones, coloring, overhang: overlap.overhang, thin };
            let memory = ToneMemory::new(compute, tones, coloring).unwrap();
            let depth = compute.upload(depth).unwrap();
            painted(compute, (&depth, splats), &divide, &memory, overlap).unwrap()
        }

        /// Paints on the processor and on the device, and compares both. Returns the picture of the
        /// processor.
        fn compare(
            &self,
            gpu: &mut Compute,
            seen: (&Field<f32>, &[StrokeSplat]),
            thin: f32,
            overlap: &OverlapSettings,
        ) -> PaintedPicture {
            let own = self.paint(&mut Compute::cpu(), seen, thin, overlap);
            let others = self.paint(gpu, seen, thin, overlap);
            let ([cover, color, height], compared) = differences(&own, &others);
            let what = format!("{overlap:?}, {compared} pixels: {cover} {color} {height}");
            assert!(cover <= 1.0 / 255.0 && color <= 1.0 / 255.0, "{what}");
            // A place in the map that rounds otherwise changes texels by a byte.
            assert!(height <= 2.0 * self.tones.step[3], "{what}");
            own
        }

        /// Splats of all tones and sizes, scattered over a picture, before the mesh, on it and behind.
        fn scattered(&self, count: usize, (width, height): (usize, usize)) -> Vec<StrokeSplat> {
            let mut random = ChaCha8Rng::seed_from_u64(3);
            let mut unit = || random.random::<f32>();
            let sizes: Vec<usize> = self.tones.sizes().map(<[_]>::len).collect();
            let splats = (0..count).map(|_| {
                let at = [unit() * width as f32, unit() * height as f32];
                let own = splat(at, [3.0 + 5.0 * unit(), 6.0 + 8.0 * unit()], 6.3 * unit());
                let slice = (unit() * sizes.len() as f32) as usize;
                let color = self.coloring.of_splat(Vec3::new(unit(), unit(), unit()));
                StrokeSplat {
                    depth: 0.46 + 0.08 * unit(),
                    slope: [0.001 * (unit() - 0.5), 0.001 * (unit() - 0.5)],
                    tolerance: 0.005 + 0.01 * unit(),
                    weight: 0.05 + 1.5 * unit(),
                    cover: 0.05 + 0.95 * unit(),
                    offset: [4.0 * unit() - 2.0, 4.0 * unit() - 2.0],
                    slice: slice as u32,
                    halvings: (unit() * sizes[slice] as f32) as u32,
                    color: color.to_array(),
                    ..own
                }
            });
            splats.collect()
        }
    }

    /// Depth of a mesh that recedes towards the right. A nearer part fills the lower quarter, and the right
    /// quarter shows the background.
    fn mesh((width, height): (usize, usize)) -> Field<f32> {
        Field::from_values(
            width,
            height,
            (0..width * height)
                .map(|index: usize| {
                    let x = index % width;
                    let y = index / width;
                    match (4 * x >= 3 * width, 4 * y >= 3 * height) {
                        (true, _) => 1.0,
                        (_, true) => 0.48,
                        _ => 0.5 + 0.0004 * x as f32,
                    }
                })
                .collect(),
        )
    }

    #[test]
    fn a_device_paints_the_same_with_all_settings() {
        let Some(mut gpu) = device() else { return };
        let relief = map(3);
        let mut flat = relief.clone();
        flat.keys.iter_mut().for_each(|key| key.tile.height_mm = None);
        let size = (83, 61);
        let depth = mesh(size);
        for map in [&relief, &flat] {
            for (from, space) in [
                (ColorSource::Map, ColorSpace::Cielab),
                (ColorSource::Model, ColorSpace::Cielab),
                (ColorSource::Model, ColorSpace::Yuv),
            ] {
                let laid = Laid::new(map, from, space);
                let splats = laid.scattered(140, size);
                for (sharpness, ridges, overhang) in
                    [(1, 0.0, 0.5), (4, 0.75, 0.5), (4, 0.0, 0.0), (1, 0.75, 1.0), (16, 0.95, 0.2)]
                {
                    let overlap = OverlapSettings {
                        sharpness,
                        ridges,
                        overhang,
                        ..OverlapSettings::default()
                    };
                    let picture = laid.compare(&mut gpu, (&depth, &splats), THIN, &overlap);
                    fn covers(least: f32, most: f32, picture: &PaintedPicture) -> usize {
                        let pixels = picture.color.values().iter();
                        pixels.filter(|pixel| (least..=most).contains(&pixel[3])).count()
                    }
                    // The mesh is painted, bare pixels stay, and strokes come in between.
                    assert!(
                        covers(0.9, 1.0, &picture) > 2000 && covers(0.0, 0.0, &picture) > 50,
                        "{overlap:?}"
                    );
                    assert!(
                        overhang == 0.0 || covers(0.05, 0.95, &picture) > 50,
                        "{}",
                        covers(0.05, 0.95, &picture)
                    );
                }
            }
        }
    }

    #[test]
    fn a_device_takes_pictures_of_any_size_one_after_the_other() {
        let Some(mut gpu) = device() else { return };
        let laid = Laid::usual();
        let overlap = OverlapSettings::default();
        for size in [(64, 48), (1, 1), (9, 7), (8, 8), (161, 3), (5, 90)] {
            let splats = laid.scattered(1 + size.0 * size.1 / 40, size);
            laid.compare(&mut gpu, (&mesh(size), &splats), THIN, &overlap);
        }
        let none = Field::filled(0, 5, 1.0);
        let picture = laid.paint(&mut gpu, (&none, &[]), THIN, &overlap);
        assert_eq!((picture.color.width(), picture.color.height()), (0, 5));
    }

    #[test]
    fn a_device_leaves_a_picture_without_strokes_bare() {
        let Some(mut gpu) = device() else { return };
        let laid = Laid::usual();
        let overlap = OverlapSettings::default();
        let size = (40, 30);
        let seen = mesh((40, 30));
        // Memory of an earlier picture is not seen again.
        laid.paint(&mut gpu, (&seen, &laid.scattered(60, size)), THIN, &overlap);
        let bare = laid.paint(&mut gpu, (&seen, &[]), THIN, &overlap);
        assert!(bare.color.values().iter().flatten().all(|&value| value == 0.0));
        assert!(bare.height_mm.values().iter().all(|&value| value == 0.0));
    }

    #[test]
    fn strokes_thin_out_below_the_cover_that_is_asked_for() {
        let Some(mut gpu) = device() else { return };
        let laid = Laid::usual();
        let size = (40, 30);
        let overlap = OverlapSettings::default();
        let depth = Field::filled(size.0, size.1, 0.5);
        let splats: Vec<StrokeSplat> = laid
            .scattered(40, size)
            .iter()
            .map(|splat| StrokeSplat { depth: 0.5, slope: [0.0; 2], ..*splat })
            .collect();
        let [opaque, _, thin] = [THIN, 0.3, 0.8].map(|thin| {
            let picture = laid.compare(&mut gpu, (&depth, &splats), thin, &overlap);
            picture.color.values().iter().map(|pixel| pixel[3]).sum::<f32>()
        });
        assert!(thin < 0.9 * opaque, "{thin} {opaque}");
    }

    #[test]
    fn a_map_beyond_the_limit_of_a_device_is_refused() {
        let found = adapters();
        let Some(adapter) = best(&found, BackendChoice::Gpu) else { return };
        let mut adapter = adapter.clone();
        adapter.limits.binding_bytes = 1 << 16;
        let mut gpu = Compute::gpu(Device::open(&adapter).unwrap());
        let laid = Laid::usual();
        let error = ToneMemory::new(&mut gpu, &laid.tones, &laid.coloring).unwrap_err();
        let DeviceError::TooLarge { what, bytes, limit } = &error else { panic!("{error}") };
        assert_eq!((*what, *limit), ("the art map", 1 << 16));
        let texels = laid.tones.sizes().flatten().map(|texels| (texels.size as u64 + 1).pow(2));
        assert_eq!(*bytes, 4 * texels.sum::<u64>());
        assert!(error.hint().is_some());
    }
}

/// A splat as the kernel reads it.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct PackedStroke {
    at: [f32; 2],
    across: [f32; 2],
    along: [f32; 2],
    slope: [f32; 2],
    /// Place in the map from the centre of the first texel, in widths of the map.
    offset: [f32; 2],
    extent: [f32; 2],
    depth: f32,
    /// 1 / tolerance.
    tightness: f32,
    weight: f32,
    /// Amount that the splat adds to the cover, for a weight of 1.
    cover: f32,
    /// Black for splats without colours of their own.
    color: [f32; 4],
    /// First texel of the tone, and width of the tile.
    texels: [u32; 2],
    spare: [u32; 2],
}

impl PackedStroke {
    fn new(splat: &StrokeSplat, tones: &DeviceTones, colored: bool) -> Self {
        let texels = tones.tile(splat.slice as usize, splat.halvings as usize);
        let [red, green, blue] = if colored { splat.color } else { [0.0; 3] };
        Self {
            at: [splat.x, splat.y],
            across: splat.across,
            along: splat.along,
            slope: splat.slope,
            offset: splat.offset.map(|at| at - 0.5 / texels[1] as f32),
            extent: splat.extent,
            depth: splat.depth,
            tightness: 1.0 / splat.tolerance,
            weight: splat.weight,
            cover: splat.cover / splat.weight,
            color: [red, green, blue, 0.0],
            texels,
            spare: [0; 2],
        }
    }
}

#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct PassesParams {
    size: [u32; 2],
    /// Index in the batch at which the starts of the lists begin.
    starts: u32,
    /// Index in the batch at which the lists begin.
    lists: u32,
    squarings: u32,
    furrow: f32,
    overhang: f32,
    thin: f32,
    low: [f32; 4],
    step: [f32; 4],
    rgb_from_xyz: [[f32; 4]; 3],
    white: [f32; 3],
    coordinates: u32,
}

/// The kernel that weighs, sums and divides the strokes of each pixel.
pub(super) static PASSES: Kernel = Kernel {
    name: "painterly_passes",
    source: concat!(include_str!("passes.wgsl"), include_str!("gather.wgsl")),
    parameters: layout!(PassesParams {
        size,
        starts,
        lists,
        squarings,
        furrow,
        overhang,
        thin,
        low,
        step,
        rgb_from_xyz,
        white,
        coordinates,
    }),
    structs: &[layout!(PackedStroke {
        at,
        across,
        along,
        slope,
        offset,
        extent,
        depth,
        tightness,
        weight,
        cover,
        color,
        texels,
        spare,
    })],
    storage: &[
        Storage::Read,
        Storage::Read,
        Storage::Batch,
        Storage::Read,
        Storage::Read,
        Storage::Write,
        Storage::Write,
    ],
};

/// Encoded sRGB with cover, and heights in mm, of splats over a mesh of this depth. You pass the
/// `tones` that `divide` names, on this device.
pub(super) fn painted_on_device(
    gpu: &mut GpuCompute,
    tones: &DeviceTones,
    (depth, splats): (&Plane<f32>, &[StrokeSplat]),
    divide: &Divide<'_>,
    overlap: &OverlapSettings,
) -> Result<(Plane<[f32; 4]>, Plane<f32>), DeviceError> {
    let (width, height) = depth.size();
    let lists = Lists::new(width, height, splats);
    let colored = divide.coloring.of_model();
    let packed: Vec<PackedStroke> =
        splats.iter().map(|splat| PackedStroke::new(splat, tones, colored)).collect();
    // Rounded up, so that the strokes of the next frame fit the same memory.
    let strokes = gpu.plane(packed.len().max(1).next_power_of_two(), 1)?;
    gpu.write(&strokes, &packed)?;
    let colors = gpu.plane(width, height)?;
    let heights = gpu.plane(width, height)?;
    let coloring = divide.coloring;
    let params = PassesParams {
        size: [width as u32, height as u32],
        starts: gpu.batch(lists.starts()),
        lists: gpu.batch(lists.numbers()),
        squarings: overlap.sharpness.max(1).ilog2(),
        furrow: 1.0 - overlap.ridges,
        overhang: divide.overhang,
        thin: divide.thin,
        low: divide.tones.low,
        step: divide.tones.step,
        rgb_from_xyz: coloring.rgb_from_xyz.map(|[x, y, z]: [f32; 3]| [x, y, z, 0.0]),
        white: coloring.white,
        coordinates: coloring.coordinates as u32,
    };
    let buffers = [
        depth.buffer(),
        strokes.buffer(),
        tones.texels(),
        tones.encoded(),
        colors.buffer(),
        heights.buffer(),
    ];
    gpu.dispatch(&PASSES, &params, &buffers, (width, height));
    Ok((colors, heights))
}

/// Sums of packed amounts at the pixels of a square, times weights.
type SquareSums = [[PackedSums; SIDE]; SIDE];

/// Paint at each pixel in mm, thinner where strokes cover a pixel in part. Splats, depth and
/// overlap are the picture's.
pub(super) fn amounts(
    depth: &Field<f32>,
    splats: &[StrokeSplat],
    divide: &Divide<'_>,
    paint: &PaintTones,
    overlap: &OverlapSettings,
) -> Field<Amounts> {
    let width = depth.width();
    let height = depth.height();
    let lists = Lists::new(width, height, splats);
    let mut found = Field::filled(width, height, [0.0; SLOTS + 1]);
    let bands = found.values_mut().par_chunks_mut((SIDE * width).max(1)).enumerate();
    bands.for_each_init(
        || (Gathered::new(), [SquareSums::default(); 2]),
        |(gathered, sums), (band, amounts)| {
            for column in 0..lists.across {
                let list = lists.of(band * lists.across + column);
                if list.is_empty() {
                    continue;
                }
                let x = column * SIDE;
                let y = band * SIDE;
                let square = Square::new(depth, x, y);
                let tones = divide.tones;
                let furrow = 1.0 - overlap.ridges;
                let squarings = overlap.sharpness.max(1).ilog2();
                graphics::lanes::vectorized(Gather {
                    square: &square,
                    list,
                    splats,
                    tones,
                    squarings,
                    furrow,
                    colored: false,
                    textured: false,
                    into: &mut *gathered,
                });
                let surfaces = [&mut gathered.on, &mut gathered.before];
                for (surface, sums) in surfaces.into_iter().zip(&mut *sums) {
                    if surface.any() {
                        let square = &square;
                        let sum = Sum { square, splats, tones, furrow, paint, surface, sums };
                        graphics::lanes::vectorized(sum);
                    }
                }
                let columns = SIDE.min(width - x);
                for (row, amounts) in amounts.chunks_mut(width).enumerate() {
                    for column in 0..columns {
                        let covered = square.depths[row][column] < 1.0;
                        let at = (row, column);
                        let [over, rest] = divide.shares(gathered, covered, at);
                        let parts =
                            [(over, &sums[1], &gathered.before), (rest, &sums[0], &gathered.on)];
                        let parts = parts.map(|(share, sums, surface)| {
                            let weight = surface.weight[row][column];
                            (share > 0.0 && weight > LOST)
                                .then(|| paint.amounts(&sums[row][column], weight / share))
                        });
                        let own = &mut amounts[x + column];
                        for part in parts.into_iter().flatten() {
                            own.iter_mut().zip(part).for_each(|(own, mm)| *own += mm);
                        }
                    }
                }
            }
        },
    );
    found
}

/// Sums the paint that the strokes of one surface show in a square, and the height that separates
/// ridges from furrows.
struct Sum<'a> {
    square: &'a Square,
    splats: &'a [StrokeSplat],
    tones: &'a Tones,
    furrow: f32,
    paint: &'a PaintTones,
    surface: &'a mut Sums,
    sums: &'a mut SquareSums,
}

impl pulp::WithSimd for Sum<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { square, splats, tones, furrow, paint, surface, sums } = self;
        *sums = SquareSums::default();
        let Sums { bytes, weight: weights, total, parts, .. } = surface;
        shown(square, splats, (tones, furrow), (parts, total), |part| {
            let size = (part.splat.slice as usize, part.splat.halvings as usize);
            let [row, column] = part.pixel;
            paint.add(&mut sums[row][column], size, part.place, part.share, part.weight);
            let all = bytes[row][column].iter_mut().zip(part.texel);
            all.for_each(|(sum, value)| *sum += value * part.weight);
            weights[row][column] += part.weight;
        });
    }
}

#[cfg(test)]
mod tests {
    use super::super::coloring::{Coloring, SubjectKind};
    use super::super::gather::THIN;
    use super::super::settings::{ColorSettings, ColorSource};
    use super::super::test_scenes::{map, splat};
    use super::super::tones::Tones;
    use super::*;
    use artmap::map::Between;

    fn laid_out(from: ColorSource) -> (Tones, Coloring) {
        let map = map(1);
        let settings = ColorSettings { from, ..ColorSettings::default() };
        let coloring = Coloring::new(&[&map], &[], &settings, SubjectKind::Model);
        (Tones::new(&[&map], Between::Blend, &coloring), coloring)
    }

    /// A picture of the lowest layer.
    fn shown(
        depth: &Field<f32>,
        splats: &[StrokeSplat],
        (tones, coloring): (&Tones, &Coloring),
        overlap: &OverlapSettings,
    ) -> PaintedPicture {
        let divide = Divide { tones, coloring, overhang: overlap.overhang, thin: THIN };
        painted_on_cpu(depth, splats, &divide, overlap)
    }

    fn overlap(sharpness: u32) -> OverlapSettings {
        OverlapSettings { sharpness, ..OverlapSettings::default() }
    }

    /// The red of a pixel and the sum of the weights before they are raised to the power. This sums
    /// over all splats in f64. A weight is exp(-4.5 d^2) to a power, times the square of the height
    /// of the texel.
    fn summed(
        splats: &[StrokeSplat],
        tones: &Tones,
        sharpness: i32,
        at: [f32; 2],
    ) -> Option<[f64; 2]> {
        let texels = tones.texels(0, 0);
        let size = texels.size as f64;
        let mut sum = 0.0;
        let mut total = 0.0;
        let mut cover = 0.0;
        for splat in splats {
            let from = [at[0] - splat.x, at[1] - splat.y];
            fn part([x, y]: [f32; 2], from: [f32; 2]) -> f64 {
                f64::from(x * from[0] + y * from[1])
            }
            let [a, b] = [part(splat.across, from), part(splat.along, from)];
            let square = a * a + b * b;
            if square >= 1.0 {
                continue;
            }
            let end = (-4.5_f64).exp();
            let weight = f64::from(splat.weight) * ((-4.5 * square).exp() - end) / (1.0 - end);
            let place = [(a, 0), (b, 1)].map(|(way, axis)| {
                let at = f64::from(splat.offset[axis]) + f64::from(splat.extent[axis]) * way;
                (at * size - 0.5).rem_euclid(size)
            });
            let [x, y] = place.map(f64::floor);
            let [right, down] = [place[0] - x, place[1] - y];
            let [upper, lower] = [y, y + 1.0].map(|y| {
                let [one, other] = [x, x + 1.0].map(|x| {
                    let [x, y] = [x, y].map(|at| at.rem_euclid(size) as usize % texels.size);
                    texels.interpolated(x, y, 0, 0).map(|byte| f64::from(byte) / 256.0)
                });
                [0, 3].map(|channel: usize| one[channel] * (1.0 - right) + other[channel] * right)
            });
            let [red, height] = [0, 1].map(|i: usize| upper[i] * (1.0 - down) + lower[i] * down);
            cover += weight;
            let high = 0.25 + 0.75 * height / 255.0;
            let weight = weight.powi(sharpness) * high * high;
            sum += weight * (f64::from(tones.low[0]) + f64::from(tones.step[0]) * red);
            total += weight;
        }
        (total > 0.0).then(|| [sum / total, cover])
    }

    #[test]
    fn a_pixel_is_the_weighted_mean_of_all_splats() {
        let (tones, coloring) = laid_out(ColorSource::Map);
        let splats: Vec<StrokeSplat> = (0..60_u8)
            .map(|i| {
                let at = [f32::from(i) * 7.3 % 45.0, f32::from(i) * 11.9 % 37.0];
                let own = splat(at, [6.0, 9.5], f32::from(i));
                let offset = [f32::from(i) * 0.37 % 1.0, f32::from(i) * 0.73 % 1.0];
                StrokeSplat { offset, weight: 0.3 + f32::from(i) / 90.0, ..own }
            })
            .collect();
        let depth = Field::filled(45, 37, 0.5);
        for sharpness in [1, 2, 4, 16] {
            let overlap = overlap(sharpness);
            let picture = shown(&depth, &splats, (&tones, &coloring), &overlap);
            let mut compared = 0;
            for y in 0..37 {
                for x in 0..45 {
                    let at = [x as f32 + 0.5, y as f32 + 0.5];
                    let wanted = summed(&splats, &tones, sharpness as i32, at);
                    let found = picture.color[(x, y)];
                    let Some(wanted) = wanted else {
                        assert_eq!(found[3], 0.0);
                        continue;
                    };
                    // A thinner cover is see-through.
                    let [wanted, cover] = wanted;
                    if cover < 2e-3 {
                        continue;
                    }
                    let off = (f64::from(found[0]) - wanted).abs();
                    assert!(off < 2.0 / 255.0, "{sharpness} at {x}, {y}: {found:?}, {wanted}");
                    compared += 1;
                }
            }
            assert!(compared > 1300, "{compared}");
        }
    }

    #[test]
    fn splats_behind_the_mesh_do_not_show_and_those_before_it_reach_out() {
        let (tones, coloring) = laid_out(ColorSource::Map);
        let own = StrokeSplat { depth: 0.5, ..splat([16.0, 16.0], [10.0, 10.0], 0.0) };
        for (mesh, overhang, cover, what) in [
            (0.3, 0.5, 0.0, "hidden"),
            (0.5, 0.5, 1.0, "on the mesh"),
            (1.0, 0.5, 1.0, "beyond the outline"),
            (1.0, 0.0, 0.0, "no overhang is asked for"),
            (0.8, 0.0, 1.0, "a mesh is not left bare"),
        ] {
            let depth = Field::filled(32, 32, mesh);
            let overlap = OverlapSettings { overhang, ..overlap(4) };
            let found = shown(&depth, &[own], (&tones, &coloring), &overlap);
            assert_eq!(found.color[(16, 16)][3], cover, "{what}");
        }
    }

    #[test]
    fn the_nearest_of_two_surfaces_shows_beyond_an_outline() {
        let (tones, coloring) = laid_out(ColorSource::Model);
        let near = StrokeSplat {
            depth: 0.4,
            color: [30.0, 40.0, 0.0],
            ..splat([16.0, 16.0], [10.0, 10.0], 0.0)
        };
        let far = StrokeSplat { depth: 0.6, color: [30.0, -40.0, 0.0], ..near };
        let depth = Field::filled(32, 32, 1.0);
        let paint = |splats: &[StrokeSplat]| {
            shown(&depth, splats, (&tones, &coloring), &overlap(4)).color[(15, 15)]
        };
        assert_eq!(paint(&[far, near]), paint(&[near]));
        assert_eq!(paint(&[near, far]), paint(&[near]));
        assert_ne!(paint(&[far]), paint(&[near]));
    }
}
