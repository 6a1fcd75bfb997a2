//! All volumes over one scene, what is done to them, and one step of time.
//!
//! ```text
//! pour, lift -> paint of volumes -> spilling -> new volumes, target radii -> motion -> volumes
//! ```
//!
//! Paint is only moved, in whole quanta: [`Tally`] says where it is. A world is data: its clone is
//! a snapshot from which it goes on to the same bytes, and so is [`World::saved`] on a disk.
//!
//! Modules are declared in order of dependence: each uses only those above it.

mod error;
mod settings;
mod recipe;
mod track;
mod actions;
mod tally;
mod state;
mod step_device;
mod spreading;
mod keeping;
mod single;
mod pouring;
mod lifting;
mod drying;
mod splitting;
mod time;
mod saved;

#[cfg(test)]
mod tests;

#[cfg(test)]
mod outline_tests;

#[cfg(test)]
mod saved_tests;

#[cfg(test)]
mod drying_tests;

#[cfg(test)]
mod limit_tests;

#[cfg(test)]
mod device_tests;

#[cfg(test)]
mod random_actions;

#[cfg(test)]
mod action_tests;

pub use actions::{Lift, Pour, Single};
pub use error::WorldError;
pub use recipe::Recipe;
pub use settings::{MOST_PARTICLES, MOST_VOLUMES, STEPS_PER_SECOND, WorldSettings};
pub use state::World;
pub use step_device::{DEVICE_PARTICLES, StepDevice};
pub use tally::Tally;
pub use track::Track;
