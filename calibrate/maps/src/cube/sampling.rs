//! Pixels from all over a cube: for surveys, and to tell one scan from another.

use std::ops::Range;

use sha2::{Digest, Sha256};

use super::block::Block;
use super::error::CubeError;
use super::scan::Cube;
use crate::pixel_maps::Mask;

/// Pixels by which a scan is told from others, about.
const SIGN_PIXELS: usize = 4096;

/// Pixels that can be mapped, from all over a rectangle of a cube.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SpreadPixels {
    /// Reflectances, pixel after pixel.
    pub values: Vec<f32>,
    /// Row and column of each pixel.
    pub places: Vec<(usize, usize)>,
    /// Number of pixels that were looked at, those that cannot be mapped included.
    pub looked_at: usize,
}

/// Distance between rows and between columns, so that about `about` of `rows` x `columns` pixels are
/// met.
fn steps(rows: usize, columns: usize, about: usize) -> (usize, usize) {
    let ratio = (rows as f64 * columns as f64 / about.max(1) as f64).max(1.0);
    let down = (ratio.sqrt().round() as usize).clamp(1, rows.max(1));
    let across = (ratio / down as f64).round() as usize;
    match across > columns {
        // A narrow scan has no columns to leave out: its rows lie farther apart.
        true => (
            ((ratio / columns.max(1) as f64).round() as usize).clamp(1, rows.max(1)),
            columns.max(1),
        ),
        false => (down, across.max(1)),
    }
}

impl Cube {
    /// Reads about `about` pixels of a rectangle, evenly spread: rows and columns at equal distances. Only
    /// the rows of these pixels are read. Those that cannot be mapped are left out.
    ///
    /// # Errors
    /// [`CubeError`] if the cube has no such pixels or cannot be read.
    pub fn spread(
        &self,
        rows: Range<usize>,
        columns: Range<usize>,
        about: usize,
    ) -> Result<SpreadPixels, CubeError> {
        let (down, across) = steps(rows.len(), columns.len(), about);
        let mut found = SpreadPixels::default();
        let mut block = Block::default();
        for row in rows.skip(down / 2).step_by(down) {
            self.read_into(row..row + 1, columns.clone(), &mut block)?;
            for at in (across / 2..columns.len()).step_by(across) {
                found.looked_at += 1;
                if block.mask[at] == Mask::Mapped {
                    found.values.extend_from_slice(block.pixel(at));
                    found.places.push((row, columns.start + at));
                }
            }
        }
        Ok(found)
    }

    /// Number of the pixels of a rectangle that can be mapped, and their mean reflectance by band; 0 in every band
    /// if there are none.
    ///
    /// # Errors
    /// [`CubeError`] if the cube has no such pixels or cannot be read.
    pub fn mean(
        &self,
        rows: Range<usize>,
        columns: Range<usize>,
    ) -> Result<(usize, Vec<f64>), CubeError> {
        let block = self.read(rows, columns)?;
        let mut mean = vec![0.0; block.bands];
        let mut pixels = 0;
        for (values, _) in block.iter().filter(|(_, mask)| *mask == Mask::Mapped) {
            pixels += 1;
            mean.iter_mut().zip(values).for_each(|(sum, value)| *sum += f64::from(*value));
        }
        mean.iter_mut().for_each(|sum| *sum /= f64::max(pixels as f64, 1.0));
        Ok((pixels, mean))
    }

    /// SHA-256, in hexadecimal digits, of the sizes, the wavelengths and the reflectances of about 4,000
    /// pixels: a sign by which another scan, or this one read in another way, is told apart without
    /// reading all of it.
    ///
    /// # Errors
    /// [`CubeError`] if the cube cannot be read.
    pub fn sign(&self) -> Result<String, CubeError> {
        let mut hash = Sha256::new();
        for size in [self.lines(), self.samples(), self.wavelengths_nm().len()] {
            hash.update((size as u64).to_le_bytes());
        }
        for nm in self.wavelengths_nm() {
            hash.update(nm.to_le_bytes());
        }
        let pixels = self.spread(0..self.lines(), 0..self.samples(), SIGN_PIXELS)?;
        for (row, column) in pixels.places {
            hash.update((row as u64).to_le_bytes());
            hash.update((column as u64).to_le_bytes());
        }
        for value in pixels.values {
            hash.update(value.to_le_bytes());
        }
        Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_meet_about_the_wanted_number_of_pixels() {
        for (rows, columns, about) in [
            (5, 7, 100),
            (1, 90_000, 20_000),
            (90_000_000, 1, 20_000),
            (4_000_000, 10, 20_000),
            (900, 900, 20_000),
            (36_000, 44_000, 20_000),
        ] {
            let (down, across) = steps(rows, columns, about);
            let count = |length: usize, step: usize| (step / 2..length).step_by(step).count();
            let met = count(rows, down) * count(columns, across);
            let wanted = about.min(rows * columns);
            let near = met >= wanted / 2 && met <= 2 * wanted;
            assert!(near, "{rows} x {columns}: {met} of {wanted}");
        }
    }
}
