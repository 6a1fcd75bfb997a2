//! The curve that maps the pressure of the pen to the pressure of the brush. It rises through a few
//! points that you can edit, by monotone cubic interpolation.
//!
//! Between two points the curve is a cubic. Its slopes are limited so that it never leaves the
//! range of the two points: F. N. Fritsch and R. E. Carlson, Monotone piecewise cubic
//! interpolation, SIAM Journal on Numerical Analysis 17 (1980) 238-246.

use serde::{Deserialize, Serialize};

const GAP: f64 = CurvePoints::GAP;

/// Two to eight points from 0 to 1: x ascends and y never falls. The curve is level before the
/// first and after the last point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<[f64; 2]>", into = "Vec<[f64; 2]>")]
pub struct CurvePoints(Vec<[f64; 2]>);

/// Why points do not make a curve.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum InvalidCurve {
    /// There are too few points, or too many.
    #[error("a curve has 2 to 8 points, not {0}")]
    Count(usize),
    /// A coordinate is not within 0 to 1.
    #[error("point {0} is not within 0 to 1")]
    Range(usize),
    /// A point is not to the right of the one before.
    #[error("point {0} is not to the right of the one before")]
    Order(usize),
    /// A point is below the one before.
    #[error("point {0} is below the one before, but more pressure must not press less")]
    Falls(usize),
}

impl TryFrom<Vec<[f64; 2]>> for CurvePoints {
    type Error = InvalidCurve;

    fn try_from(points: Vec<[f64; 2]>) -> Result<Self, InvalidCurve> {
        if !(Self::LEAST..=Self::MOST).contains(&points.len()) {
            return Err(InvalidCurve::Count(points.len()));
        }
        if let Some(at) = points
            .iter()
            .position(|point: &[f64; 2]| point.iter().any(|part| !(0.0..=1.0).contains(part)))
        {
            return Err(InvalidCurve::Range(at + 1));
        }
        for (number, pair) in (2..).zip(points.windows(2)) {
            if pair[1][0] - pair[0][0] < 0.5 * GAP {
                return Err(InvalidCurve::Order(number));
            }
            if pair[1][1] < pair[0][1] {
                return Err(InvalidCurve::Falls(number));
            }
        }
        Ok(Self(points))
    }
}

impl From<CurvePoints> for Vec<[f64; 2]> {
    fn from(points: CurvePoints) -> Self {
        points.0
    }
}

impl CurvePoints {
    /// Fewest points of a curve.
    pub const LEAST: usize = 2;

    /// Smallest distance of two points along x.
    pub(super) const GAP: f64 = 0.01;

    /// Most points of a curve.
    pub const MOST: usize = 8;

    /// The straight line from 0 to 1.
    #[must_use]
    pub fn straight() -> Self {
        Self(vec![[0.0, 0.0], [1.0, 1.0]])
    }

    /// The points, x ascending.
    #[must_use]
    pub fn list(&self) -> &[[f64; 2]] {
        &self.0
    }

    /// Height of the curve at `x`, 0 to 1.
    #[must_use]
    pub fn at(&self, x: f64) -> f64 {
        let after = self.0.iter().position(|point| point[0] > x);
        match after {
            Some(0) => self.0[0][1],
            None => self.0[self.0.len() - 1][1],
            Some(after) => self.between(after - 1, x),
        }
    }

    /// Height at `x` between the points `left` and `left + 1`.
    fn between(&self, left: usize, x: f64) -> f64 {
        let [x0, y0] = self.0[left];
        let [x1, y1] = self.0[left + 1];
        let width = x1 - x0;
        let rise = (y1 - y0) / width;
        let mut from = self.slope(left);
        let mut to = self.slope(left + 1);
        if rise == 0.0 {
            return y0;
        }
        // A circle of radius 3 lies within the region of slopes that cannot overshoot.
        let steepness = (from / rise).hypot(to / rise);
        if steepness > 3.0 {
            (from, to) = (from * 3.0 / steepness, to * 3.0 / steepness);
        }
        let t = (x - x0) / width;
        let t2 = t * t;
        let t3 = t * t * t;
        let height = (2.0 * t3 - 3.0 * t2 + 1.0) * y0
            + (t3 - 2.0 * t2 + t) * width * from
            + (3.0 * t2 - 2.0 * t3) * y1
            + (t3 - t2) * width * to;
        height.clamp(y0, y1)
    }

