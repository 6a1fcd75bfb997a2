//! A script: what there is, and what is done with it.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::action::Action;
use super::names::distinct_keys;
use super::palette::PaletteSpec;
use crate::brush::HeadShape;
use crate::document::{Lighting, Medium};
use crate::ground::GroundSpec;

/// A script of strokes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StrokeScript {
    /// Always `strokes`.
    pub(super) format: FormatName,
    /// Always 1.
    pub(super) version: FormatVersion,
    /// What is painted.
    #[serde(default)]
    pub title: String,
    /// Under which licence it may be used.
    #[serde(default)]
    pub licence: String,
    /// What is painted on.
    pub canvas: Canvas,
    /// What is mixed on, if on anything: the surface `palette` of actions. Its
    /// cells are as wide as the canvas's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mixing: Option<Canvas>,
    /// A painting (`.exr`) to go on with instead of a bare canvas, for whoever
    /// replays it to find; its size, pigments, medium and light are its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<String>,
    /// The binder; oil if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub medium: Option<Medium>,
    /// The light; daylight from the upper left if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lighting: Option<Lighting>,
    /// Which pigment library the script was made for: a path or a title, for
    /// whoever replays it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub library: Option<String>,
    /// The pigments at first.
    pub palette: PaletteSpec,
    /// Brushes by name.
    #[serde(deserialize_with = "distinct_keys")]
    pub brushes: BTreeMap<String, BrushSpec>,
    /// What is done, in this order.
    #[serde(deserialize_with = "super::rows::bounded_actions")]
    pub actions: Vec<Action>,
}

impl StrokeScript {
    /// A script without brushes and actions.
    #[must_use]
    pub fn new(title: &str, licence: &str, canvas: Canvas, palette: PaletteSpec) -> Self {
        Self {
            format: FormatName::Strokes,
            version: FormatVersion,
            title: title.to_owned(),
            licence: licence.to_owned(),
            canvas,
            mixing: None,
            start: None,
            medium: None,
            lighting: None,
            library: None,
            palette,
            brushes: BTreeMap::new(),
            actions: Vec::new(),
        }
    }

    /// All but the actions.
    #[must_use]
    pub fn header(&self) -> Self {
        let Self { format, version, title, licence, canvas, mixing, start, .. } = self;
        let Self { medium, lighting, library, palette, brushes, .. } = self;
        Self {
            format: *format,
            version: *version,
            title: title.clone(),
            licence: licence.clone(),
            canvas: canvas.clone(),
            mixing: mixing.clone(),
            start: start.clone(),
            medium: medium.clone(),
            lighting: lighting.clone(),
            library: library.clone(),
            palette: palette.clone(),
            brushes: brushes.clone(),
            actions: Vec::new(),
        }
    }
}

/// What is painted on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Canvas {
    /// Width in mm.
    pub width_mm: f64,
    /// Height in mm.
    pub height_mm: f64,
    /// Width and height of a cell in mm; 0.1 (254 to the inch) if not given.
    #[serde(default = "tenth")]
    pub cell_mm: f64,
    /// Its ground; linen if not given.
    #[serde(default)]
    pub ground: GroundSpec,
}

impl Canvas {
    /// Cells in a row and rows: as many as cover it, at least one.
    #[must_use]
    pub fn cells(&self) -> (usize, usize) {
        let Self { width_mm, height_mm, cell_mm, .. } = *self;
        (cells_within(width_mm, cell_mm), cells_within(height_mm, cell_mm))
    }

    pub(super) fn greatest_side_mm(&self) -> f64 {
        self.width_mm.max(self.height_mm)
    }
}

/// As many cells as cover a side.
pub(super) fn cells_within(side_mm: f64, cell_mm: f64) -> usize {
    // What rounding left over is no cell of its own.
    ((side_mm / cell_mm - 1e-6).ceil() as usize).max(1)
}

fn tenth() -> f64 {
    0.1
}

/// A brush.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BrushSpec {
    /// The shape of its head.
    pub shape: HeadShape,
    /// Width of the head in mm, 0.2 to 100.
    pub size_mm: f64,
}

/// The name of the format, which nothing else is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum FormatName {
    /// This one.
    Strokes,
}

/// The version that this program reads and writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "u64", into = "u64")]
pub(super) struct FormatVersion;

impl FormatVersion {
    /// Its number.
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
        if version == Self::NUMBER { Ok(Self) } else { Err(format!("version `{version}`")) }
    }
}
