//! Files: opening, saving, exports, autosaves and preferences. All but the shortest work runs on
//! its own threads.

mod problem;
mod request;
mod window_setup;
mod job;
mod new_canvas;
mod preferences;
mod opened;
mod exporting;
mod figures_log;
mod picture_file;
mod dialogs;
mod browser;
mod work;
mod new_dialog;
mod state;
mod tasks;
mod asking;
mod swatches;

pub(crate) use exporting::export;
pub use exporting::{Export, ExportKind, SceneAnswer, SceneExport};
pub use figures_log::{FiguresLog, FrameFigures};
pub use new_canvas::{CanvasPreset, KeptCanvases, LengthUnit, NewCanvas};
pub use opened::{ListedRevision, Revision, RevisionList};
pub(crate) use picture_file::{ReadPicture, on_screen, read_picture};
pub use preferences::{Backend, BrowserLook, BrowserOrder, Home, Preferences, ToolPreferences};
pub use problem::{PageProblem, Problem, ago, size};
pub use request::{
    Drawing, DrawingKind, DrawnFile, FileRequest, ReadSwatches, ReferenceChange, SwatchFormat,
};
pub use state::Files;
pub(crate) use tasks::bottom_of_notices;
pub use window_setup::{CanvasView, PinnedReference, SavedDrawing, WindowSetup};
pub use work::{BrushSets, StatusNote};
