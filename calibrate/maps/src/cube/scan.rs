//! A cube is a scan with reflectances as values. You read it in blocks.
//!
//! For surveys and checksums you can also take pixels from all over it.

use std::ops::{Range, RangeInclusive};
use std::path::{Path, PathBuf};

use pigment::Remark;
use sha2::{Digest, Sha256};

use super::error::CubeError;
use super::interpret::{Readings, interpret};
use super::options::CubeOptions;
#[cfg(feature = "files")]
use super::raw_file::FileStamp;
use super::window::{Block, Conversion, Opened, Pixels, Source, Terms, Window};
use crate::pixel_maps::Mask;

/// How the values of a file become reflectance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CubeValues {
    /// Values times this number.
    Scaled(f64),
    /// Values with a factor and a summand for each band, or with a white and a dark reading.
    ByBands,
}

/// A spectral scan, read in blocks of rows. Bands lie in the order of rising wavelength. We leave
/// out bands that the file marks as bad.
#[derive(Debug)]
pub struct Cube {
    path: PathBuf,
    lines: usize,
    samples: usize,
    wavelengths_nm: Vec<f64>,
    fwhm_nm: Option<Vec<f64>>,
    white_sd: Option<Vec<f64>>,
    black_sd: Option<Vec<f64>>,
    remarks: Vec<Remark>,
    /// Indices of the bands in the file.
    bands: Vec<usize>,
    conversion: Conversion,
    source: Box<dyn Source>,
    /// The header, or the one file.
    #[cfg(feature = "files")]
    pub(crate) stamp: Option<FileStamp>,
}

impl Cube {
    /// Makes a cube from an opened scan.
    pub(crate) fn of(
        scan: Opened,
        readings: Option<&Readings>,
        options: &CubeOptions,
    ) -> Result<Self, CubeError> {
        let Some(nm) = scan.wavelengths_nm.clone() else {
            return Err(CubeError::format(
                &scan.path,
                format!("names no wavelengths of its {} bands", scan.bands),
                "add them to the header, or give a file of them with [wavelengths=FILE]",
            ));
        };
        let found = interpret(&scan, &nm, readings, options)?;
        let of_bands = |all: &Vec<f64>| found.bands.iter().map(|&band| all[band]).collect();
        let mut remarks = scan.remarks;
        remarks.extend(found.remarks);
        Ok(Self {
            wavelengths_nm: of_bands(&nm),
            fwhm_nm: scan.fwhm_nm.as_ref().map(of_bands),
            path: scan.path,
            lines: scan.lines,
            samples: scan.samples,
            white_sd: found.white_sd,
            black_sd: found.black_sd,
            remarks,
            bands: found.bands,
            conversion: found.conversion,
            source: scan.source,
            #[cfg(feature = "files")]
            stamp: None,
        })
    }

    /// Checks that the scan is what it was when you opened it: that neither size nor time of its header and of its data
    /// changed, and that the chunks of a Zarr array are all there. Call this after reading, before you use what you
    /// made of the values.
    ///
    /// # Errors
    /// [`CubeError::Data`] for a file that was changed or removed.
    #[cfg(feature = "files")]
    pub fn check_unchanged(&self) -> Result<(), CubeError> {
        self.stamp.as_ref().map_or(Ok(()), FileStamp::check)?;
        self.source.check_unchanged()
    }

    /// Path of the header or file, as we found it.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Number of rows.
    #[must_use]
    pub fn lines(&self) -> usize {
        self.lines
    }

    /// Number of columns.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Wavelengths of the bands in nm, rising.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// Full width at half maximum of the bands in nm, if the file states it.
    #[must_use]
    pub fn fwhm_nm(&self) -> Option<&[f64]> {
        self.fwhm_nm.as_deref()
    }

    /// Standard deviation of the reflectance of a white in each band, from the scatter of the white
    /// reading over its lines. For cubes of reflectance this is `None`.
    #[must_use]
    pub fn white_sd(&self) -> Option<&[f64]> {
        self.white_sd.as_deref()
    }

    /// Standard deviation of the reflectance of a black in each band, from the scatter of the dark
    /// reading over its lines. For cubes of reflectance this is `None`.
    #[must_use]
    pub fn black_sd(&self) -> Option<&[f64]> {
        self.black_sd.as_deref()
    }

    /// Root mean square of [`Cube::white_sd`] over the bands, or `None` if there is no `white_sd`.
    #[must_use]
    pub fn noise_of_white(&self) -> Option<f64> {
        let sd = self.white_sd().filter(|sd| !sd.is_empty())?;
        let squares: f64 = sd.iter().map(|sd| sd * sd).sum();
        Some((squares / sd.len() as f64).sqrt())
    }

    /// How the values of the file become reflectance.
    #[must_use]
    pub fn values(&self) -> CubeValues {
        match &self.conversion.terms {
            Terms::One(gain) => CubeValues::Scaled(f64::from(*gain)),
            Terms::Columns { .. } => CubeValues::ByBands,
        }
    }

    /// How we understood the file. A warning tells of a guess, or of a part of the file that we leave out.
    #[must_use]
    pub fn remarks(&self) -> &[Remark] {
        &self.remarks
    }

