//! The motion of volumes: particles under forces, each volume on its own about a fixed centre.
//!
//! ```text
//! settings, surroundings -+-> resting radii -> forces -> semi-implicit Euler -+-> particles
//! target radius -> growth +                                                   |
//!                                 keep-in regions <- star-shape guard <-------+
//! ```
//!
//! We take these kinds of forces from ten Bosch (2005): pressure, elastic, friction, and forces of
//! the surroundings. Cohesion and the guard are ours. We use only f32 with + - * / and square
//! roots in a fixed order. So you get the same bytes on every machine and for any number of
//! threads.
mod settings;
mod forces;
mod surface_lattice;
mod star;
mod surroundings;
mod step;
mod device_form;
mod on_device;
#[cfg(test)]
mod acceptance;
#[cfg(test)]
mod device_tests;

pub use forces::{KeepIn, Push, kick};
pub use on_device::DeviceMotion;
pub use settings::{MotionError, MotionSettings};
pub use star::Microstructure;
pub use step::advance;
pub use surface_lattice::SurfaceLattice;
pub use surroundings::Surroundings;

pub(crate) use device_form::STEP;
