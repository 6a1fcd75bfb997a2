//! The studio window: layout, menus, keyboard, pen and worker events.

mod intent;
mod entries;
mod frames;
mod bars;
mod side;
mod dock;
mod hover;
mod guide;
mod quick;
mod crop;
mod volumes;
mod keys;
mod studio;
mod perform;
mod surfaces;

pub use bars::Message;
pub use crop::{CropAnswer, CropTool};
pub use entries::{entries, key_rows};
pub use frames::Frames;
pub use guide::{Facts, Tour, TourStep};
pub use intent::{Entry, Intent, Menu};
pub use keys::Keys;
pub use perform::Between;
pub use side::{Panels, Tab};
pub use studio::{Parts, StartedWorker, Studio, VisibleParts};
pub use volumes::{
    Orbit, SCENE_ENTRIES, SceneEntry, SceneIntent, SceneMenu, Volumes, scene_key_rows,
};
