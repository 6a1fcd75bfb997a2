//! One passage, and a set of passages of one painting.

use graphics::field::Field;
use graphics::picture::Picture;

use crate::texel::{PaintOfSamples, TexelPaint};

/// A passage of a painting.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Name that the painter gave it.
    pub name: String,
    /// Colour of each texel under a level surface, in linear sRGB with white at 1.
    pub color: Picture,
    /// Paint of each texel; `None` for pictures without pigments.
    pub paint: Option<Field<TexelPaint>>,
    /// Height of the surface above the ground in mm; `None` without relief.
    pub height_mm: Option<Field<f32>>,
    /// Whether each texel belongs to the passage. Other texels hold no information.
    pub mask: Field<bool>,
    /// Distance of neighbouring strokes in texels, across the strokes.
    pub spacing: f64,
    /// Side of a texel in mm, where it is known.
    pub mm_per_texel: Option<f64>,
    /// Whether the height was guessed from a photograph.
    pub guessed_relief: bool,
}

impl Sample {
    /// Width and height in texels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.color.width(), self.color.height())
    }
}

/// Samples of one painting, upright (strokes run along y) and of one spacing, dark to light.
#[derive(Debug, Clone, PartialEq)]
pub struct SampleSet {
    /// The samples. All or none have paint.
    pub samples: Vec<Sample>,
    /// Pigments of their paint; `None` where no sample has any.
    pub paint: Option<PaintOfSamples>,
    /// Where the samples come from, in words, for the file.
    pub provenance: String,
}
