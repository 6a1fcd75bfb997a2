//! Films of paint and one pixel in f32, eight bands or pigments at a time.

use wide::f32x8;

use super::paints::Paints;
use super::vectors::{Eight, Task, Vectors, by_vectors};
use super::whitening::{
    LANES, MOST_BLOCKS, Spectrum, Whitening, WhiteningNoise, dot, spectrum, total,
};

/// Most pigments of a set.
pub(crate) const MOST_IN_SET: usize = 4;
/// Range of internal reflectances to which a pixel is moved where it is linearised.
const INTERNAL: [f32; 2] = [1e-4, 0.9995];

/// K, S and surface of the pigments, laid out for vectors.
#[derive(Debug, Clone)]
pub(crate) struct Films {
    pub(crate) pigments: usize,
    pub(crate) bands: usize,
    /// Blocks of bands, with K = S = 1 beyond the last band.
    pub(crate) blocks: usize,
    /// Blocks of pigments, with K = S = 0 before the first pigment: where each one is combined with those after
    /// it, the last block holds most.
    pub(crate) columns: usize,
    /// K and S by pigment, each `blocks` long.
    absorption: Vec<f32x8>,
    scattering: Vec<f32x8>,
    /// K and S by band, each `columns` long.
    absorption_of_band: Vec<f32x8>,
    scattering_of_band: Vec<f32x8>,
    /// 1 for each band of the map, 0 beyond.
    inside: Spectrum,
    floor: f32x8,
    /// (1 - k1) (1 - k2).
    through: f32x8,
    k2: f32x8,
}

