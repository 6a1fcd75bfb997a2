//! A stroke in the picture.

/// A splat of brushwork in the picture: an ellipse with a part of the map.
///
/// Coordinates across and along the stroke are 0 at the centre; the splat ends where the sum of
/// their squares is 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeSplat {
    /// Distance of the centre from the left edge, in pixels.
    pub x: f32,
    /// Distance of the centre from the upper edge, in pixels.
    pub y: f32,
    /// Change of the coordinate across the stroke per pixel to the right and downwards.
    pub across: [f32; 2],
    /// Change of the coordinate along the stroke per pixel to the right and downwards.
    pub along: [f32; 2],
    /// Half the width and height of the ellipse's bounding box, in pixels.
    pub reach: [f32; 2],
    /// Depth of the centre, 0 (near plane) to 1 (far plane).
    pub depth: f32,
    /// Change of depth on the splat's plane per pixel to the right and downwards.
    pub slope: [f32; 2],
    /// Depth within which surfaces count as the same.
    pub tolerance: f32,
    /// Weight at the centre against other splats, above 0: up to 1, and more for outlines.
    pub weight: f32,
    /// Part in the cover beyond outlines at the centre, above 0 to 1.
    pub cover: f32,
    /// Place in the map at the centre, in widths of the map.
    pub offset: [f32; 2],
    /// Change of the place per unit across and along the stroke, in widths of the map.
    pub extent: [f32; 2],
    /// Tone of the stroke as an index of the map's slices.
    pub slice: u32,
    /// How often the map is halved in size.
    pub halvings: u32,
    /// Colour that is added to the map's.
    pub color: [f32; 3],
}

impl StrokeSplat {
    /// Angle of the stroke in the picture in radians: 0 to the right, positive downwards.
    #[must_use]
    pub fn turn(&self) -> f32 {
        // The inverse of the coordinates' matrix, up to its sign and size.
        let size = self.across[0] * self.along[1] - self.across[1] * self.along[0];
        (self.across[0] * size.signum()).atan2(-self.across[1] * size.signum())
    }
}
