//! The library of a script, and the light on its pigments.

use std::path::{Path, PathBuf};

use pigment::PigmentLibrary;
use pigment::library::LibraryError;
use spectra::{Illuminant, light_from_text};

use super::file::Script;
use crate::toml_text::{Checked, Fault, KeyPath};

/// Longest path of a library, in bytes.
const LONGEST: usize = 1024;

/// Whether a script may name this light: an illuminant or a temperature. Files of lamps, which
/// [`light_from_text`] reads as well, are not for scripts of others.
#[must_use]
pub fn is_light(text: &str) -> bool {
    let kelvin = text.strip_suffix(['K', 'k']).map(|number| {
        let number = number.strip_prefix(['D', 'd']).unwrap_or(number);
        number.parse::<f64>().is_ok()
    });
    (Illuminant::named(text).is_ok() || kelvin == Some(true)) && light_from_text(text).is_ok()
}

impl Script {
    /// The library that the script names; none if it names none. A path starts from `folder`, the
    /// folder of the script.
    ///
    /// # Errors
    /// [`LibraryError`] if its file is missing, or is no library.
    pub fn open_library(&self, folder: &Path) -> Result<Option<PigmentLibrary>, LibraryError> {
        match self.library_file(folder) {
            Some(file) => PigmentLibrary::open(file).map(Some),
            None => Ok(self.library.as_ref().map(|_| PigmentLibrary::van_gogh_oils())),
        }
    }

    /// The file of the library that the script names; none if it names none, or the oils that ship.
    #[must_use]
    pub fn library_file(&self, folder: &Path) -> Option<PathBuf> {
        let name = self.library.as_ref()?;
        (*name != PigmentLibrary::van_gogh_oils().title).then(|| folder.join(name))
    }

    /// Checks the name of the library and the light.
    pub(super) fn check_materials(&self) -> Checked {
        let (library, light) = (self.library.as_deref(), self.illuminant.as_deref());
        let fits =
            |path: &str| (1..=LONGEST).contains(&path.len()) && !path.contains(char::is_control);
        if let Some(path) = library.filter(|path| !fits(path)) {
            let wanted = format!("a path of 1 to {LONGEST} bytes without control characters");
            let hint = "name the file of a pigment library, or leave it out";
            return Err(Fault::new(&KeyPath::of("library"), wanted, path.escape_debug(), hint));
        }
        if let Some(light) = light.filter(|light| !is_light(light)) {
            let wanted = "the name of an illuminant, or a temperature";
            let hint = "D65, A, FL11, LED-B3 and 5600K are lights";
            let key = KeyPath::of("illuminant");
            return Err(Fault::new(&key, wanted, light.escape_debug(), hint));
        }
        Ok(())
    }
}
