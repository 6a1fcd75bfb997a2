//! Whitening of differences near one pixel, in f32, with the widest vectors of the processor.
//!
//! We fix the order of every sum, never fuse a multiplication with an addition, and round each
//! operation like the one on single numbers. So you get the same bits on all machines.

#![expect(
    clippy::needless_range_loop,
    reason = "sums over rows and columns of small matrices read best by their indices"
)]

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Sub};

use wide::f32x8;

use super::bands::MOST_BANDS;
use super::settings::{CURVES, Noise, Scale};

/// We compute this many numbers at once.
pub(crate) const LANES: usize = 8;
/// We compute at most this many blocks of bands at once.
pub(crate) const MOST_BLOCKS: usize = MOST_BANDS / LANES;

/// One number for each band, in blocks. Lanes beyond the last band are undefined.
pub(crate) type Spectrum = [f32x8; MOST_BLOCKS];

/// Sorts values into blocks, with `beyond` after the last.
pub(crate) fn spectrum(values: &[f32], beyond: f32) -> Spectrum {
    std::array::from_fn(|block| {
        f32x8::new(std::array::from_fn(|lane| {
            values.get(block * LANES + lane).copied().unwrap_or(beyond)
        }))
    })
}

#[inline(always)]
pub(crate) fn total<E: Eight>(lanes: E) -> f32 {
    let [a, b, c, d, e, f, g, h] = lanes.store().to_array();
    ((a + e) + (b + f)) + ((c + g) + (d + h))
}

/// Sum of products over `blocks`.
#[inline(always)]
pub(crate) fn dot<V: Vectors>(
    v: V,
    blocks: usize,
    a: &[V::Eight; MOST_BLOCKS],
    b: &[V::Eight; MOST_BLOCKS],
) -> f32 {
    let mut sum = v.splat(0.0);
    for (a, b) in a.iter().zip(b).take(blocks) {
        sum = sum + *a * *b;
    }
    total(sum)
}

/// Noise of a map, laid out for vectors.
#[derive(Debug, Clone)]
pub(crate) struct WhiteningNoise {
    bands: usize,
    sensor: Spectrum,
    own: Spectrum,
    curves: Vec<f32x8>,
    scale: Scale,
    gloss: f32,
}

/// Whitening of differences from one pixel: first the scale of each band, then the common curves.
///
/// With A, the curves after scaling, the covariance is I + A A^T. Let M = I + A^T A = L L^T. Then
/// x - A (I + L^T)^-1 L^-1 A^T x has the covariance I, as Potter's square root of a filter has.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Whitening {
    /// 1 / standard deviation of each band by itself, and 0 beyond the last.
    pub(crate) scale: Spectrum,
    /// The matrix A: for each band the values of all curves.
    curves: [f32x8; MOST_BANDS],
    /// The matrix A (I + L^T)^-1 L^-1: for each curve the values of all bands.
    removed: [Spectrum; CURVES],
}

impl WhiteningNoise {
    pub(crate) fn new(noise: &Noise) -> Self {
        let curves = noise.curves.iter().map(|curves| f32x8::new(curves.map(|value| value as f32)));
        Self {
            bands: noise.sensor.len(),
            sensor: list(&noise.sensor),
            own: list(&noise.own),
            curves: curves.collect(),
            scale: noise.scale,
            gloss: noise.gloss as f32,
        }
    }

    /// Whitening near a pixel. Pass its measured reflectances, and their slopes by the logarithm of
    /// K/S.
    pub(crate) fn near(&self, measured: &Spectrum, slope: &Spectrum) -> Whitening {
        by_vectors(Near { noise: self, measured, slope })
    }

