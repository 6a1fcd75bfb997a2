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
use crate::numbers::{ByteOrder, NumberType};
use spectra::WavelengthList;

/// The wavelengths of a file or a range, in nm.
pub(crate) fn wavelengths_of(path: &Path) -> Result<Vec<f64>, CubeError> {
    Ok(WavelengthList::named(&path.display().to_string())?.nm)
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
