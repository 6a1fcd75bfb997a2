//! Where the head of a brush meets the canvas during one sub-step.

use graphics::tile::Rect;

/// What the head is over one cell of the canvas. Sixteen bytes, laid out as the
/// shaders read them.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Touch {
    /// The lowest point of the head's surface above this cell, in quanta over
    /// the plane of the canvas; [`Touch::NONE`] has the highest number.
    pub height: i32,
    /// The cell of the head's paint that lies there, row by row.
    pub brush_cell: u32,
    /// The head's tangential velocity, in 1/256 cell a sub-step: x in the low
    /// half, y in the high half, each a two's complement of 16 bits.
    pub velocity: u32,
    /// Low half: how much the speed lets paint change sides, 0..=256. High
    /// half: how many cells of the canvas lie under the same cell of the head,
    /// 1 and up.
    pub weights: u32,
}

impl Touch {
    /// No head above this cell.
    pub const NONE: Self = Self { height: i32::MAX, brush_cell: u32::MAX, velocity: 0, weights: 0 };

    /// A touch at `height` by `brush_cell`, moving by `(x, y)` in 1/256 cell.
    #[must_use]
    pub fn new(height: i32, brush_cell: u32, (x, y): (i16, i16), speed: u16, sharers: u16) -> Self {
        let pack = |low: u16, high: u16| u32::from(low) | u32::from(high) << 16;
        Self {
            height,
            brush_cell,
            velocity: pack(x as u16, y as u16),
            weights: pack(speed, sharers),
        }
    }

    /// The velocity in 1/256 cell a sub-step.
    #[inline(always)]
    #[must_use]
    pub fn velocity(&self) -> (i32, i32) {
        (i32::from(self.velocity as i16), i32::from((self.velocity >> 16) as i16))
    }

    /// How much the speed lets paint change sides, 0..=256.
    #[inline(always)]
    #[must_use]
    pub fn speed(&self) -> u32 {
        self.weights & 0xffff
    }

    /// How many cells of the canvas lie under the same cell of the head.
    #[inline(always)]
    #[must_use]
    pub fn sharers(&self) -> u32 {
        self.weights >> 16
    }
}

/// The head over the canvas during one sub-step.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// The cells under the head; within the canvas.
    pub rect: Rect,
    /// A touch for each of them, row by row.
    pub touches: Vec<Touch>,
}
