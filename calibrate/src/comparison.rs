//! A library held against measurements: what it predicts of each sample, and
//! what it would predict of mixtures it had not seen.

use pigment::palette::{MeasuredSample, Palette, Recipe};
use spectra::optics::Surface;
use spectra::{Extrapolation, Grid, InterpolateError, Interpolation, Reflectance, Spectrum};

use crate::absolute::{calibrate_absolute, films};
use crate::calibration::{CalibrationError, calibrate};
use crate::fit::FitSettings;
use crate::measurement::MeasurementError;
use crate::observation::{BelowSurface, observations};
use crate::scores::Scores;
use crate::swatch::{Swatch, SwatchSet};
use crate::validation::{Validation, ValidationPlan, validate, validate_absolute};
use pigment::evaluate::{Summary, Viewing};
use pigment::library::{AmountKind, PigmentLibrary};

/// One film, measured and predicted.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedFilm {
    /// The sample, with its backing where it has several films.
    pub sample: String,
    /// Pigments of the library with their amounts; shares sum to 1.
    pub recipe: Vec<(usize, f64)>,
    /// Measured reflectance, 0..1: of a film that hides for shares, of the film
    /// itself for absolute amounts.
    pub measured: Vec<f64>,
    /// What the library predicts of it.
    pub predicted: Vec<f64>,
    /// CIEDE2000 between the two.
    pub delta_e: f64,
    /// Whether the recipe holds a pigment whose K and S are no measurement (not
    /// identified, or guessed).
    pub unsure: bool,
    /// Whether the fit left this sample out.
    pub excluded: bool,
}

/// A library held against measurements.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The films in order of the file.
    pub films: Vec<ComparedFilm>,
    /// Root mean square residual of reflectance, of sure films.
    pub rms: f64,
    /// Summary of the colour errors of sure films.
    pub delta_e: Summary,
    /// Samples that could not be compared, each with the pigments that the
    /// library has not.
    pub absent: Vec<(String, Vec<String>)>,
    /// The wavelengths of the readings, where they are not the library's.
    pub resampled_from: Option<Grid>,
}

impl Comparison {
    /// The films whose pigments are all measured and identified: those that the
    /// errors are of.
    pub fn sure(&self) -> impl Iterator<Item = &ComparedFilm> {
        self.films.iter().filter(|film| !film.unsure)
    }

    /// The films whose pigments `palette` can mix, without those that the fit
    /// excluded. None for absolute amounts, whose films do not hide.
    #[must_use]
    pub fn measured_samples(&self, palette: &Palette<'_>) -> Vec<MeasuredSample> {
        if palette.library().amounts == AmountKind::Absolute {
            return Vec::new();
        }
        let known = |recipe: &Recipe| recipe.iter().all(|(p, _)| palette.paints().contains(p));
        let films = self.films.iter().filter(|film| !film.excluded && known(&film.recipe));
        let sample = |film: &ComparedFilm| MeasuredSample {
            sample: film.sample.clone(),
            recipe: film.recipe.clone(),
            reflectance: film.measured.clone(),
        };
        films.map(sample).collect()
    }
}

/// The measurements that can be compared with a library.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparable {
    /// The samples whose every pigment is in the library, on its wavelengths.
    pub set: SwatchSet,
    /// Where each pigment of `set` stands in the library.
    pub in_library: Vec<usize>,
    /// See [`Comparison::absent`].
    pub absent: Vec<(String, Vec<String>)>,
    /// See [`Comparison::resampled_from`].
    pub resampled_from: Option<Grid>,
}

impl Comparable {
    /// The part of `set` whose pigments `library` has, by their names (without
    /// regard to case).
    ///
    /// # Errors
    /// [`ComparisonError`] if that is nothing, or if the readings do not cover
    /// the library's wavelengths.
    pub fn of(set: &SwatchSet, library: &PigmentLibrary) -> Result<Self, ComparisonError> {
        let find = |name: &String| {
            let lower = name.to_lowercase();
            let exact = library.pigments.iter().position(|p| p.name == *name);
            exact.or_else(|| library.pigments.iter().position(|p| p.name.to_lowercase() == lower))
        };
        let lacking = |swatch: &Swatch| -> Vec<String> {
            let used = set.pigments.iter().zip(&swatch.amounts).filter(|(_, a)| **a > 0.0);
            used.filter(|(name, _)| find(name).is_none()).map(|(name, _)| name.clone()).collect()
        };
        let absent = set.swatches.iter().map(|s| (s.sample.clone(), lacking(s)));
        let absent: Vec<_> = absent.filter(|(_, pigments)| !pigments.is_empty()).collect();
        let kept = set.retaining(|swatch| lacking(swatch).is_empty());
        if kept.swatches.is_empty() {
            return Err(ComparisonError::NothingInCommon {
                measured: set.pigments.clone(),
                library: library.pigments.iter().map(|p| p.name.clone()).collect(),
            });
        }
        let (from, to) = (set.grid, library.grid);
        let same = from == to;
        let covered = from.covers(to.start_nm()) && from.covers(to.end_nm());
        if !(same || covered) {
            return Err(ComparisonError::Band { readings: from, library: to });
        }
        let in_library = kept.pigments.iter().filter_map(find).collect();
        let resampled_from = (!same).then_some(from);
        let set = if same { kept } else { resampled(kept, to)? };
        Ok(Self { set, in_library, absent, resampled_from })
    }

