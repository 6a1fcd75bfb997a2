//! Back-runs: blooms of water in a drying wash, pale inside, with a dark crinkled rim.

use rand::RngExt;
use rayon::prelude::*;

use crate::watercolor::settings::BackRunSettings;
use crate::watercolor::smoothstep::smoothstep;
use graphics::field::Field;
use graphics::noise::{Hills, random};

/// Depth of the dark rim, as a share of the radius of its bloom. Chosen by eye.
const RIM: f32 = 0.06;

/// Width over which the rim begins outside, as a share of the radius. Chosen by eye.
const FRONT: f32 = 0.02;

/// Least width over which the rim begins, in pixels.
const FRONT_PX: f32 = 0.75;

/// Crinkle of the rim, as a share of the radius. Chosen by eye.
const CRINKLE: f32 = 0.34;

/// How much paler a bloom is inside its rim, at most. Chosen by eye.
const PALE: f32 = 0.3;

/// Differences of colour (distance in encoded RGB) up to the first lie in one wash, from the
/// second on in another: wider than the steps of a gradient. Chosen by eye.
const ONE_WASH: [f32; 2] = [0.25, 0.4];

/// A bloom of water.
#[derive(Debug, Clone, Copy)]
struct Bloom {
    x: f32,
    y: f32,
    radius: f32,
    /// The wash that it falls into.
    color: [f32; 3],
}

/// The change of density by back-runs, 0 to 1: 0.5 changes nothing, less is paler, more is
/// darker. Water carries the pigment from a bloom to its rim. `wash` has the colours that water
/// falls into, encoded sRGB with coverage: a bloom stays in a wash of about one colour, and
/// bare paper has none.
#[must_use]
pub fn back_runs(wash: &Field<[f32; 4]>, settings: &BackRunSettings) -> Field<f32> {
    let (width, height) = (wash.width(), wash.height());
    let size = settings.size_px.max(2.0);
    let mut noise = random(settings.seed, 31);
    let crinkles = [Hills::new(&mut noise), Hills::new(&mut noise), Hills::new(&mut noise)];
    let mut field = Field::filled(width, height, 0.5);
    let bands = field.values_mut().par_chunks_mut(width.max(1)).enumerate();
    bands.for_each(|(line, row)| {
        let y = line as f32;
        let band = (y / size).floor() as i64;
        // A bloom reaches into the neighbouring cells at most.
        let blooms: Vec<Bloom> = (band - 1..=band + 1)
            .flat_map(|row| {
                let last = (width as f32 / size).floor() as i64 + 1;
                (-1..=last).filter_map(move |column| bloom(wash, settings, size, [column, row]))
            })
            .filter(|bloom| (bloom.y - y).abs() < bloom.radius * (1.0 + CRINKLE + 4.0 * RIM))
            .collect();
        if blooms.is_empty() {
            return;
        }
        for (column, out) in row.iter_mut().enumerate() {
            let x = column as f32;
            // 0 in the middle of the nearest bloom, 1 on its rim.
            let distances = blooms.iter().map(|bloom| {
                let distance = (bloom.x - x).hypot(bloom.y - y) / bloom.radius;
                (distance, bloom)
            });
            let Some((nearest, bloom)) = distances.min_by(|a, b| a.0.total_cmp(&b.0)) else {
                continue;
            };
            if nearest > 1.0 + CRINKLE + 4.0 * RIM {
                continue;
            }
            let [r, g, b, _] = wash[(column, line)];
            let [r, g, b] = [r - bloom.color[0], g - bloom.color[1], b - bloom.color[2]];
            let own = 1.0 - smoothstep(ONE_WASH, (r * r + g * g + b * b).sqrt());
            let lobes: f32 = crinkles
                .iter()
                .zip([4.0, 9.0, 21.0])
                .map(|(hills, finer)| {
                    let step = finer / size;
                    (hills.at(x * step, y * step).abs() - 0.25) * 2.0 / finer.sqrt()
                })
                .sum();
            // Lobes bulge outwards and meet in creases that point inwards.
            let inside = 1.0 - nearest + CRINKLE * lobes;
            let front = FRONT.max(FRONT_PX / bloom.radius);
            let rim = match inside {
                inside if inside < 0.0 => (1.0 + inside / front).max(0.0),
                inside => (-inside / RIM).exp(),
            };
            let left = if inside > 0.0 { 1.0 - rim } else { 0.0 };
            let middle = (1.0 - inside).clamp(0.0, 1.0).powi(2);
            let pale = PALE * left * (0.4 + 0.6 * middle);
            *out = (0.5 + own * (0.5 * rim - pale)).clamp(0.0, 1.0);
        }
    });
    field
}

/// The bloom of a cell, if it has one and its water falls on paint.
fn bloom(
    wash: &Field<[f32; 4]>,
    settings: &BackRunSettings,
    size: f32,
    [column, row]: [i64; 2],
) -> Option<Bloom> {
    // Each cell has its own random stream.
    let cell = (((column + 0x8000) as u64) << 20) | (row + 0x8000) as u64;
    let mut random = random(settings.seed, (1 << 40) | cell);
    let [share, x, y, radius]: [f32; 4] = std::array::from_fn(|_| random.random());
    let x = (column as f32 + 0.2 + 0.6 * x) * size;
    let y = (row as f32 + 0.2 + 0.6 * y) * size;
    let on_sheet = x >= 0.0 && y >= 0.0 && x < wash.width() as f32 && y < wash.height() as f32;
    if share >= settings.share || !on_sheet {
        return None;
    }
    let [r, g, b, covered] = wash[(x as usize, y as usize)];
    let radius = size * (0.22 + 0.26 * radius);
    (covered > 0.5).then_some(Bloom { x, y, radius, color: [r, g, b] })
}
