//! The library of a script, the ground under its pigments, and the light on them.

use std::path::{Path, PathBuf};

use documents::hint::Explain;
use paint::ground::{GroundKind, GroundRelief, GroundSpec, Primer};
use pigment::PigmentLibrary;
use pigment::library::LibraryError;
use spectra::{Illuminant, light_from_text};

use super::file::Script;
use crate::toml_text::{Checked, Fault, KeyPath};

/// Longest path of a library or a lamp, in bytes.
const LONGEST: usize = 1024;

/// Width of the cells of a ground that is made to try it, in mm.
const TRIED_MM: f64 = 0.2;

/// Whether a text is a light by its name: an illuminant or a temperature. [`light_from_text`] reads
/// files of lamps as well, which a script names by another key.
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

    /// The light on pigments as [`light_from_text`] takes it; none for D65. The file of a lamp starts
    /// from `folder`, the folder of the script.
    #[must_use]
    pub fn light(&self, folder: &Path) -> Option<String> {
        let lamp = self.lamp.as_ref().map(|lamp| folder.join(lamp).to_string_lossy().into_owned());
        lamp.or_else(|| self.illuminant.clone())
    }

    /// The ground under pigments of `library`.
    ///
    /// # Errors
    /// [`Fault`] of a ground that cannot be made, such as one of a colour that is none.
    /// [`super::ScriptError::located`] adds its line.
    pub fn ground_under(&self, library: &PigmentLibrary) -> Result<GroundSpec, Box<Fault>> {
        let Some(ground) = &self.ground else { return Ok(GroundKind::Panel.spec(1)) };
        match ground.build(1, 1, TRIED_MM, library) {
            Ok(_) => Ok(ground.clone()),
            Err(error) => {
                let hint = error.hint().map_or_else(
                    || "leave it out for a white panel".to_owned(),
                    |hint| hint.to_string(),
                );
                let wanted = "a ground that can be made";
                Err(Fault::new(&KeyPath::of("ground"), wanted, error, hint))
            }
        }
    }

    /// Checks the names of library and light, and the ground.
    pub(super) fn check_materials(&self) -> Checked {
        let light = self.illuminant.as_deref();
        let fits =
            |path: &str| (1..=LONGEST).contains(&path.len()) && !path.contains(char::is_control);
        for (key, path, hint) in [
            ("library", &self.library, "name the file of a pigment library, or leave it out"),
            ("lamp", &self.lamp, "name the file of a lamp's spectrum, or leave it out"),
        ] {
            if let Some(path) = path.as_deref().filter(|path| !fits(path)) {
                let wanted = format!("a path of 1 to {LONGEST} bytes without control characters");
                return Err(Fault::new(&KeyPath::of(key), wanted, path.escape_debug(), hint));
            }
        }
        if let (Some(lamp), Some(_)) = (&self.lamp, light) {
            let hint = "leave illuminant or lamp out";
            return Err(Fault::new(&KeyPath::of("lamp"), "a light given once", lamp, hint));
        }
        let relief = self.ground.as_ref().map(|ground| &ground.relief);
        let other = match relief {
            Some(GroundRelief::Wood(_)) => Some("wood"),
            Some(GroundRelief::Image(_)) => Some("image"),
            _ => None,
        };
        let table = KeyPath::of("ground");
        if let Some(other) = other {
            let hint = "kind = \"panel\" is nearly flat";
            return Err(Fault::new(&table.key("kind"), "linen, paper or panel", other, hint));
        }
        let reflectance = self.ground.as_ref().and_then(|ground| ground.reflectance.as_ref());
        match reflectance {
            Some(Primer::Grey(own)) if !(0.0..=1.0).contains(own) => {
                let hint = "leave it out for the white of the library";
                return Err(Fault::new(&table.key("reflectance"), "0 to 1", own, hint));
            }
            _ => {}
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
