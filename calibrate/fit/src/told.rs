//! Errors of a fit or a validation as JSON for programs.

use pigment::evaluate::Summary;
use pigment::library::{Evidence, SampleEvidence};
use serde_json::{Map, Value, json};

use crate::fitting::Fit;
use crate::leave_out::FitValidation;
use crate::scores::shares_of_squares;

impl Fit {
    /// Errors of the fit as JSON: `samples` and `pigments` as numbers, `rms`, `delta_e`, `per_sample`,
    /// `shares_of_squares` of the colour errors with the greatest first, `warnings`.
    #[must_use]
    pub fn errors_json(&self) -> Map<String, Value> {
        let Evidence { rms, delta_e, per_sample, warnings, .. } = self.evidence();
        errors_json(self.library.pigments.len(), *rms, delta_e, per_sample, warnings)
    }
}

impl FitValidation {
    /// Errors of the mixtures that were left out, with the keys of [`Fit::errors_json`].
    #[must_use]
    pub fn errors_json(&self) -> Map<String, Value> {
        let pigments = self.fit.library.pigments.len();
        let errors = &self.errors;
        errors_json(pigments, errors.rms, &errors.delta_e, &errors.per_sample, &self.warnings())
    }
}

fn errors_json(
    pigments: usize,
    rms: f64,
    delta_e: &Summary,
    per_sample: &[SampleEvidence],
    warnings: &[String],
) -> Map<String, Value> {
    let shares = shares_of_squares(per_sample)
        .into_iter()
        .map(|(sample, share): (&str, f64)| json!({ "sample": sample, "share": share }));
    let pairs = [
        ("samples", json!(per_sample.len())),
        ("pigments", json!(pigments)),
        ("rms", json!(rms)),
        ("delta_e", json!(delta_e)),
        ("per_sample", json!(per_sample)),
        ("shares_of_squares", shares.collect()),
        ("warnings", json!(warnings)),
    ];
    pairs.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}
