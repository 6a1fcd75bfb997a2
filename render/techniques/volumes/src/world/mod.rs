//! All volumes over one scene, what you do to them, and one step of time.
//!
//! ```text
//! pour, lift -> paint of volumes -> spilling -> new volumes, target radii -> motion -> volumes
//! ```
//!
//! We only move paint, in whole quanta. [`Tally`] says where it is. A world is data: its clone is
//! a snapshot that continues to the same bytes, and so is [`World::saved`] on a disk.
//!
//! Modules are declared in order of dependence: each uses only those above it.
mod settings;
mod recipe;
mod actions;
mod state;
mod pouring;
mod time;

#[cfg(test)]
mod tests;

#[cfg(test)]
mod device_tests;

pub use actions::{Lift, Pour, Single};
pub use recipe::{Recipe, Track};
pub use settings::{MOST_PARTICLES, MOST_VOLUMES, STEPS_PER_SECOND, WorldError, WorldSettings};
pub use state::{Tally, World};
pub use time::{DEVICE_PARTICLES, StepDevice};