    /// Slope at a point before limiting. At either end this is the slope of the only chord,
    /// elsewhere the mean slope of both chords, or 0 if one of them is level.
    fn slope(&self, point: usize) -> f64 {
        let chord = |left: usize| {
            let [x0, y0] = self.0[left];
            let [x1, y1] = self.0[left + 1];
            (y1 - y0) / (x1 - x0)
        };
        let last = self.0.len() - 1;
        match point {
            0 => chord(0),
            end if end == last => chord(last - 1),
            inner => {
                let before = chord(inner - 1);
                let after = chord(inner);
                if before * after > 0.0 { 0.5 * (before + after) } else { 0.0 }
            }
        }
    }

    /// Adds a point and shifts it if the order of the points requires this. Returns its index, or
    /// `None` if there are eight points already or no room beside the others.
    pub fn add(&mut self, at: [f64; 2]) -> Option<usize> {
        if self.0.len() == Self::MOST || at.iter().any(|part| !part.is_finite()) {
            return None;
        }
        let index = self.0.partition_point(|point| point[0] < at[0]);
        let before = index.checked_sub(1).map_or(-GAP, |before| self.0[before][0]);
        let after = self.0.get(index).map_or(1.0 + GAP, |after| after[0]);
        if after - before < 2.0 * GAP {
            return None;
        }
        self.0.insert(index, at);
        self.move_to(index, at);
        Some(index)
    }

    /// Moves a point, but not past its neighbours or the edges. Does nothing without such a point.
    pub fn move_to(&mut self, index: usize, to: [f64; 2]) {
        if index >= self.0.len() || to.iter().any(|part| !part.is_finite()) {
            return;
        }
        let before = index.checked_sub(1).map(|before| self.0[before]);
        let after = self.0.get(index + 1).copied();
        let left = before.map_or(0.0, |point| point[0] + GAP);
        let right = after.map_or(1.0, |point| point[0] - GAP).max(left);
        let low = before.map_or(0.0, |point| point[1]);
        let high = after.map_or(1.0, |point| point[1]).max(low);
        self.0[index] = [to[0].clamp(left, right), to[1].clamp(low, high)];
    }

    /// Removes a point and returns whether this was possible: two must stay.
    pub fn remove(&mut self, index: usize) -> bool {
        let removed = self.0.len() > Self::LEAST && index < self.0.len();
        if removed {
            self.0.remove(index);
        }
        removed
    }
}

/// Smallest and greatest exponent.
const POWERS: [f64; 2] = [0.2, 5.0];

