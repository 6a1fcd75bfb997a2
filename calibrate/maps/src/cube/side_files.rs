//! Files beside a packed scan: the list of its wavelengths, and the temporary file of unpacked
//! values.
//!
//! You can read a packed image only from its beginning, but we read a cube in any order. The
//! temporary file has no name and vanishes when the program ends.

use std::fs::File;
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::error::CubeError;
use super::raw_file::{Interleave, Layout, PositionalFile, RawFile};
use super::wavelengths::Wavelengths;
use crate::numbers::{ByteOrder, NumberType};

/// Advice for a list that we cannot read.
const WAY_OUT: &str = "write one wavelength in nm in each line";

/// Reads wavelengths, one in each line or all in one line. They are in nm, or in micrometres if a
/// heading or their range shows this. If there are several columns, we take the one with a heading
/// of wavelengths, or else the last number of each line. Text after `#` is a comment.
pub(crate) fn wavelengths_of(path: &Path) -> Result<Vec<f64>, CubeError> {
    let bytes = documents::file::read(path)?;
    let text = String::from_utf8_lossy(&bytes);
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let mut heading = None;
    for (line, number) in text.trim_start_matches('\u{feff}').lines().zip(1..) {
        let line = line.split('#').next().unwrap_or_default().trim();
        let words = words(line);
        let numbers: Vec<f64> = words.iter().filter_map(|word| number_of(word)).collect();
        match (words.is_empty(), numbers.is_empty()) {
            (true, _) => {}
            (false, true) if rows.is_empty() => heading = heading.or_else(|| heading_of(&words)),
            (false, true) => {
                return Err(CubeError::Key {
                    path: path.to_owned(),
                    line: number,
                    key: line.chars().take(40).collect(),
                    problem: "is not a wavelength".to_owned(),
                    way_out: WAY_OUT.to_owned(),
                });
            }
            // Words beside the numbers, such as names of pictures, keep their columns.
            (false, false) => {
                rows.push(words.iter().map(|word| number_of(word).unwrap_or(f64::NAN)).collect());
            }
        }
    }
    let (column, unit) = heading.unwrap_or((None, None));
    let values: Vec<f64> = match &rows[..] {
        // Units and words between the numbers are passed over.
        [list] if column.is_none() => list.iter().copied().filter(|nm| nm.is_finite()).collect(),
        rows => rows
            .iter()
            .map(|row: &Vec<f64>| match column {
                Some(column) => row.get(column).copied().unwrap_or(f64::NAN),
                None => {
                    row.iter().copied().rev().find(|value| value.is_finite()).unwrap_or(f64::NAN)
                }
            })
            .collect(),
    };
    if values.is_empty() {
        return Err(CubeError::format(path, "holds no wavelengths", WAY_OUT));
    }
    let found = Wavelengths::of(&values, unit)
        .map_err(|problem| CubeError::format(path, format!("the list {problem}"), WAY_OUT))?;
    Ok(found.nm)
}

fn words(line: &str) -> Vec<&str> {
    let words = line.split([',', ';', '\t', ' ']).map(|word| word.trim().trim_matches('"'));
    words.filter(|word| !word.is_empty()).collect()
}

/// Reads a number, also with its unit, e.g. `450` or `450nm`.
fn number_of(word: &str) -> Option<f64> {
    word.strip_suffix("nm").unwrap_or(word).parse().ok().filter(|value: &f64| value.is_finite())
}

/// Column and unit of the wavelengths, if a line of words names them.
fn heading_of(words: &[&str]) -> Option<(Option<usize>, Option<&'static str>)> {
    let lower: Vec<String> = words.iter().map(|word| word.to_lowercase()).collect();
    let units = [("nm", &["nm", "nanomet"][..]), ("um", &["micromet", "(um)", "_um"])];
    let unit = units.into_iter().find(|(_, parts)| lower.iter().any(|word| has(word, parts)));
    let unit = unit.map(|(name, _)| name);
    let column =
        lower.iter().position(|word: &String| has(word, &["wavelength", "lambda"]) || word == "nm");
    (column.is_some() || unit.is_some()).then_some((column, unit))
}

