//! From readings to a library: options, default choices (reported as remarks), the surface, and the fit.

use std::path::Path;

use documents::hint::Explain;
use documents::{Task, counted, question};
use pigment::PigmentId;
use pigment::evaluate::{Viewing, percentile};
use pigment::library::{AmountKind, Evidence, Input, PigmentLibrary};
use pigment::remark::Remark;
use pigment::visible_band::{BandError, check_visible_band};
use spectra::headings::{is_white, plain};
use spectra::optics::{Specular, Surface, UnevenFilm};

use crate::absolute::{CHOICE_FITS, calibrate_absolute, chosen_film, films};
use crate::calibration::{Calibration, CalibrationError, calibrate};
use crate::disorder::{SuspectFit, explained, is_suspect};
use crate::fit::{Condition, FitSettings, Method, RefinedState};
use crate::measurement::{MeasurementError, k1_below};
use crate::observation::{BelowSurface, Observation, check_backings, least_reading};
use crate::readings::Readings;
use crate::report::ErrorReport;
use crate::request::{FitRequest, Provenance};
use crate::swatch::SwatchSet;

/// Fits K and S of every pigment to measured swatches.
///
/// ```no_run
/// let readings = calibrate::Readings::open("swatches.csv")?;
/// let fit = calibrate::fit(&readings, &calibrate::FitRequest::default())?;
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
pub fn fit(readings: &Readings, options: &FitRequest) -> Result<Fit, FittingError> {
    options.run(readings, &Task::default())
}

impl FitRequest {
    /// Fits K and S of every pigment. You see the stages in `task` and may cancel it.
    ///
    /// # Errors
    /// [`FittingError`] if options exclude each other, a name is unknown, readings cannot be used, the
    /// fit fails, or `task` was cancelled.
    pub fn run(&self, readings: &Readings, task: &Task) -> Result<Fit, FittingError> {
        let prepared = PreparedFit::new(readings, self, task)?;
        let mut fit = prepared.fit(task)?;
        fit.remarks.splice(0..0, prepared.remarks);
        Ok(fit)
    }
}

/// A fitted library, with what you should know about the fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The library, with the evidence of its fit.
    pub library: PigmentLibrary,
    /// Choices that were made, and what the films and equations show.
    pub remarks: Vec<Remark>,
    /// Swatches as the fit used them. Empty for absolute amounts.
    pub observations: Vec<Observation>,
    /// Rank and condition of the equations, or `None` for absolute amounts.
    pub condition: Option<Condition>,
    /// Share of the colour differences between the samples that the recipes explain: 1 minus the mean
    /// CIEDE2000 of the fit divided by the mean CIEDE2000 from the mean colour. `None` for absolute amounts.
    pub explained: Option<f64>,
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

/// Readings with all options resolved. You can fit or validate these.
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
        /// White with S = 1.
        reference: PigmentId,
        /// Surface of the films.
        surface: Surface,
    },
    /// Amounts on known backings.
    Absolute(UnevenFilm),
}

impl PreparedFit {
    /// [`Self::new`] reports this many steps if it chooses the film model of absolute amounts.
    pub const MODEL_FITS: usize = CHOICE_FITS;

