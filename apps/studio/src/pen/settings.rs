//! Preferences for pen input. The preferences file stores these.

use serde::{Deserialize, Serialize};
use session::brushes::{PressureCurve, StabiliserSettings};

/// Attitude of a brush that you move with a mouse or a finger, as you see it in the window.
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
    /// Rotates the brush about its handle. Positive degrees are clockwise.
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
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "StoredSettings")]
pub struct PenSettings {
    /// Pressure of the brush for each pressure of a stylus.
    pub curve: PressureCurve,
    /// Attitude of a brush if the device measures none.
    pub grip: Grip,
    /// Whether a brush without a measured attitude turns its broad side across the
    /// direction of the stroke.
    pub follow: bool,
    /// Whether the tilt and twist of a stylus move the brush. If not, `grip` is used.
    pub pen_tilt: bool,
    /// How far the brush stays behind the pen.
    pub stabiliser: StabiliserSettings,
}

/// The preferences as they are in files. Older ones have an exponent instead of a curve.
#[derive(Debug, Deserialize)]
#[serde(default)]
struct StoredSettings {
    gamma: Option<f64>,
    curve: Option<PressureCurve>,
    grip: Grip,
    follow: bool,
    pen_tilt: bool,
    stabiliser: StabiliserSettings,
}

impl Default for StoredSettings {
    fn default() -> Self {
        let PenSettings { grip, follow, pen_tilt, stabiliser, .. } = PenSettings::default();
        Self { gamma: None, curve: None, grip, follow, pen_tilt, stabiliser }
    }
}

impl From<StoredSettings> for PenSettings {
    fn from(stored: StoredSettings) -> Self {
        let StoredSettings { gamma, curve, grip, follow, pen_tilt, stabiliser } = stored;
        let curve = curve.or(gamma.map(PressureCurve::Power)).unwrap_or_default();
        Self { curve, grip, follow, pen_tilt, stabiliser }
    }
}

impl Default for PenSettings {
    fn default() -> Self {
        Self {
            curve: PressureCurve::default(),
            grip: Grip::default(),
            follow: true,
            pen_tilt: true,
            stabiliser: StabiliserSettings::default(),
        }
    }
}

impl PenSettings {
    /// Replaces values out of range by the defaults.
    pub fn bound(&mut self) {
        let default = Self::default();
        let grip = &mut self.grip;
        // NaN lies in no range, so this replaces it too.
        fn bound(value: &mut f64, least: f64, most: f64, default: f64) {
            if !(least..=most).contains(value) {
                *value = default;
            }
        }
        bound(&mut grip.lean_deg, 0.0, 80.0, default.grip.lean_deg);
        bound(&mut grip.towards_deg, 0.0, 360.0, default.grip.towards_deg);
        bound(&mut grip.twist_deg, 0.0, 360.0, default.grip.twist_deg);
        self.curve.bound();
        self.stabiliser.bound();
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
    fn preferences_with_an_exponent_press_as_they_did() {
        for gamma in [0.2, 0.7, 1.0, 2.2, 5.0] {
            let text = format!(r#"{{"gamma": {gamma}, "follow": false}}"#);
            let mut read: PenSettings = serde_json::from_str(&text).unwrap();
            read.bound();
            assert!(!read.follow && read.pen_tilt, "{read:?}");
            for pressure in [0.0, 0.1, 0.37, 0.5, 0.99, 1.0_f64] {
                assert_eq!(read.curve.at(pressure), pressure.powf(gamma), "{gamma}");
            }
            let kept = serde_json::to_string(&read).unwrap();
            assert_eq!(serde_json::from_str::<PenSettings>(&kept).unwrap(), read, "{kept}");
        }
        let mut read: PenSettings = serde_json::from_str(r#"{"gamma": 99}"#).unwrap();
        read.bound();
        assert_eq!(read, PenSettings::default());
    }
}
