//! The options of `fit` and `validate`: what is measured, and how it is fitted.

use std::path::PathBuf;

use calibrate::PigmentId;
use calibrate::absolute::{CHOICE_FITS, calibrate_absolute, chosen_film, films};
use calibrate::calibration::{Calibration, calibrate};
use calibrate::evaluate::Viewing;
use calibrate::fit::{FitSettings, Method, Smoothness};
use calibrate::library::Input;
use calibrate::observation::BelowSurface;
use calibrate::swatch::SwatchSet;
use clap::{Args, ValueEnum};
use spectra::optics::{Surface, UnevenFilm};

use crate::console::Console;
use crate::failure::Refusal;
use crate::input::{named, remark_coverage};
use crate::progress::Progress;
use crate::readings::{ReadingOptions, measurements};
use crate::surface::SurfaceOptions;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum MethodName {
    /// The published quadratic program, unweighted (Baxter, Wendt and Lin 2004)
    Qp,
    /// The program, its rows weighted into errors of reflectance
    Weighted,
    /// Nonlinear refinement in measured reflectance, robust, from `weighted`
    Refined,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Amounts {
    /// Shares of a mixture; films that hide, or read over two backings
    Relative,
    /// Amounts (mL, g) laid on a fixed area of a known backing
    Absolute,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Below {
    /// An error that names sample and wavelength
    Refuse,
    /// Read as black
    Floor,
}

/// What is measured, and how it is fitted.
#[derive(Debug, Args)]
pub(super) struct CalibrationOptions {
    /// Measurement files: CSV (columns sample, film, backing, one per pigment, then wavelengths), or
    /// an instrument's files with --recipes
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Recipes of samples whose files tell none (CSV): columns sample, one per pigment
    ///
    /// Joined to the readings by name. Further columns: film, backing, thickness_mm as in the
    /// measurement CSV, and `reading`, the name in the measurement file, where one sample was read
    /// several times (over white, over black, bare).
    #[arg(long, value_name = "FILE")]
    recipes: Option<PathBuf>,
    /// What is minimised
    #[arg(long, value_enum, default_value = "refined")]
    method: MethodName,
    /// What the amounts mean
    #[arg(long, value_enum, default_value = "relative")]
    amounts: Amounts,
    /// The white whose S is 1 [default: the pigment called white that occurs in most samples]
    #[arg(long, value_name = "PIGMENT")]
    reference: Option<String>,
    #[command(flatten)]
    surface: SurfaceOptions,
    /// What to do with a reading below k1 [default: refuse where --saunderson is given, else floor]
    #[arg(long, value_enum)]
    below_surface: Option<Below>,
    /// Smoothness of K and S over wavelength: auto, none, or a weight such as 10
    #[arg(long, value_name = "WEIGHT", default_value = "auto", allow_hyphen_values = true)]
    smoothness: String,
    /// Unevenness of films of absolute amounts: auto, or the deviation of log thickness (0.25)
    #[arg(long, value_name = "DEVIATION", default_value = "auto", allow_hyphen_values = true)]
    unevenness: String,
    /// A sample to leave out (may be repeated)
    #[arg(long, value_name = "SAMPLE")]
    exclude: Vec<String>,
    #[command(flatten)]
    reading: ReadingOptions,
}

/// A calibration to be: readings, and how to fit them.
pub(super) struct Job {
    pub(super) set: SwatchSet,
    pub(super) inputs: Vec<Input>,
    pub(super) settings: FitSettings,
    pub(super) kind: Kind,
}

/// What the amounts mean, with what only that kind needs.
pub(super) enum Kind {
    /// The reference white's index, and the surface.
    Relative(PigmentId, Surface),
    Absolute(UnevenFilm),
}

impl CalibrationOptions {
    /// The files that are read.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        self.files.iter().chain(&self.recipes).cloned().chain(self.reading.files()).collect()
    }

    /// Reads the files and settles every option.
    pub(super) fn job(&self, console: &mut Console<'_>) -> anyhow::Result<Job> {
        let surface = self.surface.surface()?;
        let smoothness = self.smoothness()?;
        let unevenness = self.unevenness()?;
        let recipes = self.recipes.as_deref();
        let (table, inputs) = measurements(&self.files, recipes, &self.reading, console)?;
        remark_coverage(table.grid, console)?;
        let set = self.without_excluded(SwatchSet::from_table(&table)?)?;
        let below_surface = match (self.below_surface, surface) {
            (Some(Below::Refuse), _) | (None, Some(_)) => BelowSurface::Refuse,
            (Some(Below::Floor), _) | (None, None) => BelowSurface::Floor,
        };
        let method = match self.method {
            MethodName::Qp => Method::Qp,
            MethodName::Weighted => Method::Weighted,
            MethodName::Refined => Method::Refined,
        };
        let excluded = self.exclude.clone();
        let settings = FitSettings { method, smoothness, below_surface, excluded };
        let kind = match self.amounts {
            Amounts::Relative => {
                let reference = self.reference(&set)?;
                console.remark(format!("reference white: {}", set.pigments[reference.index()]))?;
                Kind::Relative(reference, self.surface.surface_or_usual()?)
            }
            Amounts::Absolute => {
                if self.reference.is_some() || method != Method::Refined {
                    return Err(Refusal::usage(
                        "absolute amounts take neither a reference white nor another method",
                        "leave out --reference and --method",
                    ));
                }
                Kind::Absolute(self.film(&set, surface, unevenness, console)?)
            }
        };
        Ok(Job { set, inputs, settings, kind })
    }

    fn smoothness(&self) -> anyhow::Result<Smoothness> {
        Ok(match self.smoothness.as_str() {
            "auto" => Smoothness::Auto,
            "none" => Smoothness::None,
            text => Smoothness::Fixed(at_least_zero("--smoothness", text)?),
        })
    }

    fn unevenness(&self) -> anyhow::Result<Option<f64>> {
        Ok(match self.unevenness.as_str() {
            "auto" => None,
            text => Some(at_least_zero("--unevenness", text)?),
        })
    }

    fn without_excluded(&self, set: SwatchSet) -> anyhow::Result<SwatchSet> {
        if self.exclude.is_empty() {
            return Ok(set);
        }
        let samples: Vec<String> = set.swatches.iter().map(|s| s.sample.clone()).collect();
        let excluded = self
            .exclude
            .iter()
            .map(|name| Ok(&samples[named(&samples, name, "sample")?]))
            .collect::<anyhow::Result<Vec<_>>>()?;
        if excluded.len() >= samples.len() {
            return Err(Refusal::data("every sample is excluded", "leave out some --exclude"));
        }
        Ok(set.retaining(|swatch| !excluded.contains(&&swatch.sample)))
    }

    fn reference(&self, set: &SwatchSet) -> anyhow::Result<PigmentId> {
        if let Some(name) = &self.reference {
            return named(&set.pigments, name, "pigment").map(PigmentId);
        }
        let samples = |index: usize| set.swatches.iter().filter(|s| s.amounts[index] > 0.0).count();
        let called_white = |&index: &usize| set.pigments[index].to_lowercase().contains("white");
        let commonest = |indices: Vec<usize>| {
            // The first of equals, so that the order of columns decides.
            indices.into_iter().rev().max_by_key(|&index| samples(index))
        };
        commonest((0..set.pigments.len()).filter(called_white).collect()).map(PigmentId).ok_or_else(
            || {
                Refusal::data(
                    "no pigment is called white, so none can be the reference whose S is 1",
                    format!("name it: --reference \"{}\"", set.pigments.first().map_or("", |p| p)),
                )
            },
        )
    }

    fn film(
        &self,
        set: &SwatchSet,
        surface: Option<Surface>,
        unevenness: Option<f64>,
        console: &mut Console<'_>,
    ) -> anyhow::Result<UnevenFilm> {
        let plain = Surface { k1: 0.0, k2: 0.0, specular: self.surface.specular() };
        if surface.is_some() || unevenness.is_some() {
            return Ok(UnevenFilm {
                surface: surface.unwrap_or(plain),
                unevenness: unevenness.unwrap_or(0.0),
            });
        }
        let problem = films(set)?;
        let progress =
            Progress::new(CHOICE_FITS, "choosing the film model", console.screen.progress);
        let film = chosen_film(&problem, plain, &|| progress.step())?;
        progress.done();
        console.remark(format!(
            "film model by cross-validation: k2 = {}, unevenness {}",
            film.surface.k2, film.unevenness
        ))?;
        Ok(film)
    }
}

impl Job {
    /// Fits, and signs the library with what it was made from.
    pub(super) fn calibrate(&self, viewing: &Viewing) -> anyhow::Result<Calibration> {
        let mut calibration = match self.kind {
            Kind::Relative(reference, surface) => {
                calibrate(&self.set, reference, surface, &self.settings, viewing)?
            }
            Kind::Absolute(film) => calibrate_absolute(&self.set, film, &self.settings, viewing)?,
        };
        calibration.library.inputs = self.inputs.clone();
        Ok(calibration)
    }
}

fn at_least_zero(option: &str, text: &str) -> anyhow::Result<f64> {
    text.parse().ok().filter(|v: &f64| v.is_finite() && *v >= 0.0).ok_or_else(|| {
        Refusal::usage(
            format!("{option} takes a word or a number of 0 and up, found `{text}`"),
            format!("try {option} auto"),
        )
    })
}
