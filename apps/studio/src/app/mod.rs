//! The studio window: layout, menus, keyboard, pen and worker events.

mod intent;
mod entries;
mod key_rows;

#[cfg(test)]
mod entries_tests;
mod keys;
mod frames;
mod places;
mod callout;
mod icons;
mod status;
mod toolbar;
mod menu_item;
mod menus;
mod side;
mod parts;
mod dashes;
mod hover;
mod guide;
mod quick;
mod crop;
mod volumes;
mod twins;
mod key_editor;
mod help;
mod studio;
mod desk;
mod events;
mod aids;
mod quick_palette;
mod narrow;
mod perform;
mod own;
mod pen;
mod masks;
mod cursor;
mod first_steps;
mod tour_card;
mod surfaces;
mod layout;
mod system;
mod frame;
mod between;

pub use between::Between;
pub use crop::{CropAnswer, CropTool};
pub use entries::entries;
pub use frames::Frames;
pub use guide::{Facts, Tour, TourStep};
pub use intent::{Entry, Intent, Menu};
pub use key_rows::key_rows;
pub use keys::Keys;
pub use parts::{Parts, StartedWorker};
pub use side::{Panels, Tab};
pub use status::Message;
pub use studio::{Studio, VisibleParts};
pub use volumes::{
    Orbit, SCENE_ENTRIES, SceneEntry, SceneIntent, SceneMenu, Volumes, scene_key_rows,
};
