//! The window: what is where, and what keys do.

mod intent;

mod entries;

mod keys;

mod frames;

mod icons;

mod status;

mod toolbar;

mod menus;

mod surfaces;

mod pen;

mod cursor;

mod side;

mod parts;

mod help;

mod acts;

mod events;

mod layout;

mod outside;

mod studio;

pub use entries::ENTRIES;
pub use frames::Frames;
pub use intent::{Entry, Intent, Menu};
pub use keys::Keys;
pub use parts::{Begun, Parts};
pub use side::{Panels, Tab};
pub use status::Message;
pub use studio::{Shown, Studio};