    /// Each film as measured and as `library` predicts it, under `viewing`.
    ///
    /// # Errors
    /// [`MeasurementError`] as [`observations`] and [`films`].
    ///
    /// # Panics
    /// If `library` is not the one that the measurements were chosen for.
    pub fn with(
        &self,
        library: &PigmentLibrary,
        viewing: &Viewing,
    ) -> Result<Comparison, MeasurementError> {
        let weights = viewing.weights(library.grid).expect("the method fits the grid");
        let settings = settings(library);
        let measured = match library.amounts {
            AmountKind::Relative => self.hiding(library, &settings)?,
            AmountKind::Absolute => self.finite(library)?,
        };
        let triples = measured
            .iter()
            .map(|film| (film.sample.clone(), film.measured.as_slice(), film.predicted.clone()));
        let errors = Scores::of(&weights, triples).per_sample;
        let mut films: Vec<ComparedFilm> = measured;
        for (film, error) in films.iter_mut().zip(errors) {
            film.delta_e = error.delta_e;
            let pigments = film.recipe.iter().map(|(pigment, _)| &library.pigments[*pigment]);
            film.unsure = pigments.into_iter().any(|p| p.guessed || !p.identified);
        }
        let sure = films.iter().filter(|film| !film.unsure);
        let sure = sure.map(|f| (f.sample.clone(), f.measured.as_slice(), f.predicted.clone()));
        let Scores { rms, delta_e, .. } = Scores::of(&weights, sure);
        let (absent, resampled_from) = (self.absent.clone(), self.resampled_from);
        Ok(Comparison { films, rms, delta_e, absent, resampled_from })
    }

    fn hiding(
        &self,
        library: &PigmentLibrary,
        settings: &FitSettings,
    ) -> Result<Vec<ComparedFilm>, MeasurementError> {
        let observations = observations(&self.set, library.saunderson, settings.below_surface)?;
        let films = observations.into_iter().map(|observation| {
            let recipe = self.recipe(&observation.shares);
            let mixture = library.mix(&recipe).expect("shares sum to 1");
            let excluded = settings.excluded.contains(&observation.sample);
            let predicted = mixture.hiding(library.saunderson);
            film(observation.sample, recipe, observation.reflectance, predicted, excluded)
        });
        Ok(films.collect())
    }

    fn finite(&self, library: &PigmentLibrary) -> Result<Vec<ComparedFilm>, MeasurementError> {
        let (problem, names) = films(&self.set)?;
        let settings = settings(library);
        let excluded = self.set.swatches.iter().flat_map(|swatch| {
            let excluded = settings.excluded.contains(&swatch.sample);
            swatch.films.iter().map(move |_| excluded)
        });
        let films = names.into_iter().zip(excluded).enumerate().map(|(index, (name, excluded))| {
            let amounts = problem.recipes[index].iter();
            let recipe: Vec<_> = amounts.map(|&(p, a)| (self.in_library[p], a)).collect();
            let mixture = library.mix(&recipe).expect("amounts are above 0");
            let predicted = mixture.film(1.0, &problem.bare[index], library.film());
            film(name, recipe, problem.reflectance[index].clone(), predicted, excluded)
        });
        Ok(films.collect())
    }

    fn recipe(&self, shares: &[f64]) -> Vec<(usize, f64)> {
        let all = self.in_library.iter().copied().zip(shares.iter().copied());
        all.filter(|(_, share)| *share > 0.0).collect()
    }

    /// Mixtures that leave-one-out would predict.
    #[must_use]
    pub fn mixtures(&self, library: &PigmentLibrary) -> usize {
        let mixed = |s: &&Swatch| s.amounts.iter().filter(|a| **a > 0.0).count() > 1;
        let set = self.fitted_again(library);
        let films = set.swatches.iter().filter(mixed).map(|s| match library.amounts {
            AmountKind::Relative => 1,
            AmountKind::Absolute => s.films.len(),
        });
        films.sum()
    }

