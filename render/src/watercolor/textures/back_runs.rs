//! Back-runs: blooms of water in a drying wash, pale inside, with a dark crinkled rim.

use rand::RngExt;
use rayon::prelude::*;

use crate::watercolor::settings::BackRunSettings;
use graphics::field::Field;
use graphics::noise::{Hills, random};
use graphics::smoothstep;

/// Depth of the dark rim, as a share of the radius of its bloom. Chosen by eye.
const RIM: f32 = 0.06;

/// Width over which the rim begins outside, as a share of the radius. Chosen by eye.
const FRONT: f32 = 0.02;

/// Least width over which the rim begins, in pixels.
const FRONT_PX: f32 = 0.75;

/// Crinkle of the rim, as a share of the radius. Chosen by eye.
const CRINKLE: f32 = 0.34;

/// Radius of the circle in the noise that the large lobes of a front are taken from: six of them
/// lie around a bloom. Chosen by eye.
const AROUND: f32 = 0.9;

/// Lobes for the width of a bloom, and cosine and sine of the turn of their noise.
const TURNED: [(f32, [f32; 2]); 2] = [(9.0, [0.8, 0.6]), (21.0, [0.28, 0.96])];

/// Length and width of a bloom, as shares of its diameter. Chosen by eye.
const OVAL: [f32; 2] = [1.2, 0.84];

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
    /// Where the lobes of its front are taken from the noise.
    lobes: f32,
    /// Cosine and sine of the direction in which it is longer.
    along: [f32; 2],
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
            .filter(|bloom| {
                (bloom.y - y).abs() < OVAL[0] * bloom.radius * (1.0 + CRINKLE + 4.0 * RIM)
            })
            .collect();
        if blooms.is_empty() {
            return;
        }
        for (column, out) in row.iter_mut().enumerate() {
            let x = column as f32;
            // 0 in the middle of the nearest bloom, 1 on its rim.
            let distances = blooms.iter().map(|bloom| {
                let (dx, dy, [cos, sin]) = (x - bloom.x, y - bloom.y, bloom.along);
                let [long, wide] = OVAL;
                let distance = ((cos * dx + sin * dy) / long).hypot((cos * dy - sin * dx) / wide);
                (distance / bloom.radius, bloom)
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
            // Lobes bulge outwards and meet in creases that point inwards. Large ones lie around
            // the bloom; finer ones are turned, since noise shows the axes of its lattice.
            let (dx, dy) = (x - bloom.x, y - bloom.y);
            let away = dx.hypot(dy).max(1e-3);
            let around = |by: f32| bloom.lobes + AROUND * by / away;
            let bulge = |height: f32, finer: f32| (height.abs() - 0.25) * 2.0 / finer.sqrt();
            let mut lobes = bulge(crinkles[0].at(around(dx), around(dy)), 4.0);
            for (hills, (finer, [cos, sin])) in crinkles[1..].iter().zip(TURNED) {
                let step = finer / size;
                let [x, y] = [cos * x - sin * y, sin * x + cos * y];
                lobes += bulge(hills.at(x * step, y * step), finer);
            }
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
    let [share, x, y, radius, lobes, turn]: [f32; 6] = std::array::from_fn(|_| random.random());
    let x = (column as f32 + 0.2 + 0.6 * x) * size;
    let y = (row as f32 + 0.2 + 0.6 * y) * size;
    let on_sheet = x >= 0.0 && y >= 0.0 && x < wash.width() as f32 && y < wash.height() as f32;
    if share >= settings.share || !on_sheet {
        return None;
    }
    let [r, g, b, covered] = wash[(x as usize, y as usize)];
    let radius = size * (0.2 + 0.22 * radius);
    let (sin, cos) = (std::f32::consts::PI * turn).sin_cos();
    let (lobes, along) = (500.0 * lobes, [cos, sin]);
    (covered > 0.5).then_some(Bloom { x, y, radius, lobes, along, color: [r, g, b] })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_of_a_bloom_is_oval_on_the_whole_and_ragged_in_detail() {
        // Only one cell is painted, so that there is one bloom.
        let mut wash = Field::filled(600, 600, [0.4, 0.4, 0.6, 0.0]);
        for (y, x) in (200..400).flat_map(|y| (200..400).map(move |x| (y, x))) {
            wash[(x, y)][3] = 1.0;
        }
        let (mut fronts, mut sectors) = (Vec::new(), Vec::new());
        for seed in 0..12 {
            let settings =
                BackRunSettings { seed, size_px: 200.0, share: 1.0, ..BackRunSettings::default() };
            let Some(bloom) = bloom(&wash, &settings, 200.0, [1, 1]) else { continue };
            let field = back_runs(&wash, &settings);
            // Distance at which the rim is darkest, as a share of the radius.
            let front = |step: usize| {
                let (sin, cos) = (step as f32 / 96.0 * std::f32::consts::TAU).sin_cos();
                let at = |share: f32| {
                    let place = |at: f32| (at.round().max(0.0) as usize).min(599);
                    let away = share * bloom.radius;
                    field[(place(bloom.x + away * cos), place(bloom.y + away * sin))]
                };
                let shares = (40..140).map(|share| share as f32 / 100.0);
                shares.max_by(|a, b| at(*a).total_cmp(&at(*b))).unwrap_or(0.0)
            };
            let own: Vec<f32> = (0..96).map(front).collect();
            for quarter in own.chunks(24) {
                sectors.push(quarter.iter().sum::<f32>() / 24.0);
            }
            fronts.push(own);
        }
        assert!(fronts.len() > 8, "{} blooms", fronts.len());
        let spread = |values: &[f32]| {
            let mean = values.iter().sum::<f32>() / values.len() as f32;
            let squares: f32 = values.iter().map(|value| (value - mean).powi(2)).sum();
            (squares / values.len() as f32).sqrt()
        };
        // Neighbouring places of a front differ.
        let steps = |own: &Vec<f32>| -> f32 {
            own.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum::<f32>() / 95.0
        };
        let ragged = fronts.iter().map(steps).sum::<f32>() / fronts.len() as f32;
        let uneven = spread(&sectors);
        assert!(ragged > 0.035, "places of fronts vary by {ragged} of the radius");
        assert!(uneven < 0.07, "quarters of fronts vary by {uneven} of the radius");
    }
}
