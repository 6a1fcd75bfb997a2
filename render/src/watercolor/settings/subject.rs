//! How photographs and meshes become flat colours, and how noise follows a mesh.

use serde::{Deserialize, Serialize};

use super::figures::Figure;

/// Of photographs: mean shift, then an opening and a closing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct AbstractionSettings {
    /// Radius in space in px, 1..=128: details up to it merge.
    pub spatial_px: f32,
    /// Radius in CIELUV, 1..=100: colours up to it merge.
    pub range_luv: f32,
    /// Gradients are laid in steps of about this, in CIELUV, 0..=200; 0 is in one.
    pub tone_luv: f32,
    /// Regions of less than this are merged into a neighbour, in px of area,
    /// 0..=1e6.
    pub least_region_px: f32,
    /// Width of the brush that opens and closes in px, 0..=128; 0 is none.
    pub brush_px: f32,
}

/// Of meshes: light in a few steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ToonSettings {
    /// A picture (PNG or JPEG) whose middle row is the greys from shade to light,
    /// instead of steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub greys: Option<String>,
    /// Steps from shade to light, 1..=16; 1 is flat colour.
    pub levels: u32,
    /// How much density changes from shade to light, 0..=5.
    pub strength: f32,
    /// Over what share of a step one runs into the next, 0..=1.
    pub softness: f32,
    /// How often normals are averaged over their neighbours, 0..=1000.
    pub smoothing_rounds: u32,
    /// Where the light stands, in degrees clockwise from the top, -360..=360.
    pub light_azimuth_deg: f32,
    /// How high it stands, in degrees towards the viewer, 0..=90.
    pub light_elevation_deg: f32,
}

/// What noise holds on to while a mesh moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CoherenceMethod {
    /// The screen (the shower door).
    Static,
    /// A few particles of the object, each with a texture.
    Particles,
    /// Each feature of the noise a quad that sits on the object.
    #[default]
    Features,
}

/// Of noise while a mesh moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CoherenceSettings {
    /// What noise holds on to.
    pub method: CoherenceMethod,
    /// How many particles an object has, 1..=256.
    pub particles: u32,
    /// Octaves of the infinite zoom, and of features, 1..=8.
    pub octaves: u32,
    /// Width of the finest feature in px, 1..=256.
    pub feature_px: f32,
    /// Features over each place of the object, 0.1..=64.
    pub features_per_place: f32,
}

impl Default for AbstractionSettings {
    fn default() -> Self {
        Self {
            spatial_px: 8.0,
            range_luv: 8.0,
            tone_luv: 25.0,
            least_region_px: 40.0,
            brush_px: 5.0,
        }
    }
}

impl Default for ToonSettings {
    fn default() -> Self {
        Self {
            greys: None,
            levels: 4,
            strength: 1.6,
            softness: 0.15,
            smoothing_rounds: 4,
            light_azimuth_deg: 315.0,
            light_elevation_deg: 40.0,
        }
    }
}

impl Default for CoherenceSettings {
    fn default() -> Self {
        Self {
            method: CoherenceMethod::default(),
            particles: 6,
            octaves: 4,
            feature_px: 6.0,
            features_per_place: 4.0,
        }
    }
}

impl AbstractionSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("abstraction.spatial_px", self.spatial_px, [1.0, 128.0]),
            Figure::new("abstraction.range_luv", self.range_luv, [1.0, 100.0]),
            Figure::new("abstraction.tone_luv", self.tone_luv, [0.0, 200.0]),
            Figure::new("abstraction.least_region_px", self.least_region_px, [0.0, 1e6]),
            Figure::new("abstraction.brush_px", self.brush_px, [0.0, 128.0]),
        ]
    }

    pub(super) fn scale(&mut self, by: f32) {
        self.spatial_px *= by;
        self.least_region_px *= by * by;
        self.brush_px *= by;
    }
}

impl ToonSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        let elevation = self.light_elevation_deg;
        vec![
            Figure::new("toon.levels", self.levels, [1.0, 16.0]),
            Figure::new("toon.strength", self.strength, [0.0, 5.0]),
            Figure::new("toon.softness", self.softness, [0.0, 1.0]),
            Figure::new("toon.smoothing_rounds", self.smoothing_rounds, [0.0, 1000.0]),
            Figure::new("toon.light_azimuth_deg", self.light_azimuth_deg, [-360.0, 360.0]),
            Figure::new("toon.light_elevation_deg", elevation, [0.0, 90.0]),
        ]
    }
}

impl CoherenceSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        let features = self.features_per_place;
        vec![
            Figure::new("coherence.particles", self.particles, [1.0, 256.0]),
            Figure::new("coherence.octaves", self.octaves, [1.0, 8.0]),
            Figure::new("coherence.feature_px", self.feature_px, [1.0, 256.0]),
            Figure::new("coherence.features_per_place", features, [0.1, 64.0]),
        ]
    }

    pub(super) fn scale(&mut self, by: f32) {
        self.feature_px *= by;
    }
}
