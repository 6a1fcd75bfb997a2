//! Settings of effects that only photographs have: tones, margin, wet-in-wet, back-runs.

use serde::{Deserialize, Serialize};

use super::figures::Figure;

/// The tones of a photograph in paint: how dark black is, and what stays bare paper.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ToneSettings {
    /// Colour that black is painted in, `#rrggbb`; `#000000` keeps the darks. Lighter colours
    /// are lifted in proportion, white stays.
    pub dark: String,
    /// Value of the least of red, green and blue (encoded, 0..=1) from which a colour begins to
    /// be reserved as bare paper; halfway to 1 it is bare. 1 reserves nothing.
    pub reserve: f32,
}

/// A ragged margin of bare paper.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MarginSettings {
    /// Mean width of the margin in px, 0..=1000; 0 paints to the borders.
    pub width_px: f32,
    /// Distance in px that brush strokes reach into the margin or end before it, 0..=500.
    pub ragged_px: f32,
    /// Seed of the random margin, any number.
    pub seed: u64,
}

/// Wet-in-wet: washes that run into their neighbours.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct WetSettings {
    /// Width in px over which the steps of a gradient run together, 0..=256: only where the
    /// photograph has no outline.
    pub tone_px: f32,
    /// Share of the outlines that are painted while the neighbour is wet, 0..=1.
    pub amount: f32,
    /// Distance in px that colours run across such outlines, 0..=256.
    pub reach_px: f32,
    /// Seed of the random wet places, any number.
    pub seed: u64,
}

/// Back-runs: water that flows back into a drying wash, pale blooms with a dark crinkled rim.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct BackRunSettings {
    /// Strength of the change of density, 0..=5.
    pub strength: f32,
    /// Width of the largest blooms in px, 2..=4096.
    pub size_px: f32,
    /// Share of the places for a bloom that have one, 0..=1.
    pub share: f32,
    /// Seed of the random blooms, any number.
    pub seed: u64,
}

impl Default for ToneSettings {
    fn default() -> Self {
        Self { dark: "#2b2a33".to_owned(), reserve: 0.93 }
    }
}

impl Default for MarginSettings {
    fn default() -> Self {
        Self { width_px: 22.0, ragged_px: 12.0, seed: 1 }
    }
}

impl Default for WetSettings {
    fn default() -> Self {
        Self { tone_px: 40.0, amount: 0.25, reach_px: 14.0, seed: 1 }
    }
}

impl Default for BackRunSettings {
    fn default() -> Self {
        Self { strength: 0.5, size_px: 220.0, share: 0.3, seed: 1 }
    }
}

impl ToneSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![Figure::new("tones.reserve", self.reserve, [0.0, 1.0])]
    }
}

impl MarginSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("margin.width_px", self.width_px, [0.0, 1000.0]),
            Figure::new("margin.ragged_px", self.ragged_px, [0.0, 500.0]),
        ]
    }

    pub(super) fn scale(&mut self, by: f32) {
        self.width_px *= by;
        self.ragged_px *= by;
    }
}

impl WetSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("wet.tone_px", self.tone_px, [0.0, 256.0]),
            Figure::new("wet.amount", self.amount, [0.0, 1.0]),
            Figure::new("wet.reach_px", self.reach_px, [0.0, 256.0]),
        ]
    }

    pub(super) fn scale(&mut self, by: f32) {
        self.tone_px *= by;
        self.reach_px *= by;
    }
}

impl BackRunSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("back_runs.strength", self.strength, [0.0, 5.0]),
            Figure::new("back_runs.size_px", self.size_px, [2.0, 4096.0]),
            Figure::new("back_runs.share", self.share, [0.0, 1.0]),
        ]
    }

    pub(super) fn scale(&mut self, by: f32) {
        self.size_px *= by;
    }
}