    #[inline(always)]
    fn whitening<V: Vectors>(&self, v: V, measured: &Spectrum, slope: &Spectrum) -> Whitening {
        let zero = [f32x8::ZERO; MOST_BLOCKS];
        let mut white =
            Whitening { scale: zero, curves: [f32x8::ZERO; MOST_BANDS], removed: [zero; CURVES] };
        let mut products = [v.splat(0.0); CURVES];
        for block in 0..self.bands.div_ceil(LANES) {
            let size = match self.scale {
                Scale::FourthRoot => {
                    let root = v.load(measured[block]).greater(v.splat(1e-4)).sqrt();
                    v.splat(4.0) * root * root.sqrt()
                }
                Scale::LogRatio => v.load(slope[block]),
            };
            let variance = size * size * v.load(self.own[block]) + v.load(self.sensor[block]);
            let scales = (v.splat(1.0) / variance.sqrt()).store().to_array();
            let sizes = size.store().to_array();
            let mut kept = [0.0; LANES];
            for lane in 0..LANES.min(self.bands - block * LANES) {
                let band = block * LANES + lane;
                kept[lane] = scales[lane];
                let curves = v.splat(scales[lane] * sizes[lane]) * v.load(self.curves[band]);
                let mut numbers = curves.store().to_array();
                if self.gloss > 0.0 {
                    numbers[CURVES - 1] = scales[lane] * self.gloss;
                }
                let curves = v.load(f32x8::new(numbers));
                white.curves[band] = curves.store();
                for (sum, curve) in products.iter_mut().zip(curves.store().to_array()) {
                    *sum = *sum + v.splat(curve) * curves;
                }
            }
            white.scale[block] = f32x8::new(kept);
        }
        let factor = removal(&products.map(|row| row.store().to_array()));
        let factor = factor.map(|row| v.load(f32x8::new(row)));
        let mut removed = [[0.0; MOST_BANDS]; CURVES];
        for band in 0..self.bands {
            let mut sum = v.splat(0.0);
            for (from, row) in white.curves[band].to_array().into_iter().zip(&factor) {
                sum = sum + v.splat(from) * *row;
            }
            for (removed, value) in removed.iter_mut().zip(sum.store().to_array()) {
                removed[band] = value;
            }
        }
        white.removed = removed.map(|values| spectrum(&values, 0.0));
        white
    }
}

fn list(values: &[f64]) -> Spectrum {
    let values: Vec<f32> = values.iter().map(|value| *value as f32).collect();
    spectrum(&values, 1.0)
}

struct Near<'a> {
    noise: &'a WhiteningNoise,
    measured: &'a Spectrum,
    slope: &'a Spectrum,
}

impl Task for Near<'_> {
    type Result = Whitening;

    #[inline(always)]
    fn run<V: Vectors>(self, v: V) -> Whitening {
        self.noise.whitening(v, self.measured, self.slope)
    }
}

/// (I + L^T)^-1 L^-1 for L L^T = I + `products`.
fn removal(products: &[[f32; CURVES]; CURVES]) -> [[f32; CURVES]; CURVES] {
    let mut l = [[0.0f64; CURVES]; CURVES];
    for i in 0..CURVES {
        for j in 0..=i {
            let mut sum = f64::from(products[i][j]);
            if i == j {
                sum += 1.0;
            }
            for k in 0..j {
                sum -= l[i][k] * l[j][k];
            }
            l[i][j] = if i == j { sum.max(1e-6).sqrt() } else { sum / l[j][j] };
        }
    }
    // First L^-1, then (I + L^T)^-1 applied to its columns from below.
    let mut x = [[0.0f64; CURVES]; CURVES];
    for i in 0..CURVES {
        x[i][i] = 1.0 / l[i][i];
        for j in 0..i {
            let mut sum = 0.0;
            for k in j..i {
                sum -= l[i][k] * x[k][j];
            }
            x[i][j] = sum / l[i][i];
        }
    }
    for i in (0..CURVES).rev() {
        for k in i + 1..CURVES {
            let factor = l[k][i];
            for j in 0..CURVES {
                x[i][j] -= factor * x[k][j];
            }
        }
        for j in 0..CURVES {
            x[i][j] /= 1.0 + l[i][i];
        }
    }
    x.map(|row| row.map(|value| value as f32))
}

impl Whitening {
    /// Whitens the difference `values` of a spectrum from the pixel, and the differences `others`.
    #[inline(always)]
    pub(crate) fn whiten<V: Vectors, const N: usize>(
        &self,
        v: V,
        blocks: usize,
        values: &mut [V::Eight; MOST_BLOCKS],
        others: &mut [[V::Eight; MOST_BLOCKS]; N],
    ) {
        let zero = v.splat(0.0);
        let mut common = [zero; 2];
        let mut common_of = [[zero; 2]; N];
        for block in 0..blocks {
            let scale = v.load(self.scale[block]);
            values[block] = values[block] * scale;
            let lanes = values[block].store().to_array();
            let lanes_of: [[f32; LANES]; N] = std::array::from_fn(|i| {
                others[i][block] = others[i][block] * scale;
                others[i][block].store().to_array()
            });
            let curves = &self.curves[block * LANES..(block + 1) * LANES];
            for lane in 0..LANES {
                let curve = v.load(curves[lane]);
                common[lane % 2] = common[lane % 2] + v.splat(lanes[lane]) * curve;
                for i in 0..N {
                    common_of[i][lane % 2] =
                        common_of[i][lane % 2] + v.splat(lanes_of[i][lane]) * curve;
                }
            }
        }
        let common = (common[0] + common[1]).store().to_array();
        let common_of = common_of.map(|halves| (halves[0] + halves[1]).store().to_array());
        for block in 0..blocks {
            let mut sum = zero;
            let mut sums = [zero; N];
            for curve in 0..CURVES {
                let removed = v.load(self.removed[curve][block]);
                sum = sum + removed * v.splat(common[curve]);
                for i in 0..N {
                    sums[i] = sums[i] + removed * v.splat(common_of[i][curve]);
                }
            }
            values[block] = values[block] - sum;
            for i in 0..N {
                others[i][block] = others[i][block] - sums[i];
            }
        }
    }

