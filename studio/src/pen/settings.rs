//! What a painter may want of the pen; kept with the preferences.

use serde::{Deserialize, Serialize};

/// How a brush is held that a mouse or a finger leads, seen in the window.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Grip {
    /// How far the handle leans, in degrees from upright, 0..80.
    pub lean_deg: f64,
    /// Where it leans to: degrees clockwise from the right of the window.
    pub towards_deg: f64,
    /// Turn of the brush about its handle, clockwise, in degrees; at 0 the broad
    /// side of a flat runs from left to right.
    pub twist_deg: f64,
}

impl Default for Grip {
    /// A right hand below and to the right of what it paints.
    fn default() -> Self {
        Self { lean_deg: 35.0, towards_deg: 45.0, twist_deg: 0.0 }
    }
}

impl Grip {
    /// Turns the brush in the fingers, clockwise for positive degrees.
    pub fn turn(&mut self, degrees: f64) {
        self.twist_deg = (self.twist_deg + degrees).rem_euclid(360.0);
    }

    /// Its lean to the right and to the lower edge, in degrees.
    pub(super) fn tilt_deg(&self) -> (f64, f64) {
        let slope = self.lean_deg.clamp(0.0, 80.0).to_radians().tan();
        let (sin, cos) = self.towards_deg.to_radians().sin_cos();
        ((slope * cos).atan().to_degrees(), (slope * sin).atan().to_degrees())
    }
}

/// What a painter may want of the pen.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PenSettings {
    /// The pressure told by a pen is raised to this, 0.2..5: above 1 is a softer
    /// hand, below 1 a heavier.
    pub gamma: f64,
    /// How a brush is held that nothing tells the hold of.
    pub grip: Grip,
    /// Whether such a brush turns its broad side across the way that it is led.
    pub follow: bool,
    /// Whether the tilt and twist of a pen lead the brush; else the grip does.
    pub pen_tilt: bool,
}

impl Default for PenSettings {
    fn default() -> Self {
        Self { gamma: 1.0, grip: Grip::default(), follow: false, pen_tilt: true }
    }
}

impl PenSettings {
    /// Brings numbers into their range.
    pub fn bound(&mut self) {
        let (usual, grip) = (Self::default(), &mut self.grip);
        // What is not a number is in no range.
        let within = |value: &mut f64, least: f64, most: f64, usual: f64| {
            if !(least..=most).contains(value) {
                *value = usual;
            }
        };
        within(&mut self.gamma, 0.2, 5.0, usual.gamma);
        within(&mut grip.lean_deg, 0.0, 80.0, usual.grip.lean_deg);
        within(&mut grip.towards_deg, 0.0, 360.0, usual.grip.towards_deg);
        within(&mut grip.twist_deg, 0.0, 360.0, usual.grip.twist_deg);
    }

    /// The pressure that the brush gets, 0..1.
    pub(super) fn pressed(&self, pressure: f64) -> f64 {
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
        assert!((lean - 35.0).abs() < 1e-9, "{lean}");
        let mut grip = Grip::default();
        grip.turn(-15.0);
        assert_eq!(grip.twist_deg, 345.0);
        grip.turn(30.0);
        assert_eq!(grip.twist_deg, 15.0);
    }

    #[test]
    fn gamma_keeps_the_ends_and_bounds() {
        for gamma in [0.0, 0.5, 1.0, 2.2, 99.0, f64::NAN] {
            let settings = PenSettings { gamma, ..PenSettings::default() };
            assert_eq!((settings.pressed(0.0), settings.pressed(1.0)), (0.0, 1.0), "{gamma}");
            assert_eq!((settings.pressed(-3.0), settings.pressed(7.0)), (0.0, 1.0), "{gamma}");
        }
        let soft = PenSettings { gamma: 2.0, ..PenSettings::default() };
        assert_eq!(soft.pressed(0.5), 0.25);
    }
}
