//! Observations of swatches: K/S, and the reflectance that the paint would have in a film that hides.

use spectra::optics::{
    OverBacking, Surface, SurfaceError, absorption_over_scattering, film_over_two_backings,
};

pub use pigment::fit_settings::BelowSurface;

use crate::measurement::MeasurementError;
use crate::swatch::{Swatch, SwatchFilm, SwatchSet};

/// Internal reflectance that stands for black; K/S is about 500 there. A reading nearer to the surface's
/// own reflection contains no more information, and K/S would rise without bound.
pub const BLACK: f64 = 1e-3;
/// Two readings over different backings that differ by at most this show a film that hides; chosen by
/// eye.
pub const HIDING_DIFFERENCE: f64 = 0.05;
/// Least difference of the mean reflectances of two backings from which K/S can be computed; chosen by
/// eye.
pub(crate) const LEAST_CONTRAST: f64 = 0.05;
/// Relative difference of two thicknesses that a gauge cannot tell apart; chosen by eye.
const SAME_THICKNESS: f64 = 0.05;
/// Internal reflectance above which a reading is refused rather than read as white; chosen by eye.
const ABOVE_WHITE: f64 = 1.05;

/// Whether K/S of a swatch was computed from two backings, or the film was assumed to hide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hiding {
    /// K/S was computed from readings over two backings. The value is the largest difference of the two over
    /// wavelength, in measured reflectance.
    Difference(f64),
    /// The film was assumed to hide, because there are no two films of one thickness on backings of different
    /// reflectance that were also read bare. The value is the largest difference of readings over different
    /// backings; `None` if there is only one.
    Assumed(Option<f64>),
}

/// One swatch as the fit uses it.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// Name of the sample.
    pub sample: String,
    /// Share of each pigment, sum 1.
    pub shares: Vec<f64>,
    /// K/S at each wavelength, 0 and up.
    pub ratio: Vec<f64>,
    /// Measured reflectance of a film that hides, surface included, as `ratio` gives it. The fit aims at
    /// this: readings that no paint under this surface can have are moved to the nearest that one can.
    pub reflectance: Vec<f64>,
    /// Reflectance with which a prediction is compared: like `reflectance`, but as the instrument read it
    /// where the film was taken to hide, and where a reading was moved.
    pub as_read: Vec<f64>,
    /// How K/S was computed, and how far readings over different backings differ.
    pub hiding: Hiding,
    /// Standard deviation of repeated readings; `None` if none were repeated.
    pub spread: Option<f64>,
    /// Number of readings that were below the surface's own reflection and were read as black.
    pub below_surface: usize,
    /// Number of readings that were above a perfect white and were read as white.
    pub above_white: usize,
}

impl Hiding {
    /// Whether the two readings differ by at most 0.05 at every wavelength; `None` if hiding is assumed.
    #[must_use]
    pub fn hides(self) -> Option<bool> {
        match self {
            Self::Difference(largest) => Some(largest <= HIDING_DIFFERENCE),
            Self::Assumed(_) => None,
        }
    }
}

/// Computes the observations of all swatches.
///
/// Readings are first converted to reflectances below the surface. If a swatch has films of one thickness (to
/// 5 %) over two backings of known reflectance, K/S follows from [`film_over_two_backings`]. Of several such
/// pairs the thickest is used, and of these the one with the greatest contrast. Any other swatch is assumed
/// to hide, and its thickest film is used.
///
/// # Errors
/// [`MeasurementError::BelowSurface`] or `AboveWhite`, with sample and wavelength.
pub fn observations(
    set: &SwatchSet,
    surface: Surface,
    below: BelowSurface,
) -> Result<Vec<Observation>, MeasurementError> {
    let conversion = SurfaceConversion { set, surface, below };
    set.swatches.iter().map(|swatch| conversion.observation(swatch)).collect()
}

