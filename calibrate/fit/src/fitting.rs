//! From readings to a library: options, default choices (reported as remarks) and the fit.

use std::path::Path;

use documents::counted;
use spectra::optics::{Specular, Surface, UnevenFilm};

use crate::absolute::{CHOICE_FITS, calibrate_absolute_watched, chosen_film, films};
use crate::backings::check_backings;
use crate::calibration::{Calibration, CalibrationError, calibrate_watched};
use crate::fit::{Condition, FitSettings, Method, RefinedState, Smoothness, Watch};
use crate::fitting_error::FittingError;
use crate::observation::{BelowSurface, Observation};
use crate::readings::Readings;
use crate::report::ErrorReport;
use crate::surface_choice::{check_above_surface, usual_below_readings};
use crate::swatch::SwatchSet;
use pigment::PigmentId;
use pigment::evaluate::Viewing;
use pigment::library::{AmountKind, Evidence, Input, PigmentLibrary};
use pigment::remark::Remark;
use pigment::visible_band::check_visible_band;

/// Options of [`fit`].
///
/// ```
/// use calibrate::FitOptions;
/// use calibrate::fit::Method;
///
/// let options = FitOptions { method: Method::Weighted, ..FitOptions::default() };
/// assert!(options.reference.is_none());
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FitOptions {
    /// Meaning of the amounts in recipes: shares of a mixture, or amounts on a fixed area of a known
    /// backing.
    pub amounts: AmountKind,
    /// Method of the fit; absolute amounts always take `refined`.
    pub method: Method,
    /// Name of the white whose S is 1. Default: the pigment called white that occurs in most samples.
    pub reference: Option<String>,
    /// Surface of the films. Default: k2 = 0.6 and k1 = 0.03, or less where a reading is lower; for
    /// absolute amounts k1 = 0 and the k2 that predicts unseen films best.
    pub surface: Option<Surface>,
    /// Whether the readings contain the mirror reflection, where no `surface` says so.
    pub specular: Specular,
    /// Treatment of readings below k1. Default: refuse where `surface` is given; else none is below,
    /// because k1 is lowered. If given without `surface`, k1 stays 0.03.
    pub below_surface: Option<BelowSurface>,
    /// Smoothness of K and S over wavelength.
    pub smoothness: Smoothness,
    /// Unevenness of films of absolute amounts, as the standard deviation of log thickness, 0 to 2.
    /// Default: the value that predicts unseen films best.
    pub unevenness: Option<f64>,
    /// Names of the samples to leave out.
    pub exclude: Vec<String>,
    /// Light and observer of the colour errors. K and S do not depend on them.
    pub viewing: Viewing,
    /// Title of the library. Default: name of the first file.
    pub title: Option<String>,
    /// Licence of the library. Default: `not stated`.
    pub licence: Option<String>,
    /// Origin of the measurements. Default: `not stated`.
    pub source: Option<String>,
}

/// Fits K and S of every pigment to measured swatches.
///
/// ```no_run
/// let readings = calibrate::Readings::open("swatches.csv")?;
/// let fit = calibrate::fit(&readings, &calibrate::FitOptions::default())?;
/// println!("{}", fit.report());
/// for warning in fit.warnings() {
///     eprintln!("warning: {warning}");
/// }
/// fit.library.save("library.json")?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`FittingError`] if options exclude each other, a name is unknown, readings cannot be used, or the
/// fit fails.
pub fn fit(readings: &Readings, options: &FitOptions) -> Result<Fit, FittingError> {
    let prepared = PreparedFit::new(readings, options, Watch::default())?;
    let mut fit = prepared.fit()?;
    fit.remarks.splice(0..0, prepared.remarks);
    Ok(fit)
}

/// A fitted library, with what a user should know about the fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The library, with the evidence of its fit.
    pub library: PigmentLibrary,
    /// Choices that were made, and what the films and equations show.
    pub remarks: Vec<Remark>,
    /// Swatches as the fit used them; empty for absolute amounts.
    pub observations: Vec<Observation>,
    /// Rank and condition of the equations; `None` for absolute amounts.
    pub condition: Option<Condition>,
    /// Estimates that a validation reuses.
    pub(crate) state: Option<RefinedState>,
}

impl Fit {
    /// Errors of the fit.
    ///
    /// # Panics
    /// If the evidence was removed from the library.
    #[must_use]
    pub fn evidence(&self) -> &Evidence {
        self.library.evidence.as_ref().expect("a fit has evidence")
    }

    /// Report of the colour errors of all samples.
    #[must_use]
    pub fn report(&self) -> ErrorReport<'_> {
        let title = format!(
            "{} from {}, {}",
            counted(self.library.pigments.len(), "pigment"),
            counted(self.evidence().per_sample.len(), "sample"),
            self.library.grid
        );
        ErrorReport::of_evidence(title, self.evidence())
    }

    /// Warnings about the data: pigments that they do not identify, and contradictions.
    #[must_use]
    pub fn warnings(&self) -> &[String] {
        &self.evidence().warnings
    }
}

