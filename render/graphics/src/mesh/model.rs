//! Triangles with what a renderer needs of them.

use glam::Vec3;

/// Triangles of vertices. All lists of vertices have the same length.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Places of the vertices, in the model's own unit; y is up.
    pub positions: Vec<[f32; 3]>,
    /// Outward normals of the vertices, of length 1.
    pub normals: Vec<[f32; 3]>,
    /// Where in its texture each vertex lies: (0, 0) is the upper left corner,
    /// (1, 1) the lower right one (as in glTF); textures repeat.
    pub texture_coordinates: Vec<[f32; 2]>,
    /// Colours of the vertices, encoded sRGB in 0..1, which multiply those of the
    /// material; white where a file has none.
    pub colors: Vec<[f32; 3]>,
    /// The triangles, counter-clockwise seen from outside.
    pub triangles: Vec<Triangle>,
    /// The materials; at least one where there are triangles.
    pub materials: Vec<Material>,
}

/// Three vertices and what lies between them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Triangle {
    /// Indices of the vertices.
    pub corners: [u32; 3],
    /// Index of the material.
    pub material: u32,
}

/// The colour of a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Encoded sRGB in 0..1.
    pub color: [f32; 3],
    /// Multiplies the colour.
    pub texture: Option<Texture>,
}

/// A picture on a surface.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Texture {
    /// Texels in a row.
    pub width: u32,
    /// Rows, the uppermost first.
    pub height: u32,
    /// Red, green, blue and opacity, encoded sRGB, red in the lowest byte.
    pub texels: Vec<u32>,
}

impl Material {
    /// One colour all over, encoded sRGB in 0..1.
    #[must_use]
    pub fn plain(color: [f32; 3]) -> Self {
        Self { color, texture: None }
    }
}

impl Mesh {
    /// The lowest and the highest corner of the box around it; zeros without
    /// vertices.
    #[must_use]
    pub fn bounds(&self) -> [Vec3; 2] {
        let mut places = self.positions.iter().map(|&place| Vec3::from(place));
        let Some(first) = places.next() else { return [Vec3::ZERO; 2] };
        places.fold([first; 2], |[low, high], place| [low.min(place), high.max(place)])
    }
}