/// Least measured reflectance of any film or bare backing of `set`.
#[must_use]
pub fn least_reading(set: &SwatchSet) -> f64 {
    let films = set.swatches.iter().flat_map(|swatch| &swatch.films);
    let all = films.flat_map(|film| film.reflectance.iter().chain(film.bare.iter().flatten()));
    all.copied().fold(f64::INFINITY, f64::min)
}

/// Conversion of the readings of a set to reflectances below the surface.
pub(crate) struct SurfaceConversion<'a> {
    pub(crate) set: &'a SwatchSet,
    pub(crate) surface: Surface,
    pub(crate) below: BelowSurface,
}

impl SurfaceConversion<'_> {
    /// Converts measured reflectances of `swatch` to reflectances below the surface.
    pub(crate) fn internal(
        &self,
        swatch: &Swatch,
        measured: &[f64],
    ) -> Result<Vec<f64>, MeasurementError> {
        let at = |(index, &value): (usize, &f64)| {
            let internal = match self.surface.internal_from_measured(value) {
                Ok(internal) => internal.max(BLACK),
                Err(SurfaceError::BelowFloor { .. }) if self.below == BelowSurface::Floor => BLACK,
                Err(_) => {
                    return Err(MeasurementError::BelowSurface {
                        file: swatch.file.to_string(),
                        row: swatch.row,
                        sample: swatch.sample.clone(),
                        nm: self.set.grid.nm(index),
                        measured: value,
                        k1: self.surface.k1,
                        k2: self.surface.k2,
                        least: least_reading(self.set),
                    });
                }
            };
            if internal > ABOVE_WHITE {
                return Err(MeasurementError::AboveWhite {
                    file: swatch.file.to_string(),
                    row: swatch.row,
                    sample: swatch.sample.clone(),
                    nm: self.set.grid.nm(index),
                    measured: value,
                });
            }
            // Slightly above white is an error of the instrument's tile, not of the paint.
            Ok(internal.min(1.0))
        };
        measured.iter().enumerate().map(at).collect()
    }

    fn is_below(&self, reading: f64) -> bool {
        reading < self.surface.floor()
    }

    fn is_above(&self, reading: f64) -> bool {
        reading > self.surface.measured_from_internal(1.0) + 1e-9
    }

    /// Whether no paint under this surface has this reading, so that [`Self::internal`] moves it.
    fn is_moved(&self, reading: f64) -> bool {
        self.is_below(reading) || self.is_above(reading)
    }

    fn observation(&self, swatch: &Swatch) -> Result<Observation, MeasurementError> {
        let external = |&q: &f64| {
            self.surface.measured_from_internal(spectra::optics::infinite_film_from_ratio(q))
        };
        let pair = two_backings(&swatch.films);
        let (ratio, hiding) = match pair {
            Some((light, dark)) => self.over_two_backings(swatch, light, dark)?,
            None => {
                let internal = self.internal(swatch, &thickest(&swatch.films).reflectance)?;
                let ratio = internal.into_iter().map(absorption_over_scattering).collect();
                (ratio, Hiding::Assumed(largest_difference(&swatch.films)))
            }
        };
        let reflectance: Vec<f64> = ratio.iter().map(external).collect();
        let as_read = match pair {
            Some(((light, _), (dark, _))) => {
                let readings = light.iter().zip(dark);
                let kept = readings.zip(&reflectance).map(|((&light, &dark), &hiding)| {
                    let moved = self.is_moved(light) || self.is_moved(dark);
                    if moved { f64::midpoint(light, dark) } else { hiding }
                });
                kept.collect()
            }
            None => thickest(&swatch.films).reflectance.clone(),
        };
        let spreads: Vec<f64> = swatch.films.iter().filter_map(|film| film.spread).collect();
        Ok(Observation {
            sample: swatch.sample.clone(),
            shares: swatch.shares.clone(),
            reflectance,
            as_read,
            ratio,
            hiding,
            below_surface: count(swatch, |r| self.is_below(r)),
            above_white: count(swatch, |r| self.is_above(r)),
            spread: spreads.into_iter().reduce(f64::max),
        })
    }

    fn over_two_backings(
        &self,
        swatch: &Swatch,
        light: (&[f64], &[f64]),
        dark: (&[f64], &[f64]),
    ) -> Result<(Vec<f64>, Hiding), MeasurementError> {
        let over = |(film, bare): (&[f64], &[f64])| -> Result<Vec<OverBacking>, _> {
            let film = self.internal(swatch, film)?;
            let bare = self.internal(swatch, bare)?;
            let pairs = film.into_iter().zip(bare);
            Ok(pairs.map(|(film, backing)| OverBacking { film, backing }).collect())
        };
        let differences = light.0.iter().zip(dark.0).map(|(a, b)| (a - b).abs());
        let largest = differences.fold(0.0, f64::max);
        let light = over(light)?;
        let dark = over(dark)?;
        let ratio = light
            .into_iter()
            .zip(dark)
            .map(|(light, dark)| match film_over_two_backings(light, dark) {
                Some(optics) => optics.ratio.min(absorption_over_scattering(BLACK)),
                // Two backings that are alike at this wavelength give no ratio.
                None => absorption_over_scattering(f64::midpoint(light.film, dark.film)),
            })
            .collect();
        Ok((ratio, Hiding::Difference(largest)))
    }
}

