//! Shaders that draw triangles for their stencil, or to add to buffers, as data.

use super::layout::Layout;

/// A shader that draws triangles for their depth and stencil alone. Its vertex entry point
/// `corner` takes only the index of a corner (three per triangle). Group 0 binds its
/// parameters at 0 and the buffers that it reads from 1 on, in order.
#[derive(Debug)]
pub struct StencilShader {
    /// Name used in errors; unique among all shaders and kernels.
    pub name: &'static str,
    /// The complete WGSL source, parts concatenated.
    pub source: &'static str,
    /// Layout of the uniform struct at binding 0.
    pub parameters: Layout,
    /// Number of storage buffers that it reads.
    pub buffers: usize,
}

/// A shader that draws both sides of triangles, whose fragment entry point `pixel` returns
/// nothing and adds to a storage buffer. Otherwise as [`StencilShader`]; the buffer that it
/// writes comes last, and only the fragment stage may use it.
#[derive(Debug)]
pub struct ScatterShader {
    /// Name used in errors; unique among all shaders and kernels.
    pub name: &'static str,
    /// The complete WGSL source, parts concatenated.
    pub source: &'static str,
    /// Layout of the uniform struct at binding 0.
    pub parameters: Layout,
    /// Layouts of other structs that Rust writes or reads.
    pub structs: &'static [Layout],
    /// Number of storage buffers, that which it writes included.
    pub buffers: usize,
}
