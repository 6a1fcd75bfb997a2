//! Settings of the effects of water, pigment, paper and brush.

use serde::{Deserialize, Serialize};

use super::figures::Figure;
use paint::ground::PaperFinish;

/// Amount of pigment in the water.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct WashSettings {
    /// Density of all paint, 0..=4: 1 keeps the colours, less is paler, 2 is two layers.
    pub density: f32,
}

/// Displacement of the picture by the grain of the paper, which makes edges uneven.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct WobbleSettings {
    /// Root mean square displacement in px, 0..=50; 0 displaces nothing.
    pub amount_px: f32,
}

/// Edge darkening: pigment carried to the rim of a wash.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EdgeSettings {
    /// Increase of density at a step from black to white, 0..=10; 0 darkens nothing.
    pub strength: f32,
    /// Standard deviation of the blur before edge detection in px, 0..=20: wider edges are
    /// paler.
    pub width_px: f32,
}

/// Turbulent flow: large clouds of pigment in a wet wash.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FlowSettings {
    /// Strength of the change of density, 0..=5.
    pub strength: f32,
    /// Width of the largest clouds in px, 2..=4096.
    pub size_px: f32,
    /// Number of sizes of clouds, each half as wide as the previous one, 1..=8.
    pub octaves: u32,
    /// Seed of the random clouds, any number.
    pub seed: u64,
}

/// Pigment dispersion: fine grains of pigment that flocculates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DispersionSettings {
    /// Strength of the change of density, 0..=5.
    pub strength: f32,
    /// Standard deviation of the finest grains in px, 0.1..=64.
    pub finest_px: f32,
    /// Number of sizes of grains, each twice as wide as the previous one, 1..=6.
    pub scales: u32,
    /// Seed of the random grains, any number.
    pub seed: u64,
}

/// The paper under the picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PaperSettings {
    /// Finish of the paper: hot-pressed, cold-pressed or rough.
    pub kind: PaperFinish,
    /// Path of a picture of heights (PNG, JPEG, TIFF or WebP, white is high) that replaces the
    /// generated paper.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scan: Option<String>,
    /// Width of a pixel of the scan in px, 0.05..=20.
    pub scan_scale: f32,
    /// Seed of the generated paper, any number.
    pub seed: u64,
    /// Strength of the change of density, 0..=5: pigment settles in the hollows.
    pub strength: f32,
    /// Usual width of the bumps of cold-pressed paper in px, 1..=512; those of rough paper are
    /// wider in proportion.
    pub grain_px: f32,
    /// Colour of the paper, `#rrggbb`.
    #[serde(rename = "colour")]
    pub color: String,
    /// Strength of the shading of the grain by light from the upper left, 0..=1.
    pub relief: f32,
}

/// A dry brush, which touches only the high parts of the paper.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DryBrushSettings {
    /// Share of the paper that stays bare, 0..=1.
    pub amount: f32,
    /// Width of the band of heights in which paint fades out, 0.001..=0.5.
    pub softness: f32,
    /// Restriction to patches, 0..=1: at 0 the brush is dry everywhere, at 1 only where the
    /// flow is thin.
    pub patches: f32,
    /// Share of the strokes in what the brush touches, 0..=1: at 0 only the grain of the paper
    /// decides, at 1 only streaks along the strokes.
    pub streaks: f32,
    /// Direction of the strokes in degrees counterclockwise from the right, -360..=360.
    pub direction_deg: f32,
    /// Length of the streaks in px, 1..=4096.
    pub length_px: f32,
    /// Distance in px from outlines at which the brush becomes dry, 0..=50; 0 lets it pass over
    /// them.
    pub outline_px: f32,
    /// Mean of red, green and blue (encoded, 0..=1) up to which washes are laid wet, before water
    /// makes them paler; from about twice of it on the brush is as dry as elsewhere. 0 is no limit.
    pub darkest: f32,
    /// Colour of the wash to which the dry brush is limited, `#rrggbb`. `None` is no limit.
    #[serde(rename = "colour", skip_serializing_if = "Option::is_none")]
    pub color: Option<String>,
    /// Largest distance from that colour in CIELAB, 1..=200.
    pub tolerance: f32,
}

