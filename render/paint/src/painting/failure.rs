//! Errors of paintings and of their sessions.

use crate::brush::{BrushError, ToolError};
use crate::file::PaintingFileError;
use crate::layer::LayerId;
use crate::light::PaintLightError;
use crate::stroke::StrokeError;
use crate::strokes::{InvalidValue, ScriptError, ScriptStartError};
use documents::{counted, hint::Explain};
use graphics::gpu::DeviceError;

/// Why a painting or its session refuses an action. Nothing is changed then, unless the device failed.
#[derive(Debug, thiserror::Error, Explain)]
pub enum PaintingError {
    /// The graphics device failed.
    #[error(transparent)]
    Engine(#[from] DeviceError),
    /// The light is unknown or has no wavelengths in common with the library.
    #[error(transparent)]
    #[fault(Input)]
    Light(#[from] PaintLightError),
    /// A brush head cannot have this size.
    #[error(transparent)]
    Brush(#[from] BrushError),
    /// A stroke has a sample that cannot be painted, or none.
    #[error(transparent)]
    Stroke(#[from] StrokeError),
    /// A number of a tool is out of range.
    #[error(transparent)]
    Tool(#[from] ToolError),
    /// A number is out of range.
    #[error("{what}, found `{value}`")]
    Range {
        /// Description of the range.
        what: &'static str,
        /// Value of the number.
        value: f64,
    },
    /// A recipe has no parts above 0, or a negative part.
    #[error("a recipe needs parts above 0 and none below 0, unless the paint is vehicle alone")]
    NoMixture,
    /// A place lies beside the canvas.
    #[error("there is no canvas {x_mm} mm from its left and `{y_mm}` mm from its upper edge")]
    #[hint("places are in mm from the canvas's corner")]
    OffCanvas {
        /// Distance from the left edge in mm.
        x_mm: f64,
        /// Distance from the upper edge in mm.
        y_mm: f64,
    },
    /// The paint at a place is too high for a heap on it.
    #[error("the paint {x_mm} mm from the left and `{y_mm}` mm from the top is too high for more")]
    #[hint("squeeze beside it, or spread it first")]
    NoRoom {
        /// Distance from the left edge in mm.
        x_mm: f64,
        /// Distance from the upper edge in mm.
        y_mm: f64,
    },
    /// A recipe has parts of a slot without pigment.
    #[error("slot {0} of the palette holds no pigment")]
    EmptySlot(usize),
    /// A brush cannot hold that much paint.
    #[error(
        "the brush has room for {most_mm:.2} mm of paint with cells of {cell_mm} mm, found `{amount_mm}`"
    )]
    #[hint("load less at a time, or paint with larger cells")]
    Overloaded {
        /// Height of the paint to load, in mm.
        amount_mm: f64,
        /// Height that the clean head can take, in mm.
        most_mm: f64,
        /// Width of the canvas's cells in mm.
        cell_mm: f64,
    },
    /// A pigment cannot leave the palette while it is wet on the canvas or on a brush.
    #[error("{0} is still wet, so it cannot leave the palette")]
    #[hint("dry the painting and wash the brushes first")]
    StillWet(String),
    /// A layer would need more pigments than it has slots.
    #[error("a layer holds 8 pigments, found `{0}`")]
    #[hint("dry the painting, then go on with another palette")]
    TooManyPigments(usize),
    /// The layer does not contain the pigment.
    #[error("the layer has no {0}")]
    NotThere(String),
    /// The layer contains the pigment already.
    #[error("the layer has {0} already")]
    #[hint("a layer holds each pigment once: choose one that it lacks")]
    AlreadyThere(String),
    /// The pigment is not on the palette now.
    #[error("{0} is not on the palette now")]
    #[hint("put it there with a palette action, or undo fewer actions")]
    OffPalette(String),
    /// The wet layer has no opacity.
    #[error("wet paint has no opacity of its own")]
    #[hint("dry it first")]
    WetOpacity,
    /// Ground and dry paint are as high as the arithmetic allows.
    #[error("the paint is piled as high as it can be, 256 cell widths, at column {x}, row `{y}`")]
    #[hint("paint thinner, or with larger cells")]
    TooHigh {
        /// Column of the cell, from 0.
        x: usize,
        /// Row of the cell, from 0.
        y: usize,
    },
    /// Only dry layers can be named, hidden, moved and merged.
    #[error("wet paint lies on top of all layers and has no {0} of its own")]
    #[hint("dry it first")]
    WetLayer(&'static str),
    /// One layer was named twice for a merge.
    #[error("a layer merges with another one, not with itself")]
    SameLayer,
    /// The lowest dry layer is to be merged with the one below.
    #[error("there is no dry layer below this one")]
    #[hint("name the other layer with `with`")]
    NothingBelow,
    /// One of two layers to merge is hidden, and the other is not.
    #[error("one of the two layers is hidden")]
    #[hint("show both, or hide both")]
    UnlikeVisibility,
    /// A film between two layers to merge overlaps both.
    #[error("`{0}` lies between the two layers and overlaps both")]
    #[hint("move that layer above or below both, or merge it as well")]
    FilmBetween(String),
    /// Two layers together have more pigments than a layer holds.
    #[error("a layer holds 8 pigments, these two have {}: {}", .0.len(), .0.join(", "))]
    #[hint(
        "keep them apart, or replace a pigment of one layer by one that the other layer also has"
    )]
    MergedPigments(Vec<String>),
    /// There is no dry layer with this index.
    #[error(
        "the painting has {}, counted from 0, found `{index}`",
        counted(*count, "dry layer")
    )]
    NoLayer {
        /// The index, from 0 for the lowest.
        index: usize,
        /// Number of dry layers.
        count: usize,
    },
    /// There is no dry layer with this identity.
    #[error("there is no layer {id}; the painting has {}", listed(known))]
    UnknownLayer {
        /// Identity that was named.
        id: LayerId,
        /// Identities of the dry layers.
        known: Vec<String>,
    },
    /// Merging two layers would change a colour visibly.
    #[error(
        "merging these layers would move a colour by {delta_e:.2} CIEDE2000 (at column {x}, row {y})"
    )]
    #[hint("keep them apart; layers are unlimited")]
    MergeShows {
        /// Largest colour difference in CIEDE2000.
        delta_e: f64,
        /// Column of that cell, from 0.
        x: usize,
        /// Row of that cell, from 0.
        y: usize,
    },
    /// A number of an action is out of range, or a name is unknown.
    #[error(transparent)]
    Invalid(#[from] Box<InvalidValue>),
    /// The header of a recording is invalid.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// A canvas cannot be made.
    #[error(transparent)]
    Start(#[from] ScriptStartError),
    /// The painting cannot be saved.
    #[error(transparent)]
    File(#[from] PaintingFileError),
    /// Canvas and palette do not go together.
    #[error("canvas and palette have different {0}")]
    #[hint("set the palette up after the canvas")]
    Unlike(&'static str),
    /// The action saves a file. Sessions do not write files, so you must save their documents.
    #[error("a session does not save files")]
    #[hint("save the documents of the session yourself")]
    Save,
    /// There is no open stroke, or it was lifted.
    #[error("no stroke is open")]
    #[hint("set the brush down first")]
    NoStroke,
    /// An action other than light, gloss, stiffness and opacity was adjusted.
    #[error("`{0}` cannot be adjusted bit by bit")]
    #[hint("light, gloss, stiffness and opacity can be")]
    NoControl(&'static str),
    /// The action needs a session: it uses brushes by name, undoes, or saves.
    #[error("`{0}` is an action of a session")]
    #[hint("apply it to the session of the painting")]
    NoSession(&'static str),
}

fn listed(known: &[String]) -> String {
    if known.is_empty() { "no dry layers".to_owned() } else { known.join(", ") }
}
