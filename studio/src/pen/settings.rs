//! Preferences for pen input; stored in the preferences file.

use serde::{Deserialize, Serialize};

/// Attitude of a brush that is led by a mouse or a finger, as seen in the window.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Grip {
    /// Angle between the handle and upright, in degrees, 0 to 80.
    pub lean_deg: f64,
    /// Direction in which the handle leans, in degrees clockwise from the right of the
    /// window.
    pub towards_deg: f64,
    /// Rotation of the brush about its handle, clockwise, in degrees. At 0 the broad side
    /// of a flat brush runs from left to right.
    pub twist_deg: f64,
}

impl Default for Grip {
    /// Nearly upright, towards a right hand that comes from the lower right.
    fn default() -> Self {
        Self { lean_deg: 5.0, towards_deg: 45.0, twist_deg: 0.0 }
    }
}

impl Grip {
    /// Rotates the brush about its handle; positive degrees are clockwise.
    pub fn turn(&mut self, degrees: f64) {
        self.twist_deg = (self.twist_deg + degrees).rem_euclid(360.0);
    }

    /// Tilt towards the right and the lower edge of the window, in degrees.
    pub(super) fn tilt_deg(&self) -> (f64, f64) {
        let slope = self.lean_deg.clamp(0.0, 80.0).to_radians().tan();
        let (sin, cos) = self.towards_deg.to_radians().sin_cos();
        ((slope * cos).atan().to_degrees(), (slope * sin).atan().to_degrees())
    }
}

/// Preferences for pen input.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PenSettings {
    /// Exponent applied to the pressure of a stylus, 0.2 to 5. Values above 1 lower the
    /// pressure of the brush, values below 1 raise it.
    pub gamma: f64,
    /// Attitude of a brush whose device measures none.
    pub grip: Grip,
    /// Whether a brush without a measured attitude turns its broad side across the
    /// direction of the stroke.
    pub follow: bool,
    /// Whether the tilt and twist of a stylus move the brush; otherwise `grip` is used.
    pub pen_tilt: bool,
}

impl Default for PenSettings {
    fn default() -> Self {
        Self { gamma: 1.0, grip: Grip::default(), follow: true, pen_tilt: true }
    }
}

impl PenSettings {
    /// Replaces values that are out of range by the defaults.
    pub fn bound(&mut self) {
        let (default, grip) = (Self::default(), &mut self.grip);
        // NaN is in no range, so it is replaced too.
        let bound = |value: &mut f64, least: f64, most: f64, default: f64| {
            if !(least..=most).contains(value) {
                *value = default;
            }
        };
        bound(&mut self.gamma, 0.2, 5.0, default.gamma);
        bound(&mut grip.lean_deg, 0.0, 80.0, default.grip.lean_deg);
        bound(&mut grip.towards_deg, 0.0, 360.0, default.grip.towards_deg);
        bound(&mut grip.twist_deg, 0.0, 360.0, default.grip.twist_deg);
    }

    /// Pressure of the brush for a measured `pressure`, 0 to 1.
    pub(super) fn brush_pressure(&self, pressure: f64) -> f64 {
        let gamma = if self.gamma.is_finite() { self.gamma.clamp(0.2, 5.0) } else { 1.0 };
        pressure.clamp(0.0, 1.0).powf(gamma)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grip_leans_to_the_lower_right_by_its_angle() {
        let (x, y) = Grip::default().tilt_deg();
        assert!((x - y).abs() < 1e-9 && x > 0.0, "{x} {y}");
        let lean = x.to_radians().tan().hypot(y.to_radians().tan()).atan().to_degrees();
        assert!((lean - 5.0).abs() < 1e-9, "{lean}");
        let mut grip = Grip::default();
        grip.turn(-15.0);
        assert_eq!(grip.twist_deg, 345.0);
        grip.turn(30.0);
        assert_eq!(grip.twist_deg, 15.0);
    }

    #[test]
    fn gamma_keeps_the_endpoints_and_the_range() {
        for gamma in [0.0, 0.5, 1.0, 2.2, 99.0, f64::NAN] {
            let settings = PenSettings { gamma, ..PenSettings::default() };
            assert_eq!(
                (settings.brush_pressure(0.0), settings.brush_pressure(1.0)),
                (0.0, 1.0),
                "{gamma}"
            );
            assert_eq!(
                (settings.brush_pressure(-3.0), settings.brush_pressure(7.0)),
                (0.0, 1.0),
                "{gamma}"
            );
        }
        let soft = PenSettings { gamma: 2.0, ..PenSettings::default() };
        assert_eq!(soft.brush_pressure(0.5), 0.25);
    }
}