/// Number of points that replace a power when you edit its curve.
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
    /// For a light hand: little pressure of the pen gives more pressure of the brush.
    pub const SOFT: Self = Self::Power(0.625);

    /// The pressure of the pen as it is.
    pub const LINEAR: Self = Self::Power(1.0);

    /// For a heavy hand. The exponent is the reciprocal of [`Self::SOFT`].
    pub const FIRM: Self = Self::Power(1.6);

    /// Pressure of the brush for the measured `pressure`, both 0 to 1. If the measured one rises,
    /// this never falls.
    #[must_use]
    pub fn at(&self, pressure: f64) -> f64 {
        let pressure = if pressure.is_nan() { 0.0 } else { pressure.clamp(0.0, 1.0) };
        match self {
            Self::Power(power) => pressure.powf(bounded(*power)),
            Self::Points(points) => points.at(pressure),
        }
    }

    /// The points by which you edit the curve. A curve through points only approximates a power:
    /// it deviates by less than 0.025 for exponents from 0.5 to 2.5, and by less than 0.04 above.
    /// Powers below 0.5 are steeper at 0 than points can be. There the deviation is greater at
    /// pressures below 0.01.
    #[must_use]
    pub fn points(&self) -> CurvePoints {
        let power = match self {
            Self::Points(points) => return points.clone(),
            Self::Power(power) => bounded(*power),
        };
        let count = if power == 1.0 { CurvePoints::LEAST } else { POINTS_OF_A_POWER };
        let points = (0..count).map(|at| {
            let share = at as f64 / (count - 1) as f64;
            // Close together where the curve is steep.
            let x = if power < 1.0 {
                share.powf(1.5 / power).max(CurvePoints::GAP * at as f64)
            } else {
                share
            };
            [x, x.powf(power)]
        });
        let points: Vec<[f64; 2]> = points.collect();
        // Both coordinates rise with the index.
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

    fn curve(points: &[[f64; 2]]) -> CurvePoints {
        CurvePoints::try_from(points.to_vec()).unwrap()
    }

    #[test]
    fn the_curve_passes_its_points_and_never_falls_or_overshoots() {
        // Steps and plateaus, through which a plain cubic spline swings.
        let points = [[0.0, 0.1], [0.2, 0.1], [0.25, 0.9], [0.6, 0.9], [0.7, 0.95], [1.0, 1.0]];
        let curve = curve(&points);
        for [x, y] in points {
            assert!((curve.at(x) - y).abs() < 1e-12, "{x}: {} of {y}", curve.at(x));
        }
        let heights: Vec<f64> = (0..=4000).map(|at| curve.at(f64::from(at) / 4000.0)).collect();
        assert!(heights.is_sorted(), "it falls");
        assert!(heights.iter().all(|y| (0.1..=1.0).contains(y)), "it leaves its range");
        // Where the points rise, so does the curve between them: it does not wait at its limit.
        let rising = CurvePoints(vec![[0.0, 0.0], [0.5, 0.02], [0.52, 0.9], [1.0, 1.0]]);
        let heights: Vec<f64> = (0..=4000).map(|at| rising.at(f64::from(at) / 4000.0)).collect();
        assert!(heights.windows(2).all(|pair| pair[1] > pair[0]), "it has a plateau");
        let steep = curve.at(0.225);
        assert!((0.3..0.7).contains(&steep), "{steep}");
    }

    #[test]
    fn it_is_smooth_at_its_points_and_level_beyond_them() {
        let curve = curve(&[[0.2, 0.1], [0.5, 0.3], [0.8, 0.9]]);
        assert_eq!((curve.at(0.0), curve.at(-3.0), curve.at(1.0)), (0.1, 0.1, 0.9));
        let step = 1e-6;
        let left = (curve.at(0.5) - curve.at(0.5 - step)) / step;
        let right = (curve.at(0.5 + step) - curve.at(0.5)) / step;
        assert!((left - right).abs() < 1e-4, "{left} {right}");
        // The mean of the slopes of both chords.
        assert!((left - 0.5 * (0.2 / 0.3 + 0.6 / 0.3)).abs() < 1e-4, "{left}");
    }

    #[test]
    fn points_stay_in_order_however_they_are_dragged() {
        let mut curve = curve(&[[0.0, 0.0], [1.0, 1.0]]);
        assert_eq!(curve.add([0.5, 0.7]), Some(1));
        curve.move_to(1, [7.0, -2.0]);
        assert_eq!(curve.list()[1], [0.99, 0.0]);
        curve.move_to(0, [0.4, 0.9]);
        assert_eq!(curve.list()[0], [0.4, 0.0]);
        curve.move_to(1, [0.6, 0.5]);
        for x in [0.45, 0.5, 0.55, 0.7, 0.9] {
            assert!(curve.add([x, 0.5]).is_some(), "{x}");
        }
        assert_eq!((curve.list().len(), curve.add([0.8, 0.6])), (8, None));
        assert_eq!(CurvePoints::try_from(curve.list().to_vec()), Ok(curve.clone()));
        while curve.remove(1) {}
        assert_eq!(curve.list(), [[0.4, 0.0], [1.0, 1.0]]);
    }

    #[test]
    fn points_that_are_no_curve_are_refused_with_their_number() {
        for (points, wanted) in [
            (&[[0.0, 0.0]][..], InvalidCurve::Count(1)),
            (&[[0.0, 0.0]; 9][..], InvalidCurve::Count(9)),
            (&[[0.0, 0.0], [1.0, f64::NAN]][..], InvalidCurve::Range(2)),
            (&[[0.5, 0.0], [0.5, 1.0]][..], InvalidCurve::Order(2)),
            (&[[0.0, 0.5], [0.5, 0.6], [1.0, 0.4]][..], InvalidCurve::Falls(3)),
        ] {
            assert_eq!(CurvePoints::try_from(points.to_vec()).unwrap_err(), wanted);
        }
    }

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
        fn worst(power: f64) -> f64 {
            let curve = PressureCurve::Power(power);
            let points = PressureCurve::Power(power).points();
            (0..=1000)
                .map(|at: i32| {
                    (curve.at(f64::from(at) / 1e3) - points.at(f64::from(at) / 1e3)).abs()
                })
                .fold(0.0, f64::max)
        }
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
