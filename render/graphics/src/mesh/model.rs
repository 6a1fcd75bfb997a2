//! A triangle mesh with materials and textures.

use glam::Vec3;

/// A triangle mesh. All per-vertex lists have the same length.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Vertex positions in the model's own unit; y points up.
    pub positions: Vec<[f32; 3]>,
    /// Outward unit normals, one per vertex.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates per vertex as in glTF: (0, 0) is the upper left corner of the
    /// texture, (1, 1) the lower right; textures repeat.
    pub texture_coordinates: Vec<[f32; 2]>,
    /// Vertex colours, encoded sRGB in 0..1, which multiply the material's colour; white
    /// where a file has none.
    pub colors: Vec<[f32; 3]>,
    /// Triangles, wound counter-clockwise seen from outside.
    pub triangles: Vec<Triangle>,
    /// Materials; at least one if there are triangles.
    pub materials: Vec<Material>,
}

/// A triangle: three vertex indices and a material index.
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Triangle {
    /// Indices into the per-vertex lists.
    pub corners: [u32; 3],
    /// Index into [`Mesh::materials`].
    pub material: u32,
}

/// Colour of a surface: a base colour, optionally times a texture.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name in the file; empty where it has none. Several materials may share one.
    pub name: String,
    /// Base colour, encoded sRGB in 0..1.
    pub color: [f32; 3],
    /// Texture that multiplies the base colour, if any.
    pub texture: Option<Texture>,
}

/// An 8-bit texture image.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Texture {
    /// Width in texels.
    pub width: u32,
    /// Height in texels; row 0 is the top.
    pub height: u32,
    /// Texels row by row, encoded sRGB with opacity, packed as `0xAABBGGRR` (red in the
    /// lowest byte).
    pub texels: Vec<u32>,
}

impl Material {
    /// A material without name and texture; `color` is encoded sRGB in 0..1.
    #[must_use]
    pub fn plain(color: [f32; 3]) -> Self {
        Self::named("", color)
    }

    /// A material without texture; `color` is encoded sRGB in 0..1.
    #[must_use]
    pub fn named(name: &str, color: [f32; 3]) -> Self {
        Self { name: name.to_owned(), color, texture: None }
    }
}

impl Mesh {
    /// Lowest and highest corner of the axis-aligned bounding box; zeros for a mesh without
    /// vertices.
    #[must_use]
    pub fn bounds(&self) -> [Vec3; 2] {
        let mut positions = self.positions.iter().map(|&position| Vec3::from(position));
        let Some(first) = positions.next() else { return [Vec3::ZERO; 2] };
        positions.fold([first; 2], |[low, high], position| [low.min(position), high.max(position)])
    }
}
