//! Files of samples: OpenEXR, format `impasto-samples`, version 1.
//!
//! One file has a part per sample, `sample.000`, `sample.001` .. in the order of the set, with scan
//! lines of 32-bit float channels, so that any program that reads OpenEXR shows them.
//!
//! | channels | content |
//! | --- | --- |
//! | `R`, `G`, `B` | colour of a level surface, linear sRGB |
//! | `mask` | 1 where a texel belongs to the sample, else 0 |
//! | `height` | height over the ground in mm; left out without relief |
//! | one per pigment, `vehicle` | paint in mm; left out without pigments |
//!
//! Attribute `impasto` of the first part is JSON in ASCII: format and version, provenance, names,
//! sizes and spacing of the samples, the channel of each pigment, and the pigment library.
//! Everything comes back bit for bit.

mod header;
mod planes;
mod read;
mod write;

pub use read::read;
pub use write::write;

use std::path::Path;

use super::passage::SampleSet;
use crate::texel_file::TexelFileError;

impl SampleSet {
    /// Reads samples from their file (OpenEXR, see [`crate::sample::file`]).
    ///
    /// # Errors
    /// [`TexelFileError`] if the file cannot be read or holds no valid samples.
    pub fn open(path: &Path) -> Result<Self, TexelFileError> {
        read(&path.display().to_string(), &documents::file::read(path)?)
    }

    /// Writes samples to a file (OpenEXR, see [`crate::sample::file`]), which is replaced as a
    /// whole or not at all.
    ///
    /// # Errors
    /// [`TexelFileError`] if the set is inconsistent or the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), TexelFileError> {
        Ok(documents::file::write_whole(path, &write(self)?)?)
    }
}

#[cfg(test)]
mod tests;
