//! Settings of the flat colours of photographs and meshes, and of noise on moving meshes.

use serde::{Deserialize, Serialize};

use super::figures::Figure;

/// Abstraction of photographs: mean-shift segmentation, then morphological opening and closing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct AbstractionSettings {
    /// Radius of the window in the picture in px, 1..=128: smaller details merge.
    pub spatial_px: f32,
    /// Radius of the window in CIELUV, 1..=100: colours that differ by less merge.
    pub range_luv: f32,
    /// Step in CIELUV by which gradients are divided into tones, 0..=200; 0 divides nothing.
    pub tone_luv: f32,
    /// Area in px below which a region is merged into a neighbour, 0..=1e6.
    pub least_region_px: f32,
    /// Width of the structuring element of opening and closing in px, 0..=128; 0 does
    /// neither.
    pub brush_px: f32,
}

/// Toon shading of meshes: light in a few steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ToonSettings {
    /// Path of a picture (PNG, JPEG, TIFF or WebP) whose middle row replaces the steps: greys from
    /// shade to light.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub greys: Option<String>,
    /// Number of steps from shade to light, 1..=16; 1 is flat colour.
    pub levels: u32,
    /// Change of density from shade to light, 0..=5.
    pub strength: f32,
    /// Darkness of the shadows that parts of a mesh cast on others, 0..=1: 1 is that of the
    /// shade, 0 casts none.
    pub shadow: f32,
    /// Colour of cast shadows, `#rrggbb`: a glaze over the paint, so that white surfaces have
    /// shadows too.
    #[serde(rename = "shadow_colour")]
    pub shadow_color: String,
    /// Share of a step over which it blends into the next, 0..=1.
    pub softness: f32,
    /// Number of times that normals are averaged with their neighbours, 0..=1000.
    pub smoothing_rounds: u32,
    /// Direction of the light in degrees clockwise from the top of the picture, -360..=360.
    pub light_azimuth_deg: f32,
    /// Elevation of the light in degrees from the picture plane towards the viewer, 0..=90.
    pub light_elevation_deg: f32,
}

/// Anchoring of the noise of flow and dispersion while a mesh moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CoherenceMethod {
    /// Fixed to the screen (the shower-door effect).
    Static,
    /// Textures attached to a few particles of the mesh.
    Particles,
    /// Each feature of the noise is a quad attached to a point of the mesh.
    #[default]
    Features,
}

/// Temporal coherence: noise while a mesh moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CoherenceSettings {
    /// Anchoring of the noise.
    pub method: CoherenceMethod,
    /// Number of particles of a mesh, 1..=256.
    pub particles: u32,
    /// Number of octaves of the infinite zoom and of features, 1..=8.
    pub octaves: u32,
    /// Width of the finest feature in px, 1..=256.
    pub feature_px: f32,
    /// Mean number of features that overlap at a point of the mesh, 0.1..=64.
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
            shadow: 0.9,
            shadow_color: "#b3aecb".to_owned(),
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
            Figure::new("toon.shadow", self.shadow, [0.0, 1.0]),
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
