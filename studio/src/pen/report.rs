//! What a source tells, before anything is made of it.

use std::time::Instant;

use eframe::egui::Pos2;

/// What the painter holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Device {
    /// A mouse, or anything that acts as one.
    Mouse,
    /// A finger.
    Touch,
    /// The tip of a pen.
    Pen,
    /// The other end of a pen.
    Eraser,
}

impl Device {
    /// Whether it is an end of a pen.
    #[must_use]
    pub const fn is_pen(self) -> bool {
        matches!(self, Self::Pen | Self::Eraser)
    }
}

/// How it is held. What a device cannot tell is `None`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hold {
    /// Where, in points of the window.
    pub at: Pos2,
    /// 0..1.
    pub pressure: Option<f64>,
    /// Lean to the right of the window and to its lower edge, in degrees from
    /// upright.
    pub tilt_deg: Option<(f64, f64)>,
    /// Turn about its own axis, clockwise from above, in degrees.
    pub twist_deg: Option<f64>,
}

impl Hold {
    /// Something that tells no more than its place.
    #[must_use]
    pub const fn at(at: Pos2) -> Self {
        Self { at, pressure: None, tilt_deg: None, twist_deg: None }
    }

    /// Whether every number is one.
    pub(super) fn is_finite(&self) -> bool {
        let (tilt_x, tilt_y) = self.tilt_deg.unwrap_or_default();
        let rest = [self.pressure.unwrap_or_default(), self.twist_deg.unwrap_or_default()];
        self.at.is_finite()
            && tilt_x.is_finite()
            && tilt_y.is_finite()
            && rest.iter().all(|number| number.is_finite())
    }
}

/// What happened.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum What {
    /// It is here now.
    Moved(Hold),
    /// It touched down, or its button was pressed.
    Pressed(Hold),
    /// It was lifted.
    Released,
    /// It went out of reach.
    Gone,
    /// A button on the barrel of a pen; the one nearer to the tip is 0.
    Barrel {
        /// Which.
        button: usize,
        /// Whether it is down now.
        pressed: bool,
    },
}

/// What a source tells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// Of what.
    pub device: Device,
    /// When it happened, as well as that can be known.
    pub arrived: Instant,
    /// What happened.
    pub what: What,
}
