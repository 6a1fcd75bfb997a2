//! Unpacked values of packed images, in a temporary file without a name.
//!
//! Packed images can only be read from their beginning, and a cube is read in any order. The file
//! vanishes with the program, however that ends.

use std::fs::File;
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::error::CubeError;
use super::positional::PositionalFile;
use super::raw_file::{Interleave, Layout, RawFile};
use crate::numbers::{ByteOrder, NumberType};

/// Order of the bytes of unpacked numbers.
const ORDER: ByteOrder =
    if cfg!(target_endian = "big") { ByteOrder::Big } else { ByteOrder::Little };

/// A temporary file that is filled with the numbers of a cube.
#[derive(Debug)]
pub(crate) struct Spool {
    file: File,
    /// End of the bytes written last, where the file stands.
    at: u64,
    folder: PathBuf,
    layout: Layout,
}

impl Spool {
    /// Creates the file in `folder`, or in the system's folder for temporary files. Its numbers have
    /// the byte order of this machine.
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

    /// Writes the bytes of numbers that lie one after another, from this number on.
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

    /// Ends writing. `path` is the name of the packed images in messages.
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
