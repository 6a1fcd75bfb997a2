//! Arithmetic of one pixel in f32, eight bands or pigments at a time.
//!
//! Every sum has one order, and no multiplication is fused with an addition, so that machines with wide and
//! with narrow vectors give the same bits.

use pulp::{Simd, WithSimd};

use crate::bands::MOST_BANDS;
use crate::paints::Paints;

/// Numbers that are computed at once.
pub(crate) const LANES: usize = 8;
/// Most pigments of a set.
pub(crate) const MOST_IN_SET: usize = 4;
/// Range of internal reflectances to which a pixel is moved where it is linearised.
const INTERNAL: [f32; 2] = [1e-4, 0.9995];

/// A number for each band; bands beyond those of the map hold what does not matter.
pub(crate) type Spectrum = [f32; MOST_BANDS];

/// `count` rounded up to whole lanes.
pub(crate) fn padded(count: usize) -> usize {
    count.div_ceil(LANES) * LANES
}

/// K, S and surface of the pigments, laid out for vectors.
#[derive(Debug, Clone)]
pub(crate) struct Films {
    pub(crate) pigments: usize,
    pub(crate) bands: usize,
    /// Bands rounded up to whole lanes, with K = S = 1 beyond the last.
    pub(crate) rows: usize,
    /// Pigments rounded up to whole lanes, with K = S = 0 beyond the last.
    pub(crate) columns: usize,
    /// K and S by pigment, each `rows` long.
    absorption: Vec<f32>,
    scattering: Vec<f32>,
    /// K and S by band, each `columns` long.
    absorption_of_band: Vec<f32>,
    scattering_of_band: Vec<f32>,
    floor: f32,
    /// (1 - k1) (1 - k2).
    through: f32,
    k2: f32,
    arch: pulp::Arch,
}

/// A pixel's measured reflectance, and the internal one within the range of films.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pixel {
    pub(crate) measured: Spectrum,
    pub(crate) internal: Spectrum,
}

/// Differences of a pixel from a film: chi-square, and the normal equations of the shares.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Difference {
    pub(crate) chi2: f32,
    /// Sum of squares of the differences in reflectance.
    pub(crate) squares: f32,
    pub(crate) normal: [[f32; MOST_IN_SET]; MOST_IN_SET],
    pub(crate) right: [f32; MOST_IN_SET],
}

impl Films {
    pub(crate) fn new(paints: &Paints) -> Self {
        let (pigments, bands) = (paints.count(), paints.bands());
        let (rows, columns) = (padded(bands), padded(pigments));
        let by_pigment = |curves: &[Vec<f64>]| -> Vec<f32> {
            let value = |p: usize, b: usize| if b < bands { curves[p][b] as f32 } else { 1.0 };
            (0..pigments * rows).map(|i| value(i / rows, i % rows)).collect()
        };
        let by_band = |curves: &[Vec<f64>]| -> Vec<f32> {
            let value = |b: usize, p: usize| {
                if b < bands && p < pigments { curves[p][b] as f32 } else { 0.0 }
            };
            (0..rows * columns).map(|i| value(i / columns, i % columns)).collect()
        };
        let surface = paints.surface;
        Self {
            pigments,
            bands,
            rows,
            columns,
            absorption: by_pigment(&paints.absorption),
            scattering: by_pigment(&paints.scattering),
            absorption_of_band: by_band(&paints.absorption),
            scattering_of_band: by_band(&paints.scattering),
            floor: surface.floor() as f32,
            through: ((1.0 - surface.k1) * (1.0 - surface.k2)) as f32,
            k2: surface.k2 as f32,
            arch: pulp::Arch::new(),
        }
    }

    /// A pixel of these measured reflectances, one for each band.
    pub(crate) fn pixel(&self, reflectance: &[f32]) -> Pixel {
        let mut pixel = Pixel { measured: [0.0; MOST_BANDS], internal: [0.5; MOST_BANDS] };
        pixel.measured[..self.bands].copy_from_slice(&reflectance[..self.bands]);
        for (internal, &measured) in pixel.internal.iter_mut().zip(reflectance) {
            let above = (measured - self.floor).max(0.0);
            let inside = above / (self.through + self.k2 * above);
            *internal = inside.clamp(INTERNAL[0], INTERNAL[1]);
        }
        pixel
    }

    /// Internal reflectance and 1/S of a film, by band.
    pub(crate) fn film(&self, shares: &[(usize, f32)]) -> (Spectrum, Spectrum) {
        let (mut internal, mut inverse) = ([0.5; MOST_BANDS], [1.0; MOST_BANDS]);
        for band in 0..self.rows {
            let (mut k, mut s) = (0.0, 0.0);
            for &(pigment, share) in shares {
                k += share * self.absorption[pigment * self.rows + band];
                s += share * self.scattering[pigment * self.rows + band];
            }
            internal[band] = (s / (k + s + (k * (k + 2.0 * s)).sqrt())).clamp(INTERNAL[0], INTERNAL[1]);
            inverse[band] = 1.0 / s;
        }
        (internal, inverse)
    }

