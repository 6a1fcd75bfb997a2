//! The head of a brush over the canvas during one sub-step, cell by cell.

use graphics::tile::Rect;

/// The head's surface above one cell of the canvas. 16 bytes, laid out as the shaders
/// read them.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Touch {
    /// Height of the head's surface at the cell's centre, in quanta over the plane of the canvas.
    /// If there is no head, this is `i32::MAX`.
    pub height: i32,
    /// Index of the head's paint cell above the cell's centre, counted row by row.
    pub brush_cell: u32,
    /// Tangential velocity of the surface in 1/256 cell a sub-step: x in the low 16 bits,
    /// y in the high 16 bits, each as two's complement.
    pub velocity: u32,
    /// Bits 0 to 8: [`Touch::transfer_weight`]. Bits 9 to 15: [`Touch::release`]. Bits 16 to
    /// 31: [`Touch::sharers`].
    pub weights: u32,
}

impl Touch {
    /// The touch of a cell without a head above it.
    pub const NONE: Self = Self { height: i32::MAX, brush_cell: u32::MAX, velocity: 0, weights: 0 };

    /// Packs a touch of hair with the mean coat. See the fields and accessors for units. `(x, y)`
    /// is the velocity in 1/256 cell a sub-step.
    #[must_use]
    pub fn new(
        height: i32,
        brush_cell: u32,
        (x, y): (i16, i16),
        transfer_weight: u16,
        sharers: u16,
    ) -> Self {
        Self {
            height,
            brush_cell,
            velocity: pack(x as u16, y as u16),
            weights: pack(transfer_weight | 32 << 9, sharers),
        }
    }

    /// Velocity along x and y in 1/256 cell a sub-step.
    #[inline(always)]
    #[must_use]
    pub fn velocity(&self) -> (i32, i32) {
        (i32::from(self.velocity as i16), i32::from((self.velocity >> 16) as i16))
    }

    /// Factor on the transfer of paint, which grows with the head's speed: 0 if the head rests
    /// (this transfers nothing) to 256 (full transfer).
    #[inline(always)]
    #[must_use]
    pub fn transfer_weight(&self) -> u32 {
        self.weights & 0x1ff
    }

    /// Coat of the hair at this point relative to the head's mean, in parts of 32, below 128. Locks
    /// of hair leave different amounts of paint.
    #[inline(always)]
    #[must_use]
    pub fn release(&self) -> u32 {
        (self.weights >> 9) & 0x7f
    }

    /// Replaces [`Touch::transfer_weight`].
    #[inline(always)]
    pub(crate) fn set_transfer_weight(&mut self, weight: u32) {
        self.weights = self.weights & !0x1ff | weight;
    }

    /// Replaces [`Touch::release`].
    #[inline(always)]
    pub(crate) fn set_release(&mut self, parts_of_32: u32) {
        self.weights = self.weights & !(0x7f << 9) | parts_of_32 << 9;
    }

    /// Multiplies the velocity by `left`, 0 to 1.
    #[inline(always)]
    pub(crate) fn slow(&mut self, left: f32) {
        let (x, y) = self.velocity();
        self.velocity = velocity_bits(x, left) | velocity_bits(y, left) << 16;
    }

    /// Number of canvas cells that lie under the same cell of the head, 1 and up.
    #[inline(always)]
    #[must_use]
    pub fn sharers(&self) -> u32 {
        self.weights >> 16
    }
}

#[inline(always)]
fn velocity_bits(along: i32, left: f32) -> u32 {
    (along as f32 * left) as i32 as u32 & 0xffff
}

#[inline(always)]
fn pack(low: u16, high: u16) -> u32 {
    u32::from(low) | u32::from(high) << 16
}

/// How a head exchanges paint with the canvas in a sub-step. Shares are in parts of 65536. The
/// shaders read it.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ExchangeRates {
    /// Thickness of the head's coat relative to the paint on the head. `film` is added to this.
    pub release: u32,
    /// Thickness in quanta of the part of the coat that does not depend on the paint on the head.
    pub film: u32,
    /// Where a film is thinner than the coat, the share of the missing thickness that the head lays
    /// in a sub-step.
    pub deposit: u32,
    /// Where a film is thicker than the coat, the share of the surplus that the head takes up in a
    /// sub-step.
    pub pick_up: u32,
    /// Share of the paint that head and canvas exchange, relative to the smaller of their two
    /// amounts. Each side gives this much and gets as much of the other's paint.
    pub mixing: u32,
    /// Distance in quanta by which the canvas presses hair below the crests of the ground. It is
    /// less where the coat bears the hair.
    pub sink: u32,
    /// Velocity of the paint that the head has penetrated, relative to the head's, in
    /// parts of 256, up to 256.
    pub drag: u32,
    /// Share of the paint from before the stroke that bears the hair, in parts of 65536. This is
    /// less where the coat is thin.
    pub bearing: u32,
    /// Share of the skin and of the body that the hair stirs into each other, relative to the smaller
    /// of the skin and the part of the body that the hair reaches.
    pub shear: u32,
    /// Volume in quanta of the paint that a cell of hair with the mean coat keeps. Hair with less lays nothing.
    pub held: u32,
    /// Height in quanta of the paint from before the stroke on which a blade rides that was loaded when the
    /// stroke began. Twice the coat bears a head as well, so hair has 0 here.
    pub carried: u32,
    /// Unused. Pads the uniforms of the shaders.
    pub padding: u32,
}

/// The head of a brush over the canvas during one sub-step.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Contact {
    /// Rectangle around the cells under the head, clipped to the canvas. If the head touches none,
    /// this is empty.
    pub rect: Rect,
    /// One touch for each cell of `rect`, row by row.
    pub touches: Vec<Touch>,
    /// How the head exchanges paint with the canvas.
    pub rates: ExchangeRates,
    /// Flow of paint over the head before the sub-step. For example, paint flows before the first
    /// contact of a stroke.
    pub wicking: Wicking,
}

/// Flow of paint over a head: along each hair, and between neighbouring hairs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Wicking {
    /// Share of the differences that flows off, in parts of 65536. If this is 0, no paint flows.
    pub share: u32,
    /// First row of the head's cells that takes part. Rows count from the ferrule.
    pub first_row: u32,
    /// Number of neighbouring hairs whose paint levels together. 0 and 1 level each hair alone.
    pub hairs: u32,
    /// Number of hairs, below `hairs`, by which the first group is smaller than the others. Groups
    /// that overlap from flow to flow spread paint across the head.
    pub shift: u32,
    /// Number of flows until every group has had its turn. With 0 or 1, all groups flow at once.
    pub turns: u32,
    /// Selects the groups that take part: divide a group's number by `turns` and compare the
    /// remainder with this. Below `turns`.
    pub turn: u32,
}