    /// Resolves the options: selects samples, and finds the reference white and the surface. `task` counts
    /// the fits with which we choose the film model of absolute amounts.
    ///
    /// # Errors
    /// [`FittingError`] if options exclude each other, a name is unknown, readings cannot be used, or
    /// `task` was cancelled.
    pub fn new(
        readings: &Readings,
        options: &FitRequest,
        task: &Task,
    ) -> Result<Self, FittingError> {
        let mut remarks = Vec::from_iter(check_visible_band(readings.table.grid)?);
        let (options, geometry) = options.with_geometry_of(readings);
        let options = &options;
        remarks.extend(geometry);
        let set = without_excluded(readings.swatches()?, &options.exclude)?;
        let stated_surface = options.stated_surface();
        let below_surface = options.below_surface.unwrap_or(match stated_surface {
            Some(_) => BelowSurface::Refuse,
            None => BelowSurface::Floor,
        });
        check_backings(&set)?;
        if stated_surface.is_none() || below_surface == BelowSurface::Floor {
            let usual = Surface::of_most_paints(options.specular.unwrap_or_default());
            let Surface { k1, k2, .. } = stated_surface.unwrap_or(usual);
            check_above_surface(&set, k1, k2).map_err(CalibrationError::from)?;
        }
        let model = match options.amounts {
            AmountKind::Relative => {
                let reference = reference(&set, options.reference.as_deref())?;
                let name = &set.pigments[reference.index()];
                let note = Remark::note(format!("reference white: {name}"));
                remarks.push(note);
                // Who says how readings below k1 are treated means the usual k1.
                let surface = match (stated_surface, options.below_surface) {
                    (Some(surface), _) => surface,
                    (None, Some(_)) => {
                        Surface::of_most_paints(options.specular.unwrap_or_default())
                    }
                    (None, None) => {
                        let (surface, lowered) =
                            usual_below_readings(&set, options.specular.unwrap_or_default());
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
                FilmModel::Absolute(film_model(&set, options, task, &mut remarks)?)
            }
        };
        let Provenance { title, licence, source } = &options.provenance;
        let first = readings.inputs.first().map_or("", |input| input.path.as_str());
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
            title: title.clone().unwrap_or_else(|| stem(first)),
            licence: licence.clone(),
            source: source.clone(),
        })
    }

    /// Light and observer of the colour errors.
    #[must_use]
    pub fn viewing(&self) -> &Viewing {
        &self.viewing
    }

    /// Fits the library and reports the stages of the fit to `task`. The result has the remarks of this
    /// fit, without [`Self::remarks`].
    ///
    /// ```
    /// use calibrate::{FitRequest, PreparedFit, Readings};
    /// use documents::Task;
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../measurements/van-gogh-oils.csv");
    ///
    /// let readings = Readings::open(path)?;
    /// let task = Task::observed(|progress| eprintln!("{}", progress.stage));
    /// let prepared = PreparedFit::new(&readings, &FitRequest::default(), &task)?;
    /// // Another thread may cancel at any time.
    /// task.cancel();
    /// assert!(prepared.fit(&task).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`FittingError::Calibration`] if readings cannot be used, the fit fails or `task` was cancelled.
    pub fn fit(&self, task: &Task) -> Result<Fit, FittingError> {
        let Calibration { mut library, observations, condition, state, scattering_known } =
            match self.model {
                FilmModel::Relative { reference, surface } => {
                    let Self { set, settings, viewing, .. } = self;
                    calibrate(set, reference, surface, settings, viewing, task)?
                }
                FilmModel::Absolute(film) => {
                    calibrate_absolute(&self.set, film, &self.settings, &self.viewing, task)?
                }
            };
        library.inputs = self.inputs.clone();
        library.title = self.title.clone();
        library.licence = self.licence.clone();
        library.source = self.source.clone();
        let explained = self.check_order(&mut library, &observations, task);
        let mut remarks = remarks(&observations, condition.as_ref());
        remarks.extend(origin_of_scattering(&self.set, &scattering_known));
        Ok(Fit { library, remarks, observations, condition, explained, state })
    }

