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
