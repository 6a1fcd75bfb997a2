//! The triangle that each pixel shows (a visibility buffer, Burns and Hunt 2013).

use crate::field::Field;
use crate::gpu::{Layout, layout};

/// The triangle of a pixel that shows none.
pub const NOTHING: u32 = u32::MAX;

/// What a pixel shows; the same 16 bytes on the processor and on a device.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Seen {
    /// Index of the triangle, or [`NOTHING`].
    pub triangle: u32,
    /// Weight of its second corner, corrected for perspective.
    pub second: f32,
    /// Weight of its third corner; the first has the rest.
    pub third: f32,
    /// Depth, 0 (near) to 1 (far); 1 where nothing is seen.
    pub depth: f32,
}

/// What every pixel shows at its middle.
pub type Visible = Field<Seen>;

impl Seen {
    /// The layout that shaders share.
    pub const LAYOUT: Layout = layout!(Seen { triangle, second, third, depth });

    /// A pixel that shows nothing.
    pub const EMPTY: Self = Self { triangle: NOTHING, second: 0.0, third: 0.0, depth: 1.0 };
}