    /// Compares `pixel` with the film of `shares` of the pigments `members`.
    pub(crate) fn difference<const N: usize>(
        &self,
        whitening: &[f32],
        pixel: &Pixel,
        members: [usize; N],
        shares: [f32; N],
    ) -> Difference {
        self.arch.dispatch(Compare { films: self, whitening, pixel, members, shares })
    }

    /// Products of all pigments' rows, which are 0 in sum at the shares of a film like `pixel`, linearised
    /// with secants to the film of internal reflectance and 1/S `about`.
    pub(crate) fn products(
        &self,
        whitening: &[f32],
        pixel: &Pixel,
        about: (&Spectrum, &Spectrum),
        work: &mut Work,
    ) {
        self.arch.dispatch(Products { films: self, whitening, pixel, about, work });
    }
}

/// Memory of [`Films::products`].
#[derive(Debug, Clone)]
pub(crate) struct Work {
    plain: Vec<f32>,
    white: Vec<f32>,
    /// Products of the rows of all pairs of pigments, `columns` by `columns`; the upper half is valid.
    pub(crate) products: Vec<f32>,
}

impl Work {
    pub(crate) fn new(films: &Films) -> Self {
        let size = films.rows * films.columns;
        Self {
            plain: vec![0.0; size],
            white: vec![0.0; size],
            products: vec![0.0; films.columns * films.columns],
        }
    }
}

/// Lays out a lower triangular matrix for [`Films`]: blocks of eight rows, column by column up to the
/// diagonal.
pub(crate) fn blocked(matrix: &nalgebra::DMatrix<f64>) -> Vec<f32> {
    let count = matrix.nrows();
    let rows = padded(count);
    let mut blocks = Vec::with_capacity(blocked_length(rows));
    for block in 0..rows / LANES {
        for column in 0..(block + 1) * LANES {
            for row in block * LANES..(block + 1) * LANES {
                let inside = row < count && column < count && column <= row;
                blocks.push(if inside { matrix[(row, column)] as f32 } else { 0.0 });
            }
        }
    }
    blocks
}

/// Numbers of a matrix of `rows` rows that [`blocked`] laid out.
pub(crate) fn blocked_length(rows: usize) -> usize {
    let blocks = rows / LANES;
    LANES * LANES * blocks * (blocks + 1) / 2
}

struct Compare<'a, const N: usize> {
    films: &'a Films,
    whitening: &'a [f32],
    pixel: &'a Pixel,
    members: [usize; N],
    shares: [f32; N],
}

impl<const N: usize> WithSimd for Compare<'_, N> {
    type Output = Difference;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Difference {
        let Self { films, whitening, pixel, members, shares } = self;
        let rows = films.rows;
        let mut residual = [0.0f32; MOST_BANDS];
        let mut slopes = [[0.0f32; MOST_BANDS]; N];
        let mut squares = [0.0f32; LANES];
        for start in (0..rows).step_by(LANES) {
            let (mut k, mut s) = ([0.0f32; LANES], [0.0f32; LANES]);
            let curve = |all: &'_ [f32], member: usize| -> [f32; LANES] {
                let at = members[member] * rows + start;
                std::array::from_fn(|lane| all[at..at + LANES][lane])
            };
            for i in 0..N {
                let (a, b) = (curve(&films.absorption, i), curve(&films.scattering, i));
                for lane in 0..LANES {
                    k[lane] += shares[i] * a[lane];
                    s[lane] += shares[i] * b[lane];
                }
            }
            let measured: [f32; LANES] =
                std::array::from_fn(|lane| pixel.measured[start..start + LANES][lane]);
            let (mut over_k, mut over_s, mut rest) = ([0.0f32; LANES], [0.0f32; LANES], [0.0f32; LANES]);
            for lane in 0..LANES {
                let (k, s) = (k[lane], s[lane]);
                let inside = s / (k + s + (k * (k + 2.0 * s)).sqrt());
                let out = 1.0 / (1.0 - films.k2 * inside);
                let slope =
                    -films.through * out * out * inside * (1.0 - inside) / (1.0 + inside);
                rest[lane] = measured[lane] - (films.floor + films.through * inside * out);
                over_k[lane] = slope / k;
                over_s[lane] = slope / s;
            }
            residual[start..start + LANES].copy_from_slice(&rest);
            if start + LANES <= films.bands {
                for lane in 0..LANES {
                    squares[lane] += rest[lane] * rest[lane];
                }
            } else {
                for lane in 0..films.bands - start {
                    squares[lane] += rest[lane] * rest[lane];
                }
            }
            for i in 0..N {
                let (a, b) = (curve(&films.absorption, i), curve(&films.scattering, i));
                let slope: [f32; LANES] =
                    std::array::from_fn(|lane| a[lane] * over_k[lane] - b[lane] * over_s[lane]);
                slopes[i][start..start + LANES].copy_from_slice(&slope);
            }
        }
        let residual = whitened(whitening, rows, &residual);
        for slope in &mut slopes {
            *slope = whitened(whitening, rows, slope);
        }
        let mut found = Difference {
            chi2: dot(rows, &residual, &residual),
            squares: total(&squares),
            ..Difference::default()
        };
        for i in 0..N {
            found.right[i] = dot(rows, &slopes[i], &residual);
            for j in 0..=i {
                let product = dot(rows, &slopes[i], &slopes[j]);
                found.normal[i][j] = product;
                found.normal[j][i] = product;
            }
        }
        found
    }
}

