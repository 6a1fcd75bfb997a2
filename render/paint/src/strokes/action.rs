//! What a painter does.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::{self, Deserializer, Visitor};
use serde::{Deserialize, Serialize, Serializer};

use super::names::distinct_keys;
use super::palette::PaletteSpec;
use super::rows;
use crate::document::Lighting;
use crate::optics::Gloss;
use crate::painting::LayerRef;
use crate::pose::Sample;

/// Parts by pigment: a name of the library, or a short one of a palette.
pub type Recipe = BTreeMap<String, f64>;

/// One action.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum Action {
    /// Puts paint on a brush, beside what it has: wash it for a clean colour.
    Load(Load),
    /// Leads a brush over the canvas.
    Stroke(Stroke),
    /// Takes paint off a brush.
    Wipe {
        /// The brush.
        brush: String,
        /// The share of its paint that stays, 0..1.
        keep: f64,
    },
    /// Takes all paint off a brush.
    Wash {
        /// The brush.
        brush: String,
    },
    /// Dries the wet paint from the bottom, into a new dry layer.
    Dry {
        /// Which share of it, above 0 to 1; all if not given.
        #[serde(default = "all")]
        fraction: f64,
    },
    /// Other pigments for the wet layer.
    Palette(PaletteSpec),
    /// Takes the last action back.
    Undo {},
    /// Does again what was taken back.
    Redo {},
    /// Another light.
    Light(Lighting),
    /// What a layer's optical thickness is multiplied with.
    Opacity {
        /// The layer.
        layer: LayerRef,
        /// 0 hides it, 1 is as painted; up to 1000.
        value: f64,
    },
    /// Exchanges a pigment of a layer for another.
    Swap {
        /// The layer.
        layer: LayerRef,
        /// The pigment that goes.
        from: String,
        /// The one that takes its place.
        to: String,
    },
    /// Makes one of a dry layer and the one below it.
    Merge {
        /// The upper of the two, counted from the lowest, 0; so 1 and up.
        layer: usize,
    },
    /// Puts a heap of paint down, as from a tube.
    Squeeze(Squeeze),
    /// Takes all wet paint of a surface away.
    Scrape {
        /// The surface; the canvas if not given.
        #[serde(default, skip_serializing_if = "SurfaceId::is_canvas")]
        on: SurfaceId,
    },
    /// Another shine of the binder.
    Gloss {
        /// Of wet paint.
        wet: Gloss,
        /// Of dry paint.
        dry: Gloss,
    },
    /// Saves the painting (`.exr`) or its picture (`.png`).
    Save {
        /// Where: below the folder that the one who replays chooses.
        path: String,
    },
}

impl Action {
    /// Its key in the file.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Load(_) => "load",
            Self::Stroke(_) => "stroke",
            Self::Wipe { .. } => "wipe",
            Self::Wash { .. } => "wash",
            Self::Dry { .. } => "dry",
            Self::Palette(_) => "palette",
            Self::Undo {} => "undo",
            Self::Redo {} => "redo",
            Self::Light(_) => "light",
            Self::Opacity { .. } => "opacity",
            Self::Swap { .. } => "swap",
            Self::Merge { .. } => "merge",
            Self::Squeeze(_) => "squeeze",
            Self::Scrape { .. } => "scrape",
            Self::Gloss { .. } => "gloss",
            Self::Save { .. } => "save",
        }
    }

    /// The brush that it is done with, if with one.
    #[must_use]
    pub fn brush(&self) -> Option<&str> {
        match self {
            Self::Load(Load { brush, .. })
            | Self::Stroke(Stroke { brush, .. })
            | Self::Wipe { brush, .. }
            | Self::Wash { brush } => Some(brush),
            _ => None,
        }
    }

    pub(crate) fn brush_mut(&mut self) -> Option<&mut String> {
        match self {
            Self::Load(Load { brush, .. })
            | Self::Stroke(Stroke { brush, .. })
            | Self::Wipe { brush, .. }
            | Self::Wash { brush } => Some(brush),
            _ => None,
        }
    }
}

fn all() -> f64 {
    1.0
}

/// Paint for a brush.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// The brush.
    pub brush: String,
    /// The paint.
    #[serde(deserialize_with = "distinct_keys")]
    pub recipe: Recipe,
    /// Share of the whole that is clear vehicle, 0..1; none if not given.
    #[serde(default)]
    pub vehicle: f64,
    /// How high it lies on the head, in mm.
    pub amount_mm: f64,
}

/// A stroke.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stroke {
    /// The brush.
    pub brush: String,
    /// The surface; the canvas if not given.
    #[serde(default, skip_serializing_if = "SurfaceId::is_canvas")]
    pub on: SurfaceId,
    /// Where it was held, in order of time.
    #[serde(with = "rows")]
    pub samples: Vec<Sample>,
}

/// A heap of paint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Squeeze {
    /// The surface; the canvas if not given.
    #[serde(default, skip_serializing_if = "SurfaceId::is_canvas")]
    pub on: SurfaceId,
    /// The paint.
    #[serde(deserialize_with = "distinct_keys")]
    pub recipe: Recipe,
    /// Share of the whole that is clear vehicle, 0..1; none if not given.
    #[serde(default)]
    pub vehicle: f64,
    /// Its middle, from the left edge of the surface in mm.
    pub x_mm: f64,
    /// From the upper edge, in mm.
    pub y_mm: f64,
    /// How much, in cubic millimetres.
    pub volume_mm3: f64,
}

/// Where wet paint lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SurfaceId {
    /// What is painted on.
    #[default]
    Canvas,
    /// What is mixed on.
    Palette,
}

impl SurfaceId {
    /// Whether this is the canvas.
    #[must_use]
    pub fn is_canvas(&self) -> bool {
        *self == Self::Canvas
    }
}

impl Serialize for LayerRef {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Wet => serializer.serialize_str("wet"),
            Self::Dry(index) => serializer.serialize_u64(*index as u64),
        }
    }
}

impl<'de> Deserialize<'de> for LayerRef {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Name;

        impl Visitor<'_> for Name {
            type Value = LayerRef;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("\"wet\" or the number of a dry layer, from 0")
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<LayerRef, E> {
                match text {
                    "wet" => Ok(LayerRef::Wet),
                    _ => Err(E::invalid_value(de::Unexpected::Str(text), &self)),
                }
            }

            fn visit_u64<E: de::Error>(self, index: u64) -> Result<LayerRef, E> {
                let dry = usize::try_from(index).map(LayerRef::Dry);
                dry.map_err(|_| E::invalid_value(de::Unexpected::Unsigned(index), &self))
            }
        }

        deserializer.deserialize_any(Name)
    }
}
