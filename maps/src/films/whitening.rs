//! Whitening of differences near one pixel, in f32, eight numbers at a time.
//!
//! Every sum has one order, and no multiplication is fused with an addition, so that all machines give the
//! same bits.

#![expect(
    clippy::needless_range_loop,
    reason = "sums over rows and columns of small matrices read best by their indices"
)]

use wide::f32x8;

use super::bands::MOST_BANDS;
use super::noise::{CURVES, Noise, Scale};
use super::vectors::{Task, by_vectors};

/// Numbers that are computed at once.
pub(crate) const LANES: usize = 8;
/// Most blocks of bands that are computed at once.
pub(crate) const MOST_BLOCKS: usize = MOST_BANDS / LANES;

/// A number for each band, in blocks; bands beyond those of the map hold what does not matter.
pub(crate) type Spectrum = [f32x8; MOST_BLOCKS];

/// Values in blocks, with `beyond` after the last.
pub(crate) fn spectrum(values: &[f32], beyond: f32) -> Spectrum {
    let value = |index: usize| values.get(index).copied().unwrap_or(beyond);
    std::array::from_fn(|block| f32x8::new(std::array::from_fn(|lane| value(block * LANES + lane))))
}

/// Sum of all lanes.
#[inline(always)]
pub(crate) fn total(lanes: f32x8) -> f32 {
    let [a, b, c, d, e, f, g, h] = lanes.to_array();
    ((a + e) + (b + f)) + ((c + g) + (d + h))
}

/// Sum of products over `blocks`.
#[inline(always)]
pub(crate) fn dot(blocks: usize, a: &Spectrum, b: &Spectrum) -> f32 {
    let mut sum = f32x8::ZERO;
    for (a, b) in a.iter().zip(b).take(blocks) {
        sum += *a * *b;
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
}

/// Whitening of differences from one pixel: first the scale of each band, then the common curves.
///
/// With A, the curves after scaling, the covariance is I + A A^T. Let M = I + A^T A = L L^T. Then
/// x - A (I + L^T)^-1 L^-1 A^T x has the covariance I, as Potter's square root of a filter has.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Whitening {
    /// 1 / standard deviation of each band by itself; 0 beyond the last.
    pub(crate) scale: Spectrum,
    /// A by band, with all curves of one.
    curves: [f32x8; MOST_BANDS],
    /// A (I + L^T)^-1 L^-1 by curve.
    removed: [Spectrum; CURVES],
}

impl WhiteningNoise {
    pub(crate) fn new(noise: &Noise) -> Self {
        let list = |values: &[f64]| {
            let values: Vec<f32> = values.iter().map(|value| *value as f32).collect();
            spectrum(&values, 1.0)
        };
        let curves = noise.curves.iter().map(|curves| f32x8::new(curves.map(|value| value as f32)));
        Self {
            bands: noise.sensor.len(),
            sensor: list(&noise.sensor),
            own: list(&noise.own),
            curves: curves.collect(),
            scale: noise.scale,
        }
    }

    /// Whitening near a pixel of these measured reflectances, whose slopes by the logarithm of K/S are
    /// `slope`.
    pub(crate) fn near(&self, measured: &Spectrum, slope: &Spectrum) -> Whitening {
        by_vectors(Near { noise: self, measured, slope })
    }

    #[inline(always)]
    fn whitening(&self, measured: &Spectrum, slope: &Spectrum) -> Whitening {
        let zero = [f32x8::ZERO; MOST_BLOCKS];
        let mut white =
            Whitening { scale: zero, curves: [f32x8::ZERO; MOST_BANDS], removed: [zero; CURVES] };
        let mut products = [f32x8::ZERO; CURVES];
        for block in 0..self.bands.div_ceil(LANES) {
            let size = match self.scale {
                Scale::FourthRoot => {
                    let root = measured[block].fast_max(f32x8::splat(1e-4)).sqrt();
                    f32x8::splat(4.0) * root * root.sqrt()
                }
                Scale::LogRatio => slope[block],
            };
            let variance = size * size * self.own[block] + self.sensor[block];
            let scales = (f32x8::ONE / variance.sqrt()).to_array();
            let sizes = size.to_array();
            let mut kept = [0.0; LANES];
            for lane in 0..LANES.min(self.bands - block * LANES) {
                let band = block * LANES + lane;
                kept[lane] = scales[lane];
                let curves = f32x8::splat(scales[lane] * sizes[lane]) * self.curves[band];
                white.curves[band] = curves;
                for (sum, curve) in products.iter_mut().zip(curves.to_array()) {
                    *sum += f32x8::splat(curve) * curves;
                }
            }
            white.scale[block] = f32x8::new(kept);
        }
        let factor = removal(&products.map(f32x8::to_array)).map(f32x8::new);
        let mut removed = [[0.0; MOST_BANDS]; CURVES];
        for band in 0..self.bands {
            let mut sum = f32x8::ZERO;
            for (from, row) in white.curves[band].to_array().into_iter().zip(&factor) {
                sum += f32x8::splat(from) * *row;
            }
            for (removed, value) in removed.iter_mut().zip(sum.to_array()) {
                removed[band] = value;
            }
        }
        white.removed = removed.map(|values| spectrum(&values, 0.0));
        white
    }
}

struct Near<'a> {
    noise: &'a WhiteningNoise,
    measured: &'a Spectrum,
    slope: &'a Spectrum,
}

impl Task for Near<'_> {
    type Result = Whitening;

    #[inline(always)]
    fn run(self) -> Whitening {
        self.noise.whitening(self.measured, self.slope)
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
    /// Whitens the difference of a spectrum from the pixel.
    #[inline(always)]
    pub(crate) fn whiten(&self, blocks: usize, values: &mut Spectrum) {
        let mut common = [f32x8::ZERO; 2];
        for block in 0..blocks {
            values[block] *= self.scale[block];
            let lanes = values[block].to_array();
            let curves = &self.curves[block * LANES..(block + 1) * LANES];
            for lane in (0..LANES).step_by(2) {
                common[0] += f32x8::splat(lanes[lane]) * curves[lane];
                common[1] += f32x8::splat(lanes[lane + 1]) * curves[lane + 1];
            }
        }
        let common = (common[0] + common[1]).to_array();
        for block in 0..blocks {
            let mut sum = f32x8::ZERO;
            for (removed, common) in self.removed.iter().zip(common) {
                sum += removed[block] * f32x8::splat(common);
            }
            values[block] -= sum;
        }
    }

    /// Whitens many differences, which stand side by side in rows of `columns` blocks for each band, and are
    /// already multiplied by the scale.
    #[inline(always)]
    pub(crate) fn whiten_rows(&self, columns: usize, values: &mut [f32x8]) {
        for column in 0..columns {
            let mut common = [f32x8::ZERO; CURVES];
            for (row, curves) in values.chunks_exact(columns).zip(&self.curves) {
                for (sum, curve) in common.iter_mut().zip(curves.to_array()) {
                    *sum += f32x8::splat(curve) * row[column];
                }
            }
            for (block, rows) in values.chunks_mut(columns * LANES).enumerate() {
                let removed: [[f32; LANES]; CURVES] =
                    std::array::from_fn(|curve| self.removed[curve][block].to_array());
                for (lane, row) in rows.chunks_exact_mut(columns).enumerate() {
                    let mut sum = f32x8::ZERO;
                    for (removed, common) in removed.iter().zip(&common) {
                        sum += f32x8::splat(removed[lane]) * *common;
                    }
                    row[column] -= sum;
                }
            }
        }
    }
}
