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

pub mod saved;
pub mod volume;

#[cfg(test)]
mod test_volumes;
mod device_memory;
pub mod containing;
pub mod surfaces;
pub mod motion;
pub mod wetting;
pub mod world;
pub mod hatching;
pub mod drawing;
pub mod pigments;
pub mod toml_text {
    //! Texts of TOML under the names that this crate uses.

    pub use documents::text::{
        Checked, KeyPath, KeyStep, Source, TextError, ValueFault as Fault, read_text,
    };
}
pub mod settings;
pub mod script;
pub mod performance;
pub mod painter;
mod kernels;

pub use kernels::kernels;
