//! The studio window: layout, menus, keyboard, pen and worker events.

mod intent;

mod entries;

mod keys;

mod frames;

mod icons;

mod status;

mod toolbar;

mod menus;

mod help;

mod side;

mod parts;

mod hover;

mod volumes;

mod studio;

mod events;

mod perform;

mod pen;

mod cursor;

mod surfaces;

mod layout;

mod system;

mod frame;

pub use entries::ENTRIES;
pub use frames::Frames;
pub use intent::{Entry, Intent, Menu};
pub use keys::Keys;
pub use parts::{Parts, StartedWorker};
pub use side::{Panels, Tab};
pub use status::Message;
pub use studio::{Studio, VisibleParts};
pub use volumes::{Orbit, SCENE_ENTRIES, SceneEntry, SceneIntent, SceneMenu, Volumes};
