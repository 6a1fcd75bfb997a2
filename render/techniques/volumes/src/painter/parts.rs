//! The parts of a painting of a scene with its volumes.

use graphics::field::Field;

use crate::pigments::{Drawing, FilmHeights};

/// A painting's parts, one value for each pixel.
pub(super) struct Parts {
    /// Colours lit and textured but not hatched, each with its grey.
    pub(super) color: Field<[f32; 4]>,
    pub(super) cover: Field<f32>,
    pub(super) ink: Field<f32>,
    /// Share of the scene's own colours, if any region shows them.
    pub(super) tint: Option<Field<f32>>,
    pub(super) heights: Field<FilmHeights>,
}

impl Parts {
    pub(super) fn drawing(&self) -> Drawing<'_> {
        Drawing {
            color: &self.color,
            cover: Some(&self.cover),
            ink: Some(&self.ink),
            tint: self.tint.as_ref(),
            films: Some(&self.heights),
        }
    }
}
