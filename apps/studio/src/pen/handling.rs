//! How a brush is led by a device: the general settings with the options of the brush.

use session::brushes::{BrushOptions, StabiliserMethod, TiltUse, TwistUse};

use super::report::PointerState;
use super::settings::{Grip, PenSettings};
use super::transform::SurfaceTransform;

/// The general settings and the options of the brush in hand, which come first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Handling<'a> {
    /// The general settings.
    pub(super) settings: &'a PenSettings,
    /// Options of the brush in hand.
    pub(super) options: &'a BrushOptions,
}

impl Handling<'_> {
    /// Pressure of the brush for one that the device measures, 0 to 1.
    pub(super) fn pressure(&self, measured: f64) -> f64 {
        let curve = self.options.curve.as_ref().unwrap_or(&self.settings.curve);
        self.options.in_range(curve.at(measured))
    }

    /// Pressure of the brush for one that follows from the speed of a device without pressure.
    pub(super) fn pressure_by_speed(&self, pressure: f64) -> f64 {
        self.options.in_range(pressure)
    }

    /// Tilt in the window, in degrees.
    pub(super) fn tilt_deg(&self, state: &PointerState) -> (f64, f64) {
        let grip = self.settings.grip;
        let measured = match self.options.tilt {
            TiltUse::AsSet => state.tilt_deg.filter(|_| self.settings.pen_tilt),
            TiltUse::Pen => state.tilt_deg,
            TiltUse::Ignored => None,
            TiltUse::Fixed(lean_deg) => return Grip { lean_deg, ..grip }.tilt_deg(),
        };
        measured.unwrap_or_else(|| grip.tilt_deg())
    }

    /// Rotation in the window that the device measures, in degrees, if it moves the brush.
    pub(super) fn measured_twist(&self, state: &PointerState) -> Option<f64> {
        match self.options.twist {
            TwistUse::AsSet => state.twist_deg.filter(|_| self.settings.pen_tilt),
            TwistUse::Device => state.twist_deg,
            TwistUse::Stroke | TwistUse::Fixed(_) => None,
        }
    }

    /// Rotation in the window at the start of a stroke, in degrees, if none is measured.
    pub(super) fn first_twist(&self) -> f64 {
        match self.options.twist {
            TwistUse::Fixed(degrees) => degrees,
            _ => self.settings.grip.twist_deg,
        }
    }

    /// Whether the broad side turns across the direction of the stroke, if no rotation is measured.
    pub(super) fn follows(&self) -> bool {
        match self.options.twist {
            TwistUse::AsSet | TwistUse::Device => self.settings.follow,
            TwistUse::Stroke => true,
            TwistUse::Fixed(_) => false,
        }
    }

    /// Method of the stabiliser, and its length in mm on a surface that is shown like this.
    pub(super) fn stabiliser(&self, transform: &SurfaceTransform) -> (StabiliserMethod, f64) {
        let settings = self.options.stabiliser.unwrap_or(self.settings.stabiliser);
        let scale = match settings.unit {
            session::brushes::LengthUnit::Mm => 1.0,
            session::brushes::LengthUnit::Px => transform.mm_per_point(),
        };
        (settings.method, settings.length * scale)
    }
}

#[cfg(test)]
mod tests {
    use eframe::egui::Pos2;
    use session::brushes::PressureCurve;

    use super::*;

    fn state() -> PointerState {
        let tilt_deg = Some((20.0, -10.0));
        let twist_deg = Some(70.0);
        PointerState { tilt_deg, twist_deg, ..PointerState::at(Pos2::ZERO) }
    }

    #[test]
    fn options_of_the_brush_come_before_the_general_settings() {
        let general = PenSettings { curve: PressureCurve::Power(2.0), ..PenSettings::default() };
        let plain = BrushOptions::default();
        let handling = Handling { settings: &general, options: &plain };
        assert_eq!((handling.pressure(0.5), handling.tilt_deg(&state())), (0.25, (20.0, -10.0)));
        assert_eq!((handling.measured_twist(&state()), handling.follows()), (Some(70.0), true));
        let own = BrushOptions {
            tilt: TiltUse::Ignored,
            twist: TwistUse::Fixed(40.0),
            range: [0.5, 1.0],
            curve: Some(PressureCurve::LINEAR),
            stabiliser: None,
        };
        let handling = Handling { options: &own, ..handling };
        assert_eq!((handling.pressure(0.5), handling.pressure_by_speed(0.2)), (0.75, 0.6));
        assert_eq!(handling.tilt_deg(&state()), general.grip.tilt_deg());
        let twist = (handling.measured_twist(&state()), handling.first_twist(), handling.follows());
        assert_eq!(twist, (None, 40.0, false));
    }

    #[test]
    fn a_brush_uses_the_pen_although_the_general_settings_do_not() {
        let general = PenSettings { pen_tilt: false, follow: false, ..PenSettings::default() };
        let plain = BrushOptions::default();
        let handling = Handling { settings: &general, options: &plain };
        assert_eq!(handling.tilt_deg(&state()), general.grip.tilt_deg());
        assert_eq!(handling.measured_twist(&state()), None);
        let own = BrushOptions { tilt: TiltUse::Pen, twist: TwistUse::Device, ..plain.clone() };
        let handling = Handling { options: &own, ..handling };
        assert_eq!(handling.tilt_deg(&state()), (20.0, -10.0));
        assert_eq!(handling.measured_twist(&state()), Some(70.0));
        let own =
            BrushOptions { tilt: TiltUse::Fixed(60.0), twist: TwistUse::Stroke, ..plain.clone() };
        let handling = Handling { options: &own, ..handling };
        let (x, y) = handling.tilt_deg(&state());
        let lean = x.to_radians().tan().hypot(y.to_radians().tan()).atan().to_degrees();
        assert!((lean - 60.0).abs() < 1e-9 && handling.follows(), "{lean}");
    }
}