fn has(word: &str, parts: &[&str]) -> bool {
    parts.iter().any(|part| word.contains(part))
}

/// Order of the bytes of unpacked numbers.
const ORDER: ByteOrder =
    if cfg!(target_endian = "big") { ByteOrder::Big } else { ByteOrder::Little };

/// A temporary file that we fill with the numbers of a cube.
#[derive(Debug)]
pub(crate) struct Spool {
    file: File,
    /// Position in the file, which is the end of the bytes that we wrote last.
    at: u64,
    folder: PathBuf,
    layout: Layout,
}

impl Spool {
    /// Creates the file in `folder`, or in the system's folder for temporary files. The numbers
    /// have the byte order of this machine.
    pub(crate) fn new(
        folder: Option<&Path>,
        (lines, samples, bands): (usize, usize, usize),
        number_type: NumberType,
        interleave: Interleave,
    ) -> Result<Self, CubeError> {
        let folder = folder.map_or_else(std::env::temp_dir, Path::to_owned);
        let file = tempfile::tempfile_in(&folder).map_err(|reason| fault(&folder, &reason))?;
        let layout =
            Layout { lines, samples, bands, offset: 0, number_type, byte_order: ORDER, interleave };
        Ok(Self { file, at: 0, folder, layout })
    }

    /// Writes the bytes of consecutive numbers. The first number is at this line, sample and band.
    pub(crate) fn write(
        &mut self,
        (line, sample, band): (usize, usize, usize),
        bytes: &[u8],
    ) -> Result<(), CubeError> {
        let position = self.layout.position(line, sample, band);
        let written = match position == self.at {
            true => Ok(position),
            false => self.file.seek(SeekFrom::Start(position)),
        };
        let written = written.and_then(|_| self.file.write_all(bytes));
        written.map_err(|reason| fault(&self.folder, &reason))?;
        self.at = position + bytes.len() as u64;
        Ok(())
    }

    /// Ends writing. Messages call the packed images `path`.
    pub(crate) fn finish(self, path: &Path) -> Result<RawFile, CubeError> {
        let file = PositionalFile::of(self.file, path)?;
        let expected = self.layout.file_bytes().unwrap_or(u64::MAX);
        if expected != file.bytes() {
            let problem =
                format!("unpacks to {} bytes of values, expected {expected}", file.bytes());
            return Err(CubeError::data(path, problem, "copy the file again"));
        }
        Ok(RawFile::new(file, self.layout))
    }
}

fn fault(folder: &Path, reason: &std::io::Error) -> CubeError {
    CubeError::data(
        folder,
        format!("unpacked values cannot be written to this folder: {reason}"),
        "free space there, or name a folder on a larger disk with [scratch=FOLDER]",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<f64>, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("wavelengths.txt");
        std::fs::write(&path, text).unwrap();
        wavelengths_of(&path).map_err(|error| error.to_string())
    }

    #[test]
    fn lists_of_all_shapes_are_read() {
        for text in [
            "450\n500.5\n",
            "450, 500.5",
            "450 500.5\n",
            "450 nm, 500.5 nm\n",
            "wavelength_nm\n450\n500.5",
            "band,wavelength\n1,450\n2,500.5\n",
            "wavelength,fwhm\n450,9\n500.5,9\n",
            "file;nm\na.png;450\nb.png;500.5\n",
            "# two filters\n450nm # blue\n500.5nm\n",
            "\u{feff}1\t450\n2\t500.5\n",
            "wavelength (um)\n0.45\n0.5005\n",
        ] {
            let found = read(text).unwrap();
            let near = found.iter().zip([450.0, 500.5]).all(|(a, b)| (a - b).abs() < 1e-9);
            assert!(near && found.len() == 2, "{text:?}: {found:?}");
        }
    }

    #[test]
    fn faults_name_the_line() {
        let error = read("450\nblue\n").unwrap_err();
        assert!(error.ends_with("wavelengths.txt: line 2: `blue` is not a wavelength"), "{error}");
        assert!(read("# nothing\n").unwrap_err().ends_with("holds no wavelengths"));
        assert!(read("1\n2\n300\n").unwrap_err().contains("the list runs from"));
    }
}
