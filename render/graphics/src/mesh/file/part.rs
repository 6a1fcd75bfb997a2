//! Parts of a model as files store them, appended to one mesh.

use crate::mesh::model::{Material, Mesh, Triangle};

/// Vertices and triangles of one material.
#[derive(Debug, Default)]
pub(super) struct Part {
    pub(super) positions: Vec<[f32; 3]>,
    /// Empty, or one per position; likewise the next two lists.
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) texture_coordinates: Vec<[f32; 2]>,
    pub(super) colors: Vec<[f32; 3]>,
    /// Three vertex indices per triangle, counted within the part.
    pub(super) corners: Vec<u32>,
    pub(super) material: u32,
}

/// Material of a model without materials and vertex colours: light grey.
pub(super) const PLAIN: Material =
    Material { name: String::new(), color: [0.8, 0.8, 0.8], texture: None };

/// Material of a model without materials but with vertex colours: white, so that the
/// vertex colours show unchanged.
pub(super) const PAINTED: Material =
    Material { name: String::new(), color: [1.0; 3], texture: None };

impl Mesh {
    /// Appends a part. Missing attributes are filled in; missing normals become zeros, to be
    /// computed later.
    pub(super) fn add(&mut self, part: Part) {
        let first = self.positions.len() as u32;
        let count = first as usize + part.positions.len();
        self.positions.extend(part.positions);
        self.normals.extend(part.normals);
        self.normals.resize(count, [0.0; 3]);
        self.texture_coordinates.extend(part.texture_coordinates);
        self.texture_coordinates.resize(count, [0.0; 2]);
        self.colors.extend(part.colors);
        self.colors.resize(count, [1.0; 3]);
        let material = part.material;
        self.triangles.extend(part.corners.chunks_exact(3).map(|corners| Triangle {
            // An index out of range must stay out of range for the check.
            corners: [0, 1, 2].map(|i| first.saturating_add(corners[i])),
            material,
        }));
    }
}
