//! A small browser of files inside the window: no system dialog, which would
//! need a desktop's services.

mod listing;

mod state;

mod show;

pub use listing::{Entry, Filter};
pub use state::{Answer, Browser, Wanted};
