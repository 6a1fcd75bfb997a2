//! The head of a brush over the canvas during one sub-step, cell by cell.

use graphics::tile::Rect;

/// The head's surface above one cell of the canvas. 16 bytes, laid out as the shaders
/// read them.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Touch {
    /// Height of the head's surface at the cell's centre, in quanta over the plane of the
    /// canvas; `i32::MAX` if there is no head.
    pub height: i32,
    /// Index of the head's paint cell at that point, counted row by row.
    pub brush_cell: u32,
    /// Tangential velocity of the surface in 1/256 cell a sub-step: x in the low 16 bits,
    /// y in the high 16 bits, each as two's complement.
    pub velocity: u32,
    /// Low 16 bits: [`Touch::transfer_weight`]; high 16 bits: [`Touch::sharers`].
    pub weights: u32,
}

impl Touch {
    /// The touch of a cell without a head above it.
    pub const NONE: Self = Self { height: i32::MAX, brush_cell: u32::MAX, velocity: 0, weights: 0 };

    /// Packs a touch; see the fields and accessors for units. `(x, y)` is the velocity in
    /// 1/256 cell a sub-step.
    #[must_use]
    pub fn new(
        height: i32,
        brush_cell: u32,
        (x, y): (i16, i16),
        transfer_weight: u16,
        sharers: u16,
    ) -> Self {
        let pack = |low: u16, high: u16| u32::from(low) | u32::from(high) << 16;
        Self {
            height,
            brush_cell,
            velocity: pack(x as u16, y as u16),
            weights: pack(transfer_weight, sharers),
        }
    }

    /// Velocity along x and y in 1/256 cell a sub-step.
    #[inline(always)]
    #[must_use]
    pub fn velocity(&self) -> (i32, i32) {
        (i32::from(self.velocity as i16), i32::from((self.velocity >> 16) as i16))
    }

    /// Factor on the transfer of paint, which grows with the head's speed: 0 (the head
    /// rests, no transfer) to 256 (full transfer).
    #[inline(always)]
    #[must_use]
    pub fn transfer_weight(&self) -> u32 {
        self.weights & 0xffff
    }

    /// Number of canvas cells that lie under the same cell of the head, 1 and up.
    #[inline(always)]
    #[must_use]
    pub fn sharers(&self) -> u32 {
        self.weights >> 16
    }
}

/// The head of a brush over the canvas during one sub-step.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// Rectangle around the cells under the head, clipped to the canvas; empty if the head
    /// touches none.
    pub rect: Rect,
    /// One touch for each cell of `rect`, row by row.
    pub touches: Vec<Touch>,
}
