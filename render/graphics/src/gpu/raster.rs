//! A raster shader as data: its WGSL source and its bindings.

use super::layout::Layout;

/// A shader that draws triangles. Its vertex entry point `corner` takes only the index of a
/// corner (three per triangle); its fragment entry point `pixel` returns the four numbers of
/// a pixel. Group 0 binds its parameters at 0 and the buffers that it reads from 1 on, in
/// order.
#[derive(Debug)]
pub struct RasterShader {
    /// Name used in errors; unique among all shaders and kernels.
    pub name: &'static str,
    /// The complete WGSL source, parts concatenated.
    pub source: &'static str,
    /// Layout of the uniform struct at binding 0.
    pub parameters: Layout,
    /// Layouts of other structs that Rust writes or reads.
    pub structs: &'static [Layout],
    /// Number of storage buffers that it reads.
    pub buffers: usize,
}
