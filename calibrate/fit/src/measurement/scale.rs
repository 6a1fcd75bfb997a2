//! Unit of reflectance in a file: percent or fraction.

use serde::{Deserialize, Serialize};

/// Unit in which a file writes reflectance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Scale {
    /// A white reads about 100.
    Percent,
    /// A white reads about 1.
    Fraction,
}

/// How the unit of a file is determined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ScaleChoice {
    /// By the largest value of the whole file: above 2 the unit is percent.
    #[default]
    ByFile,
    /// The unit is known.
    Known(Scale),
}

impl Scale {
    pub(super) fn of_largest(largest: f64) -> Self {
        if largest > 2.0 { Self::Percent } else { Self::Fraction }
    }

    /// Factor that converts values to fractions.
    pub(super) fn to_fraction(self) -> f64 {
        match self {
            Self::Percent => 0.01,
            Self::Fraction => 1.0,
        }
    }

    pub(super) fn range(self) -> &'static str {
        match self {
            Self::Percent => "from 0 to 200 %",
            Self::Fraction => "from 0 to 2",
        }
    }
}
