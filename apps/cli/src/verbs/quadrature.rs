//! `impasto quadrature`: chooses a few wavelengths and weights that give XYZ.

use std::path::PathBuf;

use calibrate::evaluate::Viewing;
use calibrate::library::PigmentLibrary;
use calibrate::quadrature::{
    EffectiveQuadrature, FilmSet, MixtureSet, Quadrature as Rule, QuadratureError,
};
use clap::{Args, ValueEnum};
use documents::Task;
use serde_json::{Value, json};
use spectra::TristimulusWeights;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::library_choice::named_or_default;
use crate::progress::waited;
use crate::readings::{ViewingOptions, color_weights};

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum MethodName {
    /// Gaussian nodes of (x + y + z) E, each weight divided among X, Y and Z (Baxter, Wendt and Lin
    /// 2004)
    Gauss,
    /// Nodes of `gauss`, with weights exact for polynomials in each channel
    Moments,
    /// Nodes and weights fitted to mixtures of the library
    Library,
    /// Nodes, weights, and K and S of every pigment at the nodes fitted to films of the library: what
    /// painting computes with
    Effective,
}

/// Choose wavelengths and weights that give XYZ under a light
///
/// With a library, prints the colour error against full integration over random mixtures (films
/// that hide, of one to four pigments) that no method was fitted to; for `effective` also over thin films on
/// coloured grounds.
#[derive(Debug, Args)]
pub(crate) struct Quadrature {
    /// The pigment library (JSON) [default: that of IMPASTO_LIBRARY, else none]
    library: Option<PathBuf>,
    /// Method of choosing them [default: library where one is given, else moments]
    #[arg(long, value_enum)]
    method: Option<MethodName>,
    /// Number of wavelengths, 1 to 32
    #[arg(short = 'n', long, value_name = "N", default_value_t = 8)]
    nodes: usize,
    /// Seed of the random mixtures
    #[arg(long, default_value_t = 1, allow_hyphen_values = true)]
    seed: u64,
    /// Number of random mixtures
    #[arg(long, value_name = "N", default_value_t = 1000)]
    mixtures: usize,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: nodes_nm, weights, error (null without a library); for `effective` also pigments (name,
    /// absorption, scattering at the nodes) and error_over_grounds
    #[arg(long)]
    json: bool,
    /// Print the wavelengths and weights as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

/// One mixture and several, in figures.
const MIXTURES: [&str; 2] = ["random mixture", "random mixtures"];
/// One film over a ground and several, in figures.
const FILMS: [&str; 2] = ["film over a random ground", "films over random grounds"];

impl Quadrature {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let viewing = self.viewing.viewing()?;
        let library = named_or_default(self.library.as_deref())?.map(|(_, library)| library);
        let method = self.method.unwrap_or(match library {
            Some(_) => MethodName::Library,
            None => MethodName::Moments,
        });
        if method == MethodName::Effective
            && let Some(library) = &library
        {
            return self.effective(&viewing, library, console);
        }
        let rule = match (method, &library) {
            (MethodName::Gauss, _) => Rule::gauss(&viewing, self.nodes)?,
            (MethodName::Moments, _) => Rule::moments(&viewing, self.nodes)?,
            (MethodName::Library, Some(library)) => waited("fitting wavelengths", console, || {
                Rule::library(&viewing, library, self.nodes)
            })?,
            (MethodName::Library | MethodName::Effective, _) => {
                return Err(Failure::usage(
                    "--method library and --method effective need a pigment library",
                    "try impasto quadrature LIBRARY.json",
                ));
            }
        };
        let error = match &library {
            Some(library) if self.mixtures > 0 => {
                let weights = color_weights(&viewing, library.grid, console)?;
                Some(waited("comparing mixtures", console, || {
                    let count = self.mixtures;
                    let seed = self.seed;
                    rule.error(&MixtureSet::random(library, &weights, count, seed))
                }))
            }
            _ => None,
        };
        if self.csv {
            return console.csv_rows(&csv_rows(&rule));
        }
        if self.json {
            return console.json(&rule.to_json(error));
        }
        rows(&rule, &viewing, console)?;
        match error {
            Some(error) => console.line(self.told(MIXTURES, &error)),
            None => Ok(()),
        }
    }

    /// The method `effective`.
    fn effective(
        &self,
        viewing: &Viewing,
        library: &PigmentLibrary,
        console: &mut Console<'_>,
    ) -> Result<()> {
        let effective = waited("fitting wavelengths", console, || {
            EffectiveQuadrature::of(viewing, library, self.nodes, &Task::default())
        })?;
        let weights = color_weights(viewing, library.grid, console)?;
        let draw = |films: fn(&PigmentLibrary, &TristimulusWeights, usize, u64) -> FilmSet| {
            let count = self.mixtures;
            (count > 0)
                .then(|| effective.error(library, &films(library, &weights, count, self.seed)))
        };
        let drawn = || (draw(FilmSet::hiding), draw(FilmSet::over_grounds));
        let (hiding, over) = waited("comparing films", console, drawn);
        if self.csv {
            return console.csv_rows(&csv_rows(&effective.rule));
        }
        if self.json {
            return console.json(&effective.to_json(library, [hiding, over]));
        }
        rows(&effective.rule, viewing, console)?;
        for (error, of) in [(hiding, MIXTURES), (over, FILMS)] {
            if let Some(error) = error {
                console.line(self.told(of, &error))?;
            }
        }
        Ok(())
    }

    fn told(&self, [one, many]: [&str; 2], error: &QuadratureError) -> String {
        let films = documents::counted_as(self.mixtures, one, many);
        let seed = self.seed;
        let QuadratureError { mean, p95, max } = error;
        format!(
            "CIEDE2000 over {films} (seed {seed}): mean {mean:.3}, 95 % below {p95:.3}, largest {max:.3}"
        )
    }
}

/// The wavelengths with their weights, one row each.
fn csv_rows(rule: &Rule) -> Vec<Value> {
    let pairs = rule.nodes_nm.iter().zip(&rule.weights);
    pairs.map(|(nm, weights)| json!({"nm": nm, "weights": weights})).collect()
}

/// Prints the wavelengths with their weights.
fn rows(rule: &Rule, viewing: &Viewing, console: &mut Console<'_>) -> Result<()> {
    let count = rule.nodes_nm.len();
    let light = viewing.illuminant.name();
    console.line(format!(
        "{} for {light}, observer {}",
        documents::counted(count, "wavelength"),
        viewing.observer
    ))?;
    console.line("     nm          X          Y          Z")?;
    for (nm, [x, y, z]) in rule.nodes_nm.iter().zip(&rule.weights) {
        console.line(format!("{nm:7.2} {x:10.4} {y:10.4} {z:10.4}"))?;
    }
    Ok(())
}
