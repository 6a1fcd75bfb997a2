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
use super::vectors::{Eight, Task, Vectors, by_vectors};

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
    /// Whitens the difference of a spectrum from the pixel, and `others` with it.
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

    /// Whitens many differences, which stand side by side in rows of `columns` blocks for each band, and are
    /// already multiplied by the scale.
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
