//! A sub-step on the device: four kernels over the contact grown by 2.
//!
//! Their functions are the twins of [`crate::motion`], bit for bit.

use crate::contact::Touch;
use crate::motion::Motion;
use graphics::gpu::{Kernel, Layout, Storage, layout};

/// What every kernel of a sub-step is told.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct Step {
    pub(super) motion: Motion,
    /// The contact grown by 2: x, y, width, height.
    pub(super) region: [u32; 4],
    pub(super) contact: [u32; 4],
    pub(super) canvas: [u32; 2],
    /// In the batch.
    pub(super) first_touch: u32,
    pub(super) spare: u32,
}

const STEP: Layout = layout!(Step { motion, region, contact, canvas, first_touch, spare });

const STRUCTS: &[Layout] = &[
    layout!(Motion { push, adhesion, most, cutoff }),
    layout!(Touch { height, brush_cell, velocity, weights }),
];

/// What all four sources begin with.
macro_rules! step_source {
    ($($part:literal),*) => {
        concat!(
            include_str!("../amount.wgsl"),
            include_str!("../layer.wgsl"),
            include_str!("../contact.wgsl"),
            include_str!("../motion/motion.wgsl"),
            include_str!("../motion/press.wgsl"),
            include_str!("passes/step.wgsl"),
            $(include_str!($part)),*
        )
    };
}

/// Penetration and volume of every cell, and the cell of the head above it.
pub(super) static BEGIN: Kernel = Kernel {
    name: "begin_cells",
    source: step_source!("passes/begin.wgsl"),
    parameters: STEP,
    structs: STRUCTS,
    storage: &[
        Storage::Batch,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Write,
        Storage::Write,
    ],
};

/// Velocity and mobile share of every cell.
pub(super) static PRESS: Kernel = Kernel {
    name: "press_cells",
    source: step_source!("../motion/advect.wgsl", "passes/press.wgsl"),
    parameters: STEP,
    structs: STRUCTS,
    storage: &[Storage::Batch, Storage::Read, Storage::Write],
};

/// What every cell holds after the paint has moved.
pub(super) static ADVECT: Kernel = Kernel {
    name: "advect_cells",
    source: step_source!("../motion/advect.wgsl", "passes/advect.wgsl"),
    parameters: STEP,
    structs: STRUCTS,
    storage: &[Storage::Read, Storage::Read, Storage::Read, Storage::Write],
};

/// Paint changing sides.
pub(super) static TRANSFER: Kernel = Kernel {
    name: "transfer_cells",
    source: step_source!("../motion/transfer.wgsl", "passes/transfer.wgsl"),
    parameters: STEP,
    structs: STRUCTS,
    storage: &[
        Storage::Batch,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Write,
        Storage::Write,
        Storage::Write,
        Storage::Write,
    ],
};