/// Readings with all options resolved, ready to be fitted or validated.
#[derive(Debug, Clone)]
pub struct PreparedFit {
    /// Swatches without those that are left out.
    pub set: SwatchSet,
    /// Settings of the fit.
    pub settings: FitSettings,
    /// Film model of the fit.
    pub model: FilmModel,
    /// Choices that were made, and warnings about the wavelengths.
    pub remarks: Vec<Remark>,
    viewing: Viewing,
    inputs: Vec<Input>,
    title: String,
    licence: String,
    source: String,
}

/// Film model of a fit, by the meaning of the amounts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FilmModel {
    /// Shares of a mixture.
    Relative {
        /// White whose S is 1.
        reference: PigmentId,
        /// Surface of the films.
        surface: Surface,
    },
    /// Amounts on known backings.
    Absolute(UnevenFilm),
}

impl PreparedFit {
    /// Number of times that [`Self::new`] tells [`FitStage::FilmModel`](crate::fit::FitStage::FilmModel)
    /// if it chooses the film model of absolute amounts.
    pub const MODEL_FITS: usize = CHOICE_FITS;

    /// Resolves the options: selects samples, finds the reference white and the surface. `watch` is
    /// told each fit made to choose the film model of absolute amounts, and may end them.
    ///
    /// # Errors
    /// [`FittingError`] if options exclude each other, a name is unknown, or readings cannot be used.
    pub fn new(
        readings: &Readings,
        options: &FitOptions,
        watch: Watch<'_>,
    ) -> Result<Self, FittingError> {
        let mut remarks = Vec::from_iter(check_visible_band(readings.table.grid)?);
        let set = without_excluded(readings.swatches()?, &options.exclude)?;
        let below_surface = options.below_surface.unwrap_or(match options.surface {
            Some(_) => BelowSurface::Refuse,
            None => BelowSurface::Floor,
        });
        check_backings(&set)?;
        if options.surface.is_none() || below_surface == BelowSurface::Floor {
            let usual = Surface::of_most_paints(options.specular);
            let Surface { k1, k2, .. } = options.surface.unwrap_or(usual);
            check_above_surface(&set, k1, k2).map_err(CalibrationError::from)?;
        }
        let model = match options.amounts {
            AmountKind::Relative => {
                let reference = reference(&set, options.reference.as_deref())?;
                let name = &set.pigments[reference.index()];
                let note = Remark::note(format!("reference white: {name}"));
                remarks.push(note);
                // Who says how readings below k1 are treated means the usual k1.
                let surface = match (options.surface, options.below_surface) {
                    (Some(surface), _) => surface,
                    (None, Some(_)) => Surface::of_most_paints(options.specular),
                    (None, None) => {
                        let (surface, lowered) = usual_below_readings(&set, options.specular);
                        remarks.extend(lowered);
                        surface
                    }
                };
                FilmModel::Relative { reference, surface }
            }
            AmountKind::Absolute => {
                if options.reference.is_some() || options.method != Method::Refined {
                    return Err(FittingError::AbsoluteOptions);
                }
                FilmModel::Absolute(film_model(&set, options, watch, &mut remarks)?)
            }
        };
        let first = readings.inputs.first().map_or("", |input| input.path.as_str());
        let stated = |text: &Option<String>| text.clone().unwrap_or_else(|| "not stated".into());
        Ok(Self {
            set,
            settings: FitSettings {
                method: options.method,
                smoothness: options.smoothness,
                below_surface,
                excluded: options.exclude.clone(),
            },
            model,
            remarks,
            viewing: options.viewing.clone(),
            inputs: readings.inputs.clone(),
            title: options.title.clone().unwrap_or_else(|| stem(first)),
            licence: stated(&options.licence),
            source: stated(&options.source),
        })
    }

    /// Light and observer of the colour errors.
    #[must_use]
    pub fn viewing(&self) -> &Viewing {
        &self.viewing
    }

    /// Fits the library. The remarks are those of the fit itself.
    ///
    /// # Errors
    /// [`FittingError::Calibration`] if readings cannot be used or the fit fails.
    pub fn fit(&self) -> Result<Fit, FittingError> {
        self.fit_watched(Watch::default())
    }

    /// Fits like [`Self::fit`], tells `watch` the stages of the fit, and ends when it asks for that.
    ///
    /// # Errors
    /// [`FittingError::Calibration`] if readings cannot be used, the fit fails or `watch` ends it.
    pub fn fit_watched(&self, watch: Watch<'_>) -> Result<Fit, FittingError> {
        let Calibration { mut library, observations, condition, state } = match self.model {
            FilmModel::Relative { reference, surface } => {
                let Self { set, settings, viewing, .. } = self;
                calibrate_watched(set, reference, surface, settings, viewing, watch)?
            }
            FilmModel::Absolute(film) => {
                calibrate_absolute_watched(&self.set, film, &self.settings, &self.viewing, watch)?
            }
        };
        library.inputs = self.inputs.clone();
        library.title = self.title.clone();
        library.licence = self.licence.clone();
        library.source = self.source.clone();
        let remarks = remarks(&observations, condition.as_ref());
        Ok(Fit { library, remarks, observations, condition, state })
    }
}

