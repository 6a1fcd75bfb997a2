//! Compares a library with measurements: how it predicts each sample, and how it predicts mixtures that we
//! leave out of the fit.

use documents::{Task, hint::Explain};
use pigment::palette::{MeasuredSample, Palette};
use pigment::{PigmentId, Recipe};
use spectra::optics::Surface;
use spectra::{Extrapolation, Grid, InterpolateError, Interpolation, Reflectance, Spectrum};

use crate::absolute::{calibrate_absolute, films};
use crate::calibration::{CalibrationError, calibrate};
use crate::fit::{FitSettings, MeasuredFilm};
use crate::leave_out::LeaveOut;
use crate::measurement::MeasurementError;
use crate::observation::{BelowSurface, observations};
use crate::report::Scores;
use crate::swatch::{Swatch, SwatchSet};
use crate::validation::{
    DEFAULT_FOLDS, Validation, ValidationPlan, leave_out_films, leave_out_samples,
};
use pigment::evaluate::{Summary, Viewing};
use pigment::library::{AmountKind, PigmentLibrary};

/// One film, measured and predicted.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedFilm {
    /// Name of the sample, with its backing if it has several films.
    pub sample: String,
    /// Pigments of the library with their amounts. Shares sum to 1.
    pub recipe: Recipe,
    /// Measured reflectance as a fraction. For shares this is a film that hides. For absolute amounts it is
    /// the film itself.
    pub measured: Vec<f64>,
    /// Reflectance that the library predicts.
    pub predicted: Vec<f64>,
    /// CIEDE2000 between measured and predicted colour.
    pub delta_e: f64,
    /// Whether the recipe contains a pigment without measured K and S (e.g. not identified, or guessed).
    pub unsure: bool,
    /// Whether the fit of the library left this sample out.
    pub excluded: bool,
}

/// A library compared with measurements.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Films in order of the file.
    pub films: Vec<ComparedFilm>,
    /// Root mean square error of reflectance, over the films of [`Self::sure`].
    pub rms: f64,
    /// Summary of the colour errors, over the films of [`Self::sure`].
    pub delta_e: Summary,
    /// Samples that we cannot compare, each with the names of pigments that the library lacks.
    pub absent: Vec<(String, Vec<String>)>,
    /// Wavelengths of the readings before we resampled them. `None` if we did not.
    pub resampled_from: Option<Grid>,
}

impl Comparison {
    /// Films with measured and identified pigments only. We summarise errors over these.
    pub fn sure(&self) -> impl Iterator<Item = &ComparedFilm> {
        self.films.iter().filter(|film| !film.unsure)
    }

    /// Films that you can mix with `palette`, without those that the fit excluded. The list is empty for
    /// absolute amounts, because their films do not hide.
    #[must_use]
    pub fn measured_samples(&self, palette: &Palette<'_>) -> Vec<MeasuredSample> {
        if palette.library().amounts == AmountKind::Absolute {
            return Vec::new();
        }
        let films = self.films.iter().filter(|film| {
            !film.excluded && film.recipe.pigments().all(|p| palette.paints().contains(&p))
        });
        films
            .map(|film: &ComparedFilm| MeasuredSample {
                sample: film.sample.clone(),
                recipe: film.recipe.clone(),
                reflectance: film.measured.clone(),
            })
            .collect()
    }
}

/// Measurements that you can compare with a library.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparable {
    /// The samples whose pigments are all in the library, resampled to its wavelengths.
    pub set: SwatchSet,
    /// Index in the library of each pigment of `set`.
    pub in_library: Vec<PigmentId>,
    /// Samples that we cannot compare, each with the names of pigments that the library lacks.
    pub absent: Vec<(String, Vec<String>)>,
    /// Wavelengths of the readings before we resampled them. `None` if we did not.
    pub resampled_from: Option<Grid>,
}

