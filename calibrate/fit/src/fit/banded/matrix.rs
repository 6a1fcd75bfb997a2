//! Symmetric banded matrices.

use std::sync::Mutex;

use rayon::prelude::*;

/// Rows of a product that one task computes.
const ROWS_OF_PRODUCT: usize = 512;
/// Entries that one task copies or clears.
const ENTRIES_OF_TASK: usize = 1 << 16;

/// Lower band of a symmetric matrix, stored column by column.
#[derive(Debug, Clone)]
pub(crate) struct Banded {
    pub(super) size: usize,
    /// Number of entries kept below the diagonal.
    pub(super) reach: usize,
    pub(super) columns: Vec<f64>,
}

impl Banded {
    pub(crate) fn zeros(size: usize, reach: usize) -> Self {
        Self { size, reach, columns: vec![0.0; size * (reach + 1)] }
    }

    /// Entry at `row` and `column` within the band, where `row >= column`.
    pub(crate) fn at(&self, row: usize, column: usize) -> f64 {
        self.columns[column * (self.reach + 1) + row - column]
    }

    pub(crate) fn diagonal(&self, i: usize) -> f64 {
        self.columns[i * (self.reach + 1)]
    }

    /// Adds to the entry at `row` and `column`, where `row >= column`.
    #[inline]
    pub(crate) fn add(&mut self, row: usize, column: usize, value: f64) {
        debug_assert!(
            row >= column && row - column <= self.reach,
            "({row}, {column}) is off the band"
        );
        self.columns[column * (self.reach + 1) + row - column] += value;
    }

    /// Replaces a row and a column by those of the identity, which fixes the unknown `i`.
    pub(crate) fn hold(&mut self, i: usize) {
        let width = self.reach + 1;
        self.columns[i * width..(i + 1) * width].fill(0.0);
        for column in i.saturating_sub(self.reach)..i {
            self.columns[column * width + i - column] = 0.0;
        }
        self.columns[i * width] = 1.0;
    }

    /// Entries of `count` columns at a time, the columns of one wavelength, for adding to them on several
    /// threads.
    pub(crate) fn by_columns(
        &mut self,
        count: usize,
    ) -> impl IndexedParallelIterator<Item = ColumnsMut<'_>> {
        let width = self.reach + 1;
        let columns = self.columns.par_chunks_mut(count * width);
        columns.map(move |entries| ColumnsMut { width, entries })
    }

    /// Product with a vector.
    pub(crate) fn times(&self, vector: &[f64]) -> Vec<f64> {
        let width = self.reach + 1;
        let mut product = vec![0.0; self.size];
        product.par_chunks_mut(ROWS_OF_PRODUCT).enumerate().for_each(|(block, product)| {
            let first = block * ROWS_OF_PRODUCT;
            let end = first + product.len();
            for column in first.saturating_sub(self.reach)..end {
                let entries = &self.columns[column * width..(column + 1) * width];
                if column >= first {
                    product[column - first] += entries[0] * vector[column];
                }
                for row in first.max(column + 1)..end.min(column + width) {
                    product[row - first] += entries[row - column] * vector[column];
                }
                if column >= first {
                    let rows = &vector[column + 1..(column + width).min(self.size)];
                    let sum = &mut product[column - first];
                    rows.iter().zip(&entries[1..]).for_each(|(value, entry)| *sum += entry * value);
                }
            }
        });
        product
    }
}

/// Several neighbouring columns of a matrix.
pub(crate) struct ColumnsMut<'a> {
    width: usize,
    entries: &'a mut [f64],
}

impl ColumnsMut<'_> {
    /// Adds to the entry at `row` and `column`, both counted from the first of these columns, where
    /// `row >= column`.
    #[inline]
    pub(crate) fn add(&mut self, row: usize, column: usize, value: f64) {
        self.entries[column * self.width + row - column] += value;
    }
}

/// Memory of matrices that are no longer needed, for the next ones: a large fit makes hundreds of them,
/// and fresh memory costs as much time as the arithmetic.
#[derive(Debug, Default)]
pub(crate) struct Spare(Mutex<Vec<Vec<f64>>>);

impl Spare {
    /// A matrix of zeros.
    pub(crate) fn zeros(&self, size: usize, reach: usize) -> Banded {
        let Some(mut columns) = self.take(size * (reach + 1)) else {
            return Banded::zeros(size, reach);
        };
        columns.par_chunks_mut(ENTRIES_OF_TASK).for_each(|entries| entries.fill(0.0));
        Banded { size, reach, columns }
    }

    /// A copy of `matrix`.
    pub(crate) fn copy(&self, matrix: &Banded) -> Banded {
        let Some(mut columns) = self.take(matrix.columns.len()) else { return matrix.clone() };
        let pairs = columns.par_chunks_mut(ENTRIES_OF_TASK);
        pairs
            .zip(matrix.columns.par_chunks(ENTRIES_OF_TASK))
            .for_each(|(copy, entries)| copy.copy_from_slice(entries));
        Banded { columns, ..*matrix }
    }

    /// Keeps the memory of `matrix`.
    pub(crate) fn keep(&self, matrix: Banded) {
        if let Ok(mut kept) = self.0.lock() {
            kept.push(matrix.columns);
        }
    }

    fn take(&self, entries: usize) -> Option<Vec<f64>> {
        let mut kept = self.0.lock().ok()?;
        kept.retain(|columns| columns.len() == entries);
        kept.pop()
    }
}
