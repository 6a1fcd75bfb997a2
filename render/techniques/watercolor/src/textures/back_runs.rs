//! Back-runs: blooms of water in a drying wash, pale inside, with a dark crinkled rim.

use rand::RngExt;
use rayon::prelude::*;

use crate::settings::BackRunSettings;
use graphics::field::Field;
use graphics::noise::{Hills, random};
use graphics::smoothstep;

/// Depth of the dark rim, as a share of the radius of its bloom. Chosen by eye.
const RIM: f32 = 0.06;

/// Width over which the rim fades out beyond the front, as a share of the radius. Chosen by eye.
const FRONT: f32 = 0.02;

/// Least width over which the rim fades out beyond the front, in pixels.
const FRONT_PX: f32 = 0.75;

/// How far the front reaches outwards and inwards, in lobes of three sizes. Each pair holds the
/// radius of the circle in the noise that we take the lobes from (each unit of its length holds a
/// lobe), and their height as a share of the radius of the bloom. Noise on a circle leaves the
/// front in one piece. We chose this by eye.
const LOBES: [(f32, f32); 3] = [(1.2, 0.20), (3.0, 0.18), (7.0, 0.08)];

/// Currents that bend the front. The first number counts waves over the width of the largest bloom.
/// The second says how far they carry the front, as a share of the radius. We chose this by eye.
const CURRENTS: (f32, f32) = (9.0, 0.17);

/// Distance from the middle that a front reaches at most, as a share of the radius.
const REACH: f32 = 1.6;

/// Darkness of the rim on black, relative to the rim on white: in a thick wash you see added
/// pigment less. We chose this by eye.
const ON_BLACK: f32 = 0.3;

/// Length and width of a bloom, as shares of its diameter. Chosen by eye.
const OVAL: [f32; 2] = [1.2, 0.84];

/// How much paler a bloom is inside its rim, at most. Chosen by eye.
const PALE: f32 = 0.3;

/// Colours that differ by at most the first value (distance in encoded RGB) lie in one wash, from
/// the second value on in two. Both are greater than the steps of a gradient. Chosen by eye.
const ONE_WASH: [f32; 2] = [0.25, 0.4];

#[derive(Debug, Clone, Copy)]
struct Bloom {
    x: f32,
    y: f32,
    radius: f32,
    /// The point in the noise around which we take the lobes of its front.
    lobes: [f32; 2],
    /// Cosine and sine of the direction in which it is longer.
    along: [f32; 2],
    /// Colour of the wash into which the water falls.
    color: [f32; 3],
}

impl Bloom {
    /// Place in the oval of the bloom, along and across it, as shares of its length and width.
    fn oval(&self, x: f32, y: f32) -> [f32; 2] {
        let dx = x - self.x;
        let dy = y - self.y;
        let [cos, sin] = self.along;
        let scale = [OVAL[0] * self.radius, OVAL[1] * self.radius];
        [(cos * dx + sin * dy) / scale[0], (cos * dy - sin * dx) / scale[1]]
    }
}

