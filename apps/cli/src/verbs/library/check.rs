//! `impasto library check`: checks a library for faults and doubtful pigments.

use std::path::PathBuf;

use calibrate::curation::{Health, PigmentHealth, Severity, health};
use calibrate::library::{PigmentLibrary, SampleEvidence};
use clap::Args;
use serde_json::{Value, json};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::input::ViewingOptions;
use crate::library_choice::chosen;

/// Number of worst samples that are printed; chosen by eye.
const WORST: usize = 3;

/// Check a library for faults and doubtful pigments
///
/// Prints each pigment's K and S with their median uncertainty, and warns of an unsuitable grid,
/// guessed or unidentified pigments, large deviations, curves that jump over wavelength, masstones
/// as dark as the surface, pigments that look alike, and a missing licence or source. A file that is
/// not a library, and a library with faults, end with exit status 1.
#[derive(Debug, Args)]
pub(super) struct Check {
    /// The pigment library (JSON) [default: that of IMPASTO_LIBRARY, else
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
        let viewing = self.viewing.viewing()?;
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
    let findings = |severity: Severity| -> Vec<Value> {
        let findings = health.findings.iter().filter(|finding| finding.severity == severity);
        findings
            .map(|finding| json!({ "pigment": finding.pigment, "what": finding.what }))
            .collect()
    };
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
        "faults": findings(Severity::Fault),
        "warnings": findings(Severity::Warning),
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
    let width = health.pigments.iter().map(|p| p.name.chars().count()).max().unwrap_or(0).max(7);
    console.line(format!("{:width$}  {:>17}  +- %  {:>17}  +- %  L*", "pigment", "K", "S"))?;
    for pigment in &health.pigments {
        let PigmentHealth { name, absorption, scattering, masstone, .. } = pigment;
        let range = |[low, high]: [f64; 2]| format!("{low:.3} to {high:.3}");
        let share = |share: Option<f64>| {
            share.map_or_else(|| "-".to_owned(), |share| format!("{:.0}", 100.0 * share))
        };
        console.line(format!(
            "{name:width$}  {:>17}  {:>4}  {:>17}  {:>4}  {:2.0}",
            range(*absorption),
            share(pigment.absorption_uncertainty),
            range(*scattering),
            share(pigment.scattering_uncertainty),
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
