//! Smooth random surfaces.

use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const PERIOD: usize = 1024;

/// Slope of the surface at the corners of the lattice, in height per cell. This brings the
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
    /// direction, times the blend along x and y. The squared blend integrates to 181/462,
    /// multiplied by the squared distance, to 535/18018.
    pub const VARIANCE: f64 = 4.0 * STEEPNESS * STEEPNESS * (181.0 / 462.0) * (535.0 / 18018.0);

    /// Creates a surface. `random` gives the directions of its slopes.
    pub fn new(random: &mut ChaCha8Rng) -> Self {
        let mut order: Vec<u16> = (0..PERIOD as u16).collect();
        order.shuffle(random);
        let slopes = (0..PERIOD)
            .map(|_| {
                let angle = random.random_range(0.0..std::f64::consts::TAU);
                [angle.cos(), angle.sin()].map(|v| STEEPNESS as f32 * v as f32)
            })
            .collect();
        Self { order, slopes }
    }

    /// The height at `(x, y)`.
    pub fn at(&self, x: f32, y: f32) -> f32 {
        let left = x.floor();
        let top = y.floor();
        let a = x - left;
        let b = y - top;
        let column = left as i64 as usize;
        let row = top as i64 as usize;
        let corner = |right: usize, down: usize| {
            let first = usize::from(self.order[column.wrapping_add(right) % PERIOD]);
            let index = self.order[first.wrapping_add(row).wrapping_add(down) % PERIOD];
            let [x, y] = self.slopes[usize::from(index)];
            x * (a - right as f32) + y * (b - down as f32)
        };
        let upper = mix(corner(0, 0), corner(1, 0), blend(a));
        let lower = mix(corner(0, 1), corner(1, 1), blend(a));
        mix(upper, lower, blend(b))
    }
}

/// Random hills throughout space: gradient noise with a quintic blend (Perlin 2002). A hash of the
/// lattice corner picks the gradient from a cube. Heights lie in -1..1, with mean 0 and a standard
/// deviation of about 1/3.
///
/// We use only floor, + - * and whole numbers. This gives the same heights on every machine, and
/// compilers vectorise loops over it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SolidHills {
    seed: u32,
}

/// Greatest component of a gradient. This brings the standard deviation to 1/3: eight corners each
/// add three components of variance `STEEPEST^2 / 3`, times the blends as for [`Hills`].
const STEEPEST: f32 = 1.746;

/// Odd factors (from xxHash32, Collet 2012) that tell the axes of the lattice apart.
const FACTORS: [u32; 3] = [0x9e37_79b1, 0x85eb_ca77, 0xc2b2_ae3d];

impl SolidHills {
    /// A plane through the hills has most of its variance at this frequency, in waves per unit. It
    /// is the peak of frequency times spectral density, from the Fourier transform of the blend.
    pub const STRONGEST: f32 = 0.52;

    /// Creates hills from a number that `random` draws.
    pub fn new(random: &mut ChaCha8Rng) -> Self {
        Self { seed: random.random() }
    }

    /// The number that distinguishes these hills from others. Pass this to twins of this code in
    /// shaders.
    #[must_use]
    pub fn seed(self) -> u32 {
        self.seed
    }

    /// The height at a place in space.
    #[inline(always)]
    #[must_use]
    pub fn at(self, place: [f32; 3]) -> f32 {
        let low = [place[0].floor(), place[1].floor(), place[2].floor()];
        let from = [place[0] - low[0], place[1] - low[1], place[2] - low[2]];
        let hashes = [
            (low[0] as i32 as u32).wrapping_mul(FACTORS[0]),
            (low[1] as i32 as u32).wrapping_mul(FACTORS[1]),
            (low[2] as i32 as u32).wrapping_mul(FACTORS[2]),
        ];
        let shares = [blend(from[0]), blend(from[1]), blend(from[2])];
        let near = self.side(0, hashes, from, shares);
        let height = mix(near, self.side(1, hashes, from, shares), shares[2]) * STEEPEST;
        let height = if height > 1.0 { 1.0 } else { height };
        if height < -1.0 { -1.0 } else { height }
    }

