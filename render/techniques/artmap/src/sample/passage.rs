//! One passage, and a set of passages of one painting.

use graphics::encoding::lab_from_linear;
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

    /// Number of texels that belong to the passage.
    #[must_use]
    pub fn texels(&self) -> usize {
        self.mask.values().iter().filter(|inside| **inside).count()
    }

    /// Mean CIELAB lightness of the passage, 0 to 100; 0 without texels.
    #[must_use]
    pub fn mean_lightness(&self) -> f64 {
        self.mean(&lab_from_linear(&self.color))[0]
    }

    /// Mean colour of the passage in linear sRGB with white at 1; black without texels.
    #[must_use]
    pub fn mean_color(&self) -> [f64; 3] {
        self.mean(&self.color)
    }

    /// Mean of three values over the texels of the passage.
    fn mean(&self, values: &Field<[f32; 3]>) -> [f64; 3] {
        let mut sum = [0.0; 3];
        let inside = values.values().iter().zip(self.mask.values()).filter(|(_, inside)| **inside);
        for (value, _) in inside {
            (0..3).for_each(|channel| sum[channel] += f64::from(value[channel]));
        }
        let texels = self.texels().max(1) as f64;
        sum.map(|sum| sum / texels)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_those_of_the_passage_alone() {
        let mut mask = Field::filled(4, 2, true);
        mask[(3, 1)] = false;
        let mut color = Field::filled(4, 2, [0.2, 0.1, 0.3]);
        color[(3, 1)] = [f32::NAN; 3];
        color[(0, 0)] = [0.9, 0.8, 1.0];
        let mut sample = Sample {
            name: "a".to_owned(),
            color,
            paint: None,
            height_mm: None,
            mask,
            spacing: 1.0,
            mm_per_texel: None,
            guessed_relief: false,
        };
        assert_eq!(sample.texels(), 7);
        for (mean, wanted) in sample.mean_color().into_iter().zip([0.3, 0.2, 0.4]) {
            assert!((mean - wanted).abs() < 1e-6, "{mean}, not {wanted}");
        }
        sample.color = Field::filled(4, 2, [0.184_186_5; 3]);
        assert!((sample.mean_lightness() - 50.0).abs() < 1e-3, "{}", sample.mean_lightness());
        sample.mask = Field::filled(4, 2, false);
        assert_eq!((sample.mean_color(), sample.mean_lightness()), ([0.0; 3], 0.0));
    }
}
