//! `impasto library check` checks a library for faults and doubtful pigments, and `impasto library
//! diff` compares two libraries in colour.

use std::path::PathBuf;

use calibrate::curation::{Difference, Health, PigmentHealth, Severity, difference, health};
use calibrate::evaluate::Viewing;
use calibrate::library::{PigmentLibrary, SampleEvidence};
use clap::Args;
use serde_json::{Value, json};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::library_choice::chosen;
use crate::readings::{ViewingOptions, library, remark_coverage, viewing};

/// Number of worst samples that we print, chosen by eye.
const WORST: usize = 3;

/// Check a library for faults and doubtful pigments
///
/// Prints each pigment's K and S with their median uncertainty, and warns of an unsuitable grid,
/// guessed or unidentified pigments, large deviations, curves that jump over wavelength, masstones
/// as dark as the surface, pigments that look alike, and of what is not stated: licence, source,
/// measurement files, and the geometry of the instrument. A file that is not a library, and a library
/// with faults, end with exit status 1.
#[derive(Debug, Args)]
pub(super) struct Check {
    /// The pigment library (JSON) [default: the one in IMPASTO_LIBRARY, else
    /// the Van Gogh oils that ship]
    library: Option<PathBuf>,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: pigments, faults, warnings, evidence
    #[arg(long)]
    json: bool,
    /// Print the pigments as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Check {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let viewing = self.viewing.viewing(console)?;
        let chosen = chosen(self.library.as_deref(), console)?;
        let library = &chosen.library;
        let health = health(library, &viewing);
        if self.csv {
            let whole = as_json(library, &health);
            console.csv_rows(whole["pigments"].as_array().map_or(&[], Vec::as_slice))?;
            for finding in &health.findings {
                let name =
                    finding.pigment.as_ref().map_or_else(String::new, |name| name.clone() + ": ");
                console.remark(format!("{name}{}", finding.what))?;
            }
        } else if self.json {
            console.json(&as_json(library, &health))?;
        } else {
            print(library, &health, console)?;
        }
        if health.faulty() {
            return Err(Failure::data(
                format!("{}: the library is faulty", chosen.name()),
                "see its faults above; fit again, or correct the file",
            ));
        }
        Ok(())
    }
}

/// The samples with the largest colour errors, largest first.
fn worst(library: &PigmentLibrary) -> Vec<&SampleEvidence> {
    let mut samples: Vec<_> = library.evidence.iter().flat_map(|e| &e.per_sample).collect();
    samples.sort_by(|a, b| b.delta_e.total_cmp(&a.delta_e));
    samples.truncate(WORST);
    samples
}

fn as_json(library: &PigmentLibrary, health: &Health) -> Value {
    let [faults, warnings] = [Severity::Fault, Severity::Warning].map(|severity| {
        let findings = health.findings.iter().filter(|finding| finding.severity == severity);
        findings
            .map(|finding| json!({ "pigment": finding.pigment, "what": finding.what }))
            .collect::<Vec<Value>>()
    });
    let pigments = health.pigments.iter().zip(&library.pigments).map(|(health, pigment)| {
        json!({
            "name": health.name,
            "identified": pigment.identified,
            "guessed": pigment.guessed,
            "absorption": health.absorption,
            "scattering": health.scattering,
            "absorption_uncertainty": health.absorption_uncertainty,
            "scattering_uncertainty": health.scattering_uncertainty,
            "lab": health.masstone.to_array(),
        })
    });
    json!({
        "pigments": pigments.collect::<Vec<_>>(),
        "faults": faults,
        "warnings": warnings,
        "evidence": library.evidence.as_ref().map(|evidence| json!({
            "rms": evidence.rms,
            "delta_e": evidence.delta_e,
            "samples": evidence.per_sample.len(),
            "worst": worst(library),
        })),
    })
}

fn print(library: &PigmentLibrary, health: &Health, console: &mut Console<'_>) -> Result<()> {
    console.line(format!(
        "{}, {}",
        documents::counted(library.pigments.len(), "pigment"),
        library.grid
    ))?;
    if let Some(evidence) = &library.evidence {
        console.line(format!(
            "colour error of the fit: mean {:.2}, 90 % below {:.2}, largest {:.2}; rms {:.4}",
            evidence.delta_e.mean, evidence.delta_e.p90, evidence.delta_e.max, evidence.rms
        ))?;
        let worst = worst(library);
        if !worst.is_empty() {
            let samples = worst.iter().map(|s| format!("{} ({:.2})", s.sample, s.delta_e));
            console.line(format!("worst samples: {}", samples.collect::<Vec<_>>().join(", ")))?;
        }
    }
    let width = documents::column_width(health.pigments.iter().map(|p| &p.name), 7);
    console.line(format!("{:width$}  {:>17}  +- %  {:>17}  +- %  L*", "pigment", "K", "S"))?;
    for pigment in &health.pigments {
        let PigmentHealth { name, absorption, scattering, masstone, .. } = pigment;
        let [k, s] = [absorption, scattering].map(|[low, high]| match *high < 1e6 {
            true => format!("{low:.3} to {high:.3}"),
            false => format!("{low:.2e} to {high:.2e}"),
        });
        let shares = [pigment.absorption_uncertainty, pigment.scattering_uncertainty];
        let [k_sd, s_sd] = shares.map(|share| {
            share.map_or_else(|| "-".to_owned(), |share| format!("{:.0}", 100.0 * share))
        });
        console.line(format!(
            "{name:width$}  {k:>17}  {k_sd:>4}  {s:>17}  {s_sd:>4}  {:2.0}",
            masstone.lightness
        ))?;
    }
    for finding in &health.findings {
        let label = match finding.severity {
            Severity::Fault => "fault",
            Severity::Warning => "warning",
        };
        let pigment = finding.pigment.as_ref().map_or_else(String::new, |name| format!("{name}: "));
        console.line(format!("{label}: {pigment}{}", finding.what))?;
    }
    if health.findings.is_empty() {
        console.line("no faults or warnings")?;
    }
    Ok(())
}

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
            .map(|light| viewing(light, &self.observer, console))
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
                print_differences(viewing, found, console)?;
            }
            for (path, names) in
                [(&self.first, &found[0].only_first), (&self.second, &found[0].only_second)]
            {
                if !names.is_empty() {
                    console.line(format!("only in {}: {}", path.display(), names.join(", ")))?;
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
        let lights = lights.iter().zip(found).map(|(viewing, found)| {
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
        });
        json!({
            "lights": lights.collect::<Vec<_>>(),
            "white": found[0].white,
            "only_first": found[0].only_first,
            "only_second": found[0].only_second,
            "tolerance": self.tolerance,
            "passed": largest <= self.tolerance,
        })
    }
}

fn print_differences(
    viewing: &Viewing,
    found: &Difference,
    console: &mut Console<'_>,
) -> Result<()> {
    console.line(format!("{}, observer {}", viewing.illuminant.name(), viewing.observer))?;
    let width = documents::column_width(found.pigments.iter().map(|p| &p.name), 7);
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
