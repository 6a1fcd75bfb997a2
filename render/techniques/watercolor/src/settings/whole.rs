//! All settings of watercolor together.

use serde::{Deserialize, Serialize};

use super::effects::{
    DispersionSettings, DryBrushSettings, EdgeSettings, FlowSettings, PaperSettings, WashSettings,
    WobbleSettings,
};
use super::figures::Figure;
use super::photograph::{BackRunSettings, MarginSettings, ToneSettings, WetSettings};
use super::subject::{AbstractionSettings, CoherenceSettings, ToonSettings};

/// The style of a watercolor. Keys that a file leaves out have the defaults.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Longer side in px of the picture that lengths refer to, 16..=65536; in pictures of
    /// another size lengths are scaled in proportion.
    pub reference_px: f32,
    /// Flat regions of photographs.
    pub abstraction: AbstractionSettings,
    /// Tones of photographs: darks and reserved whites.
    pub tones: ToneSettings,
    /// Washes of photographs that run into their neighbours.
    pub wet: WetSettings,
    /// Bare margin of photographs.
    pub margin: MarginSettings,
    /// Back-runs of photographs.
    pub back_runs: BackRunSettings,
    /// Toon shading of meshes.
    pub toon: ToonSettings,
    /// Overall density of the paint.
    pub wash: WashSettings,
    /// Displacement by the grain of the paper.
    pub wobble: WobbleSettings,
    /// Pigment at the rim of a wash.
    pub edges: EdgeSettings,
    /// Large clouds of pigment.
    pub flow: FlowSettings,
    /// Fine grains of pigment.
    pub dispersion: DispersionSettings,
    /// The paper and its grain.
    pub paper: PaperSettings,
    /// A brush with little water.
    pub dry_brush: DryBrushSettings,
    /// Anchoring of noise while a mesh moves.
    pub coherence: CoherenceSettings,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            reference_px: 1000.0,
            abstraction: AbstractionSettings::default(),
            tones: ToneSettings::default(),
            wet: WetSettings::default(),
            margin: MarginSettings::default(),
            back_runs: BackRunSettings::default(),
            toon: ToonSettings::default(),
            wash: WashSettings::default(),
            wobble: WobbleSettings::default(),
            edges: EdgeSettings::default(),
            flow: FlowSettings::default(),
            dispersion: DispersionSettings::default(),
            paper: PaperSettings::default(),
            dry_brush: DryBrushSettings::default(),
            coherence: CoherenceSettings::default(),
        }
    }
}

impl Settings {
    /// The settings for a picture of `width` x `height` pixels: all lengths are scaled from
    /// the reference to its pixels. Applying this twice changes nothing. Scaled lengths may be
    /// outside of the documented ranges, which hold for the reference.
    #[must_use]
    pub fn for_size(&self, width: usize, height: usize) -> Self {
        let longer = width.max(height).max(1) as f32;
        let by = longer / self.reference_px;
        let mut own = self.clone();
        own.reference_px = longer;
        own.abstraction.scale(by);
        own.wet.scale(by);
        own.margin.scale(by);
        own.back_runs.scale(by);
        own.dry_brush.scale(by);
        own.wobble.scale(by);
        own.edges.scale(by);
        own.flow.scale(by);
        own.dispersion.scale(by);
        own.paper.scale(by);
        own.coherence.scale(by);
        own
    }

    pub(super) fn figures(&self) -> Vec<Figure> {
        let own = vec![Figure::new("reference_px", self.reference_px, [16.0, 65536.0])];
        [
            own,
            self.abstraction.figures(),
            self.tones.figures(),
            self.wet.figures(),
            self.margin.figures(),
            self.back_runs.figures(),
            self.toon.figures(),
            self.wash.figures(),
            self.wobble.figures(),
            self.edges.figures(),
            self.flow.figures(),
            self.dispersion.figures(),
            self.paper.figures(),
            self.dry_brush.figures(),
            self.coherence.figures(),
        ]
        .concat()
    }
}