    /// Leaves each mixture out in turn (absolute amounts: each of 10 seeded
    /// groups), fits the others as `library` was fitted, and predicts it.
    /// Nothing where the reference white was not measured, or there is no
    /// mixture.
    ///
    /// A library that does not tell its settings is taken to be fitted as
    /// [`FitSettings::default`] has it, dark readings read as black.
    ///
    /// # Errors
    /// [`CalibrationError`] from any fit.
    pub fn left_out(
        &self,
        library: &PigmentLibrary,
        viewing: &Viewing,
        progress: &(dyn Fn() + Sync),
    ) -> Result<Option<Validation>, CalibrationError> {
        if self.mixtures(library) == 0 {
            return Ok(None);
        }
        let settings = settings(library);
        let set = self.fitted_again(library);
        let plan =
            |state, folds| ValidationPlan { settings: &settings, viewing, state, folds, progress };
        if library.amounts == AmountKind::Absolute {
            let film = library.film();
            let state = calibrate_absolute(&set, film, &settings, viewing)?.state;
            return validate_absolute(&set, film, &plan(state, Some(10))).map(Some);
        }
        let named = |name: &String| set.pigments.iter().position(|p| p == name);
        let Some(reference) = library.reference.as_ref().and_then(named) else { return Ok(None) };
        let surface: Surface = library.saunderson;
        let state = calibrate(&set, reference, surface, &settings, viewing)?.state;
        validate(&set, reference, surface, &plan(state, None), |_| true).map(Some)
    }

    /// The samples that a fit takes, their pigments called as in the library.
    fn fitted_again(&self, library: &PigmentLibrary) -> SwatchSet {
        let names = self.in_library.iter().map(|&p| library.pigments[p].name.clone());
        let named = SwatchSet { pigments: names.collect(), ..self.set.clone() };
        let excluded = settings(library).excluded;
        named.retaining(|swatch| !excluded.contains(&swatch.sample))
    }
}

fn settings(library: &PigmentLibrary) -> FitSettings {
    let usual = || FitSettings { below_surface: BelowSurface::Floor, ..FitSettings::default() };
    library.settings.clone().unwrap_or_else(usual)
}

fn film(
    sample: String,
    recipe: Vec<(usize, f64)>,
    measured: Vec<f64>,
    predicted: Vec<f64>,
    excluded: bool,
) -> ComparedFilm {
    ComparedFilm { sample, recipe, measured, predicted, delta_e: 0.0, unsure: false, excluded }
}

/// Every reading of `set` on `grid`, which it covers.
fn resampled(set: SwatchSet, grid: Grid) -> Result<SwatchSet, InterpolateError> {
    let method = Interpolation::best_for(set.grid);
    let from = set.grid;
    let moved = |values: &[f64]| -> Result<Vec<f64>, InterpolateError> {
        let spectrum = Spectrum::<Reflectance>::new(from, values.to_vec());
        let spectrum = spectrum.expect("a reading has a value for each wavelength");
        // Between a dark and a light band an interpolation may swing below 0.
        let values = spectrum.resampled(grid, method, Extrapolation::Hold)?.into_values();
        Ok(values.into_iter().map(|value| value.max(0.0)).collect())
    };
    let mut set = SwatchSet { grid, ..set };
    for film in set.swatches.iter_mut().flat_map(|swatch| &mut swatch.films) {
        film.reflectance = moved(&film.reflectance)?;
        film.bare = film.bare.as_deref().map(moved).transpose()?;
    }
    Ok(set)
}

/// Why a library and measurements cannot be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ComparisonError {
    /// Every sample holds a pigment that the library has not.
    #[error("every sample holds a pigment that the library has not; measured are `{}`", measured.join(", "))]
    NothingInCommon {
        /// The pigments measured.
        measured: Vec<String>,
        /// The pigments of the library.
        library: Vec<String>,
    },
    /// The readings do not reach far enough.
    #[error("the library stands on {library}, the readings on `{readings}`")]
    Band {
        /// The readings' wavelengths.
        readings: Grid,
        /// The library's.
        library: Grid,
    },
    /// The readings cannot be brought to the library's wavelengths.
    #[error(transparent)]
    Interpolate(#[from] InterpolateError),
}

impl ComparisonError {
    /// What to try.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::NothingInCommon { library, .. } => {
                Some(format!("pigments of the library: {}", library.join(", ")))
            }
            Self::Band { .. } => {
                Some("fit a library from these readings, or measure the whole band".to_owned())
            }
            Self::Interpolate(_) => None,
        }
    }
}
