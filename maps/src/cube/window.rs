//! A window of pixels, and the source of raw values that fills it.

use std::fmt::Debug;
use std::ops::Range;

use super::error::CubeError;

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

/// Raw values of a cube: lines x samples x bands numbers as the file stores them.
pub(crate) trait Source: Debug + Send + Sync {
    /// Fills `values` with the values of `bands` (indices in the file) of the pixels of `window`,
    /// pixel after pixel. The window and the bands lie inside the cube.
    fn read(&self, window: &Window, bands: &[usize], values: &mut [f32]) -> Result<(), CubeError>;

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
