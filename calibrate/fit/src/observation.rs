//! Observations of swatches: K/S, and the reflectance that the paint would have in a film that hides.
//!
//! You can mix up two cards, so we also check here whether exchanged names explain the readings better.

use spectra::optics::{
    OverBacking, Surface, SurfaceError, absorption_over_scattering, film_over_two_backings,
};

use crate::measurement::{DarkerFilm, MeasurementError};
use crate::swatch::{Swatch, SwatchFilm, SwatchSet};

pub use pigment::fit_settings::BelowSurface;

/// Internal reflectance that stands for black. K/S is about 500 there. You learn nothing from a reading
/// nearer to the surface's own reflection than this, and K/S would rise without bound.
pub const BLACK: f64 = 1e-3;
/// If two readings over different backings differ by at most this, the film hides (chosen by eye).
pub const HIDING_DIFFERENCE: f64 = 0.05;
/// We compute K/S from two backings only if their mean reflectances differ by at least this (chosen by
/// eye).
pub(crate) const LEAST_CONTRAST: f64 = 0.05;
/// A gauge cannot tell apart two thicknesses with this relative difference (chosen by eye).
const SAME_THICKNESS: f64 = 0.05;
/// A reading with an internal reflectance from 1 to this value counts as white. We refuse a greater one
/// (chosen by eye).
const ABOVE_WHITE: f64 = 1.05;

/// Whether we computed K/S of a swatch from two backings, or assumed that the film hides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hiding {
    /// We computed K/S from readings over two backings. The value is the largest difference of the two over
    /// wavelength, in measured reflectance.
    Difference(f64),
    /// We assumed that the film hides, because there are no two films of one thickness on backings of
    /// different reflectance that you also read bare. The value is the largest difference of readings over
    /// different backings, or `None` if there is only one.
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
    /// Measured reflectance of a film that hides, surface included, from `ratio`. The fit aims at this. If
    /// no paint under this surface can have a reading, we move it to the nearest possible one.
    pub reflectance: Vec<f64>,
    /// Reflectance with which we compare a prediction. It is `reflectance`, but where we assumed that the
    /// film hides, or moved a reading, it is what the instrument read.
    pub as_read: Vec<f64>,
    /// How K/S was computed, and how far readings over different backings differ.
    pub hiding: Hiding,
    /// Standard deviation of repeated readings, or `None` if none were repeated.
    pub spread: Option<f64>,
    /// Number of readings that were below the surface's own reflection and were read as black.
    pub below_surface: usize,
    /// Number of readings that were above a perfect white and were read as white.
    pub above_white: usize,
}

impl Hiding {
    /// Whether the two readings differ by at most 0.05 at every wavelength. `None` if we assumed that the
    /// film hides.
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
/// We first convert readings to reflectances below the surface. If a swatch has films of one thickness (to
/// 5 %) over two backings of known reflectance, we get K/S from [`film_over_two_backings`]. Of several such
/// pairs we use the thickest, and of these the one with the greatest contrast. We assume that any other
/// swatch hides, and use its thickest film.
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
    pub(crate) fn internal(
        &self,
        swatch: &Swatch,
        measured: &[f64],
    ) -> Result<Vec<f64>, MeasurementError> {
        let internal = measured.iter().enumerate().map(|(index, &value)| {
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
        });
        internal.collect()
    }

    fn is_below(&self, reading: f64) -> bool {
        reading < self.surface.floor()
    }

    fn is_above(&self, reading: f64) -> bool {
        reading > self.surface.measured_from_internal(1.0) + 1e-9
    }

    /// Whether no paint under this surface has this reading. [`Self::internal`] then moves it.
    fn is_moved(&self, reading: f64) -> bool {
        self.is_below(reading) || self.is_above(reading)
    }