#[inline(always)]
fn total(lanes: &[f32; LANES]) -> f32 {
    let [a, b, c, d, e, f, g, h] = *lanes;
    ((a + e) + (b + f)) + ((c + g) + (d + h))
}

#[inline(always)]
fn dot(rows: usize, a: &Spectrum, b: &Spectrum) -> f32 {
    let mut sums = [0.0f32; LANES];
    for start in (0..rows).step_by(LANES) {
        let (a, b) = (&a[start..start + LANES], &b[start..start + LANES]);
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    total(&sums)
}

/// Product of the matrix laid out by [`blocked`] with `values`.
#[inline(always)]
fn whitened(matrix: &[f32], rows: usize, values: &Spectrum) -> Spectrum {
    let mut result = [0.0f32; MOST_BANDS];
    let mut at = 0;
    for start in (0..rows).step_by(LANES) {
        let columns = start + LANES;
        let block = &matrix[at..at + columns * LANES];
        let mut sums = [[0.0f32; LANES]; 2];
        for (pair, values) in block.chunks_exact(2 * LANES).zip(values[..columns].chunks_exact(2)) {
            for lane in 0..LANES {
                sums[0][lane] += pair[lane] * values[0];
                sums[1][lane] += pair[LANES + lane] * values[1];
            }
        }
        for lane in 0..LANES {
            result[start + lane] = sums[0][lane] + sums[1][lane];
        }
        at += columns * LANES;
    }
    result
}

struct Products<'a> {
    films: &'a Films,
    whitening: &'a [f32],
    pixel: &'a Pixel,
    about: (&'a Spectrum, &'a Spectrum),
    work: &'a mut Work,
}

impl WithSimd for Products<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { films, whitening, pixel, about: (internal, inverse), work } = self;
        let (rows, columns) = (films.rows, films.columns);
        for band in 0..rows {
            // The secant of K/S between two internal reflectances is exact in this form, without a
            // difference of nearly equal numbers, and finite where the pixel is black.
            let (m, r) = (pixel.internal[band], internal[band]);
            let weight = films.through * r * inverse[band]
                / ((1.0 - films.k2 * m) * (1.0 - films.k2 * r) * (1.0 - m * r));
            let (by_s, by_k) = (weight * (1.0 - m) * (1.0 - m), weight * 2.0 * m);
            let at = band * columns..(band + 1) * columns;
            let k = &films.absorption_of_band[at.clone()];
            let s = &films.scattering_of_band[at.clone()];
            for (x, (k, s)) in work.plain[at].iter_mut().zip(k.iter().zip(s)) {
                *x = by_s * s - by_k * k;
            }
        }
        let mut at = 0;
        for start in (0..rows).step_by(LANES) {
            let count = start + LANES;
            let block = &whitening[at..at + count * LANES];
            for column in (0..columns).step_by(LANES) {
                let mut sums = [[0.0f32; LANES]; LANES];
                for (weights, x) in
                    block.chunks_exact(LANES).zip(work.plain.chunks_exact(columns))
                {
                    let x = &x[column..column + LANES];
                    for row in 0..LANES {
                        for lane in 0..LANES {
                            sums[row][lane] += weights[row] * x[lane];
                        }
                    }
                }
                for (row, sums) in sums.iter().enumerate() {
                    let to = (start + row) * columns + column;
                    work.white[to..to + LANES].copy_from_slice(sums);
                }
            }
            at += count * LANES;
        }
        for first in (0..columns).step_by(LANES) {
            for second in (first..columns).step_by(LANES) {
                let mut sums = [[0.0f32; LANES]; LANES];
                for row in work.white.chunks_exact(columns) {
                    let (a, b) = (&row[first..first + LANES], &row[second..second + LANES]);
                    for i in 0..LANES {
                        for lane in 0..LANES {
                            sums[i][lane] += a[i] * b[lane];
                        }
                    }
                }
                for (i, sums) in sums.iter().enumerate() {
                    let to = (first + i) * columns + second;
                    work.products[to..to + LANES].copy_from_slice(sums);
                }
            }
        }
    }
}
