//! JSON of `fit` and `validate`.

use calibrate::evaluate::Summary;
use calibrate::library::{Evidence, SampleEvidence};
use calibrate::{Fit, shares_of_squares};
use serde_json::{Value, json};

/// Returns the JSON object of `fit` and `validate`, with `seconds` rounded to 1 ms. Shares of the sum of
/// squared colour errors come with the greatest first.
pub(super) fn to_json(
    pigments: usize,
    rms: f64,
    delta_e: &Summary,
    per_sample: &[SampleEvidence],
    warnings: &[String],
    seconds: f64,
) -> Value {
    let entry = |(sample, share): (&str, f64)| json!({ "sample": sample, "share": share });
    let shares: Vec<Value> = shares_of_squares(per_sample).into_iter().map(entry).collect();
    json!({
        "samples": per_sample.len(),
        "pigments": pigments,
        "rms": rms,
        "delta_e": delta_e,
        "per_sample": per_sample,
        "shares_of_squares": shares,
        "warnings": warnings,
        "seconds": (seconds * 1e3).round() / 1e3,
    })
}

/// Samples with their colour errors, one row each.
pub(super) fn rows(per_sample: &[SampleEvidence]) -> Vec<Value> {
    let row = |s: &SampleEvidence| json!({"sample": s.sample, "ciede2000": s.delta_e});
    per_sample.iter().map(row).collect()
}

/// Returns the JSON of the errors of a fit that took `seconds`.
pub(super) fn fit_json(fit: &Fit, seconds: f64) -> Value {
    let Evidence { rms, delta_e, per_sample, warnings, .. } = fit.evidence();
    to_json(fit.library.pigments.len(), *rms, delta_e, per_sample, warnings, seconds)
}
