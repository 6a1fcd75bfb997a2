//! Abstraction of pictures: mean shift segmentation, then morphological smoothing.

use divan::Bencher;
use graphics::compute::Compute;
use graphics::field::Field;
use graphics::morphology::opening_then_closing;
use graphics::segmentation::{SegmentationSettings, segment};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Shaded discs over each other, with noise: as much detail as a photograph.
fn picture(width: usize, height: usize) -> Field<[f32; 4]> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut number = |from: f32, to: f32| random.random_range(from..to);
    let discs: Vec<([f32; 3], [f32; 3])> = (0..150)
        .map(|_| {
            let place =
                [number(0.0, width as f32), number(0.0, height as f32), number(15.0, 110.0)];
            (place, [number(0.1, 0.9), number(0.1, 0.9), number(0.1, 0.9)])
        })
        .collect();
    let mut picture = Field::filled(width, height, [1.0; 4]);
    for y in 0..height {
        for x in 0..width {
            let mut color = [0.6, 0.55, 0.5];
            for ([disc_x, disc_y, radius], own) in &discs {
                let away = (x as f32 - disc_x).hypot(y as f32 - disc_y);
                let cover = ((radius - away) / 3.0).clamp(0.0, 1.0);
                for (color, own) in color.iter_mut().zip(own) {
                    *color += cover * (own - 0.1 * away / radius - *color);
                }
            }
            let [r, g, b] = color.map(|value| value + number(-0.03, 0.03));
            picture[(x, y)] = [r, g, b, 1.0];
        }
    }
    picture
}

/// 1 megapixel, with radii of 10 px and 8 in CIELUV.
#[divan::bench(sample_count = 5)]
fn mean_shift(bencher: Bencher<'_, '_>) {
    let picture = picture(1000, 1000);
    let settings = SegmentationSettings::default();
    bencher.bench_local(|| segment(&picture, &settings).unwrap());
}

fn smooth(bencher: Bencher<'_, '_>, picture: Field<[f32; 4]>, radius_px: u32) {
    let mut compute = Compute::cpu();
    let image = picture.into();
    bencher.bench_local(|| opening_then_closing(&mut compute, &image, radius_px).unwrap());
}

/// 1 megapixel opened and closed, by radius.
#[divan::bench(args = [3, 7, 20, 60], sample_count = 20)]
fn smoothing(bencher: Bencher<'_, '_>, radius_px: u32) {
    smooth(bencher, picture(1000, 1000), radius_px);
}

/// 750 x 570 opened and closed, by radius.
#[divan::bench(args = [3, 5], sample_count = 20)]
fn smoothing_750(bencher: Bencher<'_, '_>, radius_px: u32) {
    smooth(bencher, picture(750, 570), radius_px);
}