    /// Whitens many differences at once. They stand side by side: each band has a row of `columns`
    /// blocks. Multiply them by `scale` before.
    #[inline(always)]
    pub(crate) fn whiten_rows<V: Vectors>(&self, v: V, columns: usize, values: &mut [f32x8]) {
        for column in 0..columns {
            let mut common = [v.splat(0.0); CURVES];
            for (row, curves) in values.chunks_exact(columns).zip(&self.curves) {
                for (sum, curve) in common.iter_mut().zip(curves.to_array()) {
                    *sum = *sum + v.splat(curve) * v.load(row[column]);
                }
            }
            for (block, rows) in values.chunks_mut(columns * LANES).enumerate() {
                let removed: [[f32; LANES]; CURVES] =
                    std::array::from_fn(|curve| self.removed[curve][block].to_array());
                for (lane, row) in rows.chunks_exact_mut(columns).enumerate() {
                    let mut sum = v.splat(0.0);
                    for (removed, common) in removed.iter().zip(&common) {
                        sum = sum + v.splat(removed[lane]) * *common;
                    }
                    row[column] = (v.load(row[column]) - sum).store();
                }
            }
        }
    }
}

/// A computation that we compile once for each kind of processor. The compiler inlines all of it.
pub(crate) trait Task {
    type Result;

    /// Runs the task. Mark your implementation `#[inline(always)]`.
    fn run<V: Vectors>(self, vectors: V) -> Self::Result;
}

/// Vectors of a kind of processor. A value of this type exists only if the processor has them.
pub(crate) trait Vectors: Copy {
    type Eight: Eight;

    /// Eight times `value`.
    fn splat(self, value: f32) -> Self::Eight;

    /// Loads numbers from memory.
    fn load(self, numbers: f32x8) -> Self::Eight;
}

/// Eight numbers in registers.
pub(crate) trait Eight:
    Copy + Debug + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    fn sqrt(self) -> Self;

    /// The greater number of each pair. For NaN the result depends on the processor.
    fn greater(self, other: Self) -> Self;

    /// A bit for each number, set if it is greater than its counterpart in `other`. The lowest bit
    /// belongs to the first number.
    fn is_above(self, other: Self) -> u32;

    /// Stores the numbers in memory.
    fn store(self) -> f32x8;
}

/// Runs `task` with the vectors of this processor.
#[inline(always)]
pub(crate) fn by_vectors<T: Task>(task: T) -> T::Result {
    #[cfg(target_arch = "x86_64")]
    if let Some(vectors) = pulp::x86::V3::try_new() {
        return vectors.vectorize(avx2::Dispatched { task, vectors });
    }
    task.run(Halves)
}

/// Two vectors of four numbers, or single numbers on a processor without vectors.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Halves;

impl Vectors for Halves {
    type Eight = f32x8;

    #[inline(always)]
    fn splat(self, value: f32) -> f32x8 {
        f32x8::splat(value)
    }

    #[inline(always)]
    fn load(self, numbers: f32x8) -> f32x8 {
        numbers
    }
}

impl Eight for f32x8 {
    #[inline(always)]
    fn sqrt(self) -> Self {
        f32x8::sqrt(self)
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        self.fast_max(other)
    }

    #[inline(always)]
    fn is_above(self, other: Self) -> u32 {
        self.simd_gt(other).to_bitmask()
    }

    #[inline(always)]
    fn store(self) -> f32x8 {
        self
    }
}

/// Vectors of 256 bits. The crate `wide` would compute two halves even in code for AVX2, and take
/// nearly twice the time.
#[cfg(target_arch = "x86_64")]
mod avx2 {
    use std::arch::x86_64::__m256;
    use std::ops::{Add, Div, Mul, Sub};

    use pulp::x86::V3;
    use wide::f32x8;

    use super::{Eight, Task, Vectors};

    pub(super) struct Dispatched<T> {
        pub(super) task: T,
        pub(super) vectors: V3,
    }

