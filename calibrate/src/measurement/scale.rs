//! Percent or fractions: told apart by the file as a whole.

use serde::{Deserialize, Serialize};

/// The unit in which a file writes reflectance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Scale {
    /// White near 100.
    Percent,
    /// White near 1.
    Fraction,
}

/// How the unit is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ScaleChoice {
    /// By the largest value of the whole file: above 2 it is percent.
    #[default]
    ByFile,
    /// As told.
    Told(Scale),
}

impl Scale {
    pub(super) fn of_largest(largest: f64) -> Self {
        if largest > 2.0 { Self::Percent } else { Self::Fraction }
    }

    /// The factor that makes fractions.
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
