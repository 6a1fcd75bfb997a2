//! The workspace of paint volumes: a scene that is turned, poured over and played.

mod orbit;
mod intent;
mod entries;
mod icons;
mod menus;
mod toolbar;
mod workspace;
mod exports;
mod events;
mod perform;
mod hand;
mod canvas;
mod status;
mod frame;

pub(super) use entries::SCENE_POINTER;
pub use entries::{SCENE_ENTRIES, scene_key_rows};
pub use intent::{SceneEntry, SceneIntent, SceneMenu};
pub use orbit::Orbit;
pub(super) use perform::WindowIntent;
pub use workspace::Volumes;
