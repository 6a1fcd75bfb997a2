//! Settings of the stabiliser, which steadies the way of a brush.

use serde::{Deserialize, Serialize};

/// Lengths that a stabiliser can have, in either unit.
const LENGTHS: std::ops::RangeInclusive<f64> = 0.1..=500.0;

/// The way in which the brush follows the pen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StabiliserMethod {
    /// The brush is where the pen is.
    #[default]
    Off,
    /// The brush is at the mean of the last length of the pen's way.
    Average,
    /// The pen pulls the brush by a string of this length.
    String,
}

/// Unit of the length of a stabiliser.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LengthUnit {
    /// Millimetres of the surface, whatever its zoom.
    #[default]
    Mm,
    /// Points of the window, which are pixels where the interface is not scaled.
    Px,
}

/// How far and in which way a brush stays behind its pen.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StabiliserSettings {
    /// The way in which the brush follows.
    pub method: StabiliserMethod,
    /// Length of the averaged way or of the string, 0.1 to 500.
    pub length: f64,
    /// Unit of the length.
    pub unit: LengthUnit,
}

impl Default for StabiliserSettings {
    /// Off; 4 mm once it is switched on.
    fn default() -> Self {
        Self { method: StabiliserMethod::Off, length: 4.0, unit: LengthUnit::Mm }
    }
}

impl StabiliserSettings {
    /// Whether the length is in its range.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        LENGTHS.contains(&self.length)
    }

    /// Replaces a length that is out of range by the default.
    pub fn bound(&mut self) {
        if !self.is_valid() {
            (self.length, self.unit) = (Self::default().length, Self::default().unit);
        }
    }
}
