//! Metamerism: the difference under one light of two colours that match under another.

use super::difference::delta_e_ciede2000;
use super::lab::Lab;
use super::xyz::Xyz;
use documents::hint::Explain;

/// Corrects a sample under the test light for its difference from the standard under the
/// reference light: each tristimulus value is multiplied by the ratio of standard to sample
/// under the reference light (CIE 15:2018, section 9.2).
///
/// # Errors
/// [`MetamerismError`] if the sample is black under the reference light, which leaves the ratio
/// undefined.
pub fn corrected_to_match(
    sample_test: Xyz,
    standard_reference: Xyz,
    sample_reference: Xyz,
) -> Result<Xyz, MetamerismError> {
    let sample = sample_reference.to_array();
    if sample.iter().any(|&v| v <= 0.0) {
        return Err(MetamerismError { xyz: sample });
    }
    let mut corrected = sample_test.to_array();
    for (value, (standard, sample)) in
        corrected.iter_mut().zip(standard_reference.to_array().into_iter().zip(sample))
    {
        *value *= standard / sample;
    }
    Ok(corrected.into())
}

/// Special metamerism index for a change of illuminant (CIE 15:2018, section 9.2): the
/// CIEDE2000 difference of the pair under the test light after [`corrected_to_match`].
/// `standard` and `sample` each hold XYZ under the reference light and under the test light.
///
/// # Errors
/// [`MetamerismError`] if the sample is black under the reference light.
pub fn metamerism_index(
    standard: [Xyz; 2],
    sample: [Xyz; 2],
    test_white: Xyz,
) -> Result<f64, MetamerismError> {
    let [standard_reference, standard_test] = standard;
    let [sample_reference, sample_test] = sample;
    let corrected = corrected_to_match(sample_test, standard_reference, sample_reference)?;
    Ok(delta_e_ciede2000(
        Lab::from_xyz(standard_test, test_white),
        Lab::from_xyz(corrected, test_white),
    ))
}

/// A sample that is black under the reference light.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "a sample that is black under the reference light has no metamerism index, found XYZ `{xyz:?}`"
)]
pub struct MetamerismError {
    /// XYZ of the sample under the reference light.
    pub xyz: [f64; 3],
}

impl Explain for MetamerismError {}
