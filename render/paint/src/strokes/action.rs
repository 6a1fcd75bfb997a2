//! Actions of a script: single steps of work on a painting.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::names::distinct_keys;
use super::palette::PaletteSpec;
use super::stroke_action::Stroke;
use super::surface_id::SurfaceId;
use crate::document::Lighting;
use crate::optics::Gloss;
use crate::painting::{LayerRef, MaskChange};

/// Parts by volume of each pigment, by its name in the library or a short name of a
/// palette.
pub type Recipe = BTreeMap<String, f64>;

/// One action of a script.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum Action {
    /// Adds paint to that on a brush. Wash the brush first for a clean colour.
    Load(Load),
    /// Moves a brush over a surface, to paint or to blend, scrape or erase wet paint.
    Stroke(Stroke),
    /// Moves a brush over a surface without lifting it at the end: its last way, which lags one
    /// sample behind, is not painted, and the paint does not level. So a recording ends whose
    /// program was killed within a stroke.
    Cut(Stroke),
    /// Wipes paint off a brush.
    Wipe {
        /// Name of the brush.
        brush: String,
        /// Share of its paint that stays, 0 to 1.
        keep: f64,
    },
    /// Removes all paint from a brush.
    Wash {
        /// Name of the brush.
        brush: String,
    },
    /// Dries wet paint of the canvas, from the bottom up, into a new dry layer.
    Dry {
        /// Share of the wet paint that dries, above 0 to 1; 1 by default.
        #[serde(default = "whole")]
        fraction: f64,
    },
    /// Sets the pigments of the wet layer.
    Palette(PaletteSpec),
    /// Undoes the last action.
    Undo {},
    /// Does the last undone action again.
    Redo {},
    /// Sets the light.
    Light(Lighting),
    /// Sets the factor on the optical thickness of a dry layer.
    Opacity {
        /// The layer, which must be dry.
        layer: LayerRef,
        /// Factor from 0 (clear) over 1 (as painted) to 1000.
        value: f64,
    },
    /// Names a dry layer.
    Name {
        /// The layer, which must be dry.
        layer: LayerRef,
        /// One line of at most 80 characters; empty takes the name away.
        name: String,
    },
    /// Shows or hides a dry layer, which keeps its opacity.
    Visible {
        /// The layer, which must be dry.
        layer: LayerRef,
        /// Whether it is shown.
        value: bool,
    },
    /// Moves a dry layer to another place among the dry layers.
    Order {
        /// The layer, which must be dry.
        layer: LayerRef,
        /// Its new place from 0, the lowest.
        to: usize,
    },
    /// Replaces a pigment of a layer by another.
    Swap {
        /// The layer, wet or dry.
        layer: LayerRef,
        /// Name of the pigment to replace.
        from: String,
        /// Name of the pigment that takes its place.
        to: String,
    },
    /// Merges two dry layers into one, which keeps the identity of the lower.
    Merge {
        /// One of the two, which must be dry.
        layer: LayerRef,
        /// The other one; the layer below by default.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        with: Option<LayerRef>,
    },
    /// Puts down a heap of paint, as from a tube.
    Squeeze(Squeeze),
    /// Removes all wet paint of a surface.
    Scrape {
        /// The surface; the canvas by default.
        #[serde(default, skip_serializing_if = "SurfaceId::is_canvas")]
        on: SurfaceId,
    },
    /// Covers cells of the canvas, so that no paint gets on or off them, or uncovers them.
    Mask(MaskChange),
    /// Sets the gloss of the binder.
    Gloss {
        /// Gloss of wet paint.
        wet: Gloss,
        /// Gloss of dry paint.
        dry: Gloss,
    },
    /// Sets the stiffness of the wet paint.
    Stiffness {
        /// 0 is stand oil, which levels after a stroke, 1 is putty.
        value: f64,
    },
    /// Saves the painting (`.exr`) or its picture (`.png`).
    Save {
        /// Relative path of the file, below a folder that the player of the script chooses.
        path: String,
    },
}

impl Action {
    /// Key of the action in a file, such as `stroke`.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Load(_) => "load",
            Self::Stroke(_) => "stroke",
            Self::Cut(_) => "cut",
            Self::Wipe { .. } => "wipe",
            Self::Wash { .. } => "wash",
            Self::Dry { .. } => "dry",
            Self::Palette(_) => "palette",
            Self::Undo {} => "undo",
            Self::Redo {} => "redo",
            Self::Light(_) => "light",
            Self::Opacity { .. } => "opacity",
            Self::Name { .. } => "name",
            Self::Visible { .. } => "visible",
            Self::Order { .. } => "order",
            Self::Swap { .. } => "swap",
            Self::Merge { .. } => "merge",
            Self::Squeeze(_) => "squeeze",
            Self::Scrape { .. } => "scrape",
            Self::Mask(_) => "mask",
            Self::Gloss { .. } => "gloss",
            Self::Stiffness { .. } => "stiffness",
            Self::Save { .. } => "save",
        }
    }

    /// Name of the brush that the action uses, if it uses one.
    #[must_use]
    pub fn brush(&self) -> Option<&str> {
        match self {
            Self::Load(Load { brush, .. })
            | Self::Stroke(Stroke { brush, .. })
            | Self::Cut(Stroke { brush, .. })
            | Self::Wipe { brush, .. }
            | Self::Wash { brush } => Some(brush),
            _ => None,
        }
    }

    /// The stroke, lifted or cut, if the action is one.
    #[must_use]
    pub fn stroke(&self) -> Option<&Stroke> {
        match self {
            Self::Stroke(stroke) | Self::Cut(stroke) => Some(stroke),
            _ => None,
        }
    }

    /// Like [`Action::brush`], to rename the brush.
    pub(crate) fn brush_mut(&mut self) -> Option<&mut String> {
        match self {
            Self::Load(Load { brush, .. })
            | Self::Stroke(Stroke { brush, .. })
            | Self::Cut(Stroke { brush, .. })
            | Self::Wipe { brush, .. }
            | Self::Wash { brush } => Some(brush),
            _ => None,
        }
    }
}

fn whole() -> f64 {
    1.0
}

/// Paint that a brush takes up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Name of the brush.
    pub brush: String,
    /// Parts of each pigment.
    #[serde(deserialize_with = "distinct_keys")]
    pub recipe: Recipe,
    /// Share of clear vehicle in the paint, 0 to 1; 0 by default.
    #[serde(default)]
    pub vehicle: f64,
    /// Height of the paint on the head in mm.
    pub amount_mm: f64,
}

/// A heap of paint, as squeezed from a tube.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Squeeze {
    /// The surface; the canvas by default.
    #[serde(default, skip_serializing_if = "SurfaceId::is_canvas")]
    pub on: SurfaceId,
    /// Parts of each pigment.
    #[serde(deserialize_with = "distinct_keys")]
    pub recipe: Recipe,
    /// Share of clear vehicle in the paint, 0 to 1; 0 by default.
    #[serde(default)]
    pub vehicle: f64,
    /// Distance of the heap's centre from the left edge of the surface, in mm.
    pub x_mm: f64,
    /// Distance of the heap's centre from the upper edge, in mm.
    pub y_mm: f64,
    /// Volume in cubic millimetres.
    pub volume_mm3: f64,
}