    /// The height between the four corners at the near or far side along z.
    #[inline(always)]
    fn side(self, back: u32, hashes: [u32; 3], from: [f32; 3], shares: [f32; 3]) -> f32 {
        let upper = mix(
            self.corner([0, 0, back], hashes, from),
            self.corner([1, 0, back], hashes, from),
            shares[0],
        );
        let lower = mix(
            self.corner([0, 1, back], hashes, from),
            self.corner([1, 1, back], hashes, from),
            shares[0],
        );
        mix(upper, lower, shares[1])
    }

    #[inline(always)]
    fn corner(self, corner: [u32; 3], hashes: [u32; 3], from: [f32; 3]) -> f32 {
        let x = hashes[0].wrapping_add(corner[0].wrapping_mul(FACTORS[0]));
        let y = hashes[1].wrapping_add(corner[1].wrapping_mul(FACTORS[1]));
        let z = hashes[2].wrapping_add(corner[2].wrapping_mul(FACTORS[2]));
        let x_from = from[0] - corner[0] as f32;
        let y_from = from[1] - corner[1] as f32;
        let z_from = from[2] - corner[2] as f32;
        slope(mixed(x ^ y ^ z ^ self.seed), [x_from, y_from, z_from])
    }
}

#[inline(always)]
fn blend(t: f32) -> f32 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

#[inline(always)]
fn mix(from: f32, to: f32, share: f32) -> f32 {
    from + (to - from) * share
}

/// A hash in which every bit of `bits` counts (the finaliser of MurmurHash3, Appleby 2011).
#[inline(always)]
fn mixed(bits: u32) -> u32 {
    let bits = (bits ^ (bits >> 16)).wrapping_mul(0x85eb_ca6b);
    let bits = (bits ^ (bits >> 13)).wrapping_mul(0xc2b2_ae35);
    bits ^ (bits >> 16)
}

/// The scalar product of `from` and a gradient in the cube -1..1. `bits` holds three times ten
/// bits.
#[inline(always)]
fn slope(bits: u32, [x, y, z]: [f32; 3]) -> f32 {
    let a = (bits >> 22) as i32 as f32;
    let b = ((bits >> 12) & 1023) as i32 as f32;
    let c = ((bits >> 2) & 1023) as i32 as f32;
    (a * x + b * y + c * z) * (2.0 / 1023.0) - (x + y + z)
}

/// Random numbers for `seed`. If you pass another `kind`, you get an independent stream.
pub fn random(seed: u64, kind: u64) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(kind);
    random
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heights(seed: u64) -> Vec<f32> {
        let hills = SolidHills::new(&mut random(seed, 0));
        (0..8000)
            .map(|i| hills.at([i % 20, i / 20 % 20, i / 400].map(|n| n as f32 * 0.37 - 3.0)))
            .collect()
    }

    #[test]
    fn solid_hills_have_the_mean_and_deviation_that_they_say() {
        let mut mean = 0.0;
        let mut square = 0.0;
        for seed in 0..20 {
            for height in heights(seed).into_iter().map(f64::from) {
                assert!((-1.0..=1.0).contains(&height), "{height}");
                (mean, square) = (mean + height, square + height * height);
            }
        }
        let mean = mean / 160_000.0;
        let deviation = (square / 160_000.0).sqrt();
        assert!(mean.abs() < 0.02 && (deviation - 1.0 / 3.0).abs() < 0.02, "{mean} {deviation}");
    }

    #[test]
    fn solid_hills_are_smooth_and_differ_by_seed() {
        let hills = SolidHills::new(&mut random(1, 0));
        fn line(i: i32, hills: &SolidHills) -> f32 {
            hills.at([i as f32 / 256.0 - 4.0, 0.3, -0.7])
        }
        let steepest =
            (0..2048).map(|i| (line(i + 1, &hills) - line(i, &hills)).abs()).fold(0.0, f32::max);
        assert!((0.001..0.02).contains(&steepest), "{steepest}");
        assert_ne!(heights(1), heights(2));
        assert_eq!(hills.at([3.0, -2.0, 5.0]), 0.0, "corners of the lattice have height 0");
    }

    #[test]
    fn solid_hills_are_the_same_on_every_machine() {
        // These numbers come from a second implementation in numpy. Other bits would change every
        // world made before.
        let hills = SolidHills { seed: 0x1234_5678 };
        let found =
            [[0.5, 0.5, 0.5], [-7.3, 12.9, 0.1], [1000.2, -0.4, 33.3]].map(|at| hills.at(at));
        assert_eq!(found.map(f32::to_bits), [3_193_241_713, 1_052_674_502, 1_058_573_425]);
    }
}
