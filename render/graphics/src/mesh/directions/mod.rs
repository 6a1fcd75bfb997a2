//! Fields of directions along a surface: smoothed lines of least or greatest curvature. You can
//! also make arrows of these lines.
//!
//! ```text
//! curvature tensors -> evidence --+
//! guides -------------------------+-> smoothing -> lines -> spanning tree -> flow
//! links between tangent planes ---+
//! ```
mod smoothing;
mod field;

#[cfg(test)]
mod tests;

use documents::hint::Explain;

pub use field::{DirectionField, FlowField};

/// The principal direction that a field follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Along {
    /// The direction in which the surface bends least, for example along a branch.
    #[default]
    Least,
    /// The direction in which the surface bends most, for example around a branch.
    Greatest,
}

/// Settings of a field of directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectionSettings {
    /// The principal direction that the field follows, the least by default.
    pub along: Along,
    /// Rounds of averaging normals before we compute curvature, see
    /// [`Curvature::of_mesh`](crate::mesh::Curvature::of_mesh). The default is 1.
    pub normal_rounds: usize,
    /// Length over which we smooth directions where curvature is well defined, 0 to 1. This is a
    /// share of the model's radius (the root mean square distance of the surface from its centre).
    /// The default is 0.05. Where curvature says less, the length grows by itself.
    pub smoothing: f64,
}

impl Default for DirectionSettings {
    fn default() -> Self {
        Self { along: Along::Least, normal_rounds: 1, smoothing: 0.05 }
    }
}

/// A direction that you want at a vertex, with its weight.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Line {
    /// Direction of any length and sign in the model's axes. Only its part along the surface
    /// counts.
    pub along: [f32; 3],
    /// How much it counts, 0 to 1.
    pub weight: f32,
}

/// A direction that the field must have at a vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guide {
    /// Index of the vertex. All vertices at the same position follow. If you give several guides
    /// at one position, the last one counts.
    pub vertex: u32,
    /// Direction of any length in the model's axes. Only its part along the surface counts. Lines
    /// do not have a sign, but flow takes the sign of this guide
    /// ([`DirectionField::oriented`](DirectionField::oriented)).
    pub along: [f32; 3],
}

/// A fault of the settings or guides of a field of directions. Indices count from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum DirectionFault {
    /// The smoothing is outside 0..1.
    #[error("the smoothing of directions is `{0}`, not 0 to 1")]
    #[hint("it is a share of the model's radius; 0.05 is usual")]
    Smoothing(f64),
    /// A guide refers to a vertex that does not exist.
    #[error("guide {guide} is at vertex {found}, of {vertices}")]
    #[hint("guides belong to one model: draw them again on this one")]
    NoSuchVertex {
        /// Index of the guide.
        guide: usize,
        /// Vertex index it refers to.
        found: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A guide has no part along the surface, or is not a number.
    #[error(
        "guide {guide} at vertex {vertex} points along `{found:?}`, which is not on the surface"
    )]
    #[hint("draw the guide along the surface, not towards or away from it")]
    OffSurface {
        /// Index of the guide.
        guide: usize,
        /// Index of the vertex.
        vertex: u32,
        /// The direction that you asked for.
        found: [f32; 3],
    },
}
