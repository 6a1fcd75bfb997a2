//! What both doors lead to: flat colours, ready for water.

use graphics::field::Field;

/// Abstracted colour with what guides the effects.
#[derive(Debug, Clone, PartialEq)]
pub struct Wash {
    /// Encoded sRGB in 0..1, then coverage: 1 where paint is, 0 on bare paper.
    pub color: Field<[f32; 4]>,
    /// Where effects are stronger or weaker.
    pub controls: Controls,
}

/// What effects are multiplied with, pixel by pixel, 0..1; 1 everywhere where
/// there is none. All of the size of the colour.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Controls {
    /// Of the dry brush.
    pub dry_brush: Option<Field<f32>>,
    /// Of all changes of density.
    pub density: Option<Field<f32>>,
}
