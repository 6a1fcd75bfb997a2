//! A stroke script in memory.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::{self, Deserializer, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};

use super::action::Action;
use super::limits::MAX_ACTIONS;
use super::names::distinct_keys;
use super::palette::PaletteSpec;
use crate::brush::HeadShape;
use crate::canvas::Canvas;
use crate::document::{Lighting, Medium};

/// A script: canvas, pigments and brushes, and the actions done with them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StrokeScript {
    /// The name `strokes`.
    pub(super) format: FormatName,
    /// The version number 1.
    pub(super) version: FormatVersion,
    /// Title of the painting.
    #[serde(default)]
    pub title: String,
    /// Licence of the script, such as `CC0-1.0`.
    #[serde(default)]
    pub licence: String,
    /// Size and ground of the canvas.
    pub canvas: Canvas,
    /// Size and ground of the palette that paint is mixed on, if there is one. Its cells
    /// are as wide as those of the canvas.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mixing: Option<Canvas>,
    /// Path of a painting (`.exr`) to continue instead of a bare canvas. Its size, pigments,
    /// medium and light are its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<String>,
    /// Whether the palette with its paint and the loads of the brushes are taken from the file of
    /// `start` as well.
    #[serde(default, skip_serializing_if = "is_false")]
    pub table: bool,
    /// The binder; oil by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub medium: Option<Medium>,
    /// The light; daylight from the upper left by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lighting: Option<Lighting>,
    /// Pigment library that the script was made for: a path, or the title of a library.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub library: Option<String>,
    /// Pigments of the wet layer before the first action.
    pub palette: PaletteSpec,
    /// Brushes by name.
    #[serde(deserialize_with = "distinct_keys")]
    pub brushes: BTreeMap<String, BrushSpec>,
    /// The actions in order.
    #[serde(deserialize_with = "bounded_actions")]
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
            table: false,
            medium: None,
            lighting: None,
            library: None,
            palette,
            brushes: BTreeMap::new(),
            actions: Vec::new(),
        }
    }

    /// The script without its actions.
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
            table: self.table,
            medium: medium.clone(),
            lighting: lighting.clone(),
            library: library.clone(),
            palette: palette.clone(),
            brushes: brushes.clone(),
            actions: Vec::new(),
        }
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes references")]
fn is_false(value: &bool) -> bool {
    !*value
}

/// Deserializes a list of actions, and stops at the first beyond [`MAX_ACTIONS`].
fn bounded_actions<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Action>, D::Error> {
    struct Actions;

    impl<'de> Visitor<'de> for Actions {
        type Value = Vec<Action>;

        fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
            formatter.write_str("a list of actions")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<Action>, A::Error> {
            let mut actions = Vec::new();
            while let Some(action) = list.next_element()? {
                if actions.len() == MAX_ACTIONS {
                    return Err(de::Error::custom(format!("more than {MAX_ACTIONS} actions")));
                }
                actions.push(action);
            }
            Ok(actions)
        }
    }

    deserializer.deserialize_seq(Actions)
}

/// Shape and size of a brush.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BrushSpec {
    /// The shape of its head.
    pub shape: HeadShape,
    /// Width of its mark at half pressure in mm, 0.2 to 100.
    pub size_mm: f64,
}

/// The name of the format; serde refuses any other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum FormatName {
    /// Written `strokes` in a file.
    Strokes,
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
        if version == Self::NUMBER { Ok(Self) } else { Err(format!("version `{version}`")) }
    }
}
