//! A window of pixels, and the source of raw values that fills it.

use std::fmt::Debug;
use std::ops::Range;

use rayon::prelude::*;

use super::conversion::Conversion;
use super::error::CubeError;
use crate::pixel_maps::Mask;

/// Rows and columns of a cube.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Window {
    pub(crate) rows: Range<usize>,
    pub(crate) columns: Range<usize>,
}

impl Window {
    /// Number of pixels in a row of the window.
    pub(crate) fn width(&self) -> usize {
        self.columns.len()
    }

    /// Number of pixels.
    pub(crate) fn pixels(&self) -> usize {
        self.rows.len() * self.columns.len()
    }
}

/// Values and masks of the pixels of a window, to be filled.
#[derive(Debug)]
pub(crate) struct Pixels<'p> {
    /// Values, pixel after pixel.
    pub(crate) values: &'p mut [f32],
    /// One mask a pixel.
    pub(crate) mask: &'p mut [Mask],
}

impl<'p> Pixels<'p> {
    /// The rows of a window, each with its line: to be filled by all threads.
    pub(crate) fn rows(
        self,
        window: &Window,
        bands: usize,
    ) -> impl IndexedParallelIterator<Item = (usize, Pixels<'p>)> {
        let width = window.width().max(1);
        let values = self.values.par_chunks_mut((width * bands).max(1));
        let rows = values.zip(self.mask.par_chunks_mut(width)).zip(window.rows.clone());
        rows.map(|((values, mask), line)| (line, Pixels { values, mask }))
    }

    /// The first `rows` rows and the rest.
    #[cfg(feature = "files")]
    pub(crate) fn split(self, window: &Window, bands: usize, rows: usize) -> (Self, Self) {
        let pixels = rows * window.width();
        let (values, more_values) = self.values.split_at_mut(pixels * bands);
        let (mask, more_mask) = self.mask.split_at_mut(pixels);
        (Pixels { values, mask }, Pixels { values: more_values, mask: more_mask })
    }
}

/// Raw values of a cube: lines x samples x bands numbers as the file stores them.
pub(crate) trait Source: Debug + Send + Sync {
    /// Fills `pixels` with the values of `bands` (indices in the file) of the pixels of `window`, and
    /// converts each row by `conversion` when it is read. The window and the bands lie inside the
    /// cube.
    fn read(
        &self,
        window: &Window,
        bands: &[usize],
        conversion: &Conversion,
        pixels: Pixels<'_>,
    ) -> Result<(), CubeError>;

    /// Bytes of memory that reading needs beside the values, for a window of `rows` x `columns`.
    fn scratch_bytes(&self, rows: usize, columns: usize) -> usize;

    /// Number of rows that are best read together, and after which a new part of the file begins.
    fn natural_rows(&self) -> usize {
        1
    }

    /// Largest value at which a detector saturates, if the type of the numbers tells it.
    fn full_scale(&self) -> Option<f64> {
        None
    }
}
