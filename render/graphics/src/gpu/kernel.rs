//! A kernel: WGSL and what it is bound to, as data.

use super::layout::Layout;

/// The width and height of a group of invocations.
pub const GROUP: u32 = 8;

/// How a kernel uses a storage buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Storage {
    /// It reads it.
    Read,
    /// It reads and writes it.
    Write,
    /// It reads the data that were recorded beside the dispatches.
    Batch,
}

/// One entry point of a shader. Group 0 binds its parameters (a uniform
/// struct) at 0 and its storage buffers from 1 on, in order.
#[derive(Debug)]
pub struct Kernel {
    /// The entry point, which names pipeline and errors too.
    pub name: &'static str,
    /// The whole WGSL, its parts joined.
    pub source: &'static str,
    /// The struct at binding 0.
    pub parameters: Layout,
    /// Other structs that Rust writes or reads.
    pub structs: &'static [Layout],
    /// The storage buffers.
    pub storage: &'static [Storage],
}

/// Groups enough for `cells` in a row.
#[must_use]
pub fn groups(cells: usize) -> u32 {
    (cells as u32).div_ceil(GROUP)
}
