//! The window: what is where, and what keys do.

mod intent;

mod keys;

mod frames;

mod icons;

mod status;

mod toolbar;

mod menus;

mod surfaces;

mod pen;

mod help;

mod acts;

mod events;

mod studio;

pub use frames::{FrameRate, Frames};
pub use intent::{ENTRIES, Entry, Intent, Menu};
pub use keys::Keys;
pub use status::Message;
pub use studio::Studio;
