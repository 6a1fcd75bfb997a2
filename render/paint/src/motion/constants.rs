//! The constants of motion, as whole numbers.

use crate::amount::QUANTA_PER_CELL;

/// The constants of motion. They are uniforms of the shaders as well.
///
/// The lengths of Baxter, Wendt and Lin 2004 have no unit. One of their units of height
/// is taken as ten cells (1 mm with cells of 0.1 mm), so that a sub-step deposits at most
/// a hundredth of a cell.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct MotionConstants {
    /// Difference in penetration over two cells, in quanta, that pushes paint by 1/256
    /// cell a sub-step; 1 and up. The paper's c is `QUANTA_PER_CELL / 128 / push_quanta`.
    pub push_quanta: i32,
    /// Height in quanta that always stays behind when a column moves; below 65536.
    pub adhesion_quanta: u32,
    /// Maximum transfer between two cells in a sub-step, in quanta; below 65536.
    pub max_transfer_quanta: u32,
    /// Difference between the two sides, in quanta, from which the full tenth is
    /// transferred (the paper's cutoff); 256 and up.
    pub full_transfer_quanta: u32,
}

impl Default for MotionConstants {
    /// From the paper: the maximum transfer of 0.001 and the cutoff of 1/30 of its unit of
    /// height. Chosen by eye: c = 1/4 and an adhesion of 1/500 of a cell.
    fn default() -> Self {
        Self {
            push_quanta: (QUANTA_PER_CELL / 32) as i32,
            adhesion_quanta: QUANTA_PER_CELL / 500,
            max_transfer_quanta: QUANTA_PER_CELL / 100,
            full_transfer_quanta: QUANTA_PER_CELL / 3,
        }
    }
}
