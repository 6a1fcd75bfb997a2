//! A shader that draws triangles, as data.

use super::layout::Layout;

/// A shader that draws triangles. Its entry points are `corner`, which takes the
/// index of a corner (three a triangle, nothing else is fed to it), and `pixel`,
/// which gives the four numbers of a pixel. Group 0 binds its parameters at 0
/// and the buffers that it reads from 1 on, in order.
#[derive(Debug)]
pub struct RasterShader {
    /// Names pipeline and errors; unlike that of any other shader or kernel.
    pub name: &'static str,
    /// The whole WGSL, its parts joined.
    pub source: &'static str,
    /// The struct at binding 0.
    pub parameters: Layout,
    /// Other structs that Rust writes or reads.
    pub structs: &'static [Layout],
    /// How many buffers it reads.
    pub buffers: usize,
}
