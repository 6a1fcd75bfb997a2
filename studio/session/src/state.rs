//! What the window knows of the painting.

use std::sync::Arc;

use pigment::library::PigmentLibrary;
use render::light::Light;
use render::paint::document::{Lighting, Medium, Slots};
use render::paint::strokes::BrushSpec;

/// A small picture, sRGB.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Thumbnail {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Row by row; transparent where there is no paint.
    pub pixels: Vec<[u8; 4]>,
}

/// A dry layer.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerState {
    /// Its pigments.
    pub slots: Slots,
    /// What its optical thickness is multiplied with; 0 hides it.
    pub opacity: f64,
    /// Mean height where it has paint, in mm.
    pub mean_mm: f64,
    /// Greatest height, in mm.
    pub max_mm: f64,
    /// Share of the canvas that it covers, 0..1.
    pub coverage: f64,
    /// The layer alone over the ground.
    pub thumbnail: Arc<Thumbnail>,
}

/// A brush in the stand.
#[derive(Debug, Clone, PartialEq)]
pub struct BrushState {
    /// Its name.
    pub name: String,
    /// Its head.
    pub spec: BrushSpec,
    /// Mean height of the paint on it, in mm; 0 is clean.
    pub amount_mm: f64,
    /// Share of it that is vehicle, 0..1.
    pub vehicle: f64,
    /// Parts by slot of the palette, summing to 1; all 0 without pigment.
    pub parts: [f64; render::layer::SLOTS],
    /// sRGB of its mixture in a film that hides, if it has pigment.
    pub color: Option<[u8; 3]>,
}

/// Everything about the painting but its pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintingState {
    /// What it is called.
    pub title: String,
    /// Cells of the canvas.
    pub canvas_cells: (usize, usize),
    /// Cells of the palette.
    pub palette_cells: (usize, usize),
    /// Width of a cell of both in mm.
    pub cell_mm: f64,
    /// The pigments there are.
    pub library: Arc<PigmentLibrary>,
    /// Those on the palette.
    pub slots: Slots,
    /// sRGB of each slot's pigment in a film that hides, under the light.
    pub masstones: [Option<[u8; 3]>; render::layer::SLOTS],
    /// The same, one part in ten of the library's white.
    pub tints: [Option<[u8; 3]>; render::layer::SLOTS],
    /// Dry layers, lowest first.
    pub layers: Vec<LayerState>,
    /// The light.
    pub lighting: Lighting,
    /// The same with its curve and wavelengths.
    pub light: Arc<Light>,
    /// The second light of the split view.
    pub second_lighting: Option<Lighting>,
    /// The binder.
    pub medium: Medium,
    /// The reflectance of the ground, on the library's grid.
    pub ground_reflectance: Arc<Vec<f64>>,
    /// What each action of the history was, oldest first; those after `done` were
    /// taken back.
    pub history: Vec<String>,
    /// How many of them are done.
    pub history_done: usize,
    /// Bytes that undo keeps, and may keep.
    pub undo_bytes: (u64, u64),
    /// The stand.
    pub brushes: Vec<BrushState>,
    /// What computes.
    pub backend: String,
    /// Counts changes of paint.
    pub revision: u64,
    /// Whether a stroke is open.
    pub stroke_open: bool,
}

/// How the worker keeps up.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Performance {
    /// Sub-steps of the last second.
    pub substeps_per_second: f64,
    /// Sub-steps that wait.
    pub waiting_substeps: usize,
    /// From the arrival of a sample to its tiles being ready, in ms, the mean of
    /// the last second.
    pub mean_latency_ms: f64,
    /// The longest of the last second.
    pub max_latency_ms: f64,
}
