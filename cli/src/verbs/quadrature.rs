//! `impasto quadrature`: chooses a few wavelengths and weights that give XYZ.

use std::path::PathBuf;

use calibrate::quadrature::{MixtureSet, Quadrature as Rule};
use clap::{Args, ValueEnum};
use serde_json::json;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::input::{ViewingOptions, color_weights, library};

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum MethodName {
    /// Gaussian nodes of (x + y + z) E, each weight divided among X, Y and Z (Baxter, Wendt and Lin
    /// 2004)
    Gauss,
    /// Nodes of `gauss`, with weights exact for polynomials in each channel
    Moments,
    /// Nodes and weights fitted to mixtures of the library
    Library,
}

/// Choose wavelengths and weights that give XYZ under a light
///
/// With a library, prints the colour error against full integration over random mixtures (films
/// that hide, of one to four pigments) that no method was fitted to.
#[derive(Debug, Args)]
pub(crate) struct Quadrature {
    /// The pigment library (JSON)
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
    /// Print JSON: nodes_nm, weights, error (null without a library)
    #[arg(long)]
    json: bool,
}

impl Quadrature {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let viewing = self.viewing.viewing()?;
        let library = self.library.as_deref().map(library).transpose()?;
        let method = self.method.unwrap_or(match library {
            Some(_) => MethodName::Library,
            None => MethodName::Moments,
        });
        let rule = match (method, &library) {
            (MethodName::Gauss, _) => Rule::gauss(&viewing, self.nodes)?,
            (MethodName::Moments, _) => Rule::moments(&viewing, self.nodes)?,
            (MethodName::Library, Some(library)) => Rule::library(&viewing, library, self.nodes)?,
            (MethodName::Library, None) => {
                return Err(Failure::usage(
                    "--method library needs a pigment library",
                    "try impasto quadrature LIBRARY.json",
                ));
            }
        };
        let error = match &library {
            Some(library) if self.mixtures > 0 => {
                let weights = color_weights(&viewing, library.grid, console)?;
                let mixtures = MixtureSet::random(library, &weights, self.mixtures, self.seed);
                Some(rule.error(&mixtures))
            }
            _ => None,
        };
        if self.json {
            return console.json(&json!({
                "nodes_nm": rule.nodes_nm,
                "weights": rule.weights,
                "error": error,
            }));
        }
        console.line(format!(
            "{} wavelengths for {}, observer {}",
            rule.nodes_nm.len(),
            viewing.illuminant.name(),
            viewing.observer
        ))?;
        console.line("     nm          X          Y          Z")?;
        for (nm, [x, y, z]) in rule.nodes_nm.iter().zip(&rule.weights) {
            console.line(format!("{nm:7.2} {x:10.4} {y:10.4} {z:10.4}"))?;
        }
        if let Some(error) = error {
            console.line(format!(
                "CIEDE2000 over {} random mixtures (seed {}): mean {:.3}, 95 % below {:.3}, largest {:.3}",
                self.mixtures, self.seed, error.mean, error.p95, error.max
            ))?;
        }
        Ok(())
    }
}