/// A pixel's measured reflectance, the internal one within the range of films, and the whitening near it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pixel {
    measured: Spectrum,
    internal: Spectrum,
    white: Whitening,
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
        let pigments = paints.count();
        let bands = paints.bands();
        let blocks = bands.div_ceil(LANES);
        let columns = pigments.div_ceil(LANES);
        let by_pigment = |curves: &[Vec<f64>]| -> Vec<f32x8> {
            let value = |p: usize, b: usize| if b < bands { curves[p][b] as f32 } else { 1.0 };
            let block = |p: usize, block: usize| {
                f32x8::new(std::array::from_fn(|lane| value(p, block * LANES + lane)))
            };
            (0..pigments * blocks).map(|i| block(i / blocks, i % blocks)).collect()
        };
        let before = columns * LANES - pigments;
        let by_band = |curves: &[Vec<f64>]| -> Vec<f32x8> {
            let value = |b: usize, lane: usize| {
                if b < bands && lane >= before { curves[lane - before][b] as f32 } else { 0.0 }
            };
            let block = |b: usize, block: usize| {
                f32x8::new(std::array::from_fn(|lane| value(b, block * LANES + lane)))
            };
            (0..blocks * LANES * columns).map(|i| block(i / columns, i % columns)).collect()
        };
        let surface = paints.surface;
        Self {
            pigments,
            bands,
            blocks,
            columns,
            absorption: by_pigment(&paints.absorption),
            scattering: by_pigment(&paints.scattering),
            absorption_of_band: by_band(&paints.absorption),
            scattering_of_band: by_band(&paints.scattering),
            inside: spectrum(&vec![1.0; bands], 0.0),
            floor: f32x8::splat(surface.floor() as f32),
            through: f32x8::splat(((1.0 - surface.k1) * (1.0 - surface.k2)) as f32),
            k2: f32x8::splat(surface.k2 as f32),
        }
    }

    /// A pixel of these measured reflectances, one for each band, whose errors are like `noise`.
    pub(crate) fn pixel(&self, noise: &WhiteningNoise, reflectance: &[f32]) -> Pixel {
        let measured = spectrum(&reflectance[..self.bands], 0.3);
        let mut internal = measured;
        let mut slope = measured;
        let low = f32x8::splat(INTERNAL[0]);
        let high = f32x8::splat(INTERNAL[1]);
        for block in 0..self.blocks {
            let above = (measured[block] - self.floor).fast_max(f32x8::ZERO);
            let r = above / (self.through + self.k2 * above);
            let r = r.fast_max(low).fast_min(high);
            let out = f32x8::ONE / (f32x8::ONE - self.k2 * r);
            internal[block] = r;
            slope[block] = self.through * out * out * r * (f32x8::ONE - r) / (f32x8::ONE + r);
        }
        Pixel { white: noise.near(&measured, &slope), measured, internal }
    }

    /// Internal reflectance and 1/S of a film, by band.
    pub(crate) fn film(&self, shares: &[(usize, f32)]) -> (Spectrum, Spectrum) {
        let half = [f32x8::HALF; MOST_BLOCKS];
        let mut internal = half;
        let mut inverse = half;
        let low = f32x8::splat(INTERNAL[0]);
        let high = f32x8::splat(INTERNAL[1]);
        for block in 0..self.blocks {
            let mut k = f32x8::ZERO;
            let mut s = f32x8::ZERO;
            for &(pigment, share) in shares {
                k += f32x8::splat(share) * self.absorption[pigment * self.blocks + block];
                s += f32x8::splat(share) * self.scattering[pigment * self.blocks + block];
            }
            internal[block] = (s / (k + s + (k * (k + s + s)).sqrt())).fast_max(low).fast_min(high);
            inverse[block] = f32x8::ONE / s;
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
        by_vectors(Comparison { films: self, pixel, members, shares })
    }

    #[inline(always)]
    fn compared<V: Vectors, const N: usize>(
        &self,
        v: V,
        pixel: &Pixel,
        members: [usize; N],
        shares: [f32; N],
    ) -> Difference {
        let blocks = self.blocks;
        let zero = v.splat(0.0);
        let one = v.splat(1.0);
        let [through, floor, k2] = [self.through, self.floor, self.k2].map(|x| v.load(x));
        let curves = members.map(|p| p * blocks..(p + 1) * blocks);
        let absorption = curves.clone().map(|range| &self.absorption[range]);
        let scattering = curves.map(|range| &self.scattering[range]);
        let shares = shares.map(|share| v.splat(share));
        let mut residual = [zero; MOST_BLOCKS];
        let mut slopes = [residual; N];
        let mut squares = zero;
        for block in 0..blocks {
            let mut k = zero;
            let mut s = zero;
            for i in 0..N {
                k = k + shares[i] * v.load(absorption[i][block]);
                s = s + shares[i] * v.load(scattering[i][block]);
            }
            let inside = s / (k + s + (k * (k + s + s)).sqrt());
            let out = one / (one - k2 * inside);
            let slope = (zero - through) * out * out * inside * (one - inside);
            let rest = v.load(pixel.measured[block]) - (floor + through * inside * out);
            // One division for the slopes over K and over S: it takes as long as many products.
            let over_both = slope / ((one + inside) * (k * s));
            let over_k = over_both * s;
            let over_s = over_both * k;
            residual[block] = rest;
            squares = squares + rest * rest * v.load(self.inside[block]);
            for i in 0..N {
                slopes[i][block] =
                    v.load(absorption[i][block]) * over_k - v.load(scattering[i][block]) * over_s;
            }
        }
        pixel.white.whiten(v, blocks, &mut residual, &mut slopes);
        let mut found = Difference {
            chi2: dot(v, blocks, &residual, &residual),
            squares: total(squares),
            ..Difference::default()
        };
        for i in 0..N {
            found.right[i] = dot(v, blocks, &slopes[i], &residual);
            for j in 0..=i {
                let product = dot(v, blocks, &slopes[i], &slopes[j]);
                found.normal[i][j] = product;
                found.normal[j][i] = product;
            }
        }
        found
    }

    /// Products of all pigments' rows, which are 0 in sum at the shares of a film like `pixel`, linearised
    /// with secants to the film of internal reflectance and 1/S `about`.
    pub(crate) fn products(&self, pixel: &Pixel, about: (&Spectrum, &Spectrum), work: &mut Work) {
        by_vectors(Products { films: self, pixel, about, work });
    }

    #[inline(always)]
    fn multiplied<V: Vectors>(
        &self,
        v: V,
        pixel: &Pixel,
        (internal, inverse): (&Spectrum, &Spectrum),
        work: &mut Work,
    ) {
        let one = v.splat(1.0);
        let [through, k2] = [self.through, self.k2].map(|x| v.load(x));
        work.sizes.fill(f32x8::ZERO);
        let mut whole = v.splat(1e-12);
        for block in 0..self.blocks {
            // The secant of K/S between two internal reflectances is exact in this form, without a
            // difference of nearly equal numbers, and finite where the pixel is black.
            let m = v.load(pixel.internal[block]);
            let r = v.load(internal[block]);
            let inverse = v.load(inverse[block]);
            let weight = v.load(pixel.white.scale[block]) * through * r * inverse
                / ((one - k2 * m) * (one - k2 * r) * (one - m * r));
            let by_s = weight * (one - m) * (one - m);
            let by_k = weight * (m + m);
            whole = whole + by_s / inverse;
            let by_s = by_s.store().to_array();
            let by_k = by_k.store().to_array();
            for (lane, (by_s, by_k)) in by_s.into_iter().zip(by_k).enumerate() {
                let band = block * LANES + lane;
                let at = band * self.columns..(band + 1) * self.columns;
                let by_s = v.splat(by_s);
                let by_k = v.splat(by_k);
                let curves = self.absorption_of_band[at.clone()].iter();
                let curves = curves.zip(&self.scattering_of_band[at.clone()]);
                let row = work.white[at].iter_mut().zip(&mut work.sizes);
                for ((x, size), (k, s)) in row.zip(curves) {
                    let scattered = by_s * v.load(*s);
                    *size = (v.load(*size) + scattered).store();
                    *x = (scattered - by_k * v.load(*k)).store();
                }
            }
        }
        let whole = v.splat(total(whole));
        for size in &mut work.sizes {
            *size = (v.load(*size) / whole).greater(v.splat(1e-6)).store();
        }
        for (inverse, size) in work.inverse.iter_mut().zip(&work.sizes) {
            *inverse = (one / v.load(*size)).store();
        }
        for row in work.white.chunks_exact_mut(self.columns) {
            for (x, inverse) in row.iter_mut().zip(&work.inverse) {
                *x = (v.load(*x) * v.load(*inverse)).store();
            }
        }
        pixel.white.whiten_rows(v, self.columns, &mut work.white);
        for first in 0..self.columns {
            for second in first..self.columns {
                let mut sums = [v.splat(0.0); LANES];
                for row in work.white.chunks_exact(self.columns) {
                    let b = v.load(row[second]);
                    for (sum, a) in sums.iter_mut().zip(row[first].to_array()) {
                        *sum = *sum + v.splat(a) * b;
                    }
                }
                for (lane, sum) in sums.iter().enumerate() {
                    work.products[(first * LANES + lane) * self.columns + second] = sum.store();
                }
            }
        }
    }
}

