//! A subject laid out for painting: what model and picture have in common.

use std::sync::Arc;

use graphics::surface::PackedMesh;

use super::coloring::Coloring;
use super::places::Surface;

/// A subject.
#[derive(Debug)]
pub(super) struct Subject {
    /// Its surface for the strokes of each layer, the lowest first; at least one.
    pub(super) surfaces: Vec<Surface>,
    /// The mesh that hides what lies behind it.
    pub(super) packed: Arc<PackedMesh>,
    /// For each triangle whether its part of the mesh is closed.
    pub(super) closed: Vec<bool>,
    pub(super) coloring: Arc<Coloring>,
    /// L* of the darkest and of the lightest tone, if the subject's lightness decides the tone.
    pub(super) lightness: Option<[f32; 2]>,
    /// Units of the subject along the longer side of a picture in which strokes have the size of the
    /// settings.
    pub(super) units: f32,
    /// Strokes are kept up to this many times the density of that picture.
    pub(super) more: f32,
}
