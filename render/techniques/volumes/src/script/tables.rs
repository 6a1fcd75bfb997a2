//! Tables of a script: regions, walls, and what is done at which time.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::rows::{Ball, Pair, Row};
use crate::settings::Inside;

/// `[[region]]`: volumes with their own drawing.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RegionTable {
    /// Its name, which other tables use.
    pub name: String,
    /// How the scene looks inside of its volumes. Without it, this comes from the settings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inside: Option<Inside>,
    /// Sizes of the shells, falling. Without it, these come from the settings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shells: Option<Vec<f64>>,
    /// Share of colour by the number of shells, rising. Without it, this comes from the settings.
    /// If you give `shells`, the steps are even.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tint: Option<Vec<f64>>,
    /// Inside of volumes we multiply the grey drawing by this colour, and then lay the scene's own
    /// colours over it. Without it, this comes from the settings. You cannot use it with pigments.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stain: Option<String>,
}

/// `[[keep]]`: volumes stay inside. You give one of the three keys.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeepTable {
    /// Lower and upper corner of a box.
    #[serde(default, rename = "box", skip_serializing_if = "Option::is_none")]
    pub cuboid: Option<Pair>,
    /// Volumes stay in this sphere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Ball>,
    /// A point and the normal of a plane. Volumes stay above it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub above: Option<Pair>,
}

/// `[[volume]]`: a single volume.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct VolumeTable {
    /// Its centre in the unit of the scene.
    #[serde(rename = "centre")]
    pub center: Row<3>,
    /// Its radius in the unit of the scene, above 0 up to 1e6.
    pub radius: f64,
    /// Level of detail of its mesh, 0 to 5. Without it, this is 3.
    #[serde(default = "usual_detail")]
    pub detail: u8,
    /// Time at which it begins in seconds, 0 to 3600.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub from_s: f64,
    /// Name of its region. Without it, this is the first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub region: Option<String>,
    /// Pigments by their letters in the palette, with their parts. Without a palette it is empty.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub recipe: BTreeMap<String, f64>,
}

/// `[[pour]]`: paint that you pour. You give one of `at`, `picked` and `path`, and one of
/// `amount_mm3` and `rate_mm3_s`. Beside a `path`, `at` may repeat its first place.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PourTable {
    /// Place in the unit of the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<Row<3>>,
    /// Place in the first picture, as shares of its width from the left and its height from the
    /// top, 0 to 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picked: Option<Row<2>>,
    /// Seconds since its start, then place. Use this for a moving source.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub path: Vec<Row<4>>,
    /// Time at which it starts in seconds, 0 to 3600.
    #[serde(default)]
    pub from_s: f64,
    /// Duration in seconds, 0 to 3600.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub for_s: f64,
    /// Amount of paint in mm3, above 0 up to 1e9.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub amount_mm3: Option<f64>,
    /// Amount of paint per second in mm3/s, above 0 up to 1e9. You can give this instead of the
    /// amount.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate_mm3_s: Option<f64>,
    /// Name of its region. Without it, this is the first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub region: Option<String>,
    /// Pigments by their letters in the palette, with their parts. Without a palette it is empty.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub recipe: BTreeMap<String, f64>,
}

/// `[[push]]`: air that pushes volumes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PushTable {
    /// Centre of the ball that it pushes, in the unit of the scene.
    pub at: Row<3>,
    /// Direction of the push, of any length above 0.
    pub towards: Row<3>,
    /// Radius of the ball in the unit of the scene, above 0 up to 1e6.
    pub radius: f64,
    /// Acceleration in cells per second squared, 0 to 1e6.
    pub strength: f64,
    /// Time at which it starts in seconds, 0 to 3600.
    #[serde(default)]
    pub from_s: f64,
    /// Duration in seconds, above 0 up to 3600.
    pub for_s: f64,
}

/// `[[lift]]`: a sponge that takes paint up. You give one of `at`, `picked` and `path`, as in a
/// [`PourTable`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LiftTable {
    /// Place in the unit of the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<Row<3>>,
    /// Place in the first picture, as shares of its width from the left and its height from the
    /// top, 0 to 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picked: Option<Row<2>>,
    /// Seconds since its start, then place. Use this for a moving sponge.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub path: Vec<Row<4>>,
    /// Radius of the sponge in the unit of the scene, above 0 up to 1e6.
    pub radius: f64,
    /// Time at which it starts in seconds, 0 to 3600.
    #[serde(default)]
    pub from_s: f64,
    /// Duration in seconds, 0 to 3600.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub for_s: f64,
    /// Share of the paint below it that it takes up per second, 0 to 120. Without it, this is 120,
    /// which takes all at once.
    #[serde(default = "all_at_once")]
    pub rate: f64,
}

/// `[[split]]`: a single volume becomes volumes of the grid.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SplitTable {
    /// Time in seconds, 0 to 3600.
    pub at_s: f64,
    /// Number of the single volume in the script, from 1. Without it, all split.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub volume: Option<u32>,
}

/// `[[dry]]`: paint on the scene dries. Give `at` and `radius` together to dry the volumes in a
/// ball only.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DryTable {
    /// Time in seconds, 0 to 3600.
    pub at_s: f64,
    /// Centre of the ball in the unit of the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<Row<3>>,
    /// Radius of the ball in the unit of the scene, above 0 up to 1e6.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
}

fn all_at_once() -> f64 {
    120.0
}

fn usual_detail() -> u8 {
    3
}

fn is_zero(seconds: &f64) -> bool {
    *seconds == 0.0
}
