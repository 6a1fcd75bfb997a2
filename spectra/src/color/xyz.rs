//! Tristimulus values and chromaticity.

/// Tristimulus values of the CIE, scaled so that the white has Y = 100.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Xyz {
    /// Tristimulus value X, 0 and up.
    pub x: f64,
    /// Tristimulus value Y: the luminance factor in percent.
    pub y: f64,
    /// Tristimulus value Z, 0 and up.
    pub z: f64,
}

/// Chromaticity x, y and luminance factor Y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Xyy {
    /// Chromaticity x, 0 to 1 for real colours.
    pub x: f64,
    /// Chromaticity y, 0 to 1 for real colours.
    pub y: f64,
    /// Luminance factor in percent, 100 for the white.
    pub luminance: f64,
}

impl Xyz {
    /// X, Y and Z in this order.
    #[must_use]
    pub fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }

    /// Chromaticity and luminance. Black gets the chromaticity of `white`.
    #[must_use]
    pub fn to_xyy(self, white: Self) -> Xyy {
        let total = self.x + self.y + self.z;
        let (of, total) =
            if total == 0.0 { (white, white.x + white.y + white.z) } else { (self, total) };
        Xyy { x: of.x / total, y: of.y / total, luminance: self.y }
    }
}

impl From<[f64; 3]> for Xyz {
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self { x, y, z }
    }
}

impl From<Xyy> for Xyz {
    /// Converts to XYZ. A chromaticity with y = 0 has no finite X and Z and gives black.
    fn from(xyy: Xyy) -> Self {
        if xyy.y == 0.0 {
            return Self::default();
        }
        let scale = xyy.luminance / xyy.y;
        Self { x: xyy.x * scale, y: xyy.luminance, z: (1.0 - xyy.x - xyy.y) * scale }
    }
}