    fn observation(&self, swatch: &Swatch) -> Result<Observation, MeasurementError> {
        let pair = two_backings(&swatch.films);
        let (ratio, hiding) = match pair {
            Some((light, dark)) => self.over_two_backings(swatch, light, dark)?,
            None => {
                let internal = self.internal(swatch, &thickest(&swatch.films).reflectance)?;
                let ratio = internal.into_iter().map(absorption_over_scattering).collect();
                (ratio, Hiding::Assumed(largest_difference(&swatch.films)))
            }
        };
        let reflectance: Vec<f64> = ratio
            .iter()
            .map(|&q: &f64| {
                self.surface.measured_from_internal(spectra::optics::infinite_film_from_ratio(q))
            })
            .collect();
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

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Whether two thicknesses cannot be told apart by a gauge, or both are unknown.
pub(crate) fn alike(first: Option<f64>, second: Option<f64>) -> bool {
    match (first, second) {
        (Some(a), Some(b)) => (a - b).abs() <= SAME_THICKNESS * a.max(b),
        (None, None) => true,
        _ => false,
    }
}

/// First of the thickest films. Films of unknown thickness count as thin.
fn thickest(films: &[SwatchFilm]) -> &SwatchFilm {
    films
        .iter()
        .reduce(|a, b| if thickness(b) > thickness(a) { b } else { a })
        .expect("a swatch has films")
}

fn thickness(film: &SwatchFilm) -> f64 {
    film.thickness_mm.unwrap_or(0.0)
}

/// Largest difference of readings over different backings, or `None` if there is only one backing.
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

/// A film may be darker over the brighter card by this reflectance, because two readings have errors. For
/// the Van Gogh oils we found 0.013 at most.
const READING_ERROR: f64 = 0.02;
/// A film may also be darker by this many standard deviations of repeated readings.
const CHANCE: f64 = 3.0;

/// Refuses films that are darker over the brighter of two cards, which no film of paint can be.
///
/// # Errors
/// [`MeasurementError::DarkerOverBrighter`] for the first such sample.
pub(crate) fn check_backings(set: &SwatchSet) -> Result<(), MeasurementError> {
    let mut faults = set.swatches.iter().filter_map(|swatch| fault(set, swatch));
    faults.next().map_or(Ok(()), |first| {
        let film = DarkerFilm { others: faults.count(), ..first };
        Err(MeasurementError::DarkerOverBrighter(Box::new(film)))
    })
}

fn fault(set: &SwatchSet, swatch: &Swatch) -> Option<DarkerFilm> {
    let pairs =
        swatch.films.iter().flat_map(|bright| swatch.films.iter().map(move |d| (bright, d)));
    let (bright, dark, places) = pairs
        .filter(|(bright, dark)| alike(bright.thickness_mm, dark.thickness_mm))
        .map(|(bright, dark)| (bright, dark, darker(bright, dark)))
        .find(|(_, _, places)| !places.is_empty())?;
    let steps = places.iter().map(|&at| (at, dark.reflectance[at] - bright.reflectance[at]));
    let (worst, by) = steps.max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(DarkerFilm {
        file: swatch.file.to_string(),
        row: swatch.row,
        sample: swatch.sample.clone(),
        bright: bright.backing.clone(),
        dark: dark.backing.clone(),
        by,
        nm: set.grid.nm(worst),
        band_nm: [places[0], places[places.len() - 1]].map(|at| set.grid.nm(at)),
        others: 0,
    })
}

/// Wavelengths at which the film over the brighter card is darker than the film over the other
/// card.
fn darker(bright: &SwatchFilm, dark: &SwatchFilm) -> Vec<usize> {
    let (Some(bright_bare), Some(dark_bare)) = (&bright.bare, &dark.bare) else {
        return Vec::new();
    };
    let spread = bright.spread.unwrap_or(0.0).max(dark.spread.unwrap_or(0.0));
    let allowed = READING_ERROR.max(CHANCE * spread);
    (0..bright.reflectance.len())
        .filter(|&at: &usize| {
            bright_bare[at] - dark_bare[at] > LEAST_CONTRAST
                && dark.reflectance[at] - bright.reflectance[at] > allowed
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::fitting::fit;
    use crate::library::AmountKind;
    use crate::readings::Readings;
    use crate::request::FitRequest;
    use documents::hint::Explain;

    /// Thin films of a white and a red over two cards. The films of sample b lie on the backings named in
    /// `b`.
    fn thin(b: [&str; 2]) -> Readings {
        let text = format!(
            "sample,film,backing,White,Red,400,500,600,700\n\
             card,none,white,,,0.85,0.86,0.87,0.87\ncard,none,black,,,0.05,0.05,0.05,0.05\n\
             w,paint,white,1,,0.83,0.84,0.85,0.85\nw,paint,black,1,,0.6,0.55,0.5,0.48\n\
             r,paint,white,,1,0.1,0.12,0.6,0.7\nr,paint,black,,1,0.09,0.1,0.3,0.4\n\
             b,paint,{},1,1,0.3,0.32,0.75,0.78\nb,paint,{},1,1,0.25,0.27,0.45,0.46\n",
            b[0], b[1]
        );
        Readings::from_csv("thin.csv", text.as_bytes()).unwrap()
    }

    #[test]
    fn a_film_darker_over_the_brighter_card_is_refused() {
        for amounts in [AmountKind::Relative, AmountKind::Absolute] {
            let options = FitRequest { amounts, ..FitRequest::default() };
            assert!(fit(&thin(["white", "black"]), &options).is_ok(), "{amounts:?}");
            let exchanged = thin(["black", "white"]);
            let error = fit(&exchanged, &options).unwrap_err();
            let said = error.to_string();
            for word in ["thin.csv, row 8", "sample b", "0.320 at 700 nm", "400 to 700 nm"] {
                assert!(said.contains(word), "`{word}` is missing: {said}");
            }
            let hint = error.hint().unwrap().to_string();
            assert!(hint.contains("exchanged") && hint.contains("exclude"), "{hint}");
            let without = FitRequest { exclude: vec!["b".to_owned()], ..options };
            assert!(fit(&exchanged, &without).is_ok(), "{amounts:?}");
        }
    }
}