/// The change of density by back-runs, 0 to 1: 0.5 changes nothing, less is paler, more is darker.
/// Water carries the pigment from a bloom to its rim. You pass the colours that water falls into as
/// `wash`, encoded sRGB with coverage. A bloom stays in a wash of about one colour. Bare paper has
/// no blooms.
#[must_use]
pub fn back_runs(wash: &Field<[f32; 4]>, settings: &BackRunSettings) -> Field<f32> {
    let width = wash.width();
    let height = wash.height();
    let size = settings.size_px.max(2.0);
    let front = Front::new(settings.seed, size);
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
            .filter(|bloom| (bloom.y - y).abs() < OVAL[0] * bloom.radius * REACH)
            .collect();
        for (column, out) in row.iter_mut().enumerate() {
            let x = column as f32;
            // Where blooms meet, the one that reaches farther is on top.
            let reached = blooms.iter().filter_map(|bloom| Some((front.of(bloom, x, y)?, bloom)));
            let Some((at, bloom)) = reached.max_by(|a, b| a.0.inside.total_cmp(&b.0.inside)) else {
                continue;
            };
            let [r, g, b, _] = wash[(column, line)];
            let [red, green, blue] = bloom.color;
            let away = (r - red).hypot(g - green).hypot(b - blue);
            let own = 1.0 - smoothstep(ONE_WASH, away);
            let width = FRONT.max(FRONT_PX / bloom.radius);
            let rim = match at.inside {
                inside if inside < 0.0 => (1.0 + inside / width).max(0.0),
                inside => (-inside / RIM).exp(),
            };
            let left = if at.inside > 0.0 { 1.0 - rim } else { 0.0 };
            let pale = PALE * left * (0.4 + 0.6 * at.distance.min(1.0).powi(2));
            let dark = at.pigment * (ON_BLACK + (1.0 - ON_BLACK) * red.max(green).max(blue));
            *out = (0.5 + own * (0.5 * dark * rim - pale)).clamp(0.0, 1.0);
        }
    });
    field
}

/// The fronts of all blooms.
struct Front {
    lobes: [Hills; 3],
    currents: [Hills; 2],
    /// Waves of the currents per pixel.
    waves: f32,
}

/// A place near the front of a bloom.
struct AtFront {
    /// How far it lies inside the front, as a share of the radius. Below 0 outside.
    inside: f32,
    /// Distance from the middle of the bloom, 1 on an even front.
    distance: f32,
    /// Pigment of the rim in this direction, 0 to 1.
    pigment: f32,
}

impl Front {
    fn new(seed: u64, size: f32) -> Self {
        let mut noise = random(seed, 31);
        Self {
            lobes: std::array::from_fn(|_| Hills::new(&mut noise)),
            currents: std::array::from_fn(|_| Hills::new(&mut noise)),
            waves: CURRENTS.0 / size,
        }
    }

    /// The place (`x`, `y`) near the front of `bloom`, unless it is too far away.
    fn of(&self, bloom: &Bloom, x: f32, y: f32) -> Option<AtFront> {
        let [along, across] = bloom.oval(x, y);
        if along * along + across * across > REACH * REACH {
            return None;
        }
        let [across_x, across_y] = self
            .currents
            .each_ref()
            .map(|hills| CURRENTS.1 * bloom.radius * hills.at(x * self.waves, y * self.waves));
        let [along, across] = bloom.oval(x + across_x, y + across_y);
        let distance = along.hypot(across);
        let unit = distance.max(1e-3);
        let around = |hills: &Hills, radius: f32| {
            let x = bloom.lobes[0];
            let y = bloom.lobes[1];
            hills.at(x + radius * along / unit, y + radius * across / unit)
        };
        // Lobes bulge outwards and meet in creases that point inwards.
        let lobes = self.lobes.iter().zip(LOBES);
        let lobes =
            lobes.map(|(hills, (radius, height))| height * (around(hills, radius).abs() - 0.25));
        let inside = 1.0 - distance + lobes.sum::<f32>();
        let pigment = (0.75 + 0.7 * around(&self.lobes[2], 1.7)).clamp(0.2, 1.0);
        Some(AtFront { inside, distance, pigment })
    }
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
    let lobes = [500.0 * lobes, 310.0 * lobes];
    let along = [cos, sin];
    (covered > 0.5).then_some(Bloom { x, y, radius, lobes, along, color: [r, g, b] })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sheet with paint in its middle cell only, so that there is at most one bloom.
    fn one_cell(color: f32) -> Field<[f32; 4]> {
        let mut wash = Field::filled(600, 600, [color, color, color, 0.0]);
        for (y, x) in (200..400).flat_map(|y| (200..400).map(move |x| (y, x))) {
            wash[(x, y)][3] = 1.0;
        }
        wash
    }

