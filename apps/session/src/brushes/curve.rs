//! The curve from the pressure of a pen to that of the brush.

use serde::{Deserialize, Serialize};

use super::points::CurvePoints;

/// Exponents of a power, least and greatest.
const POWERS: [f64; 2] = [0.2, 5.0];

/// Number of points that stand for a power when it is edited.
const POINTS_OF_A_POWER: usize = 7;

/// Pressure of the brush for each pressure of the pen, both 0 to 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PressureCurve {
    /// The pressure raised to this exponent, 0.2 to 5. Above 1 the brush presses less.
    Power(f64),
    /// A curve through points.
    Points(CurvePoints),
}

impl Default for PressureCurve {
    fn default() -> Self {
        Self::LINEAR
    }
}

impl PressureCurve {
    /// A light hand presses well.
    pub const SOFT: Self = Self::Power(0.625);

    /// The pressure of the pen as it is.
    pub const LINEAR: Self = Self::Power(1.0);

    /// Only a heavy hand presses well; the reciprocal of [`Self::SOFT`].
    pub const FIRM: Self = Self::Power(1.6);

    /// Pressure of the brush for a measured `pressure`; both are 0 to 1. It never falls while the
    /// measured one rises.
    #[must_use]
    pub fn at(&self, pressure: f64) -> f64 {
        let pressure = if pressure.is_nan() { 0.0 } else { pressure.clamp(0.0, 1.0) };
        match self {
            Self::Power(power) => pressure.powf(bounded(*power)),
            Self::Points(points) => points.at(pressure),
        }
    }

    /// The points by which the curve is edited. Those of a power deviate from it by less than 0.025
    /// for exponents from 0.5 on and by less than 0.04 above 2.5; a smaller one is steeper at 0 than
    /// points can be, so they deviate more below a pressure of 0.01.
    #[must_use]
    pub fn points(&self) -> CurvePoints {
        let power = match self {
            Self::Points(points) => return points.clone(),
            Self::Power(power) => bounded(*power),
        };
        let count = if power == 1.0 { CurvePoints::LEAST } else { POINTS_OF_A_POWER };
        let point = |at: usize| {
            let share = at as f64 / (count - 1) as f64;
            // Close together where the curve is steep.
            let x = if power < 1.0 {
                share.powf(1.5 / power).max(CurvePoints::GAP * at as f64)
            } else {
                share
            };
            [x, x.powf(power)]
        };
        let points: Vec<[f64; 2]> = (0..count).map(point).collect();
        // Both coordinates rise with the number of the point.
        CurvePoints::try_from(points).unwrap_or_else(|_| CurvePoints::straight())
    }

    /// Replaces an exponent that is out of range by 1.
    pub fn bound(&mut self) {
        if let Self::Power(power) = self
            && !(POWERS[0]..=POWERS[1]).contains(power)
        {
            *self = Self::LINEAR;
        }
    }
}

fn bounded(power: f64) -> f64 {
    if power.is_finite() { power.clamp(POWERS[0], POWERS[1]) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_curve_keeps_the_range_and_never_falls() {
        let powers = [0.0, 0.2, 0.5, 1.0, 2.2, 5.0, 99.0, f64::NAN].map(PressureCurve::Power);
        let points = vec![[0.1, 0.0], [0.5, 0.8], [0.9, 1.0]];
        let drawn = PressureCurve::Points(CurvePoints::try_from(points).unwrap());
        for curve in powers.into_iter().chain([drawn]) {
            assert_eq!((curve.at(-3.0), curve.at(7.0)), (0.0, 1.0), "{curve:?}");
            assert_eq!(curve.at(f64::NAN), 0.0, "{curve:?}");
            let heights: Vec<f64> = (0..=100).map(|at| curve.at(f64::from(at) / 100.0)).collect();
            assert!(heights.is_sorted(), "{curve:?}");
        }
        assert_eq!(PressureCurve::Power(2.0).at(0.5), 0.25);
        assert_eq!(PressureCurve::LINEAR.at(0.3), 0.3);
    }

    #[test]
    fn a_power_becomes_points_that_hardly_differ() {
        let worst = |power: f64| {
            let curve = PressureCurve::Power(power);
            let points = PressureCurve::Power(power).points();
            (0..=1000)
                .map(|at: i32| {
                    (curve.at(f64::from(at) / 1e3) - points.at(f64::from(at) / 1e3)).abs()
                })
                .fold(0.0, f64::max)
        };
        for power in [0.5, 0.625, 0.8, 1.0, 1.6, 2.5] {
            assert!(worst(power) < 0.025, "{power}: {}", worst(power));
        }
        for power in [3.5, 5.0] {
            assert!(worst(power) < 0.04, "{power}: {}", worst(power));
        }
        assert_eq!(PressureCurve::Power(0.2).points().list().len(), POINTS_OF_A_POWER);
        assert_eq!(PressureCurve::LINEAR.points().list(), [[0.0, 0.0], [1.0, 1.0]]);
    }

    #[test]
    fn both_forms_survive_their_text() {
        let drawn = PressureCurve::Points(PressureCurve::FIRM.points());
        for curve in [PressureCurve::SOFT, drawn] {
            let text = serde_json::to_string(&curve).unwrap();
            assert_eq!(serde_json::from_str::<PressureCurve>(&text).unwrap(), curve, "{text}");
        }
        let falls = r#"{"points": [[0, 0.5], [1, 0.2]]}"#;
        let refused = serde_json::from_str::<PressureCurve>(falls).unwrap_err().to_string();
        assert!(refused.contains("point 2 is below"), "{refused}");
    }
}
