//! Commands that the front end sends to the worker.

use web_time::Instant;

use paint::document::{Document, Lighting};
use paint::pose::Sample;
use paint::session::KeptSession;
use paint::strokes::{
    Action, BrushSpec, Recipe, SampleDecimals, SideTable, StrokeScript, StrokeTool, SurfaceId,
};
use pigment::library::PigmentLibrary;

use super::event::Picked;

/// A sample of the pen and its time of arrival.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PenSample {
    /// Position, pressure and angles of the brush over the surface.
    pub sample: Sample,
    /// Time at which the system reported it. We measure latency from here.
    pub arrived: Instant,
}

/// How fast a replay runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pace {
    /// Without pauses, as fast as the machine allows.
    Fast,
    /// At the pace of the painter, by the times of the samples.
    AsPainted,
}

/// The source of a painting that you open.
#[derive(Debug, Clone)]
pub enum Origin {
    /// A canvas without paint as the header of a script describes it. The actions are not played.
    Blank {
        /// Script with canvas, pigments, medium and light.
        script: Box<StrokeScript>,
        /// Library of the pigments that it names.
        library: Box<PigmentLibrary>,
    },
    /// A painting that was read from a file.
    Painting(Box<Document>),
    /// A painting that was read from a file, with its saved palette and brushes.
    WithTable {
        /// Document of the canvas.
        canvas: Box<Document>,
        /// Palette and brushes as they were saved.
        table: Box<SideTable>,
    },
    /// Canvas and palette recovered from an autosave.
    Recovered {
        /// Document of the canvas.
        canvas: Box<Document>,
        /// Document of the palette.
        palette: Box<Document>,
        /// Brushes and recording. If this is `None`, the brushes are clean and nothing is recorded.
        kept: Option<Box<KeptSession>>,
    },
}

/// A request to the worker, which executes commands in order.
#[derive(Debug)]
pub enum Command {
    /// Opens a painting and closes the open one.
    Open(Origin),
    /// Adds a brush under a name, or replaces the one with that name.
    SetBrush {
        /// Name of the brush.
        name: String,
        /// Shape and size of its head.
        spec: BrushSpec,
    },
    /// Sets a brush down. Samples follow.
    PenDown {
        /// Surface to paint on.
        surface: SurfaceId,
        /// Name of the brush.
        brush: String,
        /// Number of decimals to which the samples of the stroke are rounded.
        decimals: SampleDecimals,
    },
    /// Sets the head of a brush down as a tool that works the wet paint. Samples follow and are
    /// rounded to [`SampleDecimals::PEN`].
    ToolDown {
        /// The tool that the head is used as.
        tool: StrokeTool,
        /// Surface to work on.
        surface: SurfaceId,
        /// Name of the brush.
        brush: String,
    },
    /// Adds samples to the open stroke.
    PenMove(Vec<PenSample>),
    /// Lifts the brush, which ends the stroke.
    PenUp,
    /// Begins a group: its strokes are one step of undo and redo.
    BeginGroup,
    /// Ends a group. If you did anything but strokes since it began, nothing is grouped.
    EndGroup,
    /// Applies an action. This finishes an open stroke first.
    Apply(Action),
    /// Applies an action of light, gloss, stiffness or opacity while you drag its slider. All
    /// adjustments until [`Command::EndAdjustment`] become one action of the history.
    Adjust(Action),
    /// Ends an adjustment when you release the slider.
    EndAdjustment,
    /// Undoes or repeats actions until this many actions of the history are done.
    GoTo(usize),
    /// Sets the second light of the split view. Pass `None` to turn it off.
    SetSecondLight(Option<Lighting>),
    /// Asks for reflectance and paint at a position. The answer is
    /// [`Event::Picked`](super::Event::Picked).
    Pick {
        /// Surface to pick from.
        surface: SurfaceId,
        /// Distance from the left edge in mm.
        x_mm: f64,
        /// Distance from the upper edge in mm.
        y_mm: f64,
        /// Radius of the averaged circle in mm. With 0 you get one cell.
        radius_mm: f64,
    },
    /// Asks for the present documents, to save or export them. The answer is
    /// [`Event::Snapshot`](super::Event::Snapshot) with this number.
    Snapshot(u64),
    /// Asks for everything that a later session needs to continue from here. The answer is
    /// [`Event::Kept`](super::Event::Kept) with this number.
    Keep {
        /// Number of the request.
        number: u64,
        /// How many actions of the recording you know already. The answer has the others.
        recorded: usize,
    },
    /// Asks for the recording since the painting was opened. The answer is
    /// [`Event::Recording`](super::Event::Recording) with this number.
    Recording(u64),
    /// Opens the painting that a script describes and plays the script on it.
    Replay {
        /// Script to play.
        script: Box<StrokeScript>,
        /// Library of its pigments.
        library: Box<PigmentLibrary>,
        /// Pace of the replay.
        pace: Pace,
    },
    /// Ends a replay.
    Cancel,
    /// Loads a brush with the mean wet paint that was picked. Paint already on the brush stays.
    LoadPicked {
        /// Name of the brush.
        brush: String,
        /// Answer to [`Command::Pick`].
        picked: Box<Picked>,
        /// Height of the paint on the head, in mm.
        amount_mm: f64,
    },
    /// Squeezes a heap of paint onto the palette ([`Action::Squeeze`]), at the first of `places`
    /// without wet paint around it. If there is paint at all of them, it takes the place with the
    /// least.
    SqueezeInFreeSpace {
        /// Parts of pigments by their names in the library.
        recipe: Recipe,
        /// Fraction of clear vehicle, 0 to 1.
        vehicle: f64,
        /// Volume of the heap in mm3.
        volume_mm3: f64,
        /// Positions from the upper left corner in mm, in order of preference.
        places: Vec<[f64; 2]>,
        /// Half the side of the square around a position that must be free, in mm.
        reach_mm: f64,
    },
    /// Limits the memory for undo, in bytes.
    SetUndoBytes(u64),
    /// Ends the thread.
    Quit,
}

impl Command {
    /// Whether the worker answers this while a stroke is open. Other commands end the stroke,
    /// unless they belong to the pen.
    #[must_use]
    pub fn is_question(&self) -> bool {
        matches!(
            self,
            Self::Snapshot(_)
                | Self::Keep { .. }
                | Self::Recording(_)
                | Self::Pick { .. }
                | Self::SetUndoBytes(_)
                | Self::EndAdjustment
        )
    }

    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Open(_) => "opening",
            Self::SetBrush { .. } => "taking a brush",
            Self::PenDown { .. } | Self::ToolDown { .. } | Self::PenMove(_) | Self::PenUp => {
                "a stroke"
            }
            Self::BeginGroup | Self::EndGroup => "a group of strokes",
            Self::Apply(action) | Self::Adjust(action) => action.kind(),
            Self::EndAdjustment => "settling",
            Self::GoTo(_) => "going through the history",
            Self::SetSecondLight(_) => "a second light",
            Self::Pick { .. } => "picking a colour",
            Self::Snapshot(_) | Self::Keep { .. } => "saving",
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
