//! `impasto library diff`: compares two libraries in colour.

use std::path::PathBuf;

use calibrate::curation::{Difference, difference};
use calibrate::evaluate::Viewing;
use clap::Args;
use serde_json::{Value, json};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::input::{library, remark_coverage, viewing};

/// Compare two libraries of the same pigments, in CIEDE2000
///
/// Compares the masstone and the tint (1:9 in the first's reference white) of each pigment that
/// both have, and mixtures of two of them with that white, 1:1:1. Each library is evaluated on its
/// own wavelengths and with its own surface. Exit status 1 if anything differs by more than the
/// tolerance under any light.
#[derive(Debug, Args)]
pub(super) struct Diff {
    /// A pigment library (JSON)
    first: PathBuf,
    /// The library to compare it with (JSON)
    second: PathBuf,
    /// Largest difference that passes
    #[arg(long, value_name = "CIEDE2000", default_value_t = 1.0)]
    tolerance: f64,
    /// Light (may be repeated): a CIE illuminant, 5600K, D5600K, or the file of a lamp
    #[arg(long, value_name = "LIGHT", default_value = "D65")]
    illuminant: Vec<String>,
    /// Observer: 1931-2 (or 2), 1964-10 (or 10), 2015-2, 2015-10
    #[arg(long, value_name = "NAME", default_value = "1931-2")]
    observer: String,
    /// Maximum number of mixtures of two pigments to compare
    #[arg(long, value_name = "COUNT", default_value_t = 100)]
    pairs: usize,
    /// Seed of the random choice of mixtures
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print JSON: lights, each with pigments, pairs, largest; and pigments that only one has
    #[arg(long)]
    json: bool,
    /// Print the pigments as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Diff {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        if !(self.tolerance.is_finite() && self.tolerance >= 0.0) {
            return Err(Failure::usage(
                format!("--tolerance takes a number not below 0, found `{}`", self.tolerance),
                "try --tolerance 1",
            ));
        }
        let lights = self
            .illuminant
            .iter()
            .map(|light| viewing(light, &self.observer))
            .collect::<Result<Vec<Viewing>>>()?;
        let first = library(&self.first)?;
        let second = library(&self.second)?;
        for library in [&first, &second] {
            remark_coverage(library.grid, console)?;
        }
        let found: Vec<Difference> = lights
            .iter()
            .map(|viewing| difference(&first, &second, viewing, self.pairs, self.seed))
            .collect();
        if found[0].pigments.is_empty() {
            return Err(Failure::data(
                "the two libraries have no pigment in common",
                "rename them first: impasto library rename",
            ));
        }
        let largest = found.iter().map(Difference::largest).fold(0.0, f64::max);
        if self.csv {
            let rows = lights.iter().zip(&found).flat_map(|(viewing, found)| {
                found.pigments.iter().map(|pigment| {
                    json!({
                        "illuminant": viewing.illuminant.name(),
                        "pigment": pigment.name,
                        "masstone": pigment.masstone,
                        "tint": pigment.tint,
                    })
                })
            });
            console.csv_rows(&rows.collect::<Vec<_>>())?;
        } else if self.json {
            console.json(&self.as_json(&lights, &found, largest))?;
        } else {
            for (viewing, found) in lights.iter().zip(&found) {
                print(viewing, found, console)?;
            }
            let only = |path: &PathBuf, names: &[String]| {
                format!("only in {}: {}", path.display(), names.join(", "))
            };
            for (path, names) in
                [(&self.first, &found[0].only_first), (&self.second, &found[0].only_second)]
            {
                if !names.is_empty() {
                    console.line(only(path, names))?;
                }
            }
        }
        if largest > self.tolerance {
            return Err(Failure::data(
                format!(
                    "the libraries differ by up to {largest:.2} CIEDE2000; the tolerance is `{}`",
                    self.tolerance
                ),
                "see the list above",
            ));
        }
        Ok(())
    }

    fn as_json(&self, lights: &[Viewing], found: &[Difference], largest: f64) -> Value {
        let of_light = |(viewing, found): (&Viewing, &Difference)| {
            let pigments = found
                .pigments
                .iter()
                .map(|p| json!({ "name": p.name, "masstone": p.masstone, "tint": p.tint }));
            let pairs =
                found.pairs.iter().map(|p| json!({ "names": p.names, "ciede2000": p.delta_e }));
            json!({
                "illuminant": viewing.illuminant.name(),
                "observer": viewing.observer.name(),
                "pigments": pigments.collect::<Vec<_>>(),
                "pairs": pairs.collect::<Vec<_>>(),
                "largest": found.largest(),
            })
        };
        json!({
            "lights": lights.iter().zip(found).map(of_light).collect::<Vec<_>>(),
            "white": found[0].white,
            "only_first": found[0].only_first,
            "only_second": found[0].only_second,
            "tolerance": self.tolerance,
            "passed": largest <= self.tolerance,
        })
    }
}

fn print(viewing: &Viewing, found: &Difference, console: &mut Console<'_>) -> Result<()> {
    console.line(format!("{}, observer {}", viewing.illuminant.name(), viewing.observer))?;
    let width = found.pigments.iter().map(|p| p.name.chars().count()).max().unwrap_or(0).max(7);
    console.line(format!("{:width$}  masstone  tint 1:9", "pigment"))?;
    for pigment in &found.pigments {
        let tint = pigment.tint.map_or_else(|| "-".to_owned(), |v| format!("{v:.2}"));
        console.line(format!("{:width$}  {:8.2}  {tint:>8}", pigment.name, pigment.masstone))?;
    }
    let mut pairs: Vec<_> = found.pairs.iter().collect();
    pairs.sort_by(|a, b| b.delta_e.total_cmp(&a.delta_e));
    if let Some(worst) = pairs.first() {
        let mean = pairs.iter().map(|p| p.delta_e).sum::<f64>() / pairs.len() as f64;
        let [a, b] = &worst.names;
        let white = found.white.as_ref().map_or_else(String::new, |w| format!(" with {w}"));
        console.line(format!(
            "{} of two{white}: mean {mean:.2}, largest {:.2} ({a} and {b})",
            documents::counted(pairs.len(), "mixture"),
            worst.delta_e
        ))?;
    }
    Ok(())
}
