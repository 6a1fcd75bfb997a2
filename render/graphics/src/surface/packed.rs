//! A mesh as it is drawn: the same bytes for the processor and a device.

use glam::Vec3;

use crate::gpu::Layout;
use crate::gpu::layout;
use crate::mesh::{Mesh, Triangle};

/// All that is known of a vertex.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Vertex {
    /// In the model's unit.
    pub position: [f32; 3],
    /// To the right in its texture, 0..1.
    pub u: f32,
    /// Outward, of length 1.
    pub normal: [f32; 3],
    /// Downwards in its texture, 0..1.
    pub v: f32,
    /// Encoded sRGB, 0..1.
    pub color: [f32; 3],
    spare: f32,
}

/// The colour of a surface.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Coating {
    /// Encoded sRGB, 0..1.
    pub color: [f32; 3],
    /// Where its texture starts in the texels of all.
    pub first: u32,
    /// Texels in a row; 0 without a texture.
    pub width: u32,
    /// Rows.
    pub height: u32,
    spare: [u32; 2],
}

/// Something at a place.
pub trait Placed: Sync {
    /// Where, in the model's unit.
    fn place(&self) -> [f32; 3];
}

impl Placed for [f32; 3] {
    #[inline]
    fn place(&self) -> [f32; 3] {
        *self
    }
}

impl Placed for Vertex {
    #[inline]
    fn place(&self) -> [f32; 3] {
        self.position
    }
}

impl Vertex {
    /// The layout that shaders share.
    pub const LAYOUT: Layout = layout!(Vertex { position, u, normal, v, color, spare });
}

impl Coating {
    /// The layout that shaders share.
    pub const LAYOUT: Layout = layout!(Coating { color, first, width, height, spare });
}

/// A mesh as it is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct PackedMesh {
    /// The vertices, in the order of the mesh.
    pub vertices: Vec<Vertex>,
    /// The triangles, in the order of the mesh.
    pub triangles: Vec<Triangle>,
    /// One for each material.
    pub coatings: Vec<Coating>,
    /// The texels of all textures, as of [`crate::mesh::Texture`].
    pub texels: Vec<u32>,
    /// Of the mesh.
    pub bounds: [Vec3; 2],
    /// Whether it is closed: from outside only fronts are seen.
    pub closed: bool,
}

impl PackedMesh {
    /// Packs a mesh that [`Mesh::check`] finds whole.
    ///
    /// # Panics
    /// If its lists of vertices are not of one length, or the texels of all
    /// textures are 2^32 or more.
    #[must_use]
    pub fn new(mesh: &Mesh) -> Self {
        let Mesh { positions, normals, texture_coordinates, colors, .. } = mesh;
        let count = positions.len();
        let lengths = [normals.len(), texture_coordinates.len(), colors.len()];
        assert_eq!(
            lengths, [count; 3],
            "normals, texture coordinates, colours of {count} vertices"
        );
        let vertices = (0..count).map(|i| Vertex {
            position: positions[i],
            u: texture_coordinates[i][0],
            normal: normals[i],
            v: texture_coordinates[i][1],
            color: colors[i],
            spare: 0.0,
        });
        let mut texels = Vec::new();
        let coatings = mesh.materials.iter().map(|material| {
            let first = texels.len();
            let [width, height] = material.texture.as_ref().map_or([0; 2], |texture| {
                texels.extend_from_slice(&texture.texels);
                [texture.width, texture.height]
            });
            assert!(first <= u32::MAX as usize, "{first} texels");
            let first = first as u32;
            Coating { color: material.color, first, width, height, spare: [0; 2] }
        });
        Self {
            vertices: vertices.collect(),
            triangles: mesh.triangles.clone(),
            coatings: coatings.collect(),
            texels,
            bounds: mesh.bounds(),
            closed: mesh.is_closed(),
        }
    }
}
