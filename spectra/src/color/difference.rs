//! Colour differences in CIELAB, and metamerism: the difference under one light of two colours that
//! match under another.
//!
//! CIE94 and CMC are asymmetric by definition: pass the standard first, or you get another number.

use documents::hint::Explain;

use super::xyz::{Lab, Matrix3, Xyz};

/// CIE 1976 colour difference: the Euclidean distance in CIELAB (ISO/CIE 11664-4).
#[must_use]
pub fn delta_e_cie76(first: Lab, second: Lab) -> f64 {
    let (d_l, d_a, d_b) = differences(first, second);
    (d_l * d_l + d_a * d_a + d_b * d_b).sqrt()
}

/// Differences of one colour from a standard by four formulas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorDifferences {
    /// CIEDE2000.
    pub ciede2000: f64,
    /// CIE 1976.
    pub cie1976: f64,
    /// CIE94 for graphic arts.
    pub cie94: f64,
    /// CMC(2:1).
    pub cmc_2_1: f64,
}

impl ColorDifferences {
    /// Differences of `sample` from `standard`.
    #[must_use]
    pub fn between(standard: Lab, sample: Lab) -> Self {
        Self {
            ciede2000: delta_e_ciede2000(standard, sample),
            cie1976: delta_e_cie76(standard, sample),
            cie94: delta_e_cie94(standard, sample, Cie94::GraphicArts),
            cmc_2_1: delta_e_cmc(standard, sample, Cmc::ACCEPTABILITY),
        }
    }
}

/// The application that you use CIE94 for. It sets the weight of lightness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Cie94 {
    /// Graphic arts and paint (k_L = 1).
    #[default]
    GraphicArts,
    /// Textiles (k_L = 2).
    Textiles,
}

/// CIE94 colour difference of `sample` from `standard` (CIE 116-1995).
#[must_use]
pub fn delta_e_cie94(standard: Lab, sample: Lab, application: Cie94) -> f64 {
    let (k_l, k_1, k_2) = match application {
        Cie94::GraphicArts => (1.0, 0.045, 0.015),
        Cie94::Textiles => (2.0, 0.048, 0.014),
    };
    let (d_l, d_c, d_h_squared) = lightness_chroma_hue(standard, sample);
    let chroma = standard.a.hypot(standard.b);
    let l = d_l / k_l;
    let c = d_c / (1.0 + k_1 * chroma);
    let s_h = 1.0 + k_2 * chroma;
    (l * l + c * c + d_h_squared / (s_h * s_h)).sqrt()
}

/// The weights l and c of the CMC(l:c) difference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cmc {
    /// Weight l of lightness: 2 for acceptability, 1 for perceptibility.
    pub lightness: f64,
    /// Weight c of chroma, usually 1.
    pub chroma: f64,
}

impl Cmc {
    /// CMC(2:1), for acceptability.
    pub const ACCEPTABILITY: Self = Self { lightness: 2.0, chroma: 1.0 };
    /// CMC(1:1), for perceptibility.
    pub const PERCEPTIBILITY: Self = Self { lightness: 1.0, chroma: 1.0 };
}

/// CMC(l:c) colour difference of `sample` from `standard` (Clarke, McDonald and Rigg 1984).
#[must_use]
pub fn delta_e_cmc(standard: Lab, sample: Lab, weights: Cmc) -> f64 {
    let (d_l, d_c, d_h_squared) = lightness_chroma_hue(standard, sample);
    let chroma = standard.a.hypot(standard.b);
    let hue = standard.to_lch().hue_degrees;
    let s_l = if standard.lightness < 16.0 {
        0.511
    } else {
        0.040975 * standard.lightness / (1.0 + 0.01765 * standard.lightness)
    };
    let s_c = 0.0638 * chroma / (1.0 + 0.0131 * chroma) + 0.638;
    let f = (chroma.powi(4) / (chroma.powi(4) + 1900.0)).sqrt();
    let t = if (164.0..=345.0).contains(&hue) {
        0.56 + (0.2 * (hue + 168.0).to_radians().cos()).abs()
    } else {
        0.36 + (0.4 * (hue + 35.0).to_radians().cos()).abs()
    };
    let s_h = s_c * (f * t + 1.0 - f);
    let l = d_l / (weights.lightness * s_l);
    let c = d_c / (weights.chroma * s_c);
    (l * l + c * c + d_h_squared / (s_h * s_h)).sqrt()
}

