//! Paint volumes after ten Bosch (2005): closed meshes of particles that grow over a scene; what
//! they hold of its surfaces is shown in colour, everything else as a grey drawing.
//!
//! ```text
//! pour, push, dry -> world of volumes -> counts of the volumes that hold each visible point -+
//!                                                                                            |
//! mesh, camera -> light, hatching -> colour with its grey in alpha --------------------------+-> picture
//! ```
//!
//! Modules are declared in order of dependence: each uses only those above it.

pub mod sphere_mesh;

pub mod volume;

pub mod toml_text;

pub mod settings;

pub mod script;
#[cfg(test)]
mod test_volumes;

pub mod containing;

pub mod motion;

pub mod wetting;

pub mod world;

#[cfg(test)]
mod test_surfaces;
pub mod hatching;

pub mod drawing;

mod kernels;

pub use kernels::kernels;
pub mod surfaces;


pub mod pigments;
