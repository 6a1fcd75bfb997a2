//! The models made here, by name.

use crate::mesh::model::Mesh;

/// A model made here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// A ball.
    Sphere,
    /// A closed tube in a knot.
    TorusKnot,
    /// A jug and fruit on a striped cloth.
    StillLife,
    /// Houses on a hill.
    Village,
}

impl Shape {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::StillLife, Self::Village, Self::TorusKnot, Self::Sphere];

    /// As users call it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::TorusKnot => "torus-knot",
            Self::StillLife => "still-life",
            Self::Village => "village",
        }
    }

    /// The shape of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|shape| shape.name() == name)
    }

    /// The model, of about as many triangles.
    #[must_use]
    pub fn mesh(self, triangles: usize) -> Mesh {
        match self {
            Self::Sphere => Mesh::sphere(triangles),
            Self::TorusKnot => Mesh::torus_knot(triangles),
            Self::StillLife => Mesh::still_life(triangles),
            Self::Village => Mesh::village(triangles),
        }
    }
}
