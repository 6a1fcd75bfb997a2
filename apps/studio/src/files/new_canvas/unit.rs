//! Units of lengths that a painter chooses from.

use serde::{Deserialize, Serialize};

/// A unit of lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LengthUnit {
    /// Lengths in millimetres.
    #[default]
    Mm,
    /// Lengths in centimetres.
    Cm,
    /// Inches of 25.4 mm.
    Inch,
}

impl LengthUnit {
    /// Every unit, the smallest first.
    pub(crate) const ALL: [Self; 3] = [Self::Mm, Self::Cm, Self::Inch];

    /// The sign after a number.
    #[must_use]
    pub(crate) fn sign(self) -> &'static str {
        match self {
            Self::Mm => "mm",
            Self::Cm => "cm",
            Self::Inch => "in",
        }
    }

    /// Length of one of them in mm.
    #[must_use]
    pub(crate) fn in_mm(self) -> f64 {
        match self {
            Self::Mm => 1.0,
            Self::Cm => 10.0,
            Self::Inch => 25.4,
        }
    }
}
