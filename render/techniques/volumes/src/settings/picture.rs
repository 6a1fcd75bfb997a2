//! Settings of light, grey and the picture.

use serde::{Deserialize, Serialize};

use super::setting::{
    Setting,
    Takes::{Color, Number, Switch, Whole, Words},
};
use crate::drawing::GreyWeights;

/// Whether the light moves with the camera or the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LightWith {
    /// With the camera.
    #[default]
    Camera,
    /// With the model.
    Model,
}

/// The light on the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct LightTable {
    /// Whether the scene is lit; a photograph may have light of its own.
    pub lit: bool,
    /// Whether the light moves with the camera or the model.
    pub with: LightWith,
    /// Direction of the light in degrees clockwise from the top, -360..=360.
    pub azimuth_deg: f32,
    /// Elevation of the light in degrees towards the viewer, -90..=90.
    pub elevation_deg: f32,
    /// Number of steps from shade to light, 1..=16.
    pub levels: u32,
    /// Share of a step over which it blends into the next, 0..=1.
    pub softness: f32,
    /// Share of its colour that a surface loses in full shade, beside the hatching, 0..=1.
    pub shade: f32,
}

impl Default for LightTable {
    fn default() -> Self {
        Self {
            lit: true,
            with: LightWith::default(),
            azimuth_deg: 315.0,
            elevation_deg: 45.0,
            levels: 6,
            softness: 0.5,
            shade: 0.3,
        }
    }
}

/// Grey outside of volumes.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GreyTable {
    /// How colours weigh in it.
    pub weights: GreyWeights,
    /// Share by which greys are lifted towards white before they are hatched, 0..=1; at 0 grey is
    /// as light as the colour.
    pub pale: f32,
}

/// Samples and paper of the picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PictureTable {
    /// Samples along each side of a pixel, 1..=8.
    pub samples: u32,
    /// Colour of the paper where nothing is seen, written `#rrggbb`.
    pub paper: String,
}

impl Default for PictureTable {
    fn default() -> Self {
        Self { samples: 2, paper: "#ffffff".to_owned() }
    }
}

pub(super) const SETTINGS: [Setting; 11] = [
    Setting::new("light.lit", Switch, "", "Whether light falls on the scene."),
    Setting::new(
        "light.with",
        Words(&["camera", "model"]),
        "",
        "The light moves with the camera or with the model.",
    ),
    Setting::new(
        "light.azimuth_deg",
        Number(-360.0, 360.0),
        "degrees",
        "Where the light stands, clockwise from the top.",
    ),
    Setting::new(
        "light.elevation_deg",
        Number(-90.0, 90.0),
        "degrees",
        "How high the light stands, towards the viewer.",
    ),
    Setting::new("light.levels", Whole(1, 16), "", "Number of steps from shade to light."),
    Setting::new(
        "light.softness",
        Number(0.0, 1.0),
        "",
        "Share of a step over which it blends into the next.",
    ),
    Setting::new(
        "light.shade",
        Number(0.0, 1.0),
        "",
        "Share of its colour that a surface loses in full shade, beside the hatching.",
    ),
    Setting::new(
        "grey.weights",
        Words(&["luminance", "rec601"]),
        "",
        "Grey is the luminance of a colour, or the weighted sum of Rec. 601.",
    ),
    Setting::new(
        "grey.pale",
        Number(0.0, 1.0),
        "",
        "Share by which greys are lifted towards white paper; 0 is as light as the colour.",
    ),
    Setting::new(
        "picture.samples",
        Whole(1, 8),
        "",
        "Samples along each side of a pixel: more smooth the rims of colour.",
    ),
    Setting::new("picture.paper", Color, "", "Colour of the paper, where nothing is seen."),
];
