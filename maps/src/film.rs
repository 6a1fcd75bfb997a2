//! Arithmetic of one pixel in f32, eight bands or pigments at a time.
//!
//! Every sum has one order, and no multiplication is fused with an addition, so that machines with wide and
//! with narrow vectors give the same bits.

use pulp::{Simd, WithSimd};

use crate::bands::MOST_BANDS;
use crate::paints::Paints;
use crate::whitening::{LANES, Spectrum, Whitening, WhiteningNoise, dot, padded, total};

/// Most pigments of a set.
pub(crate) const MOST_IN_SET: usize = 4;
/// Range of internal reflectances to which a pixel is moved where it is linearised.
const INTERNAL: [f32; 2] = [1e-4, 0.9995];

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
    pub(crate) white: Whitening,
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

    /// A pixel of these measured reflectances, one for each band, whose errors are like `noise`.
    pub(crate) fn pixel(&self, noise: &WhiteningNoise, reflectance: &[f32]) -> Pixel {
        let (mut measured, mut internal) = ([0.0; MOST_BANDS], [0.5; MOST_BANDS]);
        measured[..self.bands].copy_from_slice(&reflectance[..self.bands]);
        let mut slope = [0.0; MOST_BANDS];
        for band in 0..self.bands {
            let above = (measured[band] - self.floor).max(0.0);
            let inside = above / (self.through + self.k2 * above);
            let r = inside.clamp(INTERNAL[0], INTERNAL[1]);
            let out = 1.0 / (1.0 - self.k2 * r);
            internal[band] = r;
            slope[band] = self.through * out * out * r * (1.0 - r) / (1.0 + r);
        }
        let white = self.arch.dispatch(|| noise.near(&measured, &slope));
        Pixel { measured, internal, white }
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
            internal[band] =
                (s / (k + s + (k * (k + 2.0 * s)).sqrt())).clamp(INTERNAL[0], INTERNAL[1]);
            inverse[band] = 1.0 / s;
        }
        (internal, inverse)
    }

    /// Compares `pixel` with the film of `shares` of the pigments `members`.
    pub(crate) fn difference<const N: usize>(
        &self,
        pixel: &Pixel,
        members: [usize; N],
        shares: [f32; N],
    ) -> Difference {
        self.arch.dispatch(Compare { films: self, pixel, members, shares })
    }

    /// Products of all pigments' rows, which are 0 in sum at the shares of a film like `pixel`, linearised
    /// with secants to the film of internal reflectance and 1/S `about`.
    pub(crate) fn products(&self, pixel: &Pixel, about: (&Spectrum, &Spectrum), work: &mut Work) {
        self.arch.dispatch(Products { films: self, pixel, about, work });
    }
}

/// Memory of [`Films::products`].
#[derive(Debug, Clone)]
pub(crate) struct Work {
    white: Vec<f32>,
    /// Mean S of each pigment relative to that of the film about which the rows are linearised, by which each
    /// row is divided. Else pigments of little S would seem to explain every pixel.
    pub(crate) sizes: Vec<f32>,
    /// Products of the rows of all pairs of pigments, `columns` by `columns`; the upper half is valid.
    pub(crate) products: Vec<f32>,
}

impl Work {
    pub(crate) fn new(films: &Films) -> Self {
        let size = films.rows * films.columns;
        Self {
            white: vec![0.0; size],
            sizes: vec![1.0; films.columns],
            products: vec![0.0; films.columns * films.columns],
        }
    }
}

struct Compare<'a, const N: usize> {
    films: &'a Films,
    pixel: &'a Pixel,
    members: [usize; N],
    shares: [f32; N],
}

impl<const N: usize> WithSimd for Compare<'_, N> {
    type Output = Difference;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Difference {
        let Self { films, pixel, members, shares } = self;
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
            let (mut over_k, mut over_s, mut rest) =
                ([0.0f32; LANES], [0.0f32; LANES], [0.0f32; LANES]);
            for lane in 0..LANES {
                let (k, s) = (k[lane], s[lane]);
                let inside = s / (k + s + (k * (k + 2.0 * s)).sqrt());
                let out = 1.0 / (1.0 - films.k2 * inside);
                let slope = -films.through * out * out * inside * (1.0 - inside) / (1.0 + inside);
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
        pixel.white.whiten(rows, &mut residual);
        for slope in &mut slopes {
            pixel.white.whiten(rows, slope);
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

struct Products<'a> {
    films: &'a Films,
    pixel: &'a Pixel,
    about: (&'a Spectrum, &'a Spectrum),
    work: &'a mut Work,
}

impl WithSimd for Products<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { films, pixel, about: (internal, inverse), work } = self;
        let (rows, columns) = (films.rows, films.columns);
        work.sizes.fill(0.0);
        let mut whole = 1e-12;
        for band in 0..rows {
            // The secant of K/S between two internal reflectances is exact in this form, without a
            // difference of nearly equal numbers, and finite where the pixel is black.
            let (m, r) = (pixel.internal[band], internal[band]);
            let weight = pixel.white.scale[band] * films.through * r * inverse[band]
                / ((1.0 - films.k2 * m) * (1.0 - films.k2 * r) * (1.0 - m * r));
            let (by_s, by_k) = (weight * (1.0 - m) * (1.0 - m), weight * 2.0 * m);
            let at = band * columns..(band + 1) * columns;
            let k = &films.absorption_of_band[at.clone()];
            let s = &films.scattering_of_band[at.clone()];
            whole += by_s / inverse[band];
            let row = work.white[at].iter_mut().zip(&mut work.sizes);
            for ((x, size), (k, s)) in row.zip(k.iter().zip(s)) {
                *size += by_s * s;
                *x = by_s * s - by_k * k;
            }
        }
        for size in &mut work.sizes {
            *size = (*size / whole).max(1e-6);
        }
        for row in work.white.chunks_exact_mut(columns) {
            for (x, size) in row.iter_mut().zip(&work.sizes) {
                *x /= size;
            }
        }
        pixel.white.whiten_rows(rows, columns, &mut work.white);
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