    /// Share of the colour differences that the recipes explain. If it is small, a warning says so and names
    /// an order of the recipes that explains more.
    fn check_order(
        &self,
        library: &mut PigmentLibrary,
        observations: &[Observation],
        task: &Task,
    ) -> Option<f64> {
        let FilmModel::Relative { reference, surface } = self.model else { return None };
        let Self { set, settings, viewing, .. } = self;
        let evidence = library.evidence.as_mut()?;
        let explained = explained(set, observations, &evidence.per_sample, viewing);
        if is_suspect(explained, evidence.delta_e.mean) {
            let suspect = SuspectFit { set, reference, surface, settings, viewing };
            evidence.warnings.splice(0..0, suspect.warning(task));
        }
        explained
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

/// The white by name or its unique beginning, else the pigment called white that occurs in most samples.
fn reference(set: &SwatchSet, name: Option<&str>) -> Result<PigmentId, FittingError> {
    if let Some(name) = name {
        return index_of(&set.pigments, name, "pigment").map(PigmentId);
    }
    let whites: Vec<usize> =
        (0..set.pigments.len()).filter(|&index: &usize| is_white(&set.pigments[index])).collect();
    // If several occur in equally many samples, we choose the first column.
    let commonest = whites
        .into_iter()
        .rev()
        .max_by_key(|&index| set.swatches.iter().filter(|s| s.amounts[index] > 0.0).count());
    commonest
        .map(PigmentId)
        .ok_or_else(|| FittingError::NoWhite(set.pigments.first().cloned().unwrap_or_default()))
}

/// The film model of absolute amounts. We choose it by cross-validation if you do not state it.
fn film_model(
    set: &SwatchSet,
    options: &FitRequest,
    task: &Task,
    remarks: &mut Vec<Remark>,
) -> Result<UnevenFilm, FittingError> {
    let plain = Surface { k1: 0.0, k2: 0.0, specular: options.specular.unwrap_or_default() };
    let stated_surface = options.stated_surface();
    if stated_surface.is_some() || options.unevenness.is_some() {
        return Ok(UnevenFilm {
            surface: stated_surface.unwrap_or(plain),
            unevenness: options.unevenness.unwrap_or(0.0),
        });
    }
    let problem = films(set)?;
    let film = chosen_film(&problem, plain, task).map_err(CalibrationError::from)?;
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
    let spreads = films.iter().filter_map(|o| Some((o.spread?, &o.sample)));
    let spreads: Vec<(f64, &String)> = spreads.collect();
    if let Some((largest, sample)) = spreads.iter().max_by(|a, b| a.0.total_cmp(&b.0)) {
        remarks.push(Remark::note(format!(
            "repeated readings of {} averaged; they spread by {largest:.4} at most ({sample})",
            counted(spreads.len(), "sample")
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

/// How far S of the pigments comes from the data, and of which pigment least.
fn origin_of_scattering(set: &SwatchSet, known: &[(PigmentId, f64)]) -> Option<Remark> {
    let shares: Vec<f64> = known.iter().map(|(_, share)| *share).collect();
    let (least, share) = known.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(Remark::note(format!(
        "S comes to {:.0} % from the data (median of pigments), the rest is assumed; least of {}, {:.0} %",
        100.0 * percentile(&shares, 50.0),
        set.pigments[least.index()],
        100.0 * share
    )))
}

/// Index of `wanted` among `names`. We prefer an exact match, and else ignore letter case.
pub(crate) fn index_of(
    names: &[String],
    wanted: &str,
    what: &'static str,
) -> Result<usize, FittingError> {
    let lower = wanted.trim().to_lowercase();
    let exact = names.iter().position(|name| name == wanted);
    let exact = exact.or_else(|| names.iter().position(|name| name.to_lowercase() == lower));
    // `Titanweiss` is `Titanwei\u{df}`.
    let exact = exact.or_else(|| names.iter().position(|name| plain(name) == plain(&lower)));
    if let Some(index) = exact {
        return Ok(index);
    }
    let may_abbreviate = what == "pigment" && !lower.is_empty();
    let mut starting = (0..names.len())
        .filter(|index| may_abbreviate && names[*index].to_lowercase().starts_with(&lower));
    match (starting.next(), starting.next()) {
        (Some(index), None) => Ok(index),
        (Some(first), Some(second)) => Err(FittingError::Ambiguous {
            name: wanted.to_owned(),
            first: names[first].clone(),
            second: names[second].clone(),
        }),
        _ => {
            Err(FittingError::UnknownName { what, name: wanted.to_owned(), known: names.to_vec() })
        }
    }
}

/// A file's name without folder and ending.
fn stem(path: &str) -> String {
    let stem = Path::new(path).file_stem();
    stem.map_or_else(|| path.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// The surface of most paints. We lower k1 below every reading of `set`, and return a remark about this.
pub(crate) fn usual_below_readings(
    set: &SwatchSet,
    specular: Specular,
) -> (Surface, Option<Remark>) {
    let usual = Surface::of_most_paints(specular);
    let least = least_reading(set);
    if least >= usual.floor() {
        return (usual, None);
    }
    let surface = Surface { k1: k1_below(least), ..usual };
    let remark = Remark::note(format!(
        "k1 = {}, not {}: {} reads {least:.4}, and a surface reflects no more than is read",
        surface.k1,
        usual.k1,
        darkest(set, least)
    ));
    let hint = "state the surface with [saunderson=K1,K2], or set [specular=excluded] if the instrument measures at 45:0";
    (surface, Some(remark.with_hint(hint)))
}

/// Sample and wavelength at which `set` has the reading `least`, in words.
fn darkest(set: &SwatchSet, least: f64) -> String {
    for swatch in &set.swatches {
        for film in &swatch.films {
            for (readings, kind) in
                [(Some(&film.reflectance), ""), (film.bare.as_ref(), "the bare card under ")]
            {
                let at = readings.and_then(|all| all.iter().position(|&reading| reading == least));
                if let Some(at) = at {
                    return format!("{kind}{} at {} nm", swatch.sample, set.grid.nm(at));
                }
            }
        }
    }
    "a film".to_owned()
}

/// Refuses a set of films with most readings below `k1`. We assume that such a set was read in a wrong
/// unit.
pub(crate) fn check_above_surface(
    set: &SwatchSet,
    k1: f64,
    k2: f64,
) -> Result<(), MeasurementError> {
    let mut below = 0;
    let mut count = 0;
    let mut first = None;
    for swatch in &set.swatches {
        let readings = swatch.films.iter().flat_map(|film| &film.reflectance);
        let dark = readings.filter(|&&reading| reading < k1).count();
        first = first.or_else(|| (dark > 0).then_some(swatch));
        below += dark;
        count += swatch.films.iter().map(|film| film.reflectance.len()).sum::<usize>();
    }
    match first {
        Some(swatch) if 2 * below > count => Err(MeasurementError::MostBelowSurface {
            file: swatch.file.to_string(),
            row: swatch.row,
            sample: swatch.sample.clone(),
            below,
            count,
            k1,
            below_all: format!("{:.3},{k2}", k1_below(least_reading(set))),
        }),
        _ => Ok(()),
    }
}

/// A fit or validation that cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum FittingError {
    /// A sample or pigment is not among the readings.
    #[error("no {what} is called `{name}`")]
    #[hint(verbatim, "{}{what}s: {}", question(name, known), known.join(", "))]
    UnknownName {
        /// `sample` or `pigment`.
        what: &'static str,
        /// Name that was looked up.
        name: String,
        /// Names that exist.
        known: Vec<String>,
    },
    /// Several pigments begin with the name.
    #[error("`{name}` is the beginning of `{first}` and of `{second}`")]
    #[hint("write more of the name")]
    Ambiguous {
        /// Name that was looked up.
        name: String,
        /// First pigment that begins with it.
        first: String,
        /// Second pigment that begins with it.
        second: String,
    },
    /// No pigment can be guessed as the reference.
    #[error("no pigment is called white, so none can be the reference whose S is 1")]
    #[hint("name it: [reference=\"{0}\"]")]
    NoWhite(String),
    /// Every sample is excluded.
    #[error("every sample is excluded")]
    #[hint("leave out some [exclude]")]
    AllExcluded,
    /// Absolute amounts have no reference white, and you cannot choose their method.
    #[error("a fit of absolute amounts has no reference white, and its method is always `refined`")]
    #[hint("leave out [reference] and [method]")]
    #[fault(Setting)]
    AbsoluteOptions,
    /// A validation of absolute amounts cannot be limited to pigments.
    #[error("only a validation of relative amounts can be limited to some pigments")]
    #[hint("leave out [with]")]
    #[fault(Setting)]
    AbsoluteWith,
    /// Films of absolute amounts do not hide, so that they have no residuals for maps.
    #[error("residuals of films that hide need relative amounts")]
    #[hint("leave out [residuals]")]
    #[fault(Setting)]
    AbsoluteResiduals,
    /// A validation needs two groups or more.
    #[error("a validation in groups needs at least 2, found `{0}`")]
    #[hint("try [folds=10]")]
    #[fault(Setting)]
    Folds(usize),
    /// A map needs the errors of mixtures that were left out one by one. You left out something else.
    #[error("residuals for maps are those of mixtures that were left out by themselves")]
    #[hint("leave out [residuals] or [leave_out]")]
    #[fault(Setting)]
    ResidualsOfMixtures,
    /// Only films of absolute amounts lie over grounds that show.
    #[error("films of relative amounts hide their ground, so that no ground can be left out")]
    #[hint("leave out mixtures or samples with [leave_out], or state [amounts=absolute]")]
    #[fault(Setting)]
    RelativeGround,
    /// All samples are in one file.
    #[error("all samples are in one file, {0}, so that no file can be left out")]
    #[hint("give a file for each batch, or leave out mixtures or samples with [leave_out]")]
    OneFile(String),
    /// Nothing can be left out.
    #[error("{}", nothing_to_leave_out(what, needed))]
    #[hint("measure more mixtures of each pigment (masstone, two tints, a shade)")]
    NothingToLeaveOut {
        /// Noun for one of those that should be left out: `mixture`, `sample` or `film`.
        what: &'static str,
        /// Those without which a pigment would not be identified.
        needed: Vec<String>,
    },
    /// The readings have no visible wavelength.
    #[error(transparent)]
    Band(#[from] BandError),
    /// Readings cannot be used.
    #[error(transparent)]
    Measurement(#[from] MeasurementError),
    /// Readings cannot be used, or the fit failed.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
}

fn nothing_to_leave_out(what: &str, needed: &[String]) -> String {
    if needed.is_empty() {
        return format!("there is no {what} to leave out");
    }
    let needed = needed.join(", ");
    format!("no {what} can be left out: without it a pigment would not be identified ({needed})")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pigment_is_found_by_its_unique_beginning_and_without_accents() {
        let names = ["Titanwei\u{df}", "Titan Buff", "Zinkwei\u{df}"].map(str::to_owned);
        let found = |name: &str, what| index_of(&names, name, what);
        assert_eq!(found("Zink", "pigment"), Ok(2));
        assert_eq!(found("titanweiss", "pigment"), Ok(0));
        assert!(matches!(found("Titan", "pigment"), Err(FittingError::Ambiguous { .. })));
        for (name, what) in [("Zink", "sample"), ("", "pigment"), ("Blei", "pigment")] {
            assert!(matches!(found(name, what), Err(FittingError::UnknownName { .. })), "{name}");
        }
    }
    use crate::fitting::{FilmModel, PreparedFit, fit};
    use crate::observation::BelowSurface;
    use crate::readings::Readings;
    use crate::request::ValidationRequest;
    use crate::validation::validate;
    use documents::hint::Explain;
    use pigment::evaluate::delta_e;

    /// Films that hide, of a white and a black paint, read without any surface. We multiply them by
    /// `scale`.
    fn matte(scale: f64) -> Readings {
        let wavelengths: Vec<String> = (0..16).map(|i| (400 + 20 * i).to_string()).collect();
        let mut text = format!("sample,White,Black,{}\n", wavelengths.join(","));
        for (sample, black) in [("w", 0.0), ("a", 0.1), ("b", 0.5), ("c", 0.9), ("d", 1.0)] {
            let k = 0.013 * (1.0 - black) + 20.0 * black;
            let s = 1.0 - 0.5 * black;
            let value = scale * spectra::optics::infinite_film_from_ratio(k / s);
            let values = vec![value.to_string(); wavelengths.len()].join(",");
            text += &format!("{sample},{},{black},{values}\n", 1.0 - black);
        }
        Readings::from_csv("matte.csv", text.as_bytes()).unwrap()
    }

    fn floored() -> FitRequest {
        let below_surface = Some(BelowSurface::Floor);
        FitRequest {
            surface: Some(Surface::of_most_paints(Specular::Included)),
            below_surface,
            ..FitRequest::default()
        }
    }

    #[test]
    fn errors_are_told_against_readings_as_they_were_read() {
        let readings = matte(1.0);
        let options = floored();
        let fitted = fit(&readings, &options).unwrap();
        let library = &fitted.library;
        let weights = options.viewing.weights(library.grid).unwrap();
        for (sample, black) in [("c", 0.9), ("d", 1.0)] {
            let recipe = [("White", 1.0 - black), ("Black", black)];
            let recipe = recipe.map(|(name, share)| (library.find(name).unwrap(), share));
            let predicted = library.mix(recipe).unwrap();
            let read = &readings.table.readings.iter().find(|r| r.sample == sample).unwrap();
            let truth = delta_e(&weights, &read.reflectance, &predicted.hiding(library.saunderson));
            let evidence =
                fitted.evidence().per_sample.iter().find(|s| s.sample == sample).unwrap();
            assert!(truth > 2.0, "the surface reflects more than was read: {truth}");
            assert!(
                (evidence.delta_e - truth).abs() < 1e-3,
                "{sample}: {} for {truth}",
                evidence.delta_e
            );
        }
        let left_out = ValidationRequest { fit: options, ..ValidationRequest::default() };
        let worst = validate(&readings, &left_out).unwrap().errors.delta_e.max;
        assert!(worst > 2.0, "{worst}");
    }

    #[test]
    fn a_k1_that_nobody_stated_stays_below_every_reading() {
        let readings = matte(1.0);
        let fitted = fit(&readings, &FitRequest::default()).unwrap();
        let least = least_reading(&readings.swatches().unwrap());
        assert!(fitted.library.saunderson.k1 < least, "{:?}", fitted.library.saunderson);
        let lowered = fitted.remarks.iter().find(|remark| remark.text.starts_with("k1 = "));
        let lowered = &lowered.unwrap().text;
        assert!(lowered.contains("not 0.03") && lowered.contains("d at 400 nm"), "{lowered}");
        assert!(fitted.evidence().delta_e.max < 1.0, "{:?}", fitted.evidence().delta_e);

        // Readings above the usual k1 keep it, and so does who says how those below are treated.
        let mut lighter = matte(1.0);
        let reflectances = lighter.table.readings.iter_mut().flat_map(|r| &mut r.reflectance);
        reflectances.for_each(|value| *value = value.max(0.04));
        for (readings, below_surface) in [(&lighter, None), (&readings, Some(BelowSurface::Floor))]
        {
            let options = FitRequest { below_surface, ..FitRequest::default() };
            let prepared = PreparedFit::new(readings, &options, &Task::default()).unwrap();
            let FilmModel::Relative { surface, .. } = prepared.model else { panic!("relative") };
            assert_eq!(surface.k1, 0.03);
        }
    }

    #[test]
    fn readings_mostly_below_k1_are_refused_with_a_way_out() {
        let readings = matte(0.01);
        for options in [FitRequest::default(), floored()] {
            let error = fit(&readings, &options).unwrap_err();
            let said = error.to_string();
            assert!(said.contains("matte.csv, row 2") && said.contains("80 of 80"), "{said}");
            let hint = error.hint().unwrap().to_string();
            assert!(hint.contains("fraction") && hint.contains("saunderson"), "{hint}");
        }
    }
}
