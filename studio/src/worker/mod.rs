//! The thread that owns the paint.

mod command;

mod event;

mod state;

mod tiles;

mod thread;

pub use command::{Command, Origin, Pace, PenSample};
pub use event::{Event, HeadOnCanvas, Picked, PickedLayer, Snapshot, TilePixels};
pub use state::{BrushState, EaselState, Figures, LayerState, Thumbnail};
pub use thread::Worker;
