//! Chunks of a Zarr array as raw values.

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::cube::conversion::Conversion;
use crate::cube::error::CubeError;
use crate::cube::window::{Pixels, Source, Window};
use crate::zarr::{ChunkError, ZarrArray};

pub(super) fn chunk_error(error: ChunkError) -> CubeError {
    match error {
        ChunkError::Io(path, reason) => CubeError::reading(&path, reason),
        ChunkError::Fault(path, fault) => CubeError::data(&path, fault.problem, fault.way_out),
    }
}

/// Chunks of an array as raw values.
#[derive(Debug)]
pub(super) struct ZarrSource {
    array: ZarrArray,
    strides: Vec<usize>,
    /// Numbers of the axes of rows, columns and bands.
    axes: [usize; 3],
}

impl ZarrSource {
    /// The array with these numbers of the axes of rows, columns and bands.
    pub(super) fn new(array: ZarrArray, axes: [usize; 3]) -> Self {
        Self { strides: array.strides(), array, axes }
    }

    /// Reads rows that lie in one row of chunks.
    fn read_part(
        &self,
        window: &Window,
        bands: &[usize],
        conversion: &Conversion,
        pixels: Pixels<'_>,
    ) -> Result<(), CubeError> {
        let about = &self.array.about;
        let [down, across, deep] = self.axes.map(|axis| about.chunk[axis]);
        let row = window.rows.start / down;
        let columns = window.columns.start / across..=(window.columns.end - 1) / across;
        let mut depths: Vec<usize> = bands.iter().map(|band| band / deep).collect();
        depths.sort_unstable();
        depths.dedup();
        let places: Vec<(usize, usize)> =
            columns.flat_map(|column| depths.iter().map(move |&depth| (column, depth))).collect();
        let read = |&(column, depth): &(usize, usize)| {
            let mut at = [0; 3];
            for (axis, number) in self.axes.into_iter().zip([row, column, depth]) {
                at[axis] = number;
            }
            let chunk = self.array.chunk(&at).map_err(chunk_error)?;
            let numbers = chunk.map(|bytes| {
                let mut numbers = vec![0.0; bytes.len() / about.number_type.bytes()];
                about.number_type.convert(about.chain.byte_order, &bytes, &mut numbers, 1);
                numbers
            });
            Ok(((column, depth), numbers))
        };
        let chunks: BTreeMap<_, Option<Vec<f32>>> =
            places.par_iter().map(read).collect::<Result<_, CubeError>>()?;
        let [by_row, by_column, by_band] = self.axes.map(|axis| self.strides[axis]);
        pixels.rows(window, bands.len()).for_each(|(line, filled)| {
            let pixels = filled.values.chunks_exact_mut(bands.len()).zip(window.columns.clone());
            for (pixel, column) in pixels {
                for (value, &band) in pixel.iter_mut().zip(bands) {
                    let place =
                        line % down * by_row + column % across * by_column + band % deep * by_band;
                    let chunk = chunks.get(&(column / across, band / deep));
                    *value = match chunk {
                        Some(Some(numbers)) => numbers[place],
                        _ => about.fill as f32,
                    };
                }
            }
            conversion.row(window.columns.start, filled.values, filled.mask);
        });
        Ok(())
    }
}

impl Source for ZarrSource {
    fn read(
        &self,
        window: &Window,
        bands: &[usize],
        conversion: &Conversion,
        pixels: Pixels<'_>,
    ) -> Result<(), CubeError> {
        if pixels.values.is_empty() {
            return Ok(());
        }
        let down = self.natural_rows();
        let mut rest = pixels;
        let mut start = window.rows.start;
        while start < window.rows.end {
            let end = ((start / down + 1) * down).min(window.rows.end);
            let (part, more) = rest.split(window, bands.len(), end - start);
            let window = Window { rows: start..end, columns: window.columns.clone() };
            self.read_part(&window, bands, conversion, part)?;
            (rest, start) = (more, end);
        }
        Ok(())
    }

    fn scratch_bytes(&self, _: usize, columns: usize) -> usize {
        let about = &self.array.about;
        let [down, across, deep] = self.axes.map(|axis| about.chunk[axis]);
        let bands = about.shape[self.axes[2]];
        let numbers = down * (columns + 2 * across) * (bands + deep);
        numbers * (about.number_type.bytes() + size_of::<f32>())
    }

    fn natural_rows(&self) -> usize {
        self.array.about.chunk[self.axes[0]]
    }

    fn full_scale(&self) -> Option<f64> {
        self.array.about.number_type.full_scale()
    }
}
