//! Why volumes cannot be moved.

use documents::hint::{Explain, Fault, Hint};
use graphics::gpu::DeviceError;

/// A setting, a volume or a time does not allow motion.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// A number is out of its range.
    #[error("{key} is {least} to {most}, found `{value}`")]
    OutOfRange {
        /// Name of the setting, for example `pressure`.
        key: &'static str,
        /// Value that was found.
        value: f32,
        /// Least value allowed.
        least: f32,
        /// Greatest value allowed.
        most: f32,
    },
    /// Stiff forces would need more sub-steps than are taken at once.
    #[error(
        "{seconds} s under forces of stiffness {stiffness} 1/s^2 take {needed} sub-steps, more than {most}: at most {fitting_seconds} s, or a stiffness of at most {fitting_stiffness} 1/s^2, would fit"
    )]
    TooStiff {
        /// Time that was asked for, in seconds.
        seconds: f32,
        /// Stiffness of all forces together, in 1/s^2.
        stiffness: f32,
        /// Number of sub-steps that it takes; a whole number.
        needed: f32,
        /// Greatest number of sub-steps.
        most: u32,
        /// Longest time that fits this stiffness, in seconds.
        fitting_seconds: f32,
        /// Greatest stiffness that fits this time, in 1/s^2.
        fitting_stiffness: f32,
    },
    /// A volume has a centre or radius that no volume can have.
    #[error("volume {index} has {what} `{value}`, which must be {must}")]
    Volume {
        /// Index of the volume.
        index: usize,
        /// The quantity: centre, radius or target radius.
        what: &'static str,
        /// Value that was found.
        value: f32,
        /// Its range in words.
        must: &'static str,
    },
    /// The places that describe the surface are not finite.
    #[error("place {index} of the surface is not finite")]
    Place {
        /// Index of the place.
        index: usize,
    },
    /// The look-up of the nearest place of the surface would be too large.
    #[error(
        "cells of {cell} make {blocks} blocks of the surface's box, more than {most}: cells of {fitting_cell} would fit"
    )]
    TooFine {
        /// Size of a cell, in the unit of the scene.
        cell: f32,
        /// Number of blocks; a whole number.
        blocks: f32,
        /// Greatest number of blocks.
        most: usize,
        /// Size of a cell that fits, in the unit of the scene.
        fitting_cell: f32,
    },
    /// The graphics device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

impl Explain for MotionError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::verbatim(match self {
            Self::Device(error) => return error.hint(),
            Self::OutOfRange { .. } => "leave the setting out to take its default",
            Self::TooStiff { .. } => {
                "take shorter steps, or weaker forces: the settings motion.pressure, elastic, cohesion, surface_pull, keep"
            }
            Self::Volume { .. } => "give the volume a finite centre and a radius above 0",
            Self::Place { .. } => "repair the mesh: a vertex of it is not a number",
            Self::TooFine { .. } => "take larger cells (grid.cell)",
        }))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Device(error) => error.fault(),
            Self::Volume { .. } | Self::Place { .. } => Fault::Input,
            Self::OutOfRange { .. } | Self::TooStiff { .. } | Self::TooFine { .. } => {
                Fault::Setting
            }
        }
    }
}
