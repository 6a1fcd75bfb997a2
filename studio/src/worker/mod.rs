//! The thread that owns the paint.

mod command;

mod event;

mod state;

mod fresh;

mod workshop;

mod thread;

pub use command::{Command, Origin, Pace, PenSample};
pub use event::{Event, HeadOnCanvas, Picked, PickedLayer, Snapshot, TilePixels};
pub use fresh::{bare, brushes, fresh, oils};
pub use state::{BrushState, EaselState, Figures, LayerState, Thumbnail};
pub use thread::{Worker, WorkerOptions};
