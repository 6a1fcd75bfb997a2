//! Films of paint on the bands of a map, and one pixel in f32. We compute eight bands or pigments
//! at a time.

use pigment::library::PigmentLibrary;
use pigment::{PigmentId, RecipeError};
use spectra::optics::{Surface, infinite_film};
use wide::f32x8;

use super::bands::Bands;
use super::whitening::{
    Eight, LANES, MOST_BLOCKS, Spectrum, Task, Vectors, Whitening, WhiteningNoise, by_vectors, dot,
    spectrum, total,
};
use crate::pixel_maps::{BlockMaps, MapError};

/// A set holds at most this many pigments.
pub(crate) const MOST_IN_SET: usize = 4;
/// Before we linearise a pixel, we move its internal reflectances into this range.
const INTERNAL: [f32; 2] = [1e-4, 0.9995];

/// K, S and surface of the pigments, laid out for vectors.
#[derive(Debug, Clone)]
pub(crate) struct Films {
    pub(crate) pigments: usize,
    pub(crate) bands: usize,
    /// Blocks of bands, with K = S = 1 beyond the last band.
    pub(crate) blocks: usize,
    /// Blocks of pigments. The lanes before the first pigment are padding with K = S = 0. We
    /// combine each pigment with the ones after it, so it is best if the last block is full.
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

/// A pixel: its measured reflectance, its internal reflectance (moved into the range of films), and
/// the whitening near it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pixel {
    measured: Spectrum,
    internal: Spectrum,
    white: Whitening,
}

/// How a pixel differs from a film: chi-square, and the normal equations of the shares.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Difference {
    pub(crate) chi2: f32,
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
        let [absorption, scattering] = [&paints.absorption, &paints.scattering].map(|curves| {
            let blocks = (0..pigments).flat_map(|p| (0..blocks).map(move |block| (p, block)));
            let blocks = blocks.map(|(p, block)| {
                f32x8::new(std::array::from_fn(|lane| {
                    curves[p].get(block * LANES + lane).map_or(1.0, |value| *value as f32)
                }))
            });
            blocks.collect()
        });
        let before = columns * LANES - pigments;
        let of_band = [&paints.absorption, &paints.scattering].map(|curves| {
            let blocks =
                (0..blocks * LANES).flat_map(|b| (0..columns).map(move |block| (b, block)));
            let blocks = blocks.map(|(b, block)| {
                f32x8::new(std::array::from_fn(|lane| {
                    let pigment = (block * LANES + lane).checked_sub(before);
                    let value = pigment.and_then(|pigment| curves[pigment].get(b));
                    value.map_or(0.0, |value| *value as f32)
                }))
            });
            blocks.collect()
        });
        let [absorption_of_band, scattering_of_band] = of_band;
        let surface = paints.surface;
        Self {
            pigments,
            bands,
            blocks,
            columns,
            absorption,
            scattering,
            absorption_of_band,
            scattering_of_band,
            inside: spectrum(&vec![1.0; bands], 0.0),
            floor: f32x8::splat(surface.floor() as f32),
            through: f32x8::splat(((1.0 - surface.k1) * (1.0 - surface.k2)) as f32),
            k2: f32x8::splat(surface.k2 as f32),
        }
    }

    /// Prepares a pixel. Pass one measured reflectance for each band, with errors like `noise`.
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

    /// Sets up the linearised problem of `pixel`. It has a row of values for each pigment. For the
    /// shares of a film like `pixel`, the rows times their shares sum to 0. This stores the
    /// products of all pairs of rows in `work`. We linearise with secants to the film `about`,
    /// which you pass as internal reflectance and 1/S.
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
    /// Mean S of each pigment relative to the film that we linearise about. We divide each row by
    /// this, because pigments of little S would otherwise seem to explain every pixel.
    sizes: Vec<f32x8>,
    inverse: Vec<f32x8>,
    /// Products of the rows of all pairs of pigments, in a row for each pigment. A row is valid only
    /// for the pigment itself and later ones. The row or lane of a pigment is its index plus `before`.
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

    /// Product of the rows of pigments `a` and `b`, where `a` is at most `b`.
    #[inline(always)]
    pub(crate) fn product(&self, a: usize, b: usize) -> f32 {
        let a = a + self.before;
        let b = b + self.before;
        self.products[a * self.sizes.len() + b / LANES].as_array()[b % LANES]
    }

    /// Number by which we divide the row of a pigment.
    pub(crate) fn size(&self, pigment: usize) -> f32 {
        let lane = pigment + self.before;
        self.sizes[lane / LANES].as_array()[lane % LANES]
    }
}

