//! Settings of light, colour and movement.

use artmap::map::Between;
use serde::{Deserialize, Serialize};

use super::figures::Figure;

/// What the light moves with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LightWith {
    /// With the camera.
    #[default]
    Camera,
    /// With the model.
    Model,
}

/// Source of the tone of a stroke.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ToneSource {
    /// Light on a model, the lightness of a picture.
    #[default]
    Auto,
    /// Light.
    Light,
    /// The lightness of the subject's own colour.
    #[serde(rename = "colour")]
    Color,
}

/// Light, which chooses the tone of each stroke.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct LightSettings {
    /// Source of the tone of a stroke.
    pub tone: ToneSource,
    /// What the light moves with.
    pub with: LightWith,
    /// Direction of the light in degrees clockwise from the top, -360..=360.
    pub azimuth_deg: f32,
    /// Elevation of the light in degrees towards the viewer (of the model: its +z axis), -90..=90.
    pub elevation_deg: f32,
    /// How far light reaches around the surface, 0 ends where it turns away, 1 at the far side;
    /// 0..=1.
    pub wrap: f32,
    /// Tone of the deepest shade, 0 (darkest tile of the map) to 1 (lightest).
    pub darkest: f32,
    /// Tone of the full light, 0 (darkest tile of the map) to 1 (lightest).
    pub lightest: f32,
    /// Number of times that normals are averaged with their neighbours, 0..=1000.
    pub smoothing_rounds: u32,
    /// How tones between the map's tiles are made.
    pub between: Between,
}

/// Where colours come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ColorSource {
    /// Those of the map on a model; a picture's own.
    #[default]
    Auto,
    /// The map's own colours.
    Map,
    /// Colours of the model or picture, with the brushwork of the map.
    Model,
}

/// The coordinates in which the brushwork of the map is added to the model's colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ColorSpace {
    /// CIELAB.
    #[default]
    Cielab,
    /// YUV (Rec. 601) of encoded sRGB (Yan and others 2008).
    Yuv,
}

/// Colour of strokes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ColorSettings {
    /// Where colours come from.
    pub from: ColorSource,
    /// The coordinates in which brushwork is added to the model's colours.
    pub space: ColorSpace,
    /// Share of the map's detail of lightness on the model's colours (alpha), 0..=4.
    pub lightness: f32,
    /// Share of the map's detail of chroma on the model's colours (beta), 0..=4.
    pub chroma: f32,
    /// How far the spread of the map's colours becomes that of the model's (Reinhard and others
    /// 2001), 0..=1.
    pub statistics: f32,
}

/// Strokes along outlines.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SilhouetteSettings {
    /// Width of lines along outlines in px, 0..=100; 0 draws none.
    pub width_px: f32,
    /// How much darker than the model the lines are where colours are the model's, 0..=1.
    pub darkness: f32,
}

/// Strokes that flow along the surface (equation 11 of Yan and others 2008).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FlowSettings {
    /// Lengths of the map by which strokes move in a loop, 0..=16; 0 stands still.
    pub periods: u32,
    /// Duration of a loop in seconds, 0.1..=3600.
    pub loop_seconds: f32,
    /// Random offset of each splat in distances of brush strokes, 0..=4: breaks strokes that
    /// continue in their neighbours.
    pub noise: f32,
    /// How much lighter and darker strokes become by turns, each at its own time, by the range of
    /// tones, 0..=1.
    pub twinkle: f32,
    /// Duration of one change to lighter and darker in seconds, 0.1..=3600; a loop has a whole
    /// number of them.
    pub twinkle_seconds: f32,
}

impl Default for LightSettings {
    fn default() -> Self {
        Self {
            tone: ToneSource::default(),
            with: LightWith::default(),
            azimuth_deg: 315.0,
            elevation_deg: 35.0,
            wrap: 0.5,
            darkest: 0.0,
            lightest: 1.0,
            smoothing_rounds: 2,
            between: Between::default(),
        }
    }
}

impl Default for ColorSettings {
    fn default() -> Self {
        Self {
            from: ColorSource::default(),
            space: ColorSpace::default(),
            lightness: 1.0,
            chroma: 0.5,
            statistics: 0.0,
        }
    }
}

impl Default for SilhouetteSettings {
    fn default() -> Self {
        Self { width_px: 0.0, darkness: 0.5 }
    }
}

impl Default for FlowSettings {
    fn default() -> Self {
        Self { periods: 0, loop_seconds: 4.0, noise: 0.0, twinkle: 0.0, twinkle_seconds: 2.0 }
    }
}

impl LightSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("light.azimuth_deg", self.azimuth_deg, [-360.0, 360.0]),
            Figure::new("light.elevation_deg", self.elevation_deg, [-90.0, 90.0]),
            Figure::new("light.wrap", self.wrap, [0.0, 1.0]),
            Figure::new("light.darkest", self.darkest, [0.0, 1.0]),
            Figure::new("light.lightest", self.lightest, [0.0, 1.0]),
            Figure::new("light.smoothing_rounds", self.smoothing_rounds, [0.0, 1000.0]),
        ]
    }
}

impl ColorSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("colour.lightness", self.lightness, [0.0, 4.0]),
            Figure::new("colour.chroma", self.chroma, [0.0, 4.0]),
            Figure::new("colour.statistics", self.statistics, [0.0, 1.0]),
        ]
    }
}

impl SilhouetteSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("silhouette.width_px", self.width_px, [0.0, 100.0]),
            Figure::new("silhouette.darkness", self.darkness, [0.0, 1.0]),
        ]
    }

    pub(super) fn scale(&mut self, by: f32) {
        self.width_px *= by;
    }
}

impl FlowSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("flow.periods", self.periods, [0.0, 16.0]),
            Figure::new("flow.loop_seconds", self.loop_seconds, [0.1, 3600.0]),
            Figure::new("flow.noise", self.noise, [0.0, 4.0]),
            Figure::new("flow.twinkle", self.twinkle, [0.0, 1.0]),
            Figure::new("flow.twinkle_seconds", self.twinkle_seconds, [0.1, 3600.0]),
        ]
    }
}
