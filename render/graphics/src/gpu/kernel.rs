//! A compute kernel as data: its WGSL source and its bindings.

use super::layout::Layout;

/// Width and height of a workgroup, in invocations.
pub const GROUP: u32 = 8;

/// Use of a storage buffer by a kernel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Storage {
    /// The kernel only reads it.
    Read,
    /// The kernel reads and writes it.
    Write,
    /// The kernel reads the data recorded by [`super::Recording::batch`].
    Batch,
}

/// An entry point of a compute shader. Group 0 binds its parameters (a uniform struct) at 0
/// and its storage buffers from 1 on, in order.
#[derive(Debug)]
pub struct Kernel {
    /// Name of the entry point, also used in errors; unique among all shaders.
    pub name: &'static str,
    /// The complete WGSL source, parts concatenated.
    pub source: &'static str,
    /// Layout of the uniform struct at binding 0.
    pub parameters: Layout,
    /// Layouts of other structs that Rust writes or reads.
    pub structs: &'static [Layout],
    /// Uses of the storage buffers, in the order of their bindings.
    pub storage: &'static [Storage],
}

/// Number of workgroups along a row of `cells` invocations.
#[must_use]
pub fn groups(cells: usize) -> u32 {
    (cells as u32).div_ceil(GROUP)
}
