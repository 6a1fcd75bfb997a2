//! Position and attitude of a brush: a pen's sample in mm, and a pose in cells.

/// Position and attitude of a brush at one moment, as a pen reports it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Seconds since the stroke began; never less than in the sample before.
    pub seconds: f64,
    /// Distance in mm from the left edge of the canvas to the middle of
    /// what the brush touches.
    pub x_mm: f64,
    /// Distance in mm from the upper edge of the canvas to that point.
    pub y_mm: f64,
    /// Pressure from 0 (just above the canvas) to 1 (as far down as the head bends).
    pub pressure: f64,
    /// Tilt of the handle to the right, -90 to 90 degrees from upright.
    pub tilt_x_deg: f64,
    /// Tilt of the handle towards the lower edge, -90 to 90 degrees from upright.
    pub tilt_y_deg: f64,
    /// Rotation about the handle in degrees, clockwise seen from above; at 0 the broad
    /// side of a flat head runs along x.
    pub twist_deg: f64,
}

impl Sample {
    /// A sample of an upright brush.
    #[must_use]
    pub const fn upright(seconds: f64, x_mm: f64, y_mm: f64, pressure: f64) -> Self {
        let tilt_x_deg = 0.0;
        let tilt_y_deg = 0.0;
        let twist_deg = 0.0;
        Self { seconds, x_mm, y_mm, pressure, tilt_x_deg, tilt_y_deg, twist_deg }
    }
}

/// Position and attitude of a brush at one sub-step, with positions in cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Distance in cells from the left edge of the canvas to the middle of
    /// what the brush touches.
    pub x: f64,
    /// Distance in cells from the upper edge of the canvas to that point.
    pub y: f64,
    /// Pressure from 0 (just above the canvas) to 1 (as far down as the head bends).
    pub pressure: f64,
    /// Tilt of the handle to the right, in degrees from upright.
    pub tilt_x_deg: f64,
    /// Tilt of the handle towards the lower edge, in degrees from upright.
    pub tilt_y_deg: f64,
    /// Rotation about the handle in degrees, clockwise seen from above.
    pub twist_deg: f64,
}

impl Pose {
    /// Whether all numbers are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let numbers =
            [self.x, self.y, self.pressure, self.tilt_x_deg, self.tilt_y_deg, self.twist_deg];
        numbers.iter().all(|number| number.is_finite())
    }
}

impl Sample {
    /// Converts the position to cells that are `cell_mm` wide.
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
