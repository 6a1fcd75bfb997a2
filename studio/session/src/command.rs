//! What the window asks of the worker.

use std::time::Instant;

use pigment::library::PigmentLibrary;
use render::paint::document::{Document, Lighting};
use render::paint::pose::Sample;
use render::paint::strokes::{Action, BrushSpec, Recipe, StrokeScript, SurfaceId};

use super::event::Picked;

/// A sample of the pen, and when it arrived.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PenSample {
    /// Where the brush is held, in mm of the surface.
    pub sample: Sample,
    /// When the system told it; latency is counted from here.
    pub arrived: Instant,
}

/// How fast a recording is played.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pace {
    /// As fast as the machine can.
    Fast,
    /// As it was painted, by the seconds of its samples.
    AsPainted,
}

/// Where a painting begins.
#[derive(Debug, Clone)]
pub enum Origin {
    /// A canvas without paint: the header of a script, its actions not played.
    Blank {
        /// Canvas, palette, medium, light.
        script: Box<StrokeScript>,
        /// The pigments that it names.
        library: Box<PigmentLibrary>,
    },
    /// A painting from a file, with what it was read from, if that is where it
    /// may be saved again.
    Painting(Box<Document>),
    /// A painting and the palette beside it, as recovered.
    Recovered {
        /// The canvas.
        canvas: Box<Document>,
        /// The palette.
        palette: Box<Document>,
    },
}

/// What the window asks for. Commands are carried out in order.
#[derive(Debug)]
pub enum Command {
    /// Takes up another painting, in place of the one there is.
    Open(Origin),
    /// Takes a brush into the stand under a name, or exchanges the one of that
    /// name for another.
    SetBrush {
        /// Its name in recordings.
        name: String,
        /// Its head.
        spec: BrushSpec,
    },
    /// Sets a brush down; samples follow.
    PenDown {
        /// Where.
        surface: SurfaceId,
        /// Which brush.
        brush: String,
    },
    /// Leads the brush on.
    PenMove(Vec<PenSample>),
    /// Lifts the brush.
    PenUp,
    /// One action of the history. A stroke that is open ends first.
    Apply(Action),
    /// As `Act` while a control is being dragged: of light, gloss or opacity. All
    /// until [`Command::EndAdjustment`] are one action.
    Adjust(Action),
    /// The control was let go.
    EndAdjustment,
    /// Goes to a place in the history: so many actions done.
    GoTo(usize),
    /// A second light for the split view, or none.
    SetSecondLight(Option<Lighting>),
    /// What lies at a place; the answer is [`Event::Picked`](super::Event::Picked).
    Pick {
        /// Where.
        surface: SurfaceId,
        /// From the left edge, in mm.
        x_mm: f64,
        /// From the upper edge, in mm.
        y_mm: f64,
        /// Mean over cells this near, in mm; 0 is one cell.
        radius_mm: f64,
    },
    /// The documents as they are now, for saving and exporting; the answer is
    /// [`Event::Snapshot`](super::Event::Snapshot) with the same number.
    Snapshot(u64),
    /// The recording since the painting was taken up; the answer is
    /// [`Event::Recording`](super::Event::Recording) with the same number.
    Recording(u64),
    /// Plays a script on the painting that it describes.
    Replay {
        /// The script.
        script: Box<StrokeScript>,
        /// Its pigments.
        library: Box<PigmentLibrary>,
        /// How fast.
        pace: Pace,
    },
    /// Ends a replay where it is.
    Cancel,
    /// Puts what was picked on a brush, as it is: the mean paint of its wet layer.
    LoadPicked {
        /// Which brush.
        brush: String,
        /// What was picked.
        picked: Box<Picked>,
        /// How high it lies on the head, in mm.
        amount_mm: f64,
    },
    /// Puts a heap of paint on the palette, as [`Action::Squeeze`], at the first of
    /// some places that has no wet paint around it; if none has, where there is the
    /// least.
    SqueezeInFreeSpace {
        /// The paint, by names of the library.
        recipe: Recipe,
        /// Share of the whole that is clear vehicle, 0..1.
        vehicle: f64,
        /// How much, in cubic millimetres.
        volume_mm3: f64,
        /// Places from the upper left corner, in mm; the most welcome first.
        places: Vec<[f64; 2]>,
        /// How far around a place must be free, in mm.
        reach_mm: f64,
    },
    /// Bytes that undo may keep from now on.
    SetUndoBytes(u64),
    /// Ends the thread.
    Quit,
}

impl Command {
    /// What it is, for people.
    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Open(_) => "opening",
            Self::SetBrush { .. } => "taking a brush",
            Self::PenDown { .. } | Self::PenMove(_) | Self::PenUp => "a stroke",
            Self::Apply(action) | Self::Adjust(action) => action.kind(),
            Self::EndAdjustment => "settling",
            Self::GoTo(_) => "going through the history",
            Self::SetSecondLight(_) => "a second light",
            Self::Pick { .. } => "picking a colour",
            Self::Snapshot(_) => "saving",
            Self::Recording(_) => "a recording",
            Self::Replay { .. } => "a replay",
            Self::Cancel => "cancelling",
            Self::LoadPicked { .. } => "loading a brush",
            Self::SqueezeInFreeSpace { .. } => "laying paint out",
            Self::SetUndoBytes(_) => "the memory of undo",
            Self::Quit => "quitting",
        }
    }
}
