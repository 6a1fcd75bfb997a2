//! Files: opening, saving, exports, autosave, preferences; all but the shortest
//! work on threads of its own.

mod failure;

mod age;

mod request;

mod job;

mod whole;

mod home;

mod preferences;

mod begun;

mod opened;

mod session;

mod revisions;

mod exporting;

mod figures_log;

pub use age::{ago, size};
pub use begun::{built_in_library, script, varied_slots};
pub use exporting::{Export, export};
pub use failure::FileFailure;
pub use figures_log::{FigureLine, FiguresLog, FrameFigures};
pub use home::Home;
pub use job::{Job, Progress, Stopped};
pub use opened::{Opened, read};
pub use preferences::{Backend, Preferences, ToolPreferences};
pub use request::FileRequest;
pub use revisions::Revision;
pub use session::{LostSession, Session, SessionMeta};
