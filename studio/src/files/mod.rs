//! Files: opening, saving, exports, autosaves and preferences. All but the shortest work
//! runs on threads of its own.

mod problem;

mod age;

mod drawing;

mod reference_change;

mod request;

mod scene_file;

mod job;

mod home;

mod preferences;

mod opened;

mod revisions;

mod revision_list;

mod exporting;

mod figures_log;

mod browser;

mod dialogs;

mod pending;

mod notice;

mod open_dialog;

mod work;

mod scene_files;

mod state;

mod tasks;

mod drawings;

mod asking;

mod scenes;

mod finished;

mod notices;

mod frame;

pub use age::{ago, size};
pub use drawing::{Drawing, DrawingKind, DrawnFile};
pub use figures_log::{FiguresLog, FrameFigures};
pub use home::Home;
pub use preferences::{Backend, Preferences, ToolPreferences};
pub use problem::Problem;
pub use reference_change::ReferenceChange;
pub use request::FileRequest;
pub use revision_list::{ListedRevision, RevisionList};
pub use revisions::Revision;
pub use scene_file::{SceneAnswer, SceneExport};
pub use state::Files;
