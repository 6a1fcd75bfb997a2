//! A fit in words and as JSON.

use calibrate::calibration::Calibration;
use calibrate::evaluate::Summary;
use calibrate::library::{Evidence, PigmentLibrary, SampleEvidence};
use serde_json::{Value, json};

use crate::console::Console;

/// The keys that `fit` and `validate` share.
pub(super) fn to_json(
    pigments: usize,
    rms: f64,
    delta_e: &Summary,
    per_sample: &[SampleEvidence],
    warnings: &[String],
    seconds: f64,
) -> Value {
    json!({
        "samples": per_sample.len(),
        "pigments": pigments,
        "rms": rms,
        "delta_e": delta_e,
        "per_sample": per_sample,
        "warnings": warnings,
        "seconds": (seconds * 1e3).round() / 1e3,
    })
}

/// [`to_json`] of a library's own evidence.
pub(super) fn library_json(library: &PigmentLibrary, evidence: &Evidence, seconds: f64) -> Value {
    let Evidence { rms, delta_e, per_sample, warnings, .. } = evidence;
    to_json(library.pigments.len(), *rms, delta_e, per_sample, warnings, seconds)
}

/// How the films hid, how far repeated readings spread, and how well the
/// mixtures determine the unknowns.
pub(super) fn remark_films(
    calibration: &Calibration,
    console: &mut Console<'_>,
) -> anyhow::Result<()> {
    let films = &calibration.observations;
    let open = films.iter().filter(|o| o.hiding.hides() == Some(false)).count();
    if open > 0 {
        console.remark(format!(
            "{open} of {} films let their backing through; their K/S comes from the two backings",
            films.len()
        ))?;
    }
    let spreads = || films.iter().filter_map(|o| Some((o.spread?, &o.sample)));
    if let Some((largest, sample)) = spreads().max_by(|a, b| a.0.total_cmp(&b.0)) {
        console.remark(format!(
            "repeated readings of {} samples averaged; they spread by {largest:.4} at most ({sample})",
            spreads().count()
        ))?;
    }
    if let Some(c) = &calibration.condition {
        console.remark(format!(
            "rank {} of {} unknowns a wavelength; condition {:.0} at worst, at {} nm",
            c.rank, c.unknowns, c.number, c.nm
        ))?;
    }
    Ok(())
}

/// The errors of a fit: a summary, then the samples, worst first.
pub(super) fn print(
    library: &PigmentLibrary,
    evidence: &Evidence,
    shown: usize,
    console: &mut Console<'_>,
) -> anyhow::Result<()> {
    console.line(format!(
        "{} pigments from {} samples, {}",
        library.pigments.len(),
        evidence.per_sample.len(),
        library.grid
    ))?;
    print_errors(&evidence.delta_e, evidence.rms, console)?;
    console.line(format!(
        "(CIEDE2000 under {}, observer {}; rms of reflectance)",
        evidence.illuminant, evidence.observer
    ))?;
    print_samples(&evidence.per_sample, shown, console)
}

pub(super) fn print_errors(
    delta_e: &Summary,
    rms: f64,
    console: &mut Console<'_>,
) -> anyhow::Result<()> {
    let Summary { mean, median, p90, max } = delta_e;
    console.line(format!(
        "colour error: mean {mean:.2}, median {median:.2}, 90 % below {p90:.2}, largest {max:.2}; rms {rms:.4}"
    ))
}

/// Samples in columns, worst first; `shown` of them.
pub(super) fn print_samples(
    samples: &[SampleEvidence],
    shown: usize,
    console: &mut Console<'_>,
) -> anyhow::Result<()> {
    let mut sorted: Vec<&SampleEvidence> = samples.iter().collect();
    sorted.sort_by(|a, b| b.delta_e.total_cmp(&a.delta_e));
    let width = sorted.iter().map(|s| s.sample.chars().count()).max().unwrap_or(0);
    let cells: Vec<String> = sorted
        .iter()
        .take(shown)
        .map(|s| format!("{:width$} {:5.2}", s.sample, s.delta_e))
        .collect();
    let columns = (96 / (width + 9)).clamp(1, 8);
    let rows = cells.len().div_ceil(columns);
    for row in 0..rows {
        let line: Vec<&str> = cells.iter().skip(row).step_by(rows).map(String::as_str).collect();
        console.line(format!("  {}", line.join("   ")))?;
    }
    let rest = samples.len() - cells.len();
    if rest > 0 {
        console.line(format!("  and {rest} samples with less"))?;
    }
    Ok(())
}