impl Comparable {
    /// Selects the samples of `set` if all their pigments are in `library`. Names match without regard to
    /// case.
    ///
    /// # Errors
    /// [`ComparisonError`] if there is none, or if the readings do not cover the library's wavelengths.
    pub fn of(set: &SwatchSet, library: &PigmentLibrary) -> Result<Self, ComparisonError> {
        let lacking = |swatch: &Swatch| -> Vec<String> {
            let used = set.pigments.iter().zip(&swatch.amounts).filter(|(_, a)| **a > 0.0);
            let lacking = used.filter(|(name, _)| named(library, name).is_none());
            lacking.map(|(name, _)| name.clone()).collect()
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
        let from = set.grid;
        let to = library.grid;
        let same = from == to;
        let covered = from.covers(to.start_nm()) && from.covers(to.end_nm());
        if !(same || covered) {
            return Err(ComparisonError::Band { readings: from, library: to });
        }
        let in_library = kept.pigments.iter().filter_map(|name| named(library, name)).collect();
        let resampled_from = (!same).then_some(from);
        let set = if same { kept } else { resampled(kept, to)? };
        Ok(Self { set, in_library, absent, resampled_from })
    }

    /// Compares each film as measured with the prediction of `library` under `viewing`.
    ///
    /// # Errors
    /// [`MeasurementError`] if readings cannot be used.
    ///
    /// # Panics
    /// If you selected the measurements for another library.
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
            let mut pigments = film.recipe.pigments().map(|pigment| &library[pigment]);
            film.unsure = pigments.any(|p| p.guessed || !p.identified);
        }
        let sure = films.iter().filter(|film| !film.unsure);
        let sure = sure.map(|f| (f.sample.clone(), f.measured.as_slice(), f.predicted.clone()));
        let Scores { rms, delta_e, .. } = Scores::of(&weights, sure);
        let absent = self.absent.clone();
        let resampled_from = self.resampled_from;
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
            film(observation.sample, recipe, observation.as_read, predicted, excluded)
        });
        Ok(films.collect())
    }

    fn finite(&self, library: &PigmentLibrary) -> Result<Vec<ComparedFilm>, MeasurementError> {
        let problem = films(&self.set)?;
        let settings = settings(library);
        let excluded = self.set.swatches.iter().flat_map(|swatch| {
            let excluded = settings.excluded.contains(&swatch.sample);
            swatch.films.iter().map(move |_| excluded)
        });
        let films = problem.films.into_iter().zip(excluded).map(|(measured, excluded)| {
            let MeasuredFilm { name, recipe, reflectance, bare, .. } = measured;
            let amounts = recipe.iter().map(|&(p, amount)| (self.in_library[p.index()], amount));
            let recipe: Recipe = amounts.collect();
            let mixture = library.mix(&recipe).expect("amounts are above 0");
            let predicted = mixture.film(1.0, &bare, library.film());
            film(name, recipe, reflectance, predicted, excluded)
        });
        Ok(films.collect())
    }

    fn recipe(&self, shares: &[f64]) -> Recipe {
        let all = self.in_library.iter().copied().zip(shares.iter().copied());
        all.filter(|(_, share)| *share > 0.0).collect()
    }

    /// Number of samples that [`Self::left_out`] would predict.
    #[must_use]
    pub fn mixtures(&self, library: &PigmentLibrary) -> usize {
        let set = self.fitted_again(library);
        let leave_out = LeaveOut::usual(&set);
        let films =
            set.swatches.iter().filter(|swatch: &&Swatch| leave_out.selects(&swatch.amounts)).map(
                |s| match library.amounts {
                    AmountKind::Relative => 1,
                    AmountKind::Absolute => s.films.len(),
                },
            );
        films.sum()
    }

    /// Leaves out each mixture in turn (or each sample, if there are no mixtures), fits the others as
    /// `library` was fitted, and predicts it. For
    /// absolute amounts we deal the mixtures at random into 10 groups (the same every time), and leave out
    /// one group at a time. You get `None` if the reference white was not measured, or there is no mixture.
    ///
    /// If a library has no settings of its fit, we assume [`FitSettings::default`] and read dark readings
    /// as black.
    ///
    /// `task` counts the mixtures that were left out.
    ///
    /// # Errors
    /// [`CalibrationError`] from any fit, or if `task` was cancelled.
    pub fn left_out(
        &self,
        library: &PigmentLibrary,
        viewing: &Viewing,
        task: &Task,
    ) -> Result<Option<Validation>, CalibrationError> {
        if self.mixtures(library) == 0 {
            return Ok(None);
        }
        let settings = settings(library);
        let set = self.fitted_again(library);
        let quiet = task.quiet();
        let leave_out = LeaveOut::usual(&set);
        let settings = &settings;
        let plan = ValidationPlan { settings, viewing, state: None, leave_out, folds: None, task };
        if library.amounts == AmountKind::Absolute {
            let film = library.film();
            let state = calibrate_absolute(&set, film, settings, viewing, &quiet)?.state;
            let plan = ValidationPlan { state, folds: Some(DEFAULT_FOLDS), ..plan };
            return leave_out_films(&set, film, &plan).map(Some);
        }
        let Some(reference) = library
            .reference
            .as_ref()
            .and_then(|name: &String| set.pigments.iter().position(|p| p == name).map(PigmentId))
        else {
            return Ok(None);
        };
        let surface: Surface = library.saunderson;
        let state = calibrate(&set, reference, surface, settings, viewing, &quiet)?.state;
        let plan = ValidationPlan { state, ..plan };
        leave_out_samples(&set, reference, surface, &plan, |_| true).map(Some)
    }

    /// The samples that the library's fit used, with pigments named as in the library.
    fn fitted_again(&self, library: &PigmentLibrary) -> SwatchSet {
        let names = self.in_library.iter().map(|&p| library[p].name.clone());
        let named = SwatchSet { pigments: names.collect(), ..self.set.clone() };
        let excluded = settings(library).excluded;
        named.retaining(|swatch| !excluded.contains(&swatch.sample))
    }
}

