//! Tristimulus values and chromaticity.

/// CIE tristimulus values, Y = 100 for the white.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Xyz {
    /// X.
    pub x: f64,
    /// Y, the luminance factor in percent.
    pub y: f64,
    /// Z.
    pub z: f64,
}

/// Chromaticity x, y with the luminance factor Y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Xyy {
    /// Chromaticity x, 0..1 for real colours.
    pub x: f64,
    /// Chromaticity y, 0..1 for real colours.
    pub y: f64,
    /// Luminance factor, 100 for the white.
    pub luminance: f64,
}

impl Xyz {
    /// The three values in order.
    #[must_use]
    pub fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }

    /// Chromaticity and luminance. Black, which has no chromaticity of its own,
    /// takes that of `white`.
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
    /// A chromaticity with y = 0 has no finite X and Z; it gives black.
    fn from(xyy: Xyy) -> Self {
        if xyy.y == 0.0 {
            return Self::default();
        }
        let scale = xyy.luminance / xyy.y;
        Self { x: xyy.x * scale, y: xyy.luminance, z: (1.0 - xyy.x - xyy.y) * scale }
    }
}
