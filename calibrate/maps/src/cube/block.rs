//! A block of pixels with their reflectances.

use std::ops::Range;

use crate::pixel_maps::Mask;

/// Reflectances of a rectangle of pixels.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Block {
    /// Rows of the cube that the block holds.
    pub rows: Range<usize>,
    /// Columns of the cube that the block holds.
    pub columns: Range<usize>,
    /// Number of bands.
    pub bands: usize,
    /// Reflectance factors (a white is 1), pixel after pixel: row, column, band.
    pub values: Vec<f32>,
    /// Whether each pixel can be mapped, or why not.
    pub mask: Vec<Mask>,
}

impl Block {
    /// Number of pixels.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.mask.len()
    }

    /// Reflectances of a pixel, by its place in the block.
    ///
    /// # Panics
    /// If the block has no such pixel.
    #[must_use]
    pub fn pixel(&self, index: usize) -> &[f32] {
        &self.values[index * self.bands..(index + 1) * self.bands]
    }

    /// Reflectances and masks of all pixels in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&[f32], Mask)> {
        self.values.chunks_exact(self.bands.max(1)).zip(self.mask.iter().copied())
    }
}
