//! Vertices and faces as files have them, put together to one mesh.

use crate::mesh::model::{Material, Mesh, Triangle};

/// A part of a model in one material.
#[derive(Debug, Default)]
pub(super) struct Part {
    pub(super) positions: Vec<[f32; 3]>,
    /// None, or as many as positions; so are the next two.
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) texture_coordinates: Vec<[f32; 2]>,
    pub(super) colors: Vec<[f32; 3]>,
    /// Three corners a triangle, counted within the part.
    pub(super) corners: Vec<u32>,
    pub(super) material: u32,
}

/// What a model without materials is made of: light paper.
pub(super) const PLAIN: Material = Material { color: [0.8, 0.8, 0.8], texture: None };

/// The same where its vertices have colours, which are not darkened besides.
pub(super) const PAINTED: Material = Material { color: [1.0; 3], texture: None };

impl Mesh {
    /// Adds a part; what it lacks is filled in, normals with zeros.
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
            // A corner that there is not stays one.
            corners: [0, 1, 2].map(|i| first.saturating_add(corners[i])),
            material,
        }));
    }
}
