//! A script as it stands in its file.

use std::collections::BTreeMap;

use paint::ground::GroundSpec;
use serde::{Deserialize, Serialize};
use toml::Table;

use super::camera::CameraTable;
use super::tables::{
    DryTable, KeepTable, LiftTable, PourTable, PushTable, RegionTable, SplitTable, VolumeTable,
};
use crate::settings::Preset;

/// A script: the subject, its settings, and what is done to it in time. The key of each value in a
/// file is its name here; `center` is written `centre`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Script {
    /// The name `paint-volumes`.
    pub(super) format: FormatName,
    /// The version number 1.
    pub(super) version: FormatVersion,
    /// Title of the animation.
    #[serde(default)]
    pub title: String,
    /// `shape:NAME`, or the path of a model or photograph, relative to the script's folder.
    pub subject: String,
    /// Length of a unit of the scene in mm, above 0 up to 1e6; without it the longest side is
    /// 200 mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit_mm: Option<f64>,
    /// Duration in seconds, 0 to 3600.
    pub seconds: f64,
    /// Settings to start from; without it [`Preset::Sketch`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub preset: Option<Preset>,
    /// Library of the pigments: its file beside the script, or the title of the one that comes with
    /// the program.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub library: Option<String>,
    /// Light that pigments are seen under, such as `A` or `5600K`; without it D65.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub illuminant: Option<String>,
    /// File of the lamp that pigments are seen under instead, beside the script: `FILE`, or
    /// `FILE#NAME` for one spectrum of several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lamp: Option<String>,
    /// Pigments by their letters, at most eight; slots of paint are in the order of the letters.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub palette: BTreeMap<String, String>,
    /// The ground under pigments: linen, paper or panel; without it a panel with the white of the
    /// library.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ground: Option<GroundSpec>,
    /// Settings of the grid that differ from the preset's.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    pub grid: Table,
    /// Settings that differ from the preset's, by group.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    pub settings: Table,
    /// The camera; without it the subject is seen from the front and slightly above.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraTable>,
    /// Regions in the order in which they are composed, later over earlier.
    #[serde(default, rename = "region", skip_serializing_if = "Vec::is_empty")]
    pub regions: Vec<RegionTable>,
    /// Regions that volumes are kept in.
    #[serde(default, rename = "keep", skip_serializing_if = "Vec::is_empty")]
    pub keeps: Vec<KeepTable>,
    /// Single volumes, outside of the grid.
    #[serde(default, rename = "volume", skip_serializing_if = "Vec::is_empty")]
    pub volumes: Vec<VolumeTable>,
    /// Paint that is poured.
    #[serde(default, rename = "pour", skip_serializing_if = "Vec::is_empty")]
    pub pours: Vec<PourTable>,
    /// Air that pushes volumes.
    #[serde(default, rename = "push", skip_serializing_if = "Vec::is_empty")]
    pub pushes: Vec<PushTable>,
    /// Sponges that take paint up.
    #[serde(default, rename = "lift", skip_serializing_if = "Vec::is_empty")]
    pub lifts: Vec<LiftTable>,
    /// Single volumes that become volumes of the grid.
    #[serde(default, rename = "split", skip_serializing_if = "Vec::is_empty")]
    pub splits: Vec<SplitTable>,
    /// Paint that dries.
    #[serde(default, rename = "dry", skip_serializing_if = "Vec::is_empty")]
    pub dries: Vec<DryTable>,
}

impl Script {
    /// A script in which nothing happens. See the fields for `subject` and `seconds`.
    #[must_use]
    pub fn new(subject: &str, seconds: f64) -> Self {
        Self {
            format: FormatName::PaintVolumes,
            version: FormatVersion,
            title: String::new(),
            subject: subject.to_owned(),
            unit_mm: None,
            seconds,
            preset: None,
            library: None,
            illuminant: None,
            lamp: None,
            palette: BTreeMap::new(),
            ground: None,
            grid: Table::new(),
            settings: Table::new(),
            camera: None,
            regions: Vec::new(),
            keeps: Vec::new(),
            volumes: Vec::new(),
            pours: Vec::new(),
            pushes: Vec::new(),
            lifts: Vec::new(),
            splits: Vec::new(),
            dries: Vec::new(),
        }
    }
}

/// The name of the format; serde refuses any other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum FormatName {
    /// Written `paint-volumes` in a file.
    #[serde(rename = "paint-volumes")]
    PaintVolumes,
}

/// The version that is read and written; serde refuses any other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "u64", into = "u64")]
pub(super) struct FormatVersion;

impl FormatVersion {
    /// Version number in a file.
    pub(super) const NUMBER: u64 = 1;
}

impl From<FormatVersion> for u64 {
    fn from(_: FormatVersion) -> Self {
        FormatVersion::NUMBER
    }
}

impl TryFrom<u64> for FormatVersion {
    type Error = String;

    fn try_from(version: u64) -> Result<Self, String> {
        match version {
            Self::NUMBER => Ok(Self),
            _ => Err(format!("version takes {}, found `{version}`", Self::NUMBER)),
        }
    }
}