    /// The cube with the bands from `nm.start()` to `nm.end()` only. You no longer read the other
    /// bands, and they no longer decide whether a pixel can be mapped.
    ///
    /// # Errors
    /// [`CubeError::Outside`] if no band is left.
    pub fn between(mut self, nm: RangeInclusive<f64>) -> Result<Self, CubeError> {
        let all = self.bands.len();
        let chosen: Vec<usize> =
            (0..all).filter(|&band| nm.contains(&self.wavelengths_nm[band])).collect();
        if chosen.is_empty() {
            let asked = format!("wavelengths from {} to {} nm", nm.start(), nm.end());
            return Err(self.outside(asked));
        }
        let lists = [&mut self.fwhm_nm, &mut self.white_sd, &mut self.black_sd];
        let known = lists.into_iter().filter_map(Option::as_mut);
        for list in known.chain([&mut self.wavelengths_nm]) {
            *list = chosen.iter().map(|&band| list[band]).collect();
        }
        self.bands = chosen.iter().map(|&band| self.bands[band]).collect();
        self.conversion = self.conversion.of_bands(&chosen, all);
        Ok(self)
    }

    /// Number of rows that a block of `columns` columns may have in `bytes` of memory, at least
    /// one.
    #[must_use]
    pub fn rows_within(&self, bytes: usize, columns: usize) -> usize {
        let row = columns * (self.bands.len() * size_of::<f32>() + size_of::<Mask>());
        let natural = self.source.natural_rows();
        let mut rows = 1;
        while rows < self.lines {
            let scratch = self.source.scratch_bytes(2 * rows, columns);
            if row.saturating_mul(2 * rows).saturating_add(scratch) > bytes {
                break;
            }
            rows *= 2;
        }
        // Whole parts of the file where that costs no more than a half.
        if rows > natural { rows - rows % natural } else { rows }.clamp(1, self.lines)
    }

    /// Reads whole rows.
    ///
    /// # Errors
    /// [`CubeError`] if the cube has no such rows or we cannot read it.
    pub fn read_rows(&self, rows: Range<usize>) -> Result<Block, CubeError> {
        self.read(rows, 0..self.samples)
    }

    /// Reads the pixels of a rectangle.
    pub fn read(&self, rows: Range<usize>, columns: Range<usize>) -> Result<Block, CubeError> {
        let mut block = Block::default();
        self.read_into(rows, columns, &mut block)?;
        Ok(block)
    }

    /// Reads the pixels of a rectangle into `block`. Use this to keep its memory.
    pub fn read_into(
        &self,
        rows: Range<usize>,
        columns: Range<usize>,
        block: &mut Block,
    ) -> Result<(), CubeError> {
        for (name, range, end) in [("rows", &rows, self.lines), ("columns", &columns, self.samples)]
        {
            if range.start > range.end || range.end > end {
                return Err(self.outside(format!("{name} {} to {}", range.start, range.end)));
            }
        }
        let window = Window { rows, columns };
        block.bands = self.bands.len();
        block.values.resize(window.pixels() * block.bands, 0.0);
        block.mask.resize(window.pixels(), Mask::Mapped);
        let pixels = Pixels { values: &mut block.values, mask: &mut block.mask };
        self.source.read(&window, &self.bands, &self.conversion, pixels)?;
        (block.rows, block.columns) = (window.rows, window.columns);
        Ok(())
    }

    fn outside(&self, asked: String) -> CubeError {
        let ends = [self.wavelengths_nm.first(), self.wavelengths_nm.last()];
        let [first, last] = ends.map(|end| end.copied().unwrap_or(0.0));
        let has = format!("{} rows, {} columns and {first} to {last} nm", self.lines, self.samples);
        CubeError::Outside { path: self.path.clone(), asked, has }
    }
}

/// The fingerprint of a scan covers about this many pixels.
const SIGN_PIXELS: usize = 4096;

/// Pixels that can be mapped, from all over a rectangle of a cube.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SpreadPixels {
    /// Reflectances, pixel after pixel.
    pub values: Vec<f32>,
    /// Row and column of each pixel.
    pub places: Vec<(usize, usize)>,
    /// Number of pixels that we looked at. This includes ones that cannot be mapped.
    pub looked_at: usize,
}

/// Step between rows and step between columns at which we read about `about` of `rows` x `columns`
/// pixels.
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
    /// Reads about `about` pixels of a rectangle, evenly spread in rows and columns. This reads
    /// only the rows of these pixels, and leaves out pixels that cannot be mapped.
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

    /// Number of the pixels of a rectangle that can be mapped, and their mean reflectance by band.
    /// If there are none, every band is 0.
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

    /// Fingerprint of the scan: the SHA-256, in hexadecimal digits, of the sizes, the wavelengths
    /// and the reflectances of about 4,000 pixels. It differs for another scan, and for this scan
    /// with other options of reading.
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
            let met = count(rows, down) * count(columns, across);
            let wanted = about.min(rows * columns);
            let near = met >= wanted / 2 && met <= 2 * wanted;
            assert!(near, "{rows} x {columns}: {met} of {wanted}");
        }
    }

    fn count(length: usize, step: usize) -> usize {
        (step / 2..length).step_by(step).count()
    }
}
