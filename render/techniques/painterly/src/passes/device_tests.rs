//! The device's form against the processor's, which is the specification.

use artmap::map::{ArtMap, Between};
use documents::hint::Explain;
use glam::Vec3;
use graphics::gpu::{BackendChoice, Device, adapters, best};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::super::coloring::{Coloring, SubjectKind};
use super::super::divided::THIN;
use super::super::made_up::{map, splat};
use super::super::settings::{ColorSettings, ColorSource, ColorSpace};
use super::super::test_device::{device, differences};
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

    /// Paints on both and compares. Returns the picture of the processor.
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

/// A mesh that leans away to the right, with a part before it below, and nothing on the right.
fn mesh((width, height): (usize, usize)) -> Field<f32> {
    let depth = |index: usize| {
        let x = index % width;
        let y = index / width;
        match (4 * x >= 3 * width, 4 * y >= 3 * height) {
            (true, _) => 1.0,
            (_, true) => 0.48,
            _ => 0.5 + 0.0004 * x as f32,
        }
    };
    Field::from_values(width, height, (0..width * height).map(depth).collect())
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
                let overlap =
                    OverlapSettings { sharpness, ridges, overhang, ..OverlapSettings::default() };
                let picture = laid.compare(&mut gpu, (&depth, &splats), THIN, &overlap);
                let covers = |least: f32, most: f32| {
                    let pixels = picture.color.values().iter();
                    pixels.filter(|pixel| (least..=most).contains(&pixel[3])).count()
                };
                // The mesh is painted, bare pixels stay, and strokes come in between.
                assert!(covers(0.9, 1.0) > 2000 && covers(0.0, 0.0) > 50, "{overlap:?}");
                assert!(overhang == 0.0 || covers(0.05, 0.95) > 50, "{}", covers(0.05, 0.95));
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
