//! Writes a scan as ENVI: rows of reflectances as whole numbers, then the header.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use documents::file::{FileAction, FileError, FileInPieces, write_whole};

/// Divide stored values by this number to get reflectance.
pub const WRITTEN_SCALE: f32 = 10_000.0;

/// Sizes and description of a scan that you want to write.
#[derive(Debug, Clone, PartialEq)]
pub struct EnviAbout {
    /// Number of rows.
    pub lines: usize,
    /// Number of columns.
    pub samples: usize,
    /// Wavelengths of the bands in nm.
    pub wavelengths_nm: Vec<f64>,
    /// Description for readers. We leave out braces and line breaks.
    pub description: String,
}

/// Writes a scan: first `NAME.bil` of 16-bit numbers, each line band after band, then the header
/// `NAME.hdr`. The header comes last, so a scan with a header is whole.
#[derive(Debug)]
pub struct EnviWriter {
    header: PathBuf,
    about: EnviAbout,
    data: FileInPieces,
    lines: usize,
}

/// Path of the data that belong to the header `path`.
#[must_use]
pub fn written_data(path: &Path) -> PathBuf {
    path.with_extension("bil")
}

impl EnviWriter {
    /// Begins the scan with the header `path`.
    pub fn create(path: &Path, about: EnviAbout) -> Result<Self, FileError> {
        let data = FileInPieces::create(&written_data(path))?;
        Ok(Self { header: path.to_owned(), about, data, lines: 0 })
    }

    /// Adds whole rows of reflectances, pixel by pixel with all bands of each. This rounds values
    /// to 0.0001 and limits them to 0 to 6.5535.
    ///
    /// # Errors
    /// [`FileError`] if we cannot write them, or they are not whole rows of the scan.
    pub fn add(&mut self, values: &[f32]) -> Result<(), FileError> {
        let samples = self.about.samples;
        let bands = self.about.wavelengths_nm.len();
        let row = samples * bands;
        let rows = values.chunks_exact(row.max(1));
        if row == 0 || !rows.remainder().is_empty() || self.lines + rows.len() > self.about.lines {
            return Err(self.fault(format!(
                "{} numbers are not rows of {samples} x {bands} up to line {}",
                values.len(),
                self.about.lines
            )));
        }
        self.lines += rows.len();
        for row in rows {
            let mut bytes = vec![0; row.len() * 2];
            for (sample, pixel) in row.chunks_exact(bands).enumerate() {
                for (band, value) in pixel.iter().enumerate() {
                    // The conversion ends at the range of the type.
                    let number = (value * WRITTEN_SCALE).round() as u16;
                    let at = (band * samples + sample) * 2;
                    bytes[at..at + 2].copy_from_slice(&number.to_le_bytes());
                }
            }
            self.data.write(&bytes)?;
        }
        Ok(())
    }

    /// Ends the scan: the data get their name, then we write the header.
    ///
    /// # Errors
    /// [`FileError`] if we cannot write a file, or rows are missing.
    pub fn finish(self) -> Result<(), FileError> {
        if self.lines != self.about.lines {
            let found = self.lines;
            let lines = self.about.lines;
            return Err(self.fault(format!("the scan ends after line {found} of {lines}")));
        }
        // An old header does not describe the new data.
        match std::fs::remove_file(&self.header) {
            Err(reason) if reason.kind() != io::ErrorKind::NotFound => {
                return Err(failed(&self.header, reason));
            }
            _ => {}
        }
        self.data.finish()?;
        write_whole(&self.header, self.about.header().as_bytes())
    }

    fn fault(&self, problem: String) -> FileError {
        failed(&self.header, io::Error::new(io::ErrorKind::InvalidInput, problem))
    }
}

fn failed(path: &Path, reason: io::Error) -> FileError {
    FileError { path: path.to_owned(), action: FileAction::Write, reason: Arc::new(reason) }
}

impl EnviAbout {
    fn header(&self) -> String {
        let description: String = self
            .description
            .chars()
            .filter(|letter: &char| !matches!(letter, '{' | '}' | '\n' | '\r'))
            .collect();
        let nm: Vec<String> = self.wavelengths_nm.iter().map(f64::to_string).collect();
        format!(
            "ENVI\ndescription = {{{description}}}\nsamples = {}\nlines = {}\nbands = {}\n\
             header offset = 0\nfile type = ENVI Standard\ndata type = 12\ninterleave = bil\n\
             byte order = 0\nreflectance scale factor = {WRITTEN_SCALE}\n\
             wavelength units = Nanometers\nwavelength = {{{}}}\n",
            self.samples,
            self.lines,
            nm.len(),
            nm.join(", ")
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cube::{Cube, CubeValues};

    fn about() -> EnviAbout {
        EnviAbout {
            lines: 2,
            samples: 3,
            wavelengths_nm: vec![400.0, 550.5],
            description: "seed 1, {a}\nblur 2".to_owned(),
        }
    }

    #[test]
    fn what_is_written_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scan.hdr");
        let mut writer = EnviWriter::create(&path, about()).unwrap();
        let rows: [[f32; 6]; 2] = [[0.1, 0.2, 0.3, 0.4, 0.5, 0.6], [0.7, 0.8, 0.9, 1.0, 0.0, 9.0]];
        writer.add(&rows[0]).unwrap();
        assert!(!path.exists() && !written_data(&path).exists(), "not before the end");
        writer.add(&rows[1]).unwrap();
        writer.finish().unwrap();
        let cube = Cube::open(&path).unwrap();
        assert_eq!((cube.lines(), cube.samples()), (2, 3));
        assert_eq!(cube.wavelengths_nm(), [400.0, 550.5]);
        assert!(matches!(cube.values(), CubeValues::Scaled(gain) if (gain - 1e-4).abs() < 1e-9));
        let block = cube.read_rows(0..2).unwrap();
        let expected = rows.concat().into_iter().map(|value| value.min(6.5535));
        for (found, expected) in block.values.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{:?}", block.values);
        }
    }

    #[test]
    fn scans_with_missing_or_broken_rows_are_not_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scan.hdr");
        let mut writer = EnviWriter::create(&path, about()).unwrap();
        assert!(writer.add(&[0.5; 5]).is_err(), "no whole row");
        assert!(writer.add(&[0.5; 18]).is_err(), "three rows");
        writer.add(&[0.5; 6]).unwrap();
        let error = writer.finish().unwrap_err();
        assert!(error.reason.to_string().contains("line 1 of 2"), "{error}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "nothing is left");
    }
}
