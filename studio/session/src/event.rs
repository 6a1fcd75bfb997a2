//! What the worker tells the window.

use std::sync::Arc;
use std::time::Instant;

use render::layer::SLOTS;
use render::paint::document::{Document, Slots};
use render::paint::strokes::{StrokeScript, SurfaceId};
use render::tile::Rect;
use spectra::hint::Hint;

use super::state::{PaintingState, Performance};

/// A rectangle of the picture, ready for the screen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TilePixels {
    /// Its cells.
    pub rect: Rect,
    /// sRGB, 8 bits, row by row.
    pub pixels: Vec<[u8; 4]>,
}

/// Paint of one layer at a place.
#[derive(Debug, Clone, PartialEq)]
pub struct PickedLayer {
    /// Its pigments.
    pub slots: Slots,
    /// Mean height of each slot's paint, and of vehicle last, in mm.
    pub amounts_mm: [f64; SLOTS + 1],
    /// What its optical thickness is multiplied with.
    pub opacity: f64,
}

/// What lies at a place.
#[derive(Debug, Clone, PartialEq)]
pub struct Picked {
    /// Where.
    pub surface: SurfaceId,
    /// From the left edge, in mm.
    pub x_mm: f64,
    /// From the upper edge, in mm.
    pub y_mm: f64,
    /// Reflectance on the grid of the library, mean over the cells, as an
    /// instrument would read it: no relief, no gloss.
    pub reflectance: Vec<f64>,
    /// Dry layers from the lowest, the wet one last.
    pub layers: Vec<PickedLayer>,
}

/// The painting at one moment.
#[derive(Debug, Clone)]
pub struct Snapshot {
    /// As the caller numbered it.
    pub number: u64,
    /// The canvas.
    pub canvas: Arc<Document>,
    /// The palette.
    pub palette: Arc<Document>,
    /// Counts changes of paint; equal means nothing happened in between.
    pub revision: u64,
}

/// What the worker tells.
#[derive(Debug, Clone)]
pub enum Event {
    /// Another painting is there: both pictures follow whole.
    Opened(Arc<PaintingState>),
    /// Something other than pixels changed.
    State(Arc<PaintingState>),
    /// Part of a picture changed.
    Tiles {
        /// Of which surface.
        surface: SurfaceId,
        /// Whether it is the picture under the second light.
        second: bool,
        /// What changed.
        tiles: Vec<TilePixels>,
        /// When the newest sample that it shows had arrived.
        newest: Option<Instant>,
    },
    /// The head as it is bent now, or lifted.
    Head(Option<Arc<HeadOnCanvas>>),
    /// How the worker keeps up.
    Performance(Performance),
    /// What lies at a place.
    Picked(Arc<Picked>),
    /// The documents asked for.
    Snapshot(Snapshot),
    /// The recording asked for.
    Recording {
        /// As the caller numbered it.
        number: u64,
        /// The script.
        script: Arc<StrokeScript>,
    },
    /// How far a replay is: actions done, of how many.
    Progress {
        /// Actions done.
        done: usize,
        /// Of how many.
        of: usize,
    },
    /// A replay ended, as wanted or cancelled.
    Replayed,
    /// Something to be said to the painter; `true` if it is an error.
    Message {
        /// One sentence.
        text: String,
        /// What to try.
        hint: Option<Hint>,
        /// Whether something failed.
        failed: bool,
    },
}

/// The surface of a head over the canvas, for drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct HeadOnCanvas {
    /// Over which surface.
    pub surface: SurfaceId,
    /// Vertices around the head.
    pub around: usize,
    /// Vertices from the ferrule to the tip.
    pub along: usize,
    /// `around * along` places: x and y in cells of the canvas, height in cells;
    /// the ferrule first.
    pub vertices: Vec<[f32; 3]>,
}
