//! Smooth random surfaces.

use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Period of the lattice along both axes, in cells.
const PERIOD: usize = 1024;

/// Slope of the surface at the corners of the lattice, in height per cell. It brings the
/// standard deviation of the heights to about 1/3.
const STEEPNESS: f64 = 1.6;

/// A random surface of hills and hollows about one unit wide: gradient noise with a quintic
/// blend (Perlin 2002). Heights have mean 0 and lie mostly within -1..1. The same seed gives
/// the same surface.
#[derive(Debug, Clone)]
pub struct Hills {
    order: Vec<u16>,
    slopes: Vec<[f32; 2]>,
}

impl Hills {
    /// Variance of the heights. Each of four corners adds a slope of `STEEPNESS` in a random
    /// direction, times the blend along x and y. The squared blend integrates to 181/462;
    /// multiplied by the squared distance, to 535/18018.
    pub const VARIANCE: f64 = 4.0 * STEEPNESS * STEEPNESS * (181.0 / 462.0) * (535.0 / 18018.0);

    /// Creates a surface. The directions of its slopes are drawn from `random`.
    pub fn new(random: &mut ChaCha8Rng) -> Self {
        let mut order: Vec<u16> = (0..PERIOD as u16).collect();
        order.shuffle(random);
        let slope = |_| {
            let angle = random.random_range(0.0..std::f64::consts::TAU);
            [angle.cos(), angle.sin()].map(|v| STEEPNESS as f32 * v as f32)
        };
        let slopes = (0..PERIOD).map(slope).collect();
        Self { order, slopes }
    }

    /// The height at `(x, y)`.
    pub fn at(&self, x: f32, y: f32) -> f32 {
        let (left, top) = (x.floor(), y.floor());
        let (a, b) = (x - left, y - top);
        let (column, row) = (left as i64 as usize, top as i64 as usize);
        let corner = |right: usize, down: usize| {
            let first = usize::from(self.order[column.wrapping_add(right) % PERIOD]);
            let index = self.order[first.wrapping_add(row).wrapping_add(down) % PERIOD];
            let [x, y] = self.slopes[usize::from(index)];
            x * (a - right as f32) + y * (b - down as f32)
        };
        let blend = |t: f32| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
        let mix = |from: f32, to: f32, share: f32| from + (to - from) * share;
        let upper = mix(corner(0, 0), corner(1, 0), blend(a));
        let lower = mix(corner(0, 1), corner(1, 1), blend(a));
        mix(upper, lower, blend(b))
    }
}

/// Random numbers for `seed`; each `kind` gives an independent stream.
pub fn random(seed: u64, kind: u64) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(kind);
    random
}
