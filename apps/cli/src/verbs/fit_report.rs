//! JSON of `fit` and `validate`.

use calibrate::library::SampleEvidence;
use serde_json::{Map, Value, json};

/// Completes the errors of a fit or validation by the `seconds` that it took, rounded to 1 ms.
pub(super) fn timed(mut errors: Map<String, Value>, seconds: f64) -> Value {
    errors.insert("seconds".to_owned(), json!((seconds * 1e3).round() / 1e3));
    Value::Object(errors)
}

/// Samples with their colour errors, one row each.
pub(super) fn rows(per_sample: &[SampleEvidence]) -> Vec<Value> {
    per_sample
        .iter()
        .map(|s: &SampleEvidence| json!({"sample": s.sample, "ciede2000": s.delta_e}))
        .collect()
}
