//! Whitening of differences near one pixel, in f32.

use crate::bands::MOST_BANDS;
use crate::noise::{CURVES, Noise, Scale};

/// Numbers that are computed at once.
pub(crate) const LANES: usize = 8;

/// A number for each band; bands beyond those of the map hold what does not matter.
pub(crate) type Spectrum = [f32; MOST_BANDS];

/// `count` rounded up to whole lanes.
pub(crate) fn padded(count: usize) -> usize {
    count.div_ceil(LANES) * LANES
}

#[inline(always)]
pub(crate) fn total(lanes: &[f32; LANES]) -> f32 {
    let [a, b, c, d, e, f, g, h] = *lanes;
    ((a + e) + (b + f)) + ((c + g) + (d + h))
}

#[inline(always)]
pub(crate) fn dot(rows: usize, a: &Spectrum, b: &Spectrum) -> f32 {
    let mut sums = [0.0f32; LANES];
    for start in (0..rows).step_by(LANES) {
        let (a, b) = (&a[start..start + LANES], &b[start..start + LANES]);
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    total(&sums)
}

/// Noise of a map, laid out for vectors.
#[derive(Debug, Clone)]
pub(crate) struct WhiteningNoise {
    bands: usize,
    sensor: Vec<f32>,
    own: Vec<f32>,
    curves: Vec<[f32; CURVES]>,
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
    /// A by band.
    curves: [[f32; CURVES]; MOST_BANDS],
    /// A (I + L^T)^-1 L^-1 by band.
    removed: [[f32; CURVES]; MOST_BANDS],
}

impl WhiteningNoise {
    pub(crate) fn new(noise: &Noise) -> Self {
        let list = |values: &[f64]| values.iter().map(|value| *value as f32).collect();
        Self {
            bands: noise.sensor.len(),
            sensor: list(&noise.sensor),
            own: list(&noise.own),
            curves: noise.curves.iter().map(|curves| curves.map(|value| value as f32)).collect(),
            scale: noise.scale,
        }
    }

    /// Whitening near a pixel of these measured reflectances, whose slopes by the logarithm of K/S are
    /// `slope`.
    #[inline(always)]
    pub(crate) fn near(&self, measured: &Spectrum, slope: &Spectrum) -> Whitening {
        let mut white = Whitening {
            scale: [0.0; MOST_BANDS],
            curves: [[0.0; CURVES]; MOST_BANDS],
            removed: [[0.0; CURVES]; MOST_BANDS],
        };
        let mut products = [[0.0f32; CURVES]; CURVES];
        for band in 0..self.bands {
            let size = match self.scale {
                Scale::FourthRoot => {
                    let root = measured[band].max(1e-4).sqrt();
                    4.0 * root * root.sqrt()
                }
                Scale::LogRatio => slope[band],
            };
            let scale = 1.0 / (size * size * self.own[band] + self.sensor[band]).sqrt();
            white.scale[band] = scale;
            for (to, curve) in white.curves[band].iter_mut().zip(&self.curves[band]) {
                *to = scale * size * curve;
            }
            let curves = white.curves[band];
            for (row, a) in products.iter_mut().zip(&curves) {
                for (sum, b) in row.iter_mut().zip(&curves) {
                    *sum += a * b;
                }
            }
        }
        let factor = removal(&products);
        for band in 0..self.bands {
            for (from, row) in white.curves[band].iter().zip(&factor) {
                for (to, factor) in white.removed[band].iter_mut().zip(row) {
                    *to += from * factor;
                }
            }
        }
        white
    }
}

/// (I + L^T)^-1 L^-1 for L L^T = I + `products`.
#[inline(always)]
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
    pub(crate) fn whiten(&self, rows: usize, values: &mut Spectrum) {
        let mut common = [[0.0f32; CURVES]; 2];
        for band in 0..rows {
            values[band] *= self.scale[band];
        }
        for band in (0..rows).step_by(2) {
            for k in 0..CURVES {
                common[0][k] += self.curves[band][k] * values[band];
                common[1][k] += self.curves[band + 1][k] * values[band + 1];
            }
        }
        let common: [f32; CURVES] = std::array::from_fn(|k| common[0][k] + common[1][k]);
        for band in 0..rows {
            let mut products = [0.0f32; CURVES];
            for k in 0..CURVES {
                products[k] = self.removed[band][k] * common[k];
            }
            values[band] -= total(&products);
        }
    }

    /// Whitens many differences, which stand side by side in rows of `columns` for each band, and are already
    /// multiplied by the scale.
    #[inline(always)]
    pub(crate) fn whiten_rows(&self, rows: usize, columns: usize, values: &mut [f32]) {
        for column in (0..columns).step_by(LANES) {
            let mut common = [[0.0f32; LANES]; CURVES];
            for band in 0..rows {
                let row = &values[band * columns + column..][..LANES];
                for k in 0..CURVES {
                    for lane in 0..LANES {
                        common[k][lane] += self.curves[band][k] * row[lane];
                    }
                }
            }
            for band in 0..rows {
                let row = &mut values[band * columns + column..][..LANES];
                for k in 0..CURVES {
                    for lane in 0..LANES {
                        row[lane] -= self.removed[band][k] * common[k][lane];
                    }
                }
            }
        }
    }
}