/// CIEDE2000 colour difference with all parametric factors 1 (ISO/CIE 11664-6, mean hue by Sharma,
/// Wu and Dalal 2005, equation 14).
///
/// We do not take this from the crate `palette`, because its version 0.7.7 leaves a mean hue above
/// 360 degrees unreduced, an error of 2e-5 where two hues lie on either side of 0.
#[must_use]
pub fn delta_e_ciede2000(first: Lab, second: Lab) -> f64 {
    let [l, c, h, r_t] = ciede2000_terms(first, second);
    (l * l + c * c + h * h + r_t * c * h).max(0.0).sqrt()
}

/// Three residuals for least squares. Their squares sum to the squared CIEDE2000 difference at any
/// distance. They are the weighted differences of lightness, chroma and hue, the last two rotated
/// so that the cross term of the formula vanishes.
#[must_use]
pub fn ciede2000_residuals(first: Lab, second: Lab) -> [f64; 3] {
    let [l, c, h, r_t] = ciede2000_terms(first, second);
    [l, c + r_t / 2.0 * h, h * (1.0 - r_t * r_t / 4.0).max(0.0).sqrt()]
}

/// Returns the weighted differences of lightness, chroma and hue, and the rotation term R_T.
fn ciede2000_terms(first: Lab, second: Lab) -> [f64; 4] {
    let mean_chroma = f64::midpoint(first.a.hypot(first.b), second.a.hypot(second.b));
    let stretch = 1.0 + 0.5 * (1.0 - seventh_root_share(mean_chroma));
    let a1 = first.a * stretch;
    let a2 = second.a * stretch;
    let c1 = a1.hypot(first.b);
    let c2 = a2.hypot(second.b);
    let h1 = hue_degrees(a1, first.b);
    let h2 = hue_degrees(a2, second.b);

    let grey = c1 * c2 == 0.0;
    let turn = h2 - h1;
    let d_hue = match turn {
        _ if grey => 0.0,
        t if t > 180.0 => t - 360.0,
        t if t < -180.0 => t + 360.0,
        t => t,
    };
    let mean_hue = match h1 + h2 {
        sum if grey => sum,
        sum if turn.abs() <= 180.0 => sum / 2.0,
        sum if sum < 360.0 => (sum + 360.0) / 2.0,
        sum => (sum - 360.0) / 2.0,
    };

    let d_l = second.lightness - first.lightness;
    let d_c = c2 - c1;
    let d_h = 2.0 * (c1 * c2).sqrt() * (d_hue / 2.0).to_radians().sin();

    let mean_l = f64::midpoint(first.lightness, second.lightness);
    let [s_l, s_c, s_h, r_t] = ciede2000_weights(mean_l, f64::midpoint(c1, c2), mean_hue);

    [d_l / s_l, d_c / s_c, d_h / s_h, r_t]
}

/// The linear map M with `|M (lab - center)|` close to the CIEDE2000 difference near `center`. Use
/// this for least squares.
///
/// We take the weighting functions at `center`. For random colours at a distance of 0.05 the result
/// agrees with CIEDE2000 to 1 % where the chroma exceeds 5, and to 6 % near grey, where the hue
/// changes fast.
#[must_use]
pub fn ciede2000_metric(center: Lab) -> Matrix3 {
    let chroma = center.a.hypot(center.b);
    let stretch = 1.0 + 0.5 * (1.0 - seventh_root_share(chroma));
    let a = center.a * stretch;
    let c = a.hypot(center.b);
    // Unit vector of rising chroma. Hue rises at a right angle to it.
    let (cos, sin) = if c > 1e-9 { (a / c, center.b / c) } else { (1.0, 0.0) };
    let hue = hue_degrees(a, center.b);
    let [s_l, s_c, s_h, r_t] = ciede2000_weights(center.lightness, c, hue);
    // The quadratic form c^2 + h^2 + r_t c h as a sum of two squares.
    let rest = (1.0 - r_t * r_t / 4.0).max(0.0).sqrt();
    let chroma_row = [0.0, stretch * cos / s_c, sin / s_c];
    let hue_row = [0.0, -stretch * sin / s_h, cos / s_h];
    let mixed = std::array::from_fn(|i| chroma_row[i] + r_t / 2.0 * hue_row[i]);
    Matrix3([[1.0 / s_l, 0.0, 0.0], mixed, hue_row.map(|v| v * rest)])
}