/// Least K of a pigment in a band relative to its greatest K, and likewise for S. At 0 the optics
/// would have no slope.
const LEAST: f64 = 1e-7;

/// Pigments on the bands of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct Paints {
    /// Names of the pigments, as the library has them.
    pub names: Vec<String>,
    /// K by pigment and band, above 0.
    pub absorption: Vec<Vec<f64>>,
    /// S by pigment and band, above 0.
    pub scattering: Vec<Vec<f64>>,
    /// Surface of the paint.
    pub surface: Surface,
}

/// The [usual pigments](PigmentLibrary::usual_pigments) of a library, without those that were guessed from
/// a colour.
pub(crate) fn usual_pigments(library: &PigmentLibrary) -> Vec<PigmentId> {
    library.usual_pigments().into_iter().filter(|id| !library[*id].guessed).collect()
}

impl Paints {
    /// The pigments of `library` that `palette` names, or its usual ones.
    ///
    /// # Errors
    /// [`MapError::Name`] for a name that matches no pigment or several, [`MapError::Pigments`]
    /// unless 1 to 64 take part.
    pub fn new(
        library: &PigmentLibrary,
        palette: &[String],
        bands: &Bands,
    ) -> Result<Self, MapError> {
        let mut chosen: Vec<PigmentId> = if palette.is_empty() {
            usual_pigments(library)
        } else {
            palette.iter().map(|name| library.find(name)).collect::<Result<_, RecipeError>>()?
        };
        chosen.sort_unstable();
        chosen.dedup();
        if !(1..=BlockMaps::MOST_PIGMENTS).contains(&chosen.len()) {
            let found = chosen.len();
            let most = BlockMaps::MOST_PIGMENTS;
            return Err(MapError::Pigments { found, most });
        }
        let curves = chosen.iter().map(|&id| {
            [&library[id].absorption, &library[id].scattering].map(|values| {
                let folded = bands.fold_library(values);
                let greatest = folded.iter().copied().fold(0.0, f64::max).max(1e-6);
                folded.into_iter().map(|value| value.max(LEAST * greatest)).collect::<Vec<f64>>()
            })
        });
        let (absorption, scattering) = curves.map(<(_, _)>::from).unzip();
        Ok(Self {
            names: chosen.iter().map(|&id| library[id].name.clone()).collect(),
            absorption,
            scattering,
            surface: library.saunderson,
        })
    }

    /// Number of pigments.
    #[must_use]
    pub fn count(&self) -> usize {
        self.names.len()
    }

    /// Number of bands.
    #[must_use]
    pub fn bands(&self) -> usize {
        self.absorption.first().map_or(0, Vec::len)
    }