struct Comparison<'a, const N: usize> {
    films: &'a Films,
    pixel: &'a Pixel,
    members: [usize; N],
    shares: [f32; N],
}

impl<const N: usize> Task for Comparison<'_, N> {
    type Result = Difference;

    #[inline(always)]
    fn run<V: Vectors>(self, v: V) -> Difference {
        self.films.compared(v, self.pixel, self.members, self.shares)
    }
}

struct Products<'a> {
    films: &'a Films,
    pixel: &'a Pixel,
    about: (&'a Spectrum, &'a Spectrum),
    work: &'a mut Work,
}

impl Task for Products<'_> {
    type Result = ();

    #[inline(always)]
    fn run<V: Vectors>(self, v: V) {
        self.films.multiplied(v, self.pixel, self.about, self.work);
    }
}

/// Memory of [`Films::products`].
#[derive(Debug, Clone)]
pub(crate) struct Work {
    white: Vec<f32x8>,
    /// Mean S of each pigment relative to that of the film about which the rows are linearised, by which each
    /// row is divided. Else pigments of little S would seem to explain every pixel.
    sizes: Vec<f32x8>,
    inverse: Vec<f32x8>,
    /// Products of the rows of all pairs of pigments; the upper half is valid. Row and lane of a pigment are
    /// `before` its place.
    pub(crate) products: Vec<f32x8>,
    before: usize,
}

impl Work {
    pub(crate) fn new(films: &Films) -> Self {
        Self {
            white: vec![f32x8::ZERO; films.blocks * LANES * films.columns],
            sizes: vec![f32x8::ONE; films.columns],
            inverse: vec![f32x8::ONE; films.columns],
            products: vec![f32x8::ZERO; films.columns * LANES * films.columns],
            before: films.columns * LANES - films.pigments,
        }
    }

    /// Product of the rows of two pigments, of which `a` is not after `b`.
    #[inline(always)]
    pub(crate) fn product(&self, a: usize, b: usize) -> f32 {
        let a = a + self.before;
        let b = b + self.before;
        self.products[a * self.sizes.len() + b / LANES].as_array()[b % LANES]
    }

    /// Size by which the row of a pigment is divided.
    pub(crate) fn size(&self, pigment: usize) -> f32 {
        let lane = pigment + self.before;
        self.sizes[lane / LANES].as_array()[lane % LANES]
    }
}
