//! The motion of volumes: particles under forces, each volume on its own about a fixed centre.
//!
//! ```text
//! settings, surroundings -+-> resting radii -> forces -> semi-implicit Euler -+-> particles
//! target radius -> growth +                                                   |
//!                                 keep-in regions <- star-shape guard <-------+
//! ```
//!
//! The kinds of forces are those of ten Bosch (2005): pressure, elastic, friction, and those of the
//! surroundings; cohesion and the guard are ours. All is f32 with + - * / and square roots in a
//! fixed order, so that places are the same bytes on every machine and number of threads.

mod error;
mod settings;
mod growth;
mod kick;
mod microstructure;
mod forces;
mod keep_in;
mod push;
mod surface_lattice;
mod surroundings;
mod star;
mod acting;
mod step;
mod advance;
mod device_form;
mod on_device;

#[cfg(test)]
mod acceptance;

#[cfg(test)]
mod extremes;

#[cfg(test)]
mod device_tests;

pub use advance::advance;
pub use error::MotionError;
pub use keep_in::KeepIn;
pub use kick::kick;
pub use microstructure::Microstructure;
pub use on_device::DeviceMotion;
pub use push::Push;
pub use settings::MotionSettings;
pub use surface_lattice::SurfaceLattice;
pub use surroundings::Surroundings;

pub(crate) use device_form::STEP;
