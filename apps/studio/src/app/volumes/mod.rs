//! The workspace of paint volumes. You turn a scene, pour over it and play it.

mod orbit;
mod intent;
mod bars;
mod workspace;
mod frame;

pub(super) use frame::WindowIntent;
pub(super) use intent::SCENE_POINTER;
pub use intent::{SCENE_ENTRIES, SceneEntry, SceneIntent, SceneMenu, scene_key_rows};
pub use orbit::Orbit;
pub use workspace::Volumes;
