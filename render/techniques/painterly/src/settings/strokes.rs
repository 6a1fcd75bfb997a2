//! Settings of strokes and of how they overlap.

use graphics::mesh::Along;
use serde::{Deserialize, Serialize};

use super::figures::Figure;

/// The principal curvature that strokes run along.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StrokeDirection {
    /// The least: along a branch.
    #[default]
    Least,
    /// The greatest: around a branch.
    Greatest,
}

/// What stays as the model comes nearer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Zoom {
    /// Size and density of strokes in the picture.
    #[default]
    Screen,
    /// Size and density of strokes on the model, so that strokes grow (Yan and others 2008).
    Surface,
}

/// Where in the map a splat begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Offsets {
    /// Where its strokes continue those of its neighbours.
    #[default]
    Matched,
    /// Anywhere (Yan and others 2008).
    Random,
}

/// Strokes: their size, direction and place on the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct StrokeSettings {
    /// Distance of neighbouring brush strokes in px, 1..=200.
    pub width_px: f32,
    /// Half the width of a splat, in distances of brush strokes, 0.5..=8.
    pub radius: f32,
    /// Length of a splat by its width, 1..=4.
    pub stretch: f32,
    /// The curvature that strokes run along.
    pub along: StrokeDirection,
    /// Length over which directions are smoothed, as a share of the model's radius, 0..=1.
    pub smoothing: f32,
    /// How far splats lie down on the surface: 0 faces the viewer, flat on the canvas, 1 lies on the
    /// surface; 0..=1.
    pub tilt: f32,
    /// What stays as the model comes nearer.
    pub zoom: Zoom,
    /// Seed of the places of strokes.
    pub seed: u64,
}

/// Overlap: how strokes that cover a place share it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct OverlapSettings {
    /// Mean number of splats that reach a place, 2..=32.
    pub splats: f32,
    /// Power of the weights: 1, 2, 4, 8 or 16. At 1 strokes blur into each other (Yan and others
    /// 2008), at 16 each ends at an edge.
    pub sharpness: u32,
    /// How far ridges of strokes lie above furrows where strokes overlap, so that strokes end in
    /// bristles, 0..=0.95: the weight of the lowest furrow is 1 less this, squared. Maps without relief
    /// have no ridges.
    pub ridges: f32,
    /// Share of the splats that are about to appear or vanish as the model moves, 0.05..=1.
    pub fade: f32,
    /// Where in the map a splat begins.
    pub offsets: Offsets,
    /// How far strokes reach beyond outlines, 0..=1.
    pub overhang: f32,
}

impl From<StrokeDirection> for Along {
    fn from(direction: StrokeDirection) -> Self {
        match direction {
            StrokeDirection::Least => Self::Least,
            StrokeDirection::Greatest => Self::Greatest,
        }
    }
}

impl Default for StrokeSettings {
    fn default() -> Self {
        Self {
            width_px: 10.0,
            radius: 1.5,
            stretch: 1.6,
            along: StrokeDirection::default(),
            smoothing: 0.05,
            tilt: 0.6,
            zoom: Zoom::default(),
            seed: 1,
        }
    }
}

impl Default for OverlapSettings {
    fn default() -> Self {
        Self {
            splats: 8.0,
            sharpness: 4,
            ridges: 0.75,
            fade: 1.0,
            offsets: Offsets::default(),
            overhang: 0.5,
        }
    }
}

impl StrokeSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("strokes.width_px", self.width_px, [1.0, 200.0]),
            Figure::new("strokes.radius", self.radius, [0.5, 8.0]),
            Figure::new("strokes.stretch", self.stretch, [1.0, 4.0]),
            Figure::new("strokes.smoothing", self.smoothing, [0.0, 1.0]),
            Figure::new("strokes.tilt", self.tilt, [0.0, 1.0]),
        ]
    }

    pub(super) fn scale(&mut self, by: f32) {
        self.width_px *= by;
    }

    /// Half the width and half the length of a splat, in px.
    pub(crate) fn radii_px(&self) -> [f32; 2] {
        let across = self.width_px * self.radius;
        [across, across * self.stretch]
    }
}

impl OverlapSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("overlap.splats", self.splats, [2.0, 32.0]),
            Figure::new("overlap.sharpness", self.sharpness, [1.0, 16.0]),
            Figure::new("overlap.ridges", self.ridges, [0.0, 0.95]),
            Figure::new("overlap.fade", self.fade, [0.05, 1.0]),
            Figure::new("overlap.overhang", self.overhang, [0.0, 1.0]),
        ]
    }
}