/// S_L, S_C, S_H and R_T at a mean lightness, chroma and hue (in degrees).
fn ciede2000_weights(lightness: f64, chroma: f64, hue: f64) -> [f64; 4] {
    let t = 1.0 - 0.17 * cos_degrees(hue - 30.0)
        + 0.24 * cos_degrees(2.0 * hue)
        + 0.32 * cos_degrees(3.0 * hue + 6.0)
        - 0.20 * cos_degrees(4.0 * hue - 63.0);
    let from_middle = (lightness - 50.0).powi(2);
    let rotation = 30.0 * (-((hue - 275.0) / 25.0).powi(2)).exp();
    [
        1.0 + 0.015 * from_middle / (20.0 + from_middle).sqrt(),
        1.0 + 0.045 * chroma,
        1.0 + 0.015 * chroma * t,
        -2.0 * seventh_root_share(chroma) * (2.0 * rotation).to_radians().sin(),
    ]
}

fn cos_degrees(degrees: f64) -> f64 {
    degrees.to_radians().cos()
}

/// The factor sqrt(C^7 / (C^7 + 25^7)) of CIEDE2000.
fn seventh_root_share(chroma: f64) -> f64 {
    let c7 = chroma.powi(7);
    (c7 / (c7 + 25f64.powi(7))).sqrt()
}

fn differences(first: Lab, second: Lab) -> (f64, f64, f64) {
    (second.lightness - first.lightness, second.a - first.a, second.b - first.b)
}

/// Differences of lightness and chroma, and the squared difference of hue.
fn lightness_chroma_hue(first: Lab, second: Lab) -> (f64, f64, f64) {
    let (d_l, d_a, d_b) = differences(first, second);
    let d_c = second.a.hypot(second.b) - first.a.hypot(first.b);
    (d_l, d_c, (d_a * d_a + d_b * d_b - d_c * d_c).max(0.0))
}

fn hue_degrees(a: f64, b: f64) -> f64 {
    let degrees = b.atan2(a).to_degrees();
    if degrees < 0.0 { degrees + 360.0 } else { degrees }
}

/// Corrects a sample under the test light for its difference from the standard under the reference
/// light: each tristimulus value is multiplied by the ratio of standard to sample under the
/// reference light (CIE 15:2018, section 9.2).
///
/// # Errors
/// [`MetamerismError`] if the sample is black under the reference light, because the ratio is then
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

/// Special metamerism index for a change of illuminant (CIE 15:2018, section 9.2): the CIEDE2000
/// difference of the pair under the test light after [`corrected_to_match`]. Pass `standard` and
/// `sample` each as XYZ under the reference light and under the test light.
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
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error, Explain)]
#[error(
    "a sample that is black under the reference light has no metamerism index, found XYZ `{xyz:?}`"
)]
pub struct MetamerismError {
    /// XYZ of the sample under the reference light.
    pub xyz: [f64; 3],
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squared_residuals_sum_to_ciede2000_at_any_distance() {
        let colors =
            [(5.0, 8.0, 1.0), (50.0, -30.0, 20.0), (90.0, 3.0, -60.0), (30.0, 60.0, -40.0)];
        let labs = colors.map(|(lightness, a, b)| Lab { lightness, a, b });
        for first in labs {
            for second in labs {
                let made =
                    ciede2000_residuals(first, second).iter().map(|r| r * r).sum::<f64>().sqrt();
                let difference = delta_e_ciede2000(first, second);
                assert!(
                    (made - difference).abs() < 1e-9,
                    "{first:?} to {second:?}: {made} for {difference}"
                );
            }
        }
    }

    #[test]
    fn the_metric_agrees_with_ciede2000_for_small_differences() {
        for l in [5.0, 50.0, 90.0] {
            for (a, b) in [(8.0, 1.0), (-30.0, 20.0), (3.0, -60.0), (60.0, 50.0), (40.0, -4.0)] {
                let center = Lab { lightness: l, a, b };
                let metric = ciede2000_metric(center);
                for d in [[0.05, 0.0, 0.0], [0.0, 0.05, 0.0], [0.0, 0.0, 0.05], [0.02, -0.03, 0.03]]
                {
                    let near = Lab { lightness: l + d[0], a: a + d[1], b: b + d[2] };
                    let length = metric.apply(d).iter().map(|v| v * v).sum::<f64>().sqrt();
                    let true_value = delta_e_ciede2000(center, near);
                    assert!(
                        (length / true_value - 1.0).abs() < 0.01,
                        "at {center:?} by {d:?}: {length} for {true_value}"
                    );
                }
            }
        }
    }
}