/// Film and bare reflectance over each of two backings.
type Pair<'a> = ((&'a [f64], &'a [f64]), (&'a [f64], &'a [f64]));

fn two_backings(films: &[SwatchFilm]) -> Option<Pair<'_>> {
    let known: Vec<(&SwatchFilm, &[f64])> =
        films.iter().filter_map(|film| Some((film, film.bare.as_deref()?))).collect();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let mut best: Option<(f64, f64, Pair<'_>)> = None;
    for (index, (first, first_bare)) in known.iter().enumerate() {
        for (second, second_bare) in &known[index + 1..] {
            if !alike(first.thickness_mm, second.thickness_mm) {
                continue;
            }
            let contrast = (mean(first_bare) - mean(second_bare)).abs();
            let thickness = first.thickness_mm.unwrap_or(0.0);
            let better = best.as_ref().is_none_or(|(t, c, _)| (thickness, contrast) > (*t, *c));
            if contrast > LEAST_CONTRAST && better {
                let pair = (
                    (first.reflectance.as_slice(), *first_bare),
                    (second.reflectance.as_slice(), *second_bare),
                );
                best = Some((thickness, contrast, pair));
            }
        }
    }
    best.map(|(_, _, pair)| pair)
}

/// Whether two thicknesses cannot be told apart by a gauge, or both are unknown.
pub(crate) fn alike(first: Option<f64>, second: Option<f64>) -> bool {
    match (first, second) {
        (Some(a), Some(b)) => (a - b).abs() <= SAME_THICKNESS * a.max(b),
        (None, None) => true,
        _ => false,
    }
}

/// First of the thickest films; films of unknown thickness count as thin.
fn thickest(films: &[SwatchFilm]) -> &SwatchFilm {
    let thickness = |film: &SwatchFilm| film.thickness_mm.unwrap_or(0.0);
    films
        .iter()
        .reduce(|a, b| if thickness(b) > thickness(a) { b } else { a })
        .expect("a swatch has films")
}

/// Largest difference of readings over different backings; `None` if there is only one backing.
fn largest_difference(films: &[SwatchFilm]) -> Option<f64> {
    let mut largest: Option<f64> = None;
    for (index, first) in films.iter().enumerate() {
        for second in films[index + 1..].iter().filter(|f| f.backing != first.backing) {
            let pairs = first.reflectance.iter().zip(&second.reflectance);
            let difference = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            largest = Some(largest.unwrap_or(0.0).max(difference));
        }
    }
    largest
}

fn count(swatch: &Swatch, condition: impl Fn(f64) -> bool) -> usize {
    let readings = swatch.films.iter().flat_map(|film| &film.reflectance);
    readings.filter(|&&reading| condition(reading)).count()
}
