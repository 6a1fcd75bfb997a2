//! The whole picture from which samples are taken.

use graphics::field::Field;
use graphics::picture::Picture;

use crate::sample::{PaintOfSamples, TexelPaint, WholePainting};

/// A painting or photograph with all its channels, which have one size.
#[derive(Debug, Clone, PartialEq)]
pub struct SourcePicture {
    /// Colour of each pixel in linear sRGB with white at 1.
    pub color: Picture,
    /// Paint of each pixel, and its pigments; `None` for pictures without pigments.
    pub paint: Option<(Field<TexelPaint>, PaintOfSamples)>,
    /// Height of the surface above the ground in mm; `None` without relief.
    pub height_mm: Option<Field<f32>>,
    /// Side of a pixel in mm, where it is known.
    pub mm_per_pixel: Option<f64>,
    /// Whether the height was guessed from a photograph.
    pub guessed_relief: bool,
    /// Origin of the picture in words, for the file of the samples.
    pub provenance: String,
}

impl SourcePicture {
    /// A picture of colours alone.
    #[must_use]
    pub fn of_colors(color: Picture, provenance: impl Into<String>) -> Self {
        Self {
            color,
            paint: None,
            height_mm: None,
            mm_per_pixel: None,
            guessed_relief: false,
            provenance: provenance.into(),
        }
    }

    /// The picture of a painting of impasto, one pixel a cell, with its paint and relief.
    #[must_use]
    pub fn of_painting(painting: WholePainting) -> Self {
        let WholePainting { title, color, paint, height_mm, mm_per_texel, pigments, .. } = painting;
        Self {
            color,
            paint: Some((paint, pigments)),
            height_mm: Some(height_mm),
            mm_per_pixel: Some(mm_per_texel),
            guessed_relief: false,
            provenance: format!("painting `{title}`"),
        }
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.color.width(), self.color.height())
    }

    /// Name and size of a channel that is not as large as the colours.
    pub(super) fn odd_channel(&self) -> Option<(&'static str, (usize, usize))> {
        let paint = self.paint.as_ref().map(|(paint, _)| (paint.width(), paint.height()));
        let height = self.height_mm.as_ref().map(|height| (height.width(), height.height()));
        let channels = [("paint", paint), ("height", height)];
        let sizes = channels.into_iter().filter_map(|(name, size)| Some((name, size?)));
        sizes.into_iter().find(|&(_, size)| size != self.size())
    }
}