    /// Index of the pigment called `name`, or `None` if there is none.
    #[must_use]
    pub fn place(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// K and S of a mixture by band, from pigments with their shares.
    #[must_use]
    pub fn mixed(&self, shares: &[(usize, f64)]) -> (Vec<f64>, Vec<f64>) {
        let curves = [&self.absorption, &self.scattering].map(|curves| {
            let bands = (0..self.bands()).map(|band| {
                shares.iter().map(|&(pigment, share)| share * curves[pigment][band]).sum()
            });
            bands.collect()
        });
        curves.into()
    }

    /// Measured reflectance of an opaque film of a mixture, by band.
    #[must_use]
    pub fn reflectance(&self, shares: &[(usize, f64)]) -> Vec<f64> {
        let (absorption, scattering) = self.mixed(shares);
        let pairs = absorption.iter().zip(&scattering);
        pairs.map(|(&k, &s)| self.surface.measured_from_internal(infinite_film(k, s))).collect()
    }

    /// Slope dR/d ln(K/S) of the measured reflectance, 0 or below, at an internal reflectance.
    #[must_use]
    pub fn log_slope(&self, internal: f64) -> f64 {
        -self.surface.measured_slope(internal) * internal * (1.0 - internal) / (1.0 + internal)
    }

    /// Optical strength of a pigment: the mean of K + S over the bands.
    #[must_use]
    pub fn strength(&self, pigment: usize) -> f64 {
        (sum(&self.absorption[pigment]) + sum(&self.scattering[pigment])) / self.bands() as f64
    }
}

fn sum(curve: &[f64]) -> f64 {
    curve.iter().sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::films::bands::Bands;
    use crate::films::settings::{ModelError, Noise, Scale};
    use crate::films::whitening::WhiteningNoise;
    use calibrate::{LeftOutMixture, Residuals};
    use nalgebra::{Cholesky, DMatrix, DVector};
    use std::collections::BTreeMap;

    fn library_and_bands() -> (PigmentLibrary, Bands) {
        let library = PigmentLibrary::van_gogh_oils();
        let nm: Vec<f64> = library.grid.wavelengths_nm().collect();
        let bands = Bands::new(&nm, library.grid).unwrap();
        (library, bands)
    }

    #[test]
    fn reflectances_are_those_of_the_library() {
        let (library, bands) = library_and_bands();
        let paints = Paints::new(&library, &[], &bands).unwrap();
        assert_eq!(paints.count(), 18, "two pigments have no known S");
        let recipe = library.recipe([("Zinc White", 0.8), ("Viridian", 0.2)]).unwrap();
        let expected = library.mix(recipe).unwrap().hiding(library.saunderson);
        let [white, green] = ["Zinc White", "Viridian"].map(|name| paints.place(name).unwrap());
        let found = paints.reflectance(&[(white, 0.8), (green, 0.2)]);
        for (a, b) in found.iter().zip(&expected) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }

    #[test]
    fn the_slope_is_that_of_the_reflectance() {
        let (library, bands) = library_and_bands();
        let paints = Paints::new(&library, &[], &bands).unwrap();
        for q in [1e-3, 0.1, 1.0, 30.0] {
            let [above, below] = [1e-5, -1e-5].map(|step| {
                let film = infinite_film(f64::exp(f64::ln(q) + step), 1.0);
                paints.surface.measured_from_internal(film)
            });
            let quotient = (above - below) / 2e-5;
            let slope = paints.log_slope(infinite_film(q, 1.0));
            assert!((quotient - slope).abs() < 1e-7, "{q}: {quotient} {slope}");
        }
    }

    #[test]
    fn a_palette_is_looked_up_by_name() {
        let (library, bands) = library_and_bands();
        let palette = ["viridian".to_owned(), "Zinc White".to_owned(), "Viridian".to_owned()];
        let paints = Paints::new(&library, &palette, &bands).unwrap();
        assert_eq!(paints.names, ["Zinc White", "Viridian"]);
        let error = Paints::new(&library, &["Viridium".to_owned()], &bands).unwrap_err();
        assert!(matches!(error, MapError::Name(_)), "{error}");
    }

    struct Oils {
        paints: Paints,
        bands: Bands,
        films: Films,
    }

    fn oils(nm: &[f64]) -> Oils {
        let library = PigmentLibrary::van_gogh_oils();
        let bands = Bands::new(nm, library.grid).unwrap();
        let paints = Paints::new(&library, &[], &bands).unwrap();
        Oils { films: Films::new(&paints), paints, bands }
    }

    fn even(count: usize) -> Vec<f64> {
        (0..count).map(|i| 400.0 + 300.0 * i as f64 / (count - 1) as f64).collect()
    }

    /// The covariance that the noise describes near a reflectance.
    fn covariance(oils: &Oils, noise: &Noise, reflectance: &[f64]) -> DMatrix<f64> {
        let surface = oils.paints.surface;
        let scales: Vec<f64> = (reflectance.iter())
            .map(|&r| match noise.scale {
                Scale::FourthRoot => 4.0 * r.powf(0.75),
                Scale::LogRatio => {
                    oils.paints.log_slope(surface.internal_from_measured(r).unwrap()).abs()
                }
            })
            .collect();
        DMatrix::from_fn(reflectance.len(), reflectance.len(), |i, j| {
            let common: f64 =
                noise.curves[i].iter().zip(&noise.curves[j]).map(|(a, b)| a * b).sum();
            let both = scales[i] * scales[j];
            let own = if i == j { noise.own[i] } else { 0.0 };
            let sensor = if i == j { noise.sensor[i] } else { 0.0 };
            both * (common + own) + sensor + noise.gloss * noise.gloss
        })
    }

    fn residuals() -> Residuals {
        Residuals { mixtures: (0..12).map(mixture).collect(), ..Residuals::van_gogh_oils() }
    }

    fn mixture(number: usize) -> LeftOutMixture {
        let measured = curve(number, 0.3);
        let error = curve(number + 3, 0.01);
        LeftOutMixture {
            sample: number.to_string(),
            shares: BTreeMap::new(),
            predicted: measured.iter().zip(&error).map(|(m, e)| m - e).collect(),
            measured,
        }
    }

    fn curve(number: usize, scale: f64) -> Vec<f64> {
        let phases = (0..31).map(|i| 0.3 * (i * (1 + number % 5)) as f64 + number as f64);
        phases.map(|phase| scale * (1.1 + phase.sin())).collect()
    }

    #[test]
    fn chi_square_is_that_of_the_whole_covariance() {
        // 29 bands leave a part of the last block empty.
        for (count, model) in [
            (31, ModelError::Stated(0.1)),
            (29, ModelError::Residuals(residuals())),
            (5, ModelError::Stated(0.3)),
        ] {
            let oils = oils(&even(count));
            let noise = Noise::new(&oils.bands, 0.003, &model);
            let shares = [(1, 0.7), (4, 0.05), (10, 0.25)];
            let film = oils.paints.reflectance(&shares);
            let seen: Vec<f64> = film
                .iter()
                .enumerate()
                .map(|(band, r)| r * (1.0 + 0.05 * (band as f64).sin()))
                .collect();
            let difference = DVector::from_fn(film.len(), |band, _| seen[band] - film[band]);
            let whole = Cholesky::new(covariance(&oils, &noise, &seen)).unwrap();
            let expected = difference.dot(&whole.solve(&difference));
            let narrow: Vec<f32> = seen.iter().map(|r| *r as f32).collect();
            let pixel = oils.films.pixel(&WhiteningNoise::new(&noise), &narrow);
            let found = oils.films.difference(&pixel, [1, 4, 10], [0.7, 0.05, 0.25]);
            let chi2 = f64::from(found.chi2);
            assert!((chi2 / expected - 1.0).abs() < 1e-3, "{count}: {chi2} {expected}");
            let squares = difference.norm_squared();
            assert!((f64::from(found.squares) / squares - 1.0).abs() < 1e-3, "{count}: squares");
        }
    }

    #[test]
    fn slopes_are_those_of_chi_square() {
        let oils = oils(&even(31));
        let noise = WhiteningNoise::new(&Noise::new(&oils.bands, 0.003, &ModelError::Stated(0.1)));
        let seen: Vec<f32> =
            oils.paints.reflectance(&[(1, 0.6), (10, 0.4)]).iter().map(|r| *r as f32).collect();
        let pixel = oils.films.pixel(&noise, &seen);
        let shares = [0.7, 0.05, 0.25];
        let found = oils.films.difference(&pixel, [1, 4, 10], shares);
        for i in 0..3 {
            let step = 0.01 * shares[i];
            let [above, below] = [step, -step].map(|step| {
                let mut moved = shares;
                moved[i] += step;
                f64::from(oils.films.difference(&pixel, [1, 4, 10], moved).chi2)
            });
            let quotient = (above - below) / (2.0 * f64::from(step));
            let slope = -2.0 * f64::from(found.right[i]);
            assert!((quotient / slope - 1.0).abs() < 0.02, "{i}: {quotient} {slope}");
        }
    }

    #[test]
    fn linearised_rows_are_zero_in_sum_at_the_truth() {
        let oils = oils(&even(31));
        let noise = WhiteningNoise::new(&Noise::new(&oils.bands, 0.003, &ModelError::Stated(0.1)));
        let truth = [(1, 0.5), (4, 0.1), (10, 0.4)];
        let seen: Vec<f32> = oils.paints.reflectance(&truth).iter().map(|r| *r as f32).collect();
        let pixel = oils.films.pixel(&noise, &seen);
        let (internal, inverse) = oils.films.film(&[(4, 0.5), (13, 0.5)]);
        let mut work = Work::new(&oils.films);
        oils.films.products(&pixel, (&internal, &inverse), &mut work);
        let parts = truth.map(|(pigment, share)| share * f64::from(work.size(pigment)));
        let mut sums = [0.0; 2];
        for (i, (a, _)) in truth.iter().enumerate() {
            for (j, (b, _)) in truth.iter().enumerate() {
                let product = f64::from(work.product(*a.min(b), *a.max(b)));
                sums[0] += parts[i] * parts[j] * product;
                sums[1] += (parts[i] * parts[j] * product).abs();
            }
        }
        assert!(sums[0].abs() < 1e-5 * sums[1], "{sums:?}");
    }
}
