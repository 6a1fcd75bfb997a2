//! How the mixture will be laid.

/// The film that a recipe will make.
#[derive(Debug, Clone, PartialEq)]
pub enum FilmKind {
    /// So thick that its ground does not show.
    Hiding,
    /// Over a ground.
    Over {
        /// The bare ground's measured reflectance on the library's grid.
        ground: Vec<f64>,
        /// The film's thickness.
        thickness: Thickness,
    },
}

/// The thickness of a film in the library's unit: 1 is where the reference white
/// has S d = 1; for absolute amounts, the sum of all amounts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Thickness {
    /// As told, above 0.
    Fixed(f64),
    /// The search chooses, from the first to the second.
    Between(f64, f64),
}

impl Thickness {
    /// The least and the greatest thickness.
    #[must_use]
    pub fn bounds(self) -> (f64, f64) {
        match self {
            Self::Fixed(thickness) => (thickness, thickness),
            Self::Between(least, most) => (least, most),
        }
    }
}
