//! The triangle that each pixel shows (a visibility buffer, Burns and Hunt 2013).

use crate::field::Field;
use crate::gpu::{Layout, layout};

/// [`Fragment::triangle`] of a pixel that shows no triangle.
pub const NO_TRIANGLE: u32 = u32::MAX;

/// The nearest triangle at the centre of a pixel, and the position on that triangle. The 16
/// bytes are the same on the processor and on a graphics device.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Fragment {
    /// Index of the triangle, or [`NO_TRIANGLE`].
    pub triangle: u32,
    /// Barycentric weight of the triangle's second corner, corrected for perspective.
    pub second: f32,
    /// Barycentric weight of the third corner; the first corner has the rest.
    pub third: f32,
    /// Depth, 0 (near plane) to 1 (far plane); 1 where no triangle is seen.
    pub depth: f32,
}

/// The fragment of each pixel.
pub type VisibilityBuffer = Field<Fragment>;

impl Fragment {
    /// Name, size and offsets of the struct, for kernels that bind fragments.
    pub const LAYOUT: Layout = layout!(Fragment { triangle, second, third, depth });

    /// A pixel that shows no triangle.
    pub const EMPTY: Self = Self { triangle: NO_TRIANGLE, second: 0.0, third: 0.0, depth: 1.0 };
}
