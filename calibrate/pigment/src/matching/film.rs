//! The film that a recipe makes.

/// Film that a recipe will make.
#[derive(Debug, Clone, PartialEq)]
pub enum FilmKind {
    /// So thick that its ground does not show.
    Hiding,
    /// A film over a ground.
    Over {
        /// Measured reflectance of the bare ground on the library's grid.
        ground: Vec<f64>,
        /// Thickness, or a range in which the search chooses it.
        thickness: Thickness,
    },
}

/// Thickness of a film in the library's unit: 1 is the thickness at which the reference white has
/// S d = 1; for absolute amounts, the sum of all amounts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Thickness {
    /// This thickness, above 0.
    Fixed(f64),
    /// The search chooses within this range, least to greatest.
    Between(f64, f64),
}

impl Thickness {
    /// Least and greatest thickness.
    #[must_use]
    pub fn bounds(self) -> (f64, f64) {
        match self {
            Self::Fixed(thickness) => (thickness, thickness),
            Self::Between(least, most) => (least, most),
        }
    }
}
