//! A file browser inside the window. A system dialog would need the services of a desktop, and we
//! could not test it.

mod listing;
mod thumbnails;
mod state;
mod show;

pub(crate) use listing::{Filter, pictures_and};
pub(crate) use state::{Answer, Browser, BrowserOptions};
pub(crate) use thumbnails::Thumbnails;
