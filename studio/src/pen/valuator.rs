//! Axes of a pen as X tells them: numbers in some range, by label.

use super::report::Hold;
use eframe::egui::Pos2;

/// What an axis is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Axis {
    /// How hard the tip is pressed.
    Pressure,
    /// Lean to the right.
    TiltX,
    /// Lean to the lower edge.
    TiltY,
    /// Turn of the barrel.
    Twist,
}

impl Axis {
    /// The axis of a label of the X server's input drivers, if it is one of
    /// these (xserver-properties.h).
    pub(super) fn labelled(label: &str) -> Option<Self> {
        match label {
            "Abs Pressure" => Some(Self::Pressure),
            "Abs Tilt X" => Some(Self::TiltX),
            "Abs Tilt Y" => Some(Self::TiltY),
            // The first is of the Wacom driver, the second of libinput's.
            "Abs Wheel" | "Abs Rotary Z" => Some(Self::Twist),
            _ => None,
        }
    }
}

/// One axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Valuator {
    /// Its number, by which events tell it.
    pub(super) number: u16,
    /// What it is.
    pub(super) axis: Axis,
    /// Its range, as the server tells it.
    pub(super) range: (f64, f64),
    /// What it was last.
    pub(super) value: f64,
}

impl Valuator {
    /// Pressure 0..1 or an angle in degrees; `None` if the range or the value
    /// makes no sense.
    fn read(&self) -> Option<f64> {
        let (lowest, highest) = self.range;
        let span = highest - lowest;
        if !(span.is_finite() && span > 0.0 && self.value.is_finite()) {
            return None;
        }
        let value = self.value.clamp(lowest, highest);
        Some(match self.axis {
            Axis::Pressure => (value - lowest) / span,
            // Drivers tell degrees, within 64 of upright; what goes beyond 90 is
            // taken for shares of 60.
            Axis::TiltX | Axis::TiltY => {
                let most = lowest.abs().max(highest.abs());
                if most <= 90.0 { value } else { value / most * 60.0 }
            }
            Axis::Twist => value / span * 360.0,
        })
    }
}

/// The axes of one end of a pen.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Valuators(pub(super) Vec<Valuator>);

impl Valuators {
    /// Whether it is a pen at all.
    pub(super) fn is_pen(&self) -> bool {
        self.0.iter().any(|valuator| valuator.axis == Axis::Pressure)
    }

    /// Takes in an event: `mask` has a bit for each axis that `values` tells, in
    /// order. The others stay. Bits without a value tell nothing.
    pub(super) fn take(&mut self, mask: &[u32], values: impl IntoIterator<Item = f64>) {
        let numbers = (0_u16..).zip(mask).flat_map(|(word, &bits)| {
            (0_u16..32).filter(move |bit| bits >> bit & 1 == 1).map(move |bit| 32 * word + bit)
        });
        for (number, value) in numbers.zip(values) {
            for valuator in self.0.iter_mut().filter(|valuator| valuator.number == number) {
                valuator.value = value;
            }
        }
    }

    /// How the pen is held, at a point of the window.
    pub(super) fn hold(&self, at: Pos2) -> Hold {
        let read = |axis| {
            let valuator = self.0.iter().find(|valuator| valuator.axis == axis);
            valuator.and_then(Valuator::read)
        };
        Hold {
            at,
            pressure: read(Axis::Pressure),
            tilt_deg: read(Axis::TiltX).zip(read(Axis::TiltY)),
            twist_deg: read(Axis::Twist),
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
    fn events_tell_some_axes_and_the_others_stay() {
        let mut pen = wacom();
        // Axes 0, 2 and 4.
        pen.take(&[0b1_0101], [123.0, 16384.0, -20.0]);
        pen.take(&[0b10_1000], [30.0, 450.0]);
        let hold = pen.hold(Pos2::ZERO);
        assert_eq!((hold.pressure, hold.tilt_deg), (Some(0.25), Some((30.0, -20.0))));
        let twist = hold.twist_deg.unwrap_or_default();
        assert!((twist - 90.0).abs() < 0.1, "{twist}");
    }

    #[test]
    fn broken_masks_and_ranges_do_no_harm() {
        let mut pen = wacom();
        // More bits than values, and axes that nobody has.
        pen.take(&[u32::MAX, u32::MAX], [0.0, 0.0, 32768.0]);
        pen.take(&[], [1.0]);
        assert_eq!(pen.hold(Pos2::ZERO).pressure, Some(0.5));
        pen.take(&[0, 0b100], [0.0]);
        assert_eq!(pen.hold(Pos2::ZERO).pressure, Some(0.5));
        pen.take(&[0b100], [1e9]);
        assert_eq!(pen.hold(Pos2::ZERO).pressure, Some(1.0));
        for range in [(0.0, 0.0), (5.0, -5.0), (0.0, f64::NAN), (0.0, f64::INFINITY)] {
            pen.0[0].range = range;
            assert_eq!(pen.hold(Pos2::ZERO).pressure, None, "{range:?}");
        }
        pen.0[1].value = f64::NAN;
        assert_eq!(pen.hold(Pos2::ZERO).tilt_deg, None);
        // An axis told as 0..1 pressure of 0 to 2047, or tilt in other units.
        let odd = |axis, range, value| {
            Valuator { number: 0, axis, range, value }.read().unwrap_or(f64::NAN)
        };
        assert_eq!(odd(Axis::Pressure, (100.0, 300.0), 150.0), 0.25);
        assert_eq!(odd(Axis::TiltX, (-9000.0, 9000.0), -4500.0), -30.0);
    }

    #[test]
    fn a_pen_is_what_tells_pressure() {
        let labels = ["Abs X", "Abs Y", "Abs Pressure", "Abs Tilt X", "Rel Horiz Scroll"];
        let axes: Vec<Option<Axis>> = labels.iter().map(|label| Axis::labelled(label)).collect();
        assert_eq!(axes, [None, None, Some(Axis::Pressure), Some(Axis::TiltX), None]);
        assert!(wacom().is_pen());
        assert!(!Valuators(wacom().0.split_off(1)).is_pen());
    }
}
