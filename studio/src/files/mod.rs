//! Files: opening, saving, exports, autosave, preferences; all but the shortest
//! work on threads of its own.

mod age;

mod request;

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

mod notices;

mod work;

mod finished;

mod asking;

mod state;

pub use age::{ago, size};
pub use browser::{Answer, Browser, Entry, Filter, Wanted};
pub use exporting::{Export, export};
pub use figures_log::{FigureLine, FiguresLog, FrameFigures};
pub use home::Home;
pub use job::{Job, Progress, Stopped};
pub use opened::{Opened, read};
pub use preferences::{Backend, Preferences, ToolPreferences};
pub use request::FileRequest;
pub use revision_list::{ListedRevision, RevisionList};
pub use revisions::Revision;
pub use session::{Autosave, FileFailure, LostSession, SessionMeta};
pub use state::{Files, Reference};
