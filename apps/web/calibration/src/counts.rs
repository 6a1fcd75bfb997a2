//! White, dark and tile. You need them to make reflectances of raw counts.

use std::path::Path;

use documents::file::disk;
use serde::Deserialize;
use spectra::referencing::{DarkFiles, ReferenceFiles, TileSource};

use crate::failure::{Result, setting};

/// Reflectance of the white: a number, or a file.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Tile {
    Fraction(f64),
    File(String),
}

/// References as the page passes them. A file is given by its name, and `#` with a name picks one
/// of its spectra.
#[derive(Debug, Deserialize)]
pub(crate) struct References {
    white: String,
    dark: Vec<String>,
    subtracted: bool,
    tile: Option<Tile>,
    full_scale: Option<f64>,
    least_light: Option<f64>,
}

impl References {
    /// The references as `calibrate` opens them.
    pub(crate) fn files(self) -> ReferenceFiles {
        let mut files = ReferenceFiles::new(self.white);
        files.dark =
            if self.subtracted { DarkFiles::Subtracted } else { DarkFiles::Files(self.dark) };
        files.tile = match self.tile {
            Some(Tile::Fraction(value)) => TileSource::Fraction(value),
            Some(Tile::File(file)) => TileSource::File(file),
            None => files.tile,
        };
        files.full_scale = self.full_scale;
        files.least_light = self.least_light.unwrap_or(files.least_light);
        files
    }
}

/// Files that we put on the disk in memory, and remove when this is dropped.
#[derive(Debug, Default)]
pub(crate) struct GivenFiles(Vec<String>);

impl GivenFiles {
    /// Puts the files of references where `calibrate` opens them by their names.
    pub(crate) fn put(files: Vec<(String, Vec<u8>)>) -> Result<Self> {
        let mut given = Self::default();
        for (name, bytes) in files {
            let known = disk::read(&name).ok();
            if known.is_some_and(|known| known != bytes) {
                let message = format!("two different files of references are called `{name}`");
                return Err(setting(&message, "give one of them another name"));
            }
            disk::write(Path::new(&name), bytes)
                .map_err(|error| setting(&format!("{name}: {error}"), "choose the file again"))?;
            given.0.push(name);
        }
        Ok(given)
    }
}

impl Drop for GivenFiles {
    fn drop(&mut self) {
        for name in &self.0 {
            // The same file may be there twice, and is gone already then.
            let _ = disk::remove_file(name);
        }
    }
}
