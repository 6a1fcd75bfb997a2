//! A stroke script in memory.
//!
//! Every number is rounded to the digits of a file before it takes effect, so that a recording, which
//! holds the rounded numbers, paints the same bits when it is played.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use pigment::digits;
use serde::de::{self, Deserializer, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};

use super::MAX_ACTIONS;
use super::action::{Action, Load, PaletteSpec, Recipe, Squeeze, Stroke, SurfaceId, distinct_keys};
use crate::brush::{HeadShape, StrokeTool};
use crate::document::{Canvas, Document, Lighting, Medium};
use crate::layer::Layer;
use crate::optics::Gloss;
use crate::painting::MaskChange;
use crate::pose::Sample;
use crate::stroke::SampleDecimals;

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

/// A brush with the paint that its head holds.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptBrush {
    /// Name of the brush.
    pub name: String,
    /// Shape and size of its head.
    pub spec: BrushSpec,
    /// Surface where it was last used.
    pub at: SurfaceId,
    /// Paint on the cells of its head, with the pigments of the palette; `None` if it is clean.
    pub paint: Option<Layer>,
}

/// The palette with its paint, and all brushes with theirs.
#[derive(Debug, Clone, PartialEq)]
pub struct SideTable {
    /// The palette that paint is mixed on, with the pigments, light and medium of the canvas.
    pub palette: Document,
    /// The brushes in the order of their names.
    pub brushes: Vec<KeptBrush>,
}

impl Action {
    /// The action with its numbers rounded: samples to four decimals, all others to six
    /// significant digits. Writing and reading leaves a rounded action as it is.
    #[must_use]
    pub fn rounded(&self) -> Self {
        match self {
            Self::Load(load) => Self::Load(Load {
                brush: load.brush.clone(),
                recipe: recipe(&load.recipe),
                vehicle: six_digits(load.vehicle),
                amount_mm: six_digits(load.amount_mm),
            }),
            Self::Stroke(stroke) => Self::Stroke(round_stroke(stroke)),
            Self::Cut(stroke) => Self::Cut(round_stroke(stroke)),
            Self::Wipe { brush, keep } => {
                Self::Wipe { brush: brush.clone(), keep: six_digits(*keep) }
            }
            Self::Dry { fraction } => Self::Dry { fraction: six_digits(*fraction) },
            Self::Light(lighting) => Self::Light(Lighting {
                azimuth_deg: six_digits(lighting.azimuth_deg),
                elevation_deg: six_digits(lighting.elevation_deg),
                ambient: six_digits(lighting.ambient),
                relief: six_digits(lighting.relief),
                adaptation: six_digits(lighting.adaptation),
                ..lighting.clone()
            }),
            Self::Opacity { layer, value } => {
                Self::Opacity { layer: *layer, value: six_digits(*value) }
            }
            Self::Squeeze(squeeze) => Self::Squeeze(Squeeze {
                on: squeeze.on,
                recipe: recipe(&squeeze.recipe),
                vehicle: six_digits(squeeze.vehicle),
                x_mm: six_digits(squeeze.x_mm),
                y_mm: six_digits(squeeze.y_mm),
                volume_mm3: six_digits(squeeze.volume_mm3),
            }),
            Self::Mask(MaskChange::PolygonMm(points)) => {
                let points = points.iter().map(|point| point.map(six_digits));
                Self::Mask(MaskChange::PolygonMm(points.collect()))
            }
            Self::Gloss { wet, dry } => Self::Gloss { wet: gloss(*wet), dry: gloss(*dry) },
            Self::Stiffness { value } => Self::Stiffness { value: six_digits(*value) },
            Self::Wash { .. }
            | Self::Palette(_)
            | Self::Undo {}
            | Self::Redo {}
            | Self::Name { .. }
            | Self::Visible { .. }
            | Self::Order { .. }
            | Self::Swap { .. }
            | Self::Merge { .. }
            | Self::Scrape { .. }
            | Self::Mask(_)
            | Self::Save { .. } => self.clone(),
        }
    }
}

fn round_stroke(stroke: &Stroke) -> Stroke {
    Stroke {
        brush: stroke.brush.clone(),
        on: stroke.on,
        tool: stroke.tool.map(six_digits),
        samples: stroke
            .samples
            .iter()
            .map(|sample: &Sample| SampleDecimals::RECORDING.round(sample))
            .collect(),
    }
}

fn recipe(parts: &Recipe) -> Recipe {
    parts.iter().map(|(name, part)| (name.clone(), six_digits(*part))).collect()
}

fn gloss(gloss: Gloss) -> Gloss {
    let round = |value: f32| six_digits(f64::from(value)) as f32;
    Gloss { strength: round(gloss.strength), exponent: round(gloss.exponent) }
}

/// `value` rounded to six significant digits, and never -0, which a file cannot tell
/// from 0.
pub(crate) fn six_digits(value: f64) -> f64 {
    digits::rounded(value) + 0.0
}

impl StrokeScript {
    /// Index of the first stroke, and name, of each brush that paints on the canvas before it was
    /// loaded or moved over the palette, in order. Such a stroke only moves the paint that lies there.
    /// Brushes of `kept`, which come with paint of an earlier session, are left out.
    #[must_use]
    pub fn unloaded_brushes(&self, kept: &BTreeSet<&str>) -> Vec<(usize, &str)> {
        let mut seen = kept.clone();
        let mut found = Vec::new();
        for (index, action) in self.actions.iter().enumerate() {
            match action {
                Action::Load(load) => {
                    seen.insert(&load.brush);
                }
                Action::Stroke(stroke) | Action::Cut(stroke) => {
                    let paints = stroke.on.is_canvas() && stroke.tool == StrokeTool::Paint;
                    let is_first = seen.insert(&stroke.brush);
                    if paints && is_first {
                        found.push((index, stroke.brush.as_str()));
                    }
                }
                _ => {}
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brushes_without_paint_are_found_once() {
        let stroke = |brush: &str, more: &str| {
            format!(r#"{{"stroke": {{"brush": "{brush}", {more} "samples": [[0, 1, 1, 0.5]]}}}}"#)
        };
        let actions = [
            stroke("dry", ""),
            stroke("dry", ""),
            r#"{"load": {"brush": "wet", "recipe": {"W": 1}, "amount_mm": 0.3}}"#.to_owned(),
            stroke("wet", ""),
            stroke("soft", r#""tool": "blend","#),
            stroke("kept", ""),
        ];
        let brush = r#"{"shape": "flat", "size_mm": 5}"#;
        let brushes = ["dry", "wet", "soft", "kept"].map(|name| format!(r#""{name}": {brush}"#));
        let text = format!(
            r#"{{"format": "strokes", "version": 1, "title": "", "palette": {{"W": "Lead White"}},
            "canvas": {{"width_mm": 9, "height_mm": 9, "cell_mm": 0.2}},
            "brushes": {{{}}}, "actions": [{}]}}"#,
            brushes.join(", "),
            actions.join(", ")
        );
        let script = StrokeScript::from_json("a.json", text.as_bytes()).unwrap();
        assert_eq!(script.unloaded_brushes(&BTreeSet::from(["kept"])), [(0, "dry")]);
        assert_eq!(script.unloaded_brushes(&BTreeSet::new()), [(0, "dry"), (5, "kept")]);
    }
}
