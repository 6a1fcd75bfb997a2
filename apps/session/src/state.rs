//! The state of the painting as the front end shows it: everything except the pixels.

use std::sync::Arc;

use paint::document::{LayerId, Lighting, Medium, Slots};
use paint::layer::layer_label;
use paint::light::Light;
use paint::strokes::BrushSpec;
use pigment::library::PigmentLibrary;
use spectra::color::Lab;

/// A small sRGB picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Thumbnail {
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// Pixels with alpha row by row. They are transparent where there is no paint.
    pub pixels: Vec<[u8; 4]>,
}

/// State of a dry layer.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerState {
    /// Its identity within the painting.
    pub id: LayerId,
    /// Its name, which may be empty.
    pub name: String,
    /// Whether it is shown.
    pub visible: bool,
    /// Pigment of each slot.
    pub slots: Slots,
    /// Factor of the optical thickness.
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

impl LayerState {
    /// Its name, or its number if it has none.
    #[must_use]
    pub fn label(&self) -> String {
        layer_label(self.id, &self.name)
    }
}

/// Colour of a film under the light of the painting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmColor {
    /// CIELAB relative to the white of the light.
    pub lab: Lab,
    /// sRGB as the screen shows it.
    pub srgb: [u8; 3],
}

/// Films of the paint that a brush holds now, as a paint maker draws them down on cards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BrushSwatch {
    /// Film so thick that it hides everything below.
    pub opaque: FilmColor,
    /// Bare ground of the painting.
    pub ground: FilmColor,
    /// Film of the present thickness over the ground.
    pub over_ground: FilmColor,
    /// Bare black and white card (ISO 6504-3).
    pub cards: [FilmColor; 2],
    /// Film of the present thickness over these cards.
    pub over_cards: [FilmColor; 2],
    /// Contrast ratio of this film, 0 to 1: Y over the black card divided by Y over the white one.
    /// From 0.98 on it hides.
    pub contrast: f64,
    /// Thickness of the film with its vehicle, in mm.
    pub thickness_mm: f64,
}

/// State of a brush.
#[derive(Debug, Clone, PartialEq)]
pub struct BrushState {
    /// Name of the brush.
    pub name: String,
    /// Shape and size of its head.
    pub spec: BrushSpec,
    /// Mean height of the paint on its whole head in mm. A clean brush has 0.
    pub amount_mm: f64,
    /// Fraction of vehicle in this paint, 0 to 1.
    pub vehicle: f64,
    /// Parts by slot of the palette. Their sum is 1, or 0 without pigment.
    pub parts: [f64; paint::layer::SLOTS],
    /// Mean height of the paint at its tip in mm: this is what it paints with now.
    pub tip_mm: f64,
    /// Largest load that it can still take, in mm. This is infinite for a brush that was never
    /// used.
    pub most_load_mm: f64,
    /// sRGB of the mixture at its tip in an opaque film. If the tip is clean, this is the mixture
    /// of the whole head. Without pigment it is `None`.
    pub color: Option<[u8; 3]>,
    /// Films of this mixture, or `None` without pigment.
    pub swatch: Option<Box<BrushSwatch>>,
}

/// The canvas after an action of the history.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HistoryShot {
    /// Small picture of the canvas.
    pub picture: Arc<Thumbnail>,
    /// Pixels of the picture that the action changed, as left, top, width and height. This is
    /// `None` if it changed none, or if the state before it is unknown.
    pub changed: Option<[usize; 4]>,
}

/// Small pictures of the history.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct HistoryShots {
    /// The canvas before the first action and after each one. Some pictures may be missing.
    pub shots: Vec<Option<HistoryShot>>,
    /// Memory that they take, in bytes.
    pub bytes: usize,
    /// Memory that they may take, in bytes.
    pub most_bytes: usize,
}

/// Mask of the canvas, for drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct MaskState {
    /// Lines between covered and open cells, from corner to corner in cells, along x or y. If there
    /// are very many, they follow blocks of cells instead.
    pub outline: Vec<[(u32, u32); 2]>,
    /// Share of the canvas that is covered, 0 to 1.
    pub covered: f64,
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
    pub masstones: [Option<[u8; 3]>; paint::layer::SLOTS],
    /// sRGB of one part of the pigment of each slot in nine parts of white.
    pub tints: [Option<[u8; 3]>; paint::layer::SLOTS],
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
    /// Reflectance of the ground at the wavelengths of the library.
    pub ground_reflectance: Arc<Vec<f64>>,
    /// Labels of the actions of the history, the oldest first. The actions from `history_done` on
    /// were undone.
    pub history: Vec<String>,
    /// Number of actions of the history that are done.
    pub history_done: usize,
    /// Pictures of the canvas along the history.
    pub history_shots: HistoryShots,
    /// Memory that the undo history uses, and its limit, in bytes.
    pub undo_bytes: (u64, u64),
    /// All brushes, in the order of their names.
    pub brushes: Vec<BrushState>,
    /// Mask of the canvas, if one is set.
    pub mask: Option<Arc<MaskState>>,
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
    /// Mean time in ms from the arrival of a sample until its tiles are sent, over the last second.
    pub mean_latency_ms: f64,
    /// Longest such time of the last second, in ms.
    pub max_latency_ms: f64,
    /// Whether the paint is so far behind the pen that pictures should wait.
    pub paint_is_behind: bool,
}
