//! Sample models made by code. You can ask for any number of triangles. We use them in examples,
//! tests and figures.

mod surfaces;
mod still_life;
mod village;

use crate::mesh::model::Mesh;

pub use surfaces::GridSize;

/// A sample model made by code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SampleModel {
    /// Sphere of radius 1.
    Sphere,
    /// Closed tube along a (2, 3) torus knot.
    TorusKnot,
    /// Jug and fruit on a striped cloth.
    StillLife,
    /// Village with a church on a hill.
    Village,
}

impl SampleModel {
    /// All sample models.
    pub const ALL: [Self; 4] = [Self::StillLife, Self::Village, Self::TorusKnot, Self::Sphere];

    /// Name as users write it, for example `torus-knot`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::TorusKnot => "torus-knot",
            Self::StillLife => "still-life",
            Self::Village => "village",
        }
    }

    /// The sample model with this name, if there is one.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|shape| shape.name() == name)
    }

    /// Makes the model with about `triangles` triangles.
    #[must_use]
    pub fn mesh(self, triangles: usize) -> Mesh {
        match self {
            Self::Sphere => Mesh::sphere(triangles),
            Self::TorusKnot => Mesh::torus_knot(triangles),
            Self::StillLife => still_life::still_life(triangles),
            Self::Village => village::village(triangles),
        }
    }
}
