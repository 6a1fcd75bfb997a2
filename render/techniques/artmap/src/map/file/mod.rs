//! Files of art maps: OpenEXR, format `impasto-artmap`, version 1.
//!
//! One file has a part per key tile, `key.000`, `key.001` .. from dark to light, with scan lines
//! of 32-bit float channels, so that any program that reads OpenEXR shows them. Tiles are squares
//! of one size.
//!
//! | channels | content |
//! | --- | --- |
//! | `R`, `G`, `B` | colour of a level surface, linear sRGB |
//! | `height` | height over the ground in mm; left out without relief |
//! | one per pigment, `vehicle` | paint in mm; left out without pigments |
//! | `source.x`, `source.y` | column and row of the sample that the texel shows, 0 to 65534 |
//!
//! Attribute `impasto` of the first part is JSON in ASCII: format and version, provenance, size and
//! spacing of the tiles, their names and tones, the settings of the synthesis, the channel of each
//! pigment, and the pigment library. OpenEXR has no check sums, so the description has a SHA-256
//! digest of every part and of itself (with the text of `digest` left empty): a damaged file is
//! refused. Everything comes back bit for bit.

mod header;
mod planes;
mod read;
mod write;

#[cfg(test)]
mod tests;

pub use read::read;
pub use write::write;

use std::path::Path;

use super::art_map::ArtMap;
use crate::texel_file::TexelFileError;

impl ArtMap {
    /// Reads a map from its file (OpenEXR, see [`crate::map::file`]).
    ///
    /// # Errors
    /// [`TexelFileError`] if the file cannot be read or holds no valid map.
    pub fn open(path: &Path) -> Result<Self, TexelFileError> {
        read(&path.display().to_string(), &documents::file::read(path)?)
    }

    /// Writes the map to a file (OpenEXR, see [`crate::map::file`]), which is replaced as a whole
    /// or not at all.
    ///
    /// # Errors
    /// [`TexelFileError`] if the map is inconsistent or the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), TexelFileError> {
        Ok(documents::file::write_whole(path, &write(self)?)?)
    }
}