fn without_excluded(set: SwatchSet, exclude: &[String]) -> Result<SwatchSet, FittingError> {
    if exclude.is_empty() {
        return Ok(set);
    }
    let samples: Vec<String> = set.swatches.iter().map(|s| s.sample.clone()).collect();
    let excluded = exclude
        .iter()
        .map(|name| Ok(&samples[index_of(&samples, name, "sample")?]))
        .collect::<Result<Vec<_>, FittingError>>()?;
    if excluded.len() >= samples.len() {
        return Err(FittingError::AllExcluded);
    }
    Ok(set.retaining(|swatch| !excluded.contains(&&swatch.sample)))
}

/// The white by name, else the pigment called white that occurs in most samples.
fn reference(set: &SwatchSet, name: Option<&str>) -> Result<PigmentId, FittingError> {
    if let Some(name) = name {
        return index_of(&set.pigments, name, "pigment").map(PigmentId);
    }
    let samples = |index: usize| set.swatches.iter().filter(|s| s.amounts[index] > 0.0).count();
    let called_white = |&index: &usize| set.pigments[index].to_lowercase().contains("white");
    let whites: Vec<usize> = (0..set.pigments.len()).filter(called_white).collect();
    // Of several in equally many samples, the first column is chosen.
    let commonest = whites.into_iter().rev().max_by_key(|&index| samples(index));
    commonest.map(PigmentId).ok_or_else(|| FittingError::NoWhite {
        first: set.pigments.first().cloned().unwrap_or_default(),
    })
}

/// The film model of absolute amounts: as stated, else chosen by cross-validation.
fn film_model(
    set: &SwatchSet,
    options: &FitOptions,
    watch: Watch<'_>,
    remarks: &mut Vec<Remark>,
) -> Result<UnevenFilm, FittingError> {
    let plain = Surface { k1: 0.0, k2: 0.0, specular: options.specular };
    if options.surface.is_some() || options.unevenness.is_some() {
        return Ok(UnevenFilm {
            surface: options.surface.unwrap_or(plain),
            unevenness: options.unevenness.unwrap_or(0.0),
        });
    }
    let problem = films(set)?;
    let film = chosen_film(&problem, plain, watch).map_err(CalibrationError::from)?;
    remarks.push(Remark::note(format!(
        "film model by cross-validation: k2 = {}, unevenness {}",
        film.surface.k2, film.unevenness
    )));
    Ok(film)
}

/// Remarks on how well the films hid, how far repeated readings differ, and how well the equations are
/// conditioned.
fn remarks(films: &[Observation], condition: Option<&Condition>) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let open = films.iter().filter(|o| o.hiding.hides() == Some(false)).count();
    if open > 0 {
        let [lets, its] = if open == 1 { ["lets its", "its"] } else { ["let their", "their"] };
        remarks.push(Remark::note(format!(
            "{open} of {} {lets} backing through; {its} K/S comes from the two backings",
            counted(films.len(), "film")
        )));
    }
    let spreads = || films.iter().filter_map(|o| Some((o.spread?, &o.sample)));
    if let Some((largest, sample)) = spreads().max_by(|a, b| a.0.total_cmp(&b.0)) {
        remarks.push(Remark::note(format!(
            "repeated readings of {} averaged; they spread by {largest:.4} at most ({sample})",
            counted(spreads().count(), "sample")
        )));
    }
    if let Some(c) = condition {
        remarks.push(Remark::note(format!(
            "rank {} of {} unknowns a wavelength; condition {:.0} at worst, at {} nm",
            c.rank, c.unknowns, c.number, c.nm
        )));
    }
    remarks
}

/// Index of `wanted` among `names`: exactly, else without regard to case.
pub(crate) fn index_of(
    names: &[String],
    wanted: &str,
    what: &'static str,
) -> Result<usize, FittingError> {
    let lower = wanted.to_lowercase();
    let exact = names.iter().position(|name| name == wanted);
    exact.or_else(|| names.iter().position(|name| name.to_lowercase() == lower)).ok_or_else(|| {
        FittingError::UnknownName { what, name: wanted.to_owned(), known: names.to_vec() }
    })
}

/// A file's name without folder and ending.
fn stem(path: &str) -> String {
    let stem = Path::new(path).file_stem();
    stem.map_or_else(|| path.to_owned(), |stem| stem.to_string_lossy().into_owned())
}
