//! A sub-step on the device: four kernels over the contact grown by 2 cells.
//!
//! The kernels compute the same as [`crate::motion`], bit for bit.

use crate::contact::Touch;
use crate::motion::MotionConstants;
use graphics::gpu::{Kernel, Layout, Storage, layout};

/// Uniforms of the four kernels. Rectangles are x, y, width, height in cells.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct SubStepParams {
    pub(super) motion: MotionConstants,
    /// The contact's rectangle grown by 2 within the canvas.
    pub(super) region: [u32; 4],
    /// The contact's rectangle.
    pub(super) contact: [u32; 4],
    /// Width and height of the canvas in cells.
    pub(super) canvas: [u32; 2],
    /// Index of the contact's first touch in the batch.
    pub(super) first_touch: u32,
    pub(super) padding: u32,
}

const SUB_STEP_PARAMS: Layout =
    layout!(SubStepParams { motion, region, contact, canvas, first_touch, padding });

const STRUCTS: &[Layout] = &[
    layout!(MotionConstants {
        push_quanta,
        adhesion_quanta,
        max_transfer_quanta,
        full_transfer_quanta
    }),
    layout!(Touch { height, brush_cell, velocity, weights }),
];

/// Joins the sources that all four kernels share with those of one kernel.
macro_rules! sub_step_source {
    ($($part:literal),*) => {
        concat!(
            include_str!("../../amount.wgsl"),
            include_str!("../../layer.wgsl"),
            include_str!("../../contact.wgsl"),
            include_str!("../../motion/constants.wgsl"),
            include_str!("../../motion/press.wgsl"),
            include_str!("passes/sub_step.wgsl"),
            $(include_str!($part)),*
        )
    };
}

/// Computes penetration and volume of every cell and copies the head's cell above it.
pub(super) static BEGIN: Kernel = Kernel {
    name: "begin_cells",
    source: sub_step_source!("passes/begin.wgsl"),
    parameters: SUB_STEP_PARAMS,
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

/// Computes velocity and mobile share of every cell.
pub(super) static PRESS: Kernel = Kernel {
    name: "press_cells",
    source: sub_step_source!("../../motion/advect.wgsl", "passes/press.wgsl"),
    parameters: SUB_STEP_PARAMS,
    structs: STRUCTS,
    storage: &[Storage::Batch, Storage::Read, Storage::Write],
};

/// Computes the paint of every cell after advection.
pub(super) static ADVECT: Kernel = Kernel {
    name: "advect_cells",
    source: sub_step_source!("../../motion/advect.wgsl", "passes/advect.wgsl"),
    parameters: SUB_STEP_PARAMS,
    structs: STRUCTS,
    storage: &[Storage::Read, Storage::Read, Storage::Read, Storage::Write],
};

/// Transfers paint between canvas and head, and writes the canvas.
pub(super) static TRANSFER: Kernel = Kernel {
    name: "transfer_cells",
    source: sub_step_source!("../../motion/transfer.wgsl", "passes/transfer.wgsl"),
    parameters: SUB_STEP_PARAMS,
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
