//! State of the painting besides its pixels.

use std::sync::Arc;

use pigment::library::PigmentLibrary;
use render::light::Light;
use render::paint::document::{Lighting, Medium, Slots};
use render::paint::strokes::BrushSpec;

/// A small sRGB picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Thumbnail {
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// Pixels with alpha row by row; transparent where there is no paint.
    pub pixels: Vec<[u8; 4]>,
}

/// State of a dry layer.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerState {
    /// Pigment of each slot.
    pub slots: Slots,
    /// Factor of the optical thickness; 0 hides the layer.
    pub opacity: f64,
    /// Mean height of the cells with paint, in mm.
    pub mean_mm: f64,
    /// Maximum height in mm.
    pub max_mm: f64,
    /// Fraction of the canvas with paint of this layer, 0 to 1.
    pub coverage: f64,
    /// Picture of the layer alone over the ground.
    pub thumbnail: Arc<Thumbnail>,
}

/// State of a brush.
#[derive(Debug, Clone, PartialEq)]
pub struct BrushState {
    /// Name of the brush.
    pub name: String,
    /// Shape and size of its head.
    pub spec: BrushSpec,
    /// Mean height of the paint on its whole head, in mm; 0 if it is clean.
    pub amount_mm: f64,
    /// Fraction of vehicle in this paint, 0 to 1.
    pub vehicle: f64,
    /// Parts by slot of the palette, with sum 1; all 0 without pigment.
    pub parts: [f64; render::layer::SLOTS],
    /// Mean height of the paint at its tip, in mm: what it paints with now.
    pub tip_mm: f64,
    /// Largest load that it can take besides, in mm; infinite for a brush that was never used.
    pub most_load_mm: f64,
    /// sRGB of the mixture at its tip in an opaque film, or of the whole head if the tip is
    /// clean; `None` without pigment.
    pub color: Option<[u8; 3]>,
}

/// State of the painting besides its pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintingState {
    /// Title of the painting.
    pub title: String,
    /// Columns and rows of cells of the canvas.
    pub canvas_cells: (usize, usize),
    /// Columns and rows of cells of the palette.
    pub palette_cells: (usize, usize),
    /// Width of a cell of canvas and palette in mm.
    pub cell_mm: f64,
    /// Library of the pigments.
    pub library: Arc<PigmentLibrary>,
    /// Pigment of each slot of the palette.
    pub slots: Slots,
    /// sRGB of the pigment of each slot in an opaque film, under the light.
    pub masstones: [Option<[u8; 3]>; render::layer::SLOTS],
    /// sRGB of one part of the pigment of each slot in nine parts of white.
    pub tints: [Option<[u8; 3]>; render::layer::SLOTS],
    /// Dry layers, lowest first.
    pub layers: Vec<LayerState>,
    /// Names of the light, and its direction.
    pub lighting: Lighting,
    /// Spectrum and wavelengths of the light.
    pub light: Arc<Light>,
    /// Second light of the split view, if it is on.
    pub second_lighting: Option<Lighting>,
    /// Scattering per mm, stiffness and gloss of the binder.
    pub medium: Medium,
    /// Reflectance of the ground on the grid of the library.
    pub ground_reflectance: Arc<Vec<f64>>,
    /// Labels of the actions of the history, the oldest first. Those from `history_done` on
    /// were undone.
    pub history: Vec<String>,
    /// Number of actions of the history that are done.
    pub history_done: usize,
    /// Memory that the undo history uses, and its limit, in bytes.
    pub undo_bytes: (u64, u64),
    /// All brushes, in the order of their names.
    pub brushes: Vec<BrushState>,
    /// Name of the backend.
    pub backend: String,
    /// Counter of changes of the painting.
    pub revision: u64,
    /// Whether a stroke is open.
    pub stroke_open: bool,
}

/// Painting speed and latency of the worker.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Performance {
    /// Number of sub-steps in the last second.
    pub substeps_per_second: f64,
    /// Number of sub-steps that wait to be painted.
    pub waiting_substeps: usize,
    /// Mean time from the arrival of a sample until its tiles are sent, in ms, over the last
    /// second.
    pub mean_latency_ms: f64,
    /// Longest such time of the last second, in ms.
    pub max_latency_ms: f64,
}
