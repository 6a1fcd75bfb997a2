//! Back-runs: blooms of water in a drying wash, pale inside, with a dark crinkled rim.

use rand::RngExt;
use rayon::prelude::*;

use crate::watercolor::settings::BackRunSettings;
use graphics::field::Field;
use graphics::noise::{Hills, random};

/// Width of the dark rim, as a share of the radius of its bloom. Chosen by eye.
const RIM: f32 = 0.07;

/// Crinkle of the rim, as a share of the radius. Chosen by eye.
const CRINKLE: f32 = 0.34;

/// A bloom of water.
#[derive(Debug, Clone, Copy)]
struct Bloom {
    x: f32,
    y: f32,
    radius: f32,
}

/// The change of density by back-runs, 0 to 1: 0.5 changes nothing, less is paler, more is
/// darker. Water carries the pigment from a bloom to its rim. The value of a pixel does not
/// depend on the size of the field.
#[must_use]
pub fn back_runs(width: usize, height: usize, settings: &BackRunSettings) -> Field<f32> {
    let size = settings.size_px.max(2.0);
    let mut noise = random(settings.seed, 31);
    let crinkles = [Hills::new(&mut noise), Hills::new(&mut noise), Hills::new(&mut noise)];
    let mut field = Field::filled(width, height, 0.5);
    let bands = field.values_mut().par_chunks_mut(width.max(1)).enumerate();
    bands.for_each(|(y, row)| {
        let y = y as f32;
        let band = (y / size).floor() as i64;
        // A bloom reaches into the neighbouring cells at most.
        let blooms: Vec<Bloom> = (band - 1..=band + 1)
            .flat_map(|row| {
                let last = (width as f32 / size).floor() as i64 + 1;
                (-1..=last).filter_map(move |column| bloom(settings, size, column, row))
            })
            .filter(|bloom| (bloom.y - y).abs() < bloom.radius * (1.0 + CRINKLE + 4.0 * RIM))
            .collect();
        if blooms.is_empty() {
            return;
        }
        for (x, out) in row.iter_mut().enumerate() {
            let x = x as f32;
            // 0 in the middle of the nearest bloom, 1 on its rim.
            let nearest =
                blooms.iter().map(|bloom| (bloom.x - x).hypot(bloom.y - y) / bloom.radius);
            let nearest = nearest.fold(f32::INFINITY, f32::min);
            if nearest > 1.0 + CRINKLE + 4.0 * RIM {
                continue;
            }
            let lobes: f32 = crinkles
                .iter()
                .zip([4.0, 9.0, 21.0])
                .map(|(hills, finer)| {
                    let step = finer / size;
                    (hills.at(x * step, y * step).abs() - 0.25) * 2.0 / finer.sqrt()
                })
                .sum();
            let at = nearest + CRINKLE * lobes;
            let inside = (1.0 - (at - 1.0 + RIM) / RIM).clamp(0.0, 1.0);
            let pale = 0.25 + 0.75 * at.clamp(0.0, 1.0).powi(2);
            let rim = (-0.5 * ((at - 1.0) / (0.6 * RIM)).powi(2)).exp();
            *out = (0.5 - 0.32 * inside * pale + 0.5 * rim).clamp(0.0, 1.0);
        }
    });
    field
}

/// The bloom of a cell, if it has one.
fn bloom(settings: &BackRunSettings, size: f32, column: i64, row: i64) -> Option<Bloom> {
    // Each cell has its own random stream.
    let cell = (((column + 0x8000) as u64) << 20) | (row + 0x8000) as u64;
    let mut random = random(settings.seed, (1 << 40) | cell);
    let [share, x, y, radius]: [f32; 4] = std::array::from_fn(|_| random.random());
    (share < settings.share).then_some(Bloom {
        x: (column as f32 + 0.2 + 0.6 * x) * size,
        y: (row as f32 + 0.2 + 0.6 * y) * size,
        radius: size * (0.22 + 0.26 * radius),
    })
}