    impl<T: Task> pulp::NullaryFnOnce for Dispatched<T> {
        type Output = T::Result;

        #[inline(always)]
        fn call(self) -> T::Result {
            self.task.run(self.vectors)
        }
    }

    /// Eight numbers. The token proves that the processor has vectors for them.
    #[derive(Debug, Clone, Copy)]
    pub(crate) struct Numbers {
        vectors: V3,
        lanes: __m256,
    }

    impl Vectors for V3 {
        type Eight = Numbers;

        #[inline(always)]
        fn splat(self, value: f32) -> Numbers {
            Numbers { vectors: self, lanes: self.avx._mm256_set1_ps(value) }
        }

        #[inline(always)]
        fn load(self, numbers: f32x8) -> Numbers {
            Numbers { vectors: self, lanes: pulp::cast(numbers) }
        }
    }

    impl Numbers {
        #[inline(always)]
        fn with(self, lanes: __m256) -> Self {
            Self { lanes, ..self }
        }
    }

    impl Add for Numbers {
        type Output = Self;

        #[inline(always)]
        fn add(self, other: Self) -> Self {
            self.with(self.vectors.avx._mm256_add_ps(self.lanes, other.lanes))
        }
    }

    impl Sub for Numbers {
        type Output = Self;

        #[inline(always)]
        fn sub(self, other: Self) -> Self {
            self.with(self.vectors.avx._mm256_sub_ps(self.lanes, other.lanes))
        }
    }

    impl Mul for Numbers {
        type Output = Self;

        #[inline(always)]
        fn mul(self, other: Self) -> Self {
            self.with(self.vectors.avx._mm256_mul_ps(self.lanes, other.lanes))
        }
    }

    impl Div for Numbers {
        type Output = Self;

        #[inline(always)]
        fn div(self, other: Self) -> Self {
            self.with(self.vectors.avx._mm256_div_ps(self.lanes, other.lanes))
        }
    }

    impl Eight for Numbers {
        #[inline(always)]
        fn sqrt(self) -> Self {
            self.with(self.vectors.avx._mm256_sqrt_ps(self.lanes))
        }

        #[inline(always)]
        fn greater(self, other: Self) -> Self {
            self.with(self.vectors.avx._mm256_max_ps(self.lanes, other.lanes))
        }

        #[inline(always)]
        fn is_above(self, other: Self) -> u32 {
            let avx = self.vectors.avx;
            let above =
                avx._mm256_cmp_ps::<{ std::arch::x86_64::_CMP_GT_OQ }>(self.lanes, other.lanes);
            avx._mm256_movemask_ps(above) as u32
        }

        #[inline(always)]
        fn store(self) -> f32x8 {
            pulp::cast(self.lanes)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The results of all operations on eight numbers.
    struct All([f32x8; 2]);

    impl Task for All {
        type Result = ([[f32; 8]; 6], u32);

        fn run<V: Vectors>(self, v: V) -> Self::Result {
            let [a, b] = self.0.map(|numbers| v.load(numbers));
            let found = [a + b, a - b, a * v.splat(3.7) * b, a / b, a.sqrt(), a.greater(b)];
            (found.map(|numbers| numbers.store().to_array()), a.is_above(b))
        }
    }

    #[test]
    fn all_vectors_round_as_single_numbers_do() {
        for row in 0..50 {
            let [a, mut b]: [[f32; 8]; 2] = [1.3, 0.7].map(|factor: f32| {
                std::array::from_fn(|lane: usize| {
                    let wave = (factor * (8 * row + lane) as f32).sin();
                    wave * wave * 10f32.powi((row as i32 + lane as i32) % 30 - 15)
                })
            });
            b[row % 8] = a[row % 8];
            let both = [f32x8::new(a), f32x8::new(b)];
            let single: [[f32; 6]; 8] = std::array::from_fn(|i| {
                let a = a[i];
                let b = b[i];
                [a + b, a - b, a * 3.7 * b, a / b, a.sqrt(), if a > b { a } else { b }]
            });
            let above = (0..8).fold(0, |bits, i| bits | u32::from(a[i] > b[i]) << i);
            for (found, bits) in [by_vectors(All(both)), All(both).run(Halves)] {
                assert_eq!(bits, above, "{a:?} {b:?}");
                for (operation, numbers) in found.iter().enumerate() {
                    for (lane, number) in numbers.iter().enumerate() {
                        let expected = single[lane][operation];
                        assert_eq!(
                            number.to_bits(),
                            expected.to_bits(),
                            "{operation}: {a:?} {b:?}"
                        );
                    }
                }
            }
        }
    }
}
