//! A sub-step on the device: four kernels over the contact grown by 2 cells, and one
//! along the hair of the head.
//!
//! The kernels compute the same as [`crate::motion`], bit for bit.

use crate::contact::{Contact, ExchangeRates, Touch};
use crate::motion::MotionConstants;
use graphics::gpu::{Kernel, Layout, Storage, layout};
use graphics::tile::Rect;

/// Uniforms of the four kernels. Rectangles are x, y, width, height in cells.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct SubStepParams {
    pub(super) motion: MotionConstants,
    pub(super) rates: ExchangeRates,
    /// The contact's rectangle grown by 2 within the canvas.
    pub(super) region: [u32; 4],
    /// The contact's rectangle.
    pub(super) contact: [u32; 4],
    /// Width and height of the canvas in cells.
    pub(super) canvas: [u32; 2],
    /// Index of the contact's first touch in the batch.
    pub(super) first_touch: u32,
    /// Number of cells of the head.
    pub(super) brush_cells: u32,
    /// First: index of the mask's first word in the buffer of the floor, 0 without a mask.
    pub(super) mask: [u32; 4],
}

const SUB_STEP_PARAMS: Layout = layout!(SubStepParams {
    motion,
    rates,
    region,
    contact,
    canvas,
    first_touch,
    brush_cells,
    mask
});

const STRUCTS: &[Layout] = &[
    layout!(MotionConstants {
        push_share,
        squeeze_share,
        yield_quanta,
        levelling_share,
        adhesion_quanta,
        everywhere,
        padding
    }),
    layout!(ExchangeRates { release, film, deposit, pick_up, mixing, sink, drag, bearing }),
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
            include_str!("../../motion/bed.wgsl"),
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

/// Uniforms of [`NOTE_BED`].
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct BedParams {
    /// x, y, width and height in cells of the canvas.
    pub(super) tile: [u32; 4],
    /// Width and height of the canvas in cells.
    pub(super) canvas: [u32; 2],
    pub(super) padding: [u32; 2],
}

/// Notes the surface of the paint in a tile as the bed of a stroke.
pub(super) static NOTE_BED: Kernel = Kernel {
    name: "note_bed",
    source: concat!(
        include_str!("../../amount.wgsl"),
        include_str!("../../layer.wgsl"),
        include_str!("passes/note_bed.wgsl"),
    ),
    parameters: layout!(BedParams { tile, canvas, padding }),
    structs: &[],
    storage: &[Storage::Read, Storage::Read, Storage::Write],
};

/// Uniforms of [`WICK`].
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct WickParams {
    /// Width and height of the head in cells.
    pub(super) size: [u32; 2],
    /// Share of each surplus that moves, in parts of 65536.
    pub(super) wicking: u32,
    /// First row that takes part.
    pub(super) first_row: u32,
    /// Number of hairs in a group.
    pub(super) hairs: u32,
    /// Number of hairs that the first group lacks.
    pub(super) shift: u32,
    /// Number of flows in which all groups have their turn.
    pub(super) turns: u32,
    /// Which of them this is.
    pub(super) turn: u32,
}

/// Lets paint flow over a head; an invocation a group of hairs.
pub(super) static WICK: Kernel = Kernel {
    name: "wick_hairs",
    source: concat!(
        include_str!("../../amount.wgsl"),
        include_str!("../../layer.wgsl"),
        include_str!("../../motion/wick.wgsl"),
        include_str!("passes/wick.wgsl"),
    ),
    parameters: layout!(WickParams { size, wicking, first_row, hairs, shift, turns, turn }),
    structs: &[],
    storage: &[Storage::Write, Storage::Write],
};

/// Panics if a contact names cells of the canvas or of the head that do not exist.
pub(super) fn check_contact(contact: &Contact, bounds: Rect, brush_cells: u32) {
    let Contact { rect, touches, .. } = contact;
    assert_eq!(rect.intersection(bounds), *rect, "a contact must lie within {bounds:?}");
    assert_eq!(touches.len(), rect.width * rect.height, "a contact has a touch per cell");
    let outside = |touch: &&Touch| touch.brush_cell >= brush_cells && touch.height < i32::MAX;
    let outside = touches.iter().find(outside);
    assert!(outside.is_none(), "a touch must lie within the head's {brush_cells}: {outside:?}");
}
