//! The visible surface of a mesh, pixel by pixel.
//!
//! You put a mesh into the memory of a [`crate::compute::Compute`] as a [`Model`]. Its bytes are
//! the same on the processor and on a device. The model draws a [`VisibilityBuffer`] (Burns and
//! Hunt 2013), which is the triangle that each pixel shows. Use [`SurfacePoint`] to interpolate
//! position, normal and colour there.
mod raster;
mod surface_point;
mod model;
mod inside;

use glam::Vec3;

use crate::field::Field;
use crate::gpu::{Layout, layout};
use crate::mesh::{Mesh, Triangle};

pub use inside::{
    ADD_STENCIL, ClosedSurfaces, Count, Crossing, CrossingSum, Crossings, GATED_FACES, Gates,
    InsideCounter, STENCIL_FACES, WEIGHED_FACES, WeighedCount,
};
pub use model::{DeviceModel, HostModel, Model};
pub use raster::{RASTER, RasterParams, Rasteriser, Sides, visible};
pub use surface_point::{FourPoints, FourVectors, SurfacePoint, dot_products, position_at};

/// [`Fragment::triangle`] of a pixel that shows no triangle.
pub const NO_TRIANGLE: u32 = u32::MAX;

/// The nearest triangle at the centre of a pixel, and the position on this triangle. The 16 bytes
/// are the same on the processor and on a graphics device.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Fragment {
    /// Index of the triangle, or [`NO_TRIANGLE`].
    pub triangle: u32,
    /// Barycentric weight of the triangle's second corner, corrected for perspective.
    pub second: f32,
    /// Barycentric weight of the third corner. The first corner has the rest.
    pub third: f32,
    /// Depth, 0 (near plane) to 1 (far plane), 1 where no triangle is seen.
    pub depth: f32,
}

/// The fragment of each pixel.
pub type VisibilityBuffer = Field<Fragment>;

impl Fragment {
    /// Name, size and offsets of the struct. Kernels that bind fragments need this.
    pub const LAYOUT: Layout = layout!(Fragment { triangle, second, third, depth });

    /// A pixel that shows no triangle.
    pub const EMPTY: Self = Self { triangle: NO_TRIANGLE, second: 0.0, third: 0.0, depth: 1.0 };
}

/// The attributes of a vertex.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Vertex {
    /// Position in the unit of the model.
    pub position: [f32; 3],
    /// Texture coordinate to the right. 0 and 1 are the edges. Beyond them the texture repeats.
    pub u: f32,
    /// Outward normal of length 1.
    pub normal: [f32; 3],
    /// Texture coordinate downwards. 0 and 1 are the edges. Beyond them the texture repeats.
    pub v: f32,
    /// Encoded sRGB, 0..1. This multiplies the colour of the material.
    pub color: [f32; 3],
    spare: f32,
}

/// The colour of a material, and where to find its texture among all texels.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct PackedMaterial {
    /// Encoded sRGB, 0..1. This multiplies the texture.
    pub color: [f32; 3],
    /// Index of the texture's first texel in [`PackedMesh::texels`].
    pub first: u32,
    /// Width of the texture in texels. If there is no texture, this is 0.
    pub width: u32,
    /// Height of the texture in texels.
    pub height: u32,
    spare: [u32; 2],
}

/// Something with a position, e.g. a vertex.
pub trait Positioned: Sync {
    /// Position in the unit of the model.
    fn position(&self) -> [f32; 3];
}

impl Positioned for [f32; 3] {
    #[inline]
    fn position(&self) -> [f32; 3] {
        *self
    }
}

impl Positioned for Vertex {
    #[inline]
    fn position(&self) -> [f32; 3] {
        self.position
    }
}

impl Vertex {
    /// Name, size and offsets of the struct. Shaders that bind vertices need this.
    pub const LAYOUT: Layout = layout!(Vertex { position, u, normal, v, color, spare });
}

impl PackedMaterial {
    /// Name, size and offsets of the struct. Kernels that bind materials need this.
    pub const LAYOUT: Layout = layout!(PackedMaterial { color, first, width, height, spare });
}

/// A mesh in the memory layout for drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct PackedMesh {
    /// The vertices, in the order of the mesh.
    pub vertices: Vec<Vertex>,
    /// The triangles, in the order of the mesh.
    pub triangles: Vec<Triangle>,
    /// One for each material of the mesh.
    pub materials: Vec<PackedMaterial>,
    /// The texels of all textures, one after the other, as in [`crate::mesh::Texture`].
    pub texels: Vec<u32>,
    /// Lowest and highest corner of the bounding box, in the unit of the model.
    pub bounds: [Vec3; 2],
    /// Whether the mesh is closed. From outside you then see only front faces.
    pub closed: bool,
}

impl PackedMesh {
    /// Packs a mesh. It must pass [`Mesh::check`].
    ///
    /// # Panics
    /// If the mesh's lists of vertex attributes differ in length, or its textures have 2^32 texels
    /// or more.
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
        let materials = mesh.materials.iter().map(|material| {
            let first = texels.len();
            let [width, height] = material.texture.as_ref().map_or([0; 2], |texture| {
                texels.extend_from_slice(&texture.texels);
                [texture.width, texture.height]
            });
            assert!(first <= u32::MAX as usize, "{first} texels");
            let first = first as u32;
            PackedMaterial { color: material.color, first, width, height, spare: [0; 2] }
        });
        Self {
            vertices: vertices.collect(),
            triangles: mesh.triangles.clone(),
            materials: materials.collect(),
            texels,
            bounds: mesh.bounds(),
            closed: mesh.is_closed(),
        }
    }
}
