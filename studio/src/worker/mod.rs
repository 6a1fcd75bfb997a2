//! The thread that owns the paint.

mod command;

mod event;

mod state;

mod fresh;

mod backend;

mod srgb;

mod tiles;

mod colours;

mod thumbnail;

mod layers;

mod pick;

mod room;

mod meter;

mod inbox;

mod outbox;

mod opening;

mod telling;

mod live;

mod playing;

mod workshop;

mod doing;

mod staging;

mod thread;

pub use command::{Command, Origin, Pace, PenSample};
pub use event::{Event, HeadOnCanvas, Picked, PickedLayer, Snapshot, TilePixels};
pub use fresh::{bare, brushes, fresh, mixing, oils};
pub use state::{BrushState, EaselState, Figures, LayerState, Thumbnail};
pub use thread::{Worker, WorkerOptions};
