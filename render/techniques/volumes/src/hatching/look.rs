//! How hatching looks.

/// Where strokes lie on surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coordinates {
    /// Along the model's own texture coordinate u, one tile of strokes a tile of texture.
    Own,
    /// Projected along the three axes, each where the surface faces it.
    ThreePlanes,
}

/// How hatching looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HatchingLook {
    /// Where strokes lie on surfaces; `None` takes the model's own texture coordinates if they
    /// are useful ([`super::has_useful_coordinates`]).
    pub coordinates: Option<Coordinates>,
    /// Share of the strokes that is shown inside of volumes, 0 to 1; 0 is no hatching.
    pub inside: f32,
    /// Share of the strokes that is shown outside of volumes, 0 to 1.
    pub outside: f32,
    /// Factor of the colour under full ink, 0 to 1.
    pub pencil: f32,
    /// Width of a stroke in pixels, 1 to 16; it varies by a third either way.
    pub width_px: f32,
    /// Half the range of tone over which a texel takes ink, 0.01 to 0.15; greater is softer.
    pub softness: f32,
    /// Tone of the darkest shade, 0 to 1: 0 leaves no paper between the strokes.
    pub darkest: f32,
    /// Angle of the strokes in the three planes, in degrees from the horizontal.
    pub angle_deg: f32,
}

impl Default for HatchingLook {
    /// Pencil strokes 2.8 pixels wide that slant like those of a right hand.
    fn default() -> Self {
        Self {
            coordinates: None,
            inside: 1.0,
            outside: 1.0,
            pencil: 0.15,
            width_px: 2.8,
            softness: 0.12,
            darkest: 0.15,
            angle_deg: 32.0,
        }
    }
}
