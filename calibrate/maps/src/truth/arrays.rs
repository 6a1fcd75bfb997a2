//! The arrays of truth on the disk.

use serde_json::{Map, Value, json};

use super::paint_class::PaintClass;

/// Title by which the group is known.
pub(super) const TITLE: &str = "truth of a simulated scan";

/// An array of truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TruthArray {
    Share,
    Ground,
    MeanReflectance,
    Class,
}

impl TruthArray {
    pub(super) const ALL: [Self; 4] =
        [Self::Share, Self::Ground, Self::MeanReflectance, Self::Class];

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Share => "share",
            Self::Ground => "ground",
            Self::MeanReflectance => "mean_reflectance",
            Self::Class => "class",
        }
    }

    pub(super) const fn data_type(self) -> &'static str {
        match self {
            Self::Class => "uint8",
            _ => "float32",
        }
    }

    /// Bytes of a number.
    pub(super) const fn bytes(self) -> usize {
        match self {
            Self::Class => 1,
            _ => 4,
        }
    }

    /// Sizes of the array, or of a part of it, for `down` x `across` pixels.
    pub(super) fn sizes(self, down: usize, across: usize, pigments: usize) -> Vec<usize> {
        match self {
            Self::Share => vec![down, across, pigments],
            _ => vec![down, across],
        }
    }

    pub(super) const fn dimensions(self) -> &'static [&'static str] {
        match self {
            Self::Share => &["y", "x", "pigment"],
            _ => &["y", "x"],
        }
    }

    pub(super) fn attributes(self) -> Map<String, Value> {
        let attributes = match self {
            Self::Share => json!({
                "long_name": "share of the pigment in the paint that is seen", "units": "1"
            }),
            Self::Ground => {
                json!({"long_name": "part of the ground in what is seen", "units": "1"})
            }
            Self::MeanReflectance => {
                json!({"long_name": "mean reflectance over the bands, without noise", "units": "1"})
            }
            Self::Class => json!({
                "long_name": "kind of the paint",
                "flag_values": PaintClass::ALL.map(PaintClass::code),
                "flag_meanings": PaintClass::ALL.map(PaintClass::name).join(" ")
            }),
        };
        match attributes {
            Value::Object(map) => map,
            _ => Map::new(),
        }
    }
}