impl Default for WashSettings {
    fn default() -> Self {
        Self { density: 0.8 }
    }
}

impl Default for WobbleSettings {
    fn default() -> Self {
        Self { amount_px: 1.0 }
    }
}

impl Default for EdgeSettings {
    fn default() -> Self {
        Self { strength: 3.0, width_px: 1.0 }
    }
}

impl Default for FlowSettings {
    fn default() -> Self {
        Self { strength: 1.0, size_px: 240.0, octaves: 5, seed: 1 }
    }
}

impl Default for DispersionSettings {
    fn default() -> Self {
        Self { strength: 0.35, finest_px: 0.5, scales: 3, seed: 1 }
    }
}

impl Default for PaperSettings {
    fn default() -> Self {
        Self {
            kind: PaperFinish::ColdPressed,
            scan: None,
            scan_scale: 1.0,
            seed: 1,
            strength: 0.5,
            grain_px: 4.5,
            color: "#fbf9f4".to_owned(),
            relief: 0.02,
        }
    }
}

impl Default for DryBrushSettings {
    fn default() -> Self {
        Self {
            amount: 0.0,
            softness: 0.1,
            patches: 1.0,
            streaks: 0.7,
            direction_deg: 15.0,
            length_px: 90.0,
            outline_px: 6.0,
            darkest: 0.2,
            color: None,
            tolerance: 25.0,
        }
    }
}

impl WashSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![Figure::new("wash.density", self.density, [0.0, 4.0])]
    }
}

impl WobbleSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![Figure::new("wobble.amount_px", self.amount_px, [0.0, 50.0])]
    }

    pub(super) fn scale(&mut self, by: f32) {
        self.amount_px *= by;
    }
}

impl EdgeSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("edges.strength", self.strength, [0.0, 10.0]),
            Figure::new("edges.width_px", self.width_px, [0.0, 20.0]),
        ]
    }

    pub(super) fn scale(&mut self, by: f32) {
        self.width_px *= by;
    }
}

impl FlowSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("flow.strength", self.strength, [0.0, 5.0]),
            Figure::new("flow.size_px", self.size_px, [2.0, 4096.0]),
            Figure::new("flow.octaves", self.octaves, [1.0, 8.0]),
        ]
    }

    pub(super) fn scale(&mut self, by: f32) {
        self.size_px *= by;
    }
}

impl DispersionSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("dispersion.strength", self.strength, [0.0, 5.0]),
            Figure::new("dispersion.finest_px", self.finest_px, [0.1, 64.0]),
            Figure::new("dispersion.scales", self.scales, [1.0, 6.0]),
        ]
    }

    pub(super) fn scale(&mut self, by: f32) {
        self.finest_px *= by;
    }
}

impl PaperSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("paper.scan_scale", self.scan_scale, [0.05, 20.0]),
            Figure::new("paper.strength", self.strength, [0.0, 5.0]),
            Figure::new("paper.grain_px", self.grain_px, [1.0, 512.0]),
            Figure::new("paper.relief", self.relief, [0.0, 1.0]),
        ]
    }

    pub(super) fn scale(&mut self, by: f32) {
        self.scan_scale *= by;
        self.grain_px *= by;
    }
}

impl DryBrushSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("dry_brush.amount", self.amount, [0.0, 1.0]),
            Figure::new("dry_brush.softness", self.softness, [0.001, 0.5]),
            Figure::new("dry_brush.patches", self.patches, [0.0, 1.0]),
            Figure::new("dry_brush.streaks", self.streaks, [0.0, 1.0]),
            Figure::new("dry_brush.direction_deg", self.direction_deg, [-360.0, 360.0]),
            Figure::new("dry_brush.length_px", self.length_px, [1.0, 4096.0]),
            Figure::new("dry_brush.outline_px", self.outline_px, [0.0, 50.0]),
            Figure::new("dry_brush.darkest", self.darkest, [0.0, 1.0]),
            Figure::new("dry_brush.tolerance", self.tolerance, [1.0, 200.0]),
        ]
    }

    pub(super) fn scale(&mut self, by: f32) {
        self.length_px *= by;
        self.outline_px *= by;
    }
}