fn settings(library: &PigmentLibrary) -> FitSettings {
    library.settings.clone().unwrap_or_else(|| FitSettings {
        below_surface: BelowSurface::Floor,
        ..FitSettings::default()
    })
}

fn film(
    sample: String,
    recipe: Recipe,
    measured: Vec<f64>,
    predicted: Vec<f64>,
    excluded: bool,
) -> ComparedFilm {
    ComparedFilm { sample, recipe, measured, predicted, delta_e: 0.0, unsure: false, excluded }
}

/// The pigment of `library` with this name, otherwise the first with it in other letter case.
fn named(library: &PigmentLibrary, name: &str) -> Option<PigmentId> {
    let lower = name.to_lowercase();
    let exact = library.ids().find(|id| library[*id].name == name);
    exact.or_else(|| library.ids().find(|id| library[*id].name.to_lowercase() == lower))
}

/// Resamples every reading of `set` to `grid`, which its own grid covers.
fn resampled(set: SwatchSet, grid: Grid) -> Result<SwatchSet, InterpolateError> {
    let method = Interpolation::best_for(set.grid);
    let from = set.grid;
    let moved = |values: &[f64]| -> Result<Vec<f64>, InterpolateError> {
        let spectrum = Spectrum::<Reflectance>::new(from, values.to_vec());
        let spectrum = spectrum.expect("a reading has a value for each wavelength");
        // Between a dark and a light band, we may interpolate to a value below 0.
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

/// A library and measurements that cannot be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum ComparisonError {
    /// Every sample contains a pigment that the library lacks.
    #[error("every sample contains a pigment that the library lacks; the measured pigments are `{}`", measured.join(", "))]
    #[hint("pigments of the library: {}", library.join(", "))]
    NothingInCommon {
        /// Names of the measured pigments.
        measured: Vec<String>,
        /// Names of the library's pigments.
        library: Vec<String>,
    },
    /// The readings do not cover the library's wavelengths.
    #[error("the library has the wavelengths {library}, the readings have `{readings}`")]
    #[hint("fit a library from these readings, or measure the whole band")]
    Band {
        /// Wavelengths of the readings.
        readings: Grid,
        /// Wavelengths of the library.
        library: Grid,
    },
    /// The readings cannot be interpolated to the library's wavelengths.
    #[error(transparent)]
    Interpolate(#[from] InterpolateError),
}
