//! Files: opening, saving, exports, autosaves and preferences. All but the shortest work
//! runs on threads of its own.

mod problem;

mod age;

mod page_problem;

mod drawing;

mod desk;

mod reference_change;

mod swatch_format;

mod swatch_list;

mod request;

mod job;

mod home;

mod browser_look;

mod new_canvas;

mod preferences;

mod opened;

mod revisions;

mod revision_list;

mod exporting;

mod scene_file;

mod timelapse;

mod figures_log;

mod default_button;

mod picture_file;

mod browser;

mod dialogs;

mod pending;

mod notice;

mod own_brushes;

mod work;

mod new_dialog;

mod open_dialog;

mod scene_files;

mod state;

mod cropping;

mod tasks;

mod autosaving;

mod drawings;

mod brush_sets;

mod swatches;

mod asking;

mod beginning;

mod scenes;

mod finished;

mod notices;

mod sample;

mod frame;

pub use age::{ago, size};
pub use browser_look::{BrowserLook, BrowserOrder};
pub use desk::{Desk, DeskDrawing, DeskReference, DeskView};
pub use drawing::{Drawing, DrawingKind, DrawnFile};
pub(crate) use exporting::export;
pub use exporting::{Export, ExportKind};
pub use figures_log::{FiguresLog, FrameFigures};
pub use home::Home;
pub use new_canvas::{CanvasPreset, KeptCanvases, LengthUnit, NewCanvas};
pub use notice::StatusNote;
pub(crate) use notices::bottom_of_notices;
pub use own_brushes::BrushSets;
pub use page_problem::PageProblem;
pub(crate) use picture_file::{ReadPicture, on_screen, read_picture};
pub use preferences::{Backend, Preferences, ToolPreferences};
pub use problem::Problem;
pub use reference_change::ReferenceChange;
pub use request::FileRequest;
pub use revision_list::{ListedRevision, RevisionList};
pub use revisions::Revision;
pub use scene_file::{SceneAnswer, SceneExport};
pub use state::Files;
pub use swatch_format::{ReadSwatches, SwatchFormat};
