//! Events that the worker sends to the front end.

use std::sync::Arc;
use web_time::Instant;

use documents::hint::Hint;
use graphics::tile::Rect;
use paint::document::{Document, Slots};
use paint::layer::SLOTS;
use paint::mask::Mask;
use paint::session::{KeptHead, RecordingTail};
use paint::strokes::{KeptBrush, StrokeScript, SurfaceId};

use super::state::{PaintingState, Performance};

/// Pixels of a rectangle of a picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TilePixels {
    /// Cells of the rectangle. A pixel is a cell.
    pub rect: Rect,
    /// sRGB and alpha with 8 bits each, row by row.
    pub pixels: Vec<[u8; 4]>,
}

/// Mean paint of one layer in a picked circle.
#[derive(Debug, Clone, PartialEq)]
pub struct PickedLayer {
    /// Label of the layer: its name, its number, or `Wet`.
    pub label: String,
    /// Pigment of each slot.
    pub slots: Slots,
    /// Mean height of each slot and, last, of the vehicle, in mm.
    pub amounts_mm: [f64; SLOTS + 1],
    /// Factor of the optical thickness. A hidden layer has 0.
    pub opacity: f64,
}

/// Reflectance and paint at a position.
#[derive(Debug, Clone, PartialEq)]
pub struct Picked {
    /// Surface that was picked from.
    pub surface: SurfaceId,
    /// Distance from the left edge in mm.
    pub x_mm: f64,
    /// Distance from the upper edge in mm.
    pub y_mm: f64,
    /// Mean reflectance at the wavelengths of the library, as an instrument would measure it
    /// without relief and gloss.
    pub reflectance: Vec<f64>,
    /// Dry layers from the lowest, then the wet layer.
    pub layers: Vec<PickedLayer>,
}

/// The painting at one moment.
#[derive(Debug, Clone)]
pub struct Snapshot {
    /// Number of the request.
    pub number: u64,
    /// Document of the canvas.
    pub canvas: Arc<Document>,
    /// Document of the palette.
    pub palette: Arc<Document>,
    /// All brushes with the paint that they hold.
    pub brushes: Arc<Vec<KeptBrush>>,
    /// Counts changes of the painting: if two snapshots have the same value, nothing changed
    /// between them.
    pub revision: u64,
}

/// Everything that a later session needs to continue from one moment.
#[derive(Debug, Clone)]
pub struct KeptPainting {
    /// Canvas and palette.
    pub snapshot: Snapshot,
    /// The recording from the action that you asked for. This is `None` if nothing is recorded, or
    /// if samples of a replayed stroke still wait to be painted.
    pub recording: Option<RecordingTail>,
    /// All heads, with the paint on them.
    pub brushes: Vec<KeptHead>,
    /// The mask of the canvas, if one is set.
    pub mask: Option<Arc<Mask>>,
}

/// A message of the worker.
#[derive(Debug, Clone)]
pub enum Event {
    /// Another painting was opened. Both pictures follow completely.
    Opened(Arc<PaintingState>),
    /// Something other than pixels changed.
    State(Arc<PaintingState>),
    /// Part of a picture changed.
    Tiles {
        /// Surface of the picture.
        surface: SurfaceId,
        /// Whether it is the picture under the second light.
        second: bool,
        /// Pixels of the changed tiles.
        tiles: Vec<TilePixels>,
        /// Arrival time of the newest pen sample that the tiles show.
        newest: Option<Instant>,
    },
    /// How the head is bent now, or `None` after it was lifted.
    Head(Option<Arc<HeadOnCanvas>>),
    /// Painting speed and latency changed.
    Performance(Performance),
    /// Answer to [`Command::Pick`](super::Command::Pick).
    Picked(Arc<Picked>),
    /// Answer to [`Command::Snapshot`](super::Command::Snapshot).
    Snapshot(Snapshot),
    /// Answer to [`Command::Keep`](super::Command::Keep).
    Kept(Arc<KeptPainting>),
    /// Answer to [`Command::Recording`](super::Command::Recording).
    Recording {
        /// Number of the request.
        number: u64,
        /// The recording so far.
        script: Arc<StrokeScript>,
    },
    /// Progress of a replay.
    Progress {
        /// Number of actions played.
        done: usize,
        /// Number of actions of the script.
        of: usize,
    },
    /// A replay ended or was cancelled.
    Replayed,
    /// After a stroke, a brush had pigments at its tip that it was not loaded with. The front end
    /// advises you to wash or wipe it. A worker sends this only once.
    DirtyBrush(String),
    /// A message for the painter, for example that the recording ended early.
    Message {
        /// Text of the message, one sentence.
        text: String,
        /// Advice on what to do, if there is any.
        hint: Option<Hint>,
        /// Whether something failed.
        failed: bool,
    },
}

/// Shape of a brush's head over the canvas, for drawing it.
#[derive(Debug, Clone, PartialEq)]
pub struct HeadOnCanvas {
    /// Surface that the head is over.
    pub surface: SurfaceId,
    /// Number of vertices around the head.
    pub around: usize,
    /// Number of vertices from the ferrule to the tip.
    pub along: usize,
    /// `around * along` vertices, starting at the ferrule: x and y in cells of the canvas, height in
    /// cells.
    pub vertices: Vec<[f32; 3]>,
}