    fn settings(seed: u64) -> BackRunSettings {
        BackRunSettings { seed, size_px: 200.0, share: 1.0, ..BackRunSettings::default() }
    }

    /// Number of pixels that back-runs make paler.
    fn pale(field: &Field<f32>) -> usize {
        field.values().iter().filter(|value| **value < 0.5).count()
    }

    /// Greatest increase of density by back-runs in a wash.
    fn darkest(color: f32) -> f32 {
        let field = back_runs(&one_cell(color), &settings(3));
        field.values().iter().fold(0.0, |most: f32, value| most.max(value - 0.5))
    }

    /// Distance from the middle of `bloom` in one of 96 directions at which the rim is darkest, as a
    /// share of the radius.
    fn front(field: &Field<f32>, bloom: &Bloom, direction: usize) -> f32 {
        let (sin, cos) = (direction as f32 / 96.0 * std::f32::consts::TAU).sin_cos();
        let at = |share: f32| {
            let place =
                [bloom.x + share * bloom.radius * cos, bloom.y + share * bloom.radius * sin];
            let [x, y] = place.map(|at| (at.round().max(0.0) as usize).min(599));
            field[(x, y)]
        };
        let shares = (40..140).map(|share| share as f32 / 100.0);
        shares.max_by(|a, b| at(*a).total_cmp(&at(*b))).unwrap_or(0.0)
    }

    fn standard_deviation(values: &[f32]) -> f32 {
        let mean = values.iter().sum::<f32>() / values.len() as f32;
        let squares: f32 = values.iter().map(|value| (value - mean).powi(2)).sum();
        (squares / values.len() as f32).sqrt()
    }

    #[test]
    fn a_bloom_is_in_one_piece() {
        let wash = one_cell(0.5);
        for seed in 0..12 {
            let Some(bloom) = bloom(&wash, &settings(seed), 200.0, [1, 1]) else { continue };
            let mut field = back_runs(&wash, &settings(seed));
            let all = pale(&field);
            // Remove all that can be reached from the middle.
            let mut next = vec![(bloom.x as usize, bloom.y as usize)];
            while let Some((x, y)) = next.pop() {
                if field[(x, y)] < 0.5 {
                    field[(x, y)] = 1.0;
                    next.extend([(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)]);
                }
            }
            let apart = pale(&field);
            assert!(
                all > 3000 && 200 * apart < all,
                "seed {seed}: {apart} of {all} pixels lie apart"
            );
        }
    }

    #[test]
    fn the_rim_is_fainter_in_a_dark_wash() {
        let dark = darkest(0.1);
        let light = darkest(0.9);
        assert!(light > 0.25 && (dark / light - 0.4).abs() < 0.02, "{dark} and {light}");
    }

    #[test]
    fn the_front_of_a_bloom_is_oval_on_the_whole_and_ragged_in_detail() {
        let wash = one_cell(0.5);
        let mut fronts = Vec::new();
        let mut sectors = Vec::new();
        for seed in 0..12 {
            let settings = settings(seed);
            let Some(bloom) = bloom(&wash, &settings, 200.0, [1, 1]) else { continue };
            let field = back_runs(&wash, &settings);
            let own: Vec<f32> = (0..96).map(|direction| front(&field, &bloom, direction)).collect();
            for quarter in own.chunks(24) {
                sectors.push(quarter.iter().sum::<f32>() / 24.0);
            }
            fronts.push(own);
        }
        assert!(fronts.len() > 8, "{} blooms", fronts.len());
        // Neighbouring places of a front differ.
        let steps = fronts
            .iter()
            .map(|own| own.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum::<f32>() / 95.0);
        let ragged = steps.sum::<f32>() / fronts.len() as f32;
        let uneven = standard_deviation(&sectors);
        assert!(ragged > 0.035, "places of fronts vary by {ragged} of the radius");
        assert!(uneven < 0.07, "quarters of fronts vary by {uneven} of the radius");
    }
}
