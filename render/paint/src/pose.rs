//! Where a brush is held.

/// A brush at one moment, as a pen tells it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Seconds since the stroke began, never falling.
    pub seconds: f64,
    /// From the left edge of the canvas to where the tip would touch, in mm.
    pub x_mm: f64,
    /// From the upper edge, in mm.
    pub y_mm: f64,
    /// 0 (just above the canvas) to 1 (as far down as the head bends).
    pub pressure: f64,
    /// Lean to the right, -90..90 degrees from upright.
    pub tilt_x_deg: f64,
    /// Lean towards the lower edge, -90..90 degrees from upright.
    pub tilt_y_deg: f64,
    /// Turn about the handle, clockwise seen from above, in degrees; at 0 the
    /// broad side of a flat head runs along x.
    pub twist_deg: f64,
}

/// Where a brush is at one sub-step, in cells of the canvas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// From the left edge to where the tip would touch, in cells.
    pub x: f64,
    /// From the upper edge, in cells.
    pub y: f64,
    /// As in [`Sample`].
    pub pressure: f64,
    /// As in [`Sample`].
    pub tilt_x_deg: f64,
    /// As in [`Sample`].
    pub tilt_y_deg: f64,
    /// As in [`Sample`].
    pub twist_deg: f64,
}

impl Pose {
    /// Whether every number is one.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let numbers =
            [self.x, self.y, self.pressure, self.tilt_x_deg, self.tilt_y_deg, self.twist_deg];
        numbers.iter().all(|number| number.is_finite())
    }
}

impl Sample {
    /// The pose over cells that are `cell_mm` wide.
    #[must_use]
    pub fn pose(&self, cell_mm: f64) -> Pose {
        Pose {
            x: self.x_mm / cell_mm,
            y: self.y_mm / cell_mm,
            pressure: self.pressure,
            tilt_x_deg: self.tilt_x_deg,
            tilt_y_deg: self.tilt_y_deg,
            twist_deg: self.twist_deg,
        }
    }
}
