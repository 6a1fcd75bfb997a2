//! Axes of a stylus in XInput: numbers within a range, identified by a label.

use super::report::PointerState;
use eframe::egui::Pos2;

/// The quantity that an axis measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Axis {
    /// Pressure of the tip.
    Pressure,
    /// Tilt towards the right.
    TiltX,
    /// Tilt towards the lower edge.
    TiltY,
    /// Rotation of the barrel.
    Twist,
}

impl Axis {
    /// The axis with this label in the X server's input drivers, if it is one of the four
    /// (labels from xserver-properties.h).
    pub(super) fn labelled(label: &str) -> Option<Self> {
        match label {
            "Abs Pressure" => Some(Self::Pressure),
            "Abs Tilt X" => Some(Self::TiltX),
            "Abs Tilt Y" => Some(Self::TiltY),
            // The first is the label of the Wacom driver, the second that of libinput.
            "Abs Wheel" | "Abs Rotary Z" => Some(Self::Twist),
            _ => None,
        }
    }
}

/// One axis with its last value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Valuator {
    /// Number of the axis in events.
    pub(super) number: u16,
    /// The quantity that it measures.
    pub(super) axis: Axis,
    /// Lowest and highest value, in the server's unit.
    pub(super) range: (f64, f64),
    /// Last value, in the server's unit.
    pub(super) value: f64,
}

impl Valuator {
    /// The value as a pressure of 0 to 1 or as an angle in degrees; `None` if the range or
    /// the value is invalid.
    fn normalized(&self) -> Option<f64> {
        let (lowest, highest) = self.range;
        let span = highest - lowest;
        if !(span.is_finite() && span > 0.0 && self.value.is_finite()) {
            return None;
        }
        let value = self.value.clamp(lowest, highest);
        Some(match self.axis {
            Axis::Pressure => (value - lowest) / span,
            // Drivers report degrees, at most 64 from upright. A range beyond 90 has
            // another unit; its end is taken as 60 degrees.
            Axis::TiltX | Axis::TiltY => {
                let most = lowest.abs().max(highest.abs());
                if most <= 90.0 { value } else { value / most * 60.0 }
            }
            Axis::Twist => value / span * 360.0,
        })
    }
}

/// The axes of one end of a stylus.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Valuators(pub(super) Vec<Valuator>);

impl Valuators {
    /// Whether the device is a stylus: it measures pressure.
    pub(super) fn is_pen(&self) -> bool {
        self.0.iter().any(|valuator| valuator.axis == Axis::Pressure)
    }

    /// Applies an event. `mask` has one bit for each axis that has a value in `values`, in
    /// order. The other axes keep their values, and bits without a value are ignored.
    pub(super) fn update(&mut self, mask: &[u32], values: impl IntoIterator<Item = f64>) {
        let numbers = (0_u16..).zip(mask).flat_map(|(word, &bits)| {
            (0_u16..32).filter(move |bit| bits >> bit & 1 == 1).map(move |bit| 32 * word + bit)
        });
        for (number, value) in numbers.zip(values) {
            for valuator in self.0.iter_mut().filter(|valuator| valuator.number == number) {
                valuator.value = value;
            }
        }
    }

    /// State of the stylus at a point of the window.
    pub(super) fn state(&self, at: Pos2) -> PointerState {
        let normalized = |axis| {
            let valuator = self.0.iter().find(|valuator| valuator.axis == axis);
            valuator.and_then(Valuator::normalized)
        };
        PointerState {
            at,
            pressure: normalized(Axis::Pressure),
            tilt_deg: normalized(Axis::TiltX).zip(normalized(Axis::TiltY)),
            twist_deg: normalized(Axis::Twist),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wacom() -> Valuators {
        let one = |number, axis, range| Valuator { number, axis, range, value: 0.0 };
        Valuators(vec![
            one(2, Axis::Pressure, (0.0, 65536.0)),
            one(3, Axis::TiltX, (-64.0, 63.0)),
            one(4, Axis::TiltY, (-64.0, 63.0)),
            one(5, Axis::Twist, (-900.0, 899.0)),
        ])
    }

    #[test]
    fn an_event_updates_its_axes_and_keeps_the_others() {
        let mut pen = wacom();
        // Axes 0, 2 and 4.
        pen.update(&[0b1_0101], [123.0, 16384.0, -20.0]);
        pen.update(&[0b10_1000], [30.0, 450.0]);
        let state = pen.state(Pos2::ZERO);
        assert_eq!((state.pressure, state.tilt_deg), (Some(0.25), Some((30.0, -20.0))));
        let twist = state.twist_deg.unwrap_or_default();
        assert!((twist - 90.0).abs() < 0.1, "{twist}");
    }

    #[test]
    fn invalid_masks_and_ranges_are_harmless() {
        let mut pen = wacom();
        // More bits than values, and axes that the device does not have.
        pen.update(&[u32::MAX, u32::MAX], [0.0, 0.0, 32768.0]);
        pen.update(&[], [1.0]);
        assert_eq!(pen.state(Pos2::ZERO).pressure, Some(0.5));
        pen.update(&[0, 0b100], [0.0]);
        assert_eq!(pen.state(Pos2::ZERO).pressure, Some(0.5));
        pen.update(&[0b100], [1e9]);
        assert_eq!(pen.state(Pos2::ZERO).pressure, Some(1.0));
        for range in [(0.0, 0.0), (5.0, -5.0), (0.0, f64::NAN), (0.0, f64::INFINITY)] {
            pen.0[0].range = range;
            assert_eq!(pen.state(Pos2::ZERO).pressure, None, "{range:?}");
        }
        pen.0[1].value = f64::NAN;
        assert_eq!(pen.state(Pos2::ZERO).tilt_deg, None);
        // A pressure range that does not start at 0, and tilt in another unit.
        let normalized = |axis, range, value| {
            Valuator { number: 0, axis, range, value }.normalized().unwrap_or(f64::NAN)
        };
        assert_eq!(normalized(Axis::Pressure, (100.0, 300.0), 150.0), 0.25);
        assert_eq!(normalized(Axis::TiltX, (-9000.0, 9000.0), -4500.0), -30.0);
    }

    #[test]
    fn a_device_with_pressure_is_a_stylus() {
        let labels = ["Abs X", "Abs Y", "Abs Pressure", "Abs Tilt X", "Rel Horiz Scroll"];
        let axes: Vec<Option<Axis>> = labels.iter().map(|label| Axis::labelled(label)).collect();
        assert_eq!(axes, [None, None, Some(Axis::Pressure), Some(Axis::TiltX), None]);
        assert!(wacom().is_pen());
        assert!(!Valuators(wacom().0.split_off(1)).is_pen());
    }
}
