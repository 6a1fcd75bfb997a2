//! Errors in opening and reading a cube.

use std::io;
use std::path::{Path, PathBuf};

use documents::file::FileError;
use documents::hint::{Explain, Fault, Hint};

/// A cube that cannot be opened or read.
#[derive(Debug, thiserror::Error)]
pub enum CubeError {
    /// The operating system cannot read a file.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file or folder is no cube, or one of a kind that is not read.
    #[error("{}: {problem}", path.display())]
    Format {
        /// Path as the caller gave it.
        path: PathBuf,
        /// The kind that was found, as a sentence part.
        problem: String,
        /// Advice on how to go on.
        way_out: String,
    },
    /// A key of a header is missing or has an impossible value.
    #[error("{}{}: `{key}` {problem}", path.display(), line_words(*line))]
    Key {
        /// Path of the header.
        path: PathBuf,
        /// Line from 1; 0 if the key is not there.
        line: usize,
        /// Name of the key.
        key: String,
        /// The fault of the key, with the value that was found.
        problem: String,
        /// Advice on how to go on.
        way_out: String,
    },
    /// Header and data disagree about the number of bytes.
    #[error(
        "{}: the header {} describes {expected} bytes ({sizes}), found `{found}`",
        data.display(), header.display()
    )]
    Size {
        /// Path of the data.
        data: PathBuf,
        /// Path of the header.
        header: PathBuf,
        /// Bytes by the header.
        expected: u64,
        /// Bytes of the file.
        found: u64,
        /// Offset and sizes that the header names, in words.
        sizes: String,
    },
    /// The values are counts of a detector, or a multiple of reflectance that nothing tells.
    #[error("{}: the values are no reflectances: the largest read is `{largest}`", path.display())]
    NoReflectance {
        /// Path of the cube.
        path: PathBuf,
        /// Largest value of the sampled pixels.
        largest: f64,
    },
    /// No sampled pixel can be used.
    #[error("{}: {problem}", path.display())]
    Unusable {
        /// Path of the cube.
        path: PathBuf,
        /// The fault of all pixels that were sampled.
        problem: String,
        /// Advice on how to go on.
        way_out: String,
    },
    /// A white or dark reading does not fit the cube.
    #[error("{}: the {role} reading {problem}", path.display())]
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
    /// Stored data cannot be decoded.
    #[error("{}: {problem}", path.display())]
    Data {
        /// Path of the file.
        path: PathBuf,
        /// The fault and its place.
        problem: String,
        /// Advice on how to go on.
        way_out: String,
    },
    /// A caller asks for pixels or bands that the cube does not have.
    #[error("{}: {asked} lie outside the cube of {has}", path.display())]
    Outside {
        /// Path of the cube.
        path: PathBuf,
        /// Rows, columns or wavelengths that were asked for.
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
    /// The error of reading `path`.
    pub(crate) fn reading(path: &Path, reason: io::Error) -> Self {
        Self::File(FileError::reading(path, reason))
    }

    /// The error of unpacking the file `path`.
    #[cfg(feature = "files")]
    pub(crate) fn unpacking(path: &Path, reason: io::Error) -> Self {
        match reason.kind() {
            io::ErrorKind::UnexpectedEof => {
                Self::data(path, "ends before its data end", "copy or export the file again")
            }
            _ => Self::reading(path, reason),
        }
    }

    /// A file of a kind that is not read.
    pub(crate) fn format(
        path: &Path,
        problem: impl Into<String>,
        way_out: impl Into<String>,
    ) -> Self {
        Self::Format { path: path.to_owned(), problem: problem.into(), way_out: way_out.into() }
    }

    /// Data that cannot be decoded.
    pub(crate) fn data(
        path: &Path,
        problem: impl Into<String>,
        way_out: impl Into<String>,
    ) -> Self {
        Self::Data { path: path.to_owned(), problem: problem.into(), way_out: way_out.into() }
    }
}

impl Explain for CubeError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::File(error) => error.hint(),
            Self::Format { way_out, .. }
            | Self::Key { way_out, .. }
            | Self::Unusable { way_out, .. }
            | Self::Reading { way_out, .. }
            | Self::Data { way_out, .. } => Some(Hint::new(way_out.clone())),
            Self::Size { .. } => Some(Hint::new(
                "correct samples, lines, bands, data type or header offset in the header, or copy the data file again",
            )),
            Self::NoReflectance { .. } => Some(Hint::new(
                "raw counts need [white_reading=FILE] and [dark_reading=FILE]; reflectances times a factor need [scale=10000] with that factor",
            )),
            Self::Outside { .. } => Some(Hint::new("name rows, columns and wavelengths inside it")),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            Self::Outside { .. } => Fault::Setting,
            _ => Fault::Input,
        }
    }
}
