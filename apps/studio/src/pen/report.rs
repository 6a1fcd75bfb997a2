//! Reports of input devices, before they become strokes.

use web_time::Instant;

use eframe::egui::Pos2;

/// The device that the painter uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Device {
    /// A mouse, or a device that acts as one.
    Mouse,
    /// A finger on a touch screen.
    Touch,
    /// The tip of a stylus.
    Pen,
    /// The eraser end of a stylus.
    Eraser,
}

impl Device {
    /// Whether this is a stylus, held either way round.
    #[must_use]
    pub const fn is_pen(self) -> bool {
        matches!(self, Self::Pen | Self::Eraser)
    }
}

/// Position and attitude of a device. A quantity that the device does not measure is
/// `None`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointerState {
    /// Position in points of the window.
    pub at: Pos2,
    /// Pressure, 0 to 1.
    pub pressure: Option<f64>,
    /// Tilt towards the right and the lower edge of the window, in degrees from upright.
    pub tilt_deg: Option<(f64, f64)>,
    /// Rotation about the device's own axis, clockwise from above, in degrees.
    pub twist_deg: Option<f64>,
}

impl PointerState {
    /// State of a device that measures only its position.
    #[must_use]
    pub const fn at(at: Pos2) -> Self {
        Self { at, pressure: None, tilt_deg: None, twist_deg: None }
    }

    /// Whether every value is finite.
    pub(super) fn is_finite(&self) -> bool {
        let (tilt_x, tilt_y) = self.tilt_deg.unwrap_or_default();
        let rest = [self.pressure.unwrap_or_default(), self.twist_deg.unwrap_or_default()];
        self.at.is_finite()
            && tilt_x.is_finite()
            && tilt_y.is_finite()
            && rest.iter().all(|number| number.is_finite())
    }
}

/// The event that a report describes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ReportKind {
    /// The device moved to this state.
    Moved(PointerState),
    /// The device touched the surface, or its primary button was pressed.
    Pressed(PointerState),
    /// The device was lifted, or its primary button was released.
    Released,
    /// The device left the range in which the system can detect it.
    Gone,
    /// A button on the barrel of a stylus.
    Barrel {
        /// Button number; 0 is the button nearest to the tip.
        button: usize,
        /// Whether the button was pressed (or released).
        pressed: bool,
    },
}

/// One event of an input device.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// The device that caused the event.
    pub device: Device,
    /// Time of the event, as exactly as the system reports it.
    pub arrived: Instant,
    /// The event and the state of the device.
    pub kind: ReportKind,
}
