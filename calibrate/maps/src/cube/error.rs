//! Errors of scans, and advice on kinds of files that are not scans.

use std::io;
use std::path::{Path, PathBuf};

use documents::file::FileError;
use documents::hint::Explain;
use spectra::instrument::FileText;

/// We cannot open or read a cube.
#[derive(Debug, thiserror::Error, Explain)]
pub enum CubeError {
    /// The operating system cannot read a file.
    #[error(transparent)]
    File(#[from] FileError),
    /// The list of wavelengths is faulty.
    #[error(transparent)]
    Wavelengths(#[from] spectra::WavelengthListError),
    /// The file or folder is not a cube, or it is of a kind that we do not read.
    #[error("{}: {problem}", path.display())]
    #[hint("{way_out}")]
    Format {
        /// Path as you gave it.
        path: PathBuf,
        /// The kind that we found, as part of a sentence.
        problem: String,
        /// Advice on how to go on.
        way_out: String,
    },
    /// A key of a header is missing or has an impossible value.
    #[error("{}{}: `{key}` {problem}", path.display(), line_words(*line))]
    #[hint("{way_out}")]
    Key {
        /// Path of the header.
        path: PathBuf,
        /// Line from 1, or 0 if the key is missing.
        line: usize,
        /// Name of the key.
        key: String,
        /// The fault of the key, with the value that we found.
        problem: String,
        /// Advice on how to go on.
        way_out: String,
    },
    /// Header and data disagree about the number of bytes.
    #[error(
        "{}: the header {} describes {expected} bytes ({sizes}), found `{found}`",
        data.display(), header.display()
    )]
    #[hint(
        "correct samples, lines, bands, data type or header offset in the header, or copy the data file again"
    )]
    Size {
        /// Path of the data.
        data: PathBuf,
        /// Path of the header.
        header: PathBuf,
        /// Number of bytes that the header describes.
        expected: u64,
        /// Number of bytes in the file.
        found: u64,
        /// Offset and sizes that the header names, in words.
        sizes: String,
    },
    /// The values are counts of a detector, or a multiple of reflectance that we cannot find out.
    #[error("{}: the values are not reflectances: the largest read is `{largest}`", path.display())]
    #[hint(
        "raw counts need [white_reading=FILE] and [dark_reading=FILE]; reflectances times a factor need [scale=10000] with that factor"
    )]
    NoReflectance {
        /// Path of the cube.
        path: PathBuf,
        /// Largest value of the sampled pixels.
        largest: f64,
    },
    /// We cannot use any sampled pixel.
    #[error("{}: {problem}", path.display())]
    #[hint("{way_out}")]
    Unusable {
        /// Path of the cube.
        path: PathBuf,
        /// The fault of all sampled pixels.
        problem: String,
        /// Advice on how to go on.
        way_out: String,
    },
    /// A white or dark reading does not fit the cube.
    #[error("{}: the {role} reading {problem}", path.display())]
    #[hint("{way_out}")]
    Reading {
        /// Path of the reading.
        path: PathBuf,
        /// `white` or `dark`.
        role: &'static str,
        /// The fault, with both numbers where two disagree.
        problem: String,
        /// Advice on how to go on.
        way_out: String,
    },
    /// We cannot decode stored data.
    #[error("{}: {problem}", path.display())]
    #[hint("{way_out}")]
    Data {
        /// Path of the file.
        path: PathBuf,
        /// The fault and its place.
        problem: String,
        /// Advice on how to go on.
        way_out: String,
    },
    /// You ask for pixels or bands that the cube does not have.
    #[error("{}: {asked} lie outside the cube of {has}", path.display())]
    #[hint("name rows, columns and wavelengths inside it")]
    #[fault(Setting)]
    Outside {
        /// Path of the cube.
        path: PathBuf,
        /// Rows, columns or wavelengths that you asked for.
        asked: String,
        /// Sizes of the cube.
        has: String,
    },
}

fn line_words(line: usize) -> String {
    match line {
        0 => String::new(),
        line => format!(": line {line}"),
    }
}

impl CubeError {
    pub(crate) fn reading(path: &Path, reason: io::Error) -> Self {
        Self::File(FileError::reading(path, reason))
    }

    #[cfg(feature = "files")]
    pub(crate) fn unpacking(path: &Path, reason: io::Error) -> Self {
        match reason.kind() {
            io::ErrorKind::UnexpectedEof => {
                Self::data(path, "ends before its data end", "copy or export the file again")
            }
            _ => Self::reading(path, reason),
        }
    }

    /// A file of a kind that we do not read.
    pub(crate) fn format(
        path: &Path,
        problem: impl Into<String>,
        way_out: impl Into<String>,
    ) -> Self {
        Self::Format { path: path.to_owned(), problem: problem.into(), way_out: way_out.into() }
    }

    /// Data that we cannot decode.
    pub(crate) fn data(
        path: &Path,
        problem: impl Into<String>,
        way_out: impl Into<String>,
    ) -> Self {
        Self::Data { path: path.to_owned(), problem: problem.into(), way_out: way_out.into() }
    }
}

/// Shortens a value of a file for messages.
pub(crate) fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}..", &text[..end]),
        None => text.to_owned(),
    }
}

/// Kinds of files that only other programs read, by their first bytes.
const OTHERS: [(&[u8], &str, &str); 5] = [
    (
        b"\x89HDF\r\n",
        "an HDF5 file (or MATLAB 7.3, NeXus)",
        "open it in Python with h5py and save it as Zarr with xarray, or export ENVI",
    ),
    (b"CDF", "a NetCDF file", "open it in Python with xarray and save it as Zarr"),
    (
        b"MATLAB 5.0",
        "a MATLAB file",
        "open it in Python with scipy.io and save it as Zarr with xarray, or export ENVI",
    ),
    (
        b"\x89PNG",
        "one picture, which is not a cube",
        "name the folder that holds a picture for each wavelength",
    ),
    (
        b"\xff\xd8\xff",
        "a JPEG picture, which is not a cube",
        "name the folder that holds a picture for each wavelength",
    ),
];

/// Refuses a file that begins with `start` if only another program reads its kind.
pub(crate) fn refuse_other_kinds(path: &Path, start: &[u8]) -> Result<(), CubeError> {
    if let Some((_, kind, way_out)) = OTHERS.iter().find(|(magic, ..)| start.starts_with(magic)) {
        return Err(CubeError::format(path, format!("is {kind}"), *way_out));
    }
    if holds_spectra(path, start) {
        return Err(CubeError::format(
            path,
            "holds spectra of points, not a scan",
            "`impasto identify SPOTS LIBRARY` names the pigments of each spectrum",
        ));
    }
    Ok(())
}

/// Whether a file that begins with `start` is a text with numbers, a workbook, or a binary file of a
/// spectrometer.
fn holds_spectra(path: &Path, start: &[u8]) -> bool {
    // An archive that goes on behind its start cannot be looked into.
    if start.starts_with(b"PK") {
        return path.extension().is_some_and(|end| end.eq_ignore_ascii_case("xlsx"));
    }
    match FileText::of(&path.display().to_string(), start) {
        Ok(None) => true,
        Ok(Some(FileText { text, .. })) => {
            let is_plain = !text.chars().any(|c| c.is_control() && !c.is_whitespace());
            let words = text.split(|c: char| c.is_whitespace() || matches!(c, ',' | ';'));
            is_plain && words.filter(|word| word.parse::<f64>().is_ok()).count() >= FEWEST_NUMBERS
        }
        Err(_) => false,
    }
}

/// A text with fewer numbers at its start holds no spectrum.
const FEWEST_NUMBERS: usize = 3;
