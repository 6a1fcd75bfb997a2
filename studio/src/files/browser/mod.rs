//! A file browser inside the window. A system dialog would need the services of a desktop,
//! and could not be tested.

mod listing;

mod state;

mod show;

pub(crate) use listing::Filter;
pub(crate) use state::{Answer, Browser, BrowserOptions};
