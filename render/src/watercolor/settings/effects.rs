//! What water, pigment, paper and brush do.

use serde::{Deserialize, Serialize};

use super::figures::Figure;
use paint::ground::PaperFinish;

/// How much water is in the paint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct WashSettings {
    /// Density of all paint, 0..=4: 1 as the colours are, less is paler, 2 is two glazes.
    pub density: f32,
}

/// Edges that follow the paper's grain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct WobbleSettings {
    /// How far the picture is displaced, root mean square, in px, 0..=50; 0 is not
    /// at all.
    pub amount_px: f32,
}

/// Pigment carried to the rim of a wash.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EdgeSettings {
    /// What density gains where the picture steps from black to white, 0..=10; 0
    /// is nothing.
    pub strength: f32,
    /// Standard deviation of the blur before edges are looked for, in px, 0..=20:
    /// wider edges are paler.
    pub width_px: f32,
}

/// Large clouds, as of a wet wash.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FlowSettings {
    /// How much density changes, 0..=5.
    pub strength: f32,
    /// Width of the largest clouds in px, 2..=4096.
    pub size_px: f32,
    /// How many sizes of clouds, each half as wide as the one before, 1..=8.
    pub octaves: u32,
    /// The same seed, the same clouds.
    pub seed: u64,
}

/// Fine grains, as of pigment that flocks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DispersionSettings {
    /// How much density changes, 0..=5.
    pub strength: f32,
    /// Standard deviation of the finest grains in px, 0.1..=64.
    pub finest_px: f32,
    /// How many sizes of grains, each twice as wide as the one before, 1..=6.
    pub scales: u32,
    /// The same seed, the same grains.
    pub seed: u64,
}

/// What is painted on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PaperSettings {
    /// How it was made.
    pub kind: PaperFinish,
    /// A picture of heights (PNG or JPEG, white the highest) instead.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scan: Option<String>,
    /// Px to a pixel of the scan, 0.05..=20.
    pub scan_scale: f32,
    /// The same seed, the same paper.
    pub seed: u64,
    /// How much density changes: pigment settles in hollows, 0..=5.
    pub strength: f32,
    /// Width of the usual bump of cold-pressed paper in px, 1..=512; of rough paper
    /// they are wider.
    pub grain_px: f32,
    /// Its colour, `#rrggbb`.
    #[serde(rename = "colour")]
    pub color: String,
    /// How much light from the upper left shows the grain, 0..=1.
    pub relief: f32,
}

/// A brush that touches the heights of the paper only.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DryBrushSettings {
    /// The share of the paper that stays bare, 0..=1.
    pub amount: f32,
    /// Over how much of the paper's height paint fades out, 0.001..=0.5.
    pub softness: f32,
    /// How much of it is kept to patches, 0..=1: at 0 the brush is dry everywhere, at 1
    /// only where the wash flows thinly.
    pub patches: f32,
    /// Only where the wash is of about this colour, `#rrggbb`.
    #[serde(rename = "colour", skip_serializing_if = "Option::is_none")]
    pub color: Option<String>,
    /// How far from that colour, in CIELAB, 1..=200.
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
        Self { amount: 0.0, softness: 0.1, patches: 1.0, color: None, tolerance: 25.0 }
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
            Figure::new("dry_brush.tolerance", self.tolerance, [1.0, 200.0]),
        ]
    }
}
