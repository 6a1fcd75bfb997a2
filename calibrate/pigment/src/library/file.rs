//! Reading and writing the library as a JSON file.

use std::path::Path;

use documents::counted;
use documents::file::{FileError, read, write_whole};
use documents::hint::{Explain, Fault, Hint};
use serde_json::{Map, Value};

use super::json::to_text;
use super::pigment_library::PigmentLibrary;

const FORMAT: &str = "impasto-pigment-library";
const VERSION: u64 = 1;

impl PigmentLibrary {
    /// Reads a library from its JSON file.
    ///
    /// # Errors
    /// [`LibraryError`] if the file cannot be read or is not a valid library.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, LibraryError> {
        let path = path.as_ref();
        let bytes = read(path)?;
        Self::from_json(&path.display().to_string(), &String::from_utf8_lossy(&bytes))
    }

    /// Writes the library to a JSON file, completely or not at all.
    ///
    /// # Errors
    /// [`FileError`] if the file cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), FileError> {
        write_whole(path.as_ref(), self.to_json().as_bytes())
    }

    /// Writes the library as JSON text; equal libraries give equal bytes.
    ///
    /// # Panics
    /// Never: every value of a library has a JSON form.
    #[must_use]
    pub fn to_json(&self) -> String {
        let mut file = Map::new();
        file.insert("format".into(), FORMAT.into());
        file.insert("version".into(), VERSION.into());
        let Value::Object(content) = serde_json::to_value(self).expect("a library is JSON") else {
            unreachable!("a struct becomes an object")
        };
        file.extend(content);
        to_text(&Value::Object(file))
    }

    /// Reads the library from `text`, the content of `file`, which is only named in errors.
    ///
    /// # Errors
    /// [`LibraryError`] if the text is not JSON, has another format or version, an unknown or missing key, or
    /// values that no K and S can have.
    pub fn from_json(file: &str, text: &str) -> Result<Self, LibraryError> {
        let text = text.trim_start_matches('\u{feff}');
        if !text.trim_start().starts_with('{') {
            return Err(LibraryError::Format {
                file: file.to_owned(),
                found: "no JSON object".to_owned(),
            });
        }
        let syntax = |error: serde_json::Error| LibraryError::Syntax {
            file: file.to_owned(),
            reason: documents::plain_parser_message(&error.to_string()),
        };
        let mut value: Value = serde_json::from_str(text).map_err(syntax)?;
        let object = value.as_object_mut().ok_or_else(|| LibraryError::Format {
            file: file.to_owned(),
            found: "no object".to_owned(),
        })?;
        match object.remove("format") {
            Some(Value::String(format)) if format == FORMAT => {}
            other => {
                return Err(LibraryError::Format {
                    file: file.to_owned(),
                    found: other.map_or_else(|| "nothing".to_owned(), |v| v.to_string()),
                });
            }
        }
        let version = object.remove("version").unwrap_or(Value::Null);
        // Files of older versions will be upgraded here, one step each.
        if version != VERSION {
            return Err(LibraryError::Version {
                file: file.to_owned(),
                found: version.to_string(),
                newest: VERSION,
            });
        }
        let library: Self = serde_json::from_value(value).map_err(syntax)?;
        library.checked(file)
    }

    fn checked(self, file: &str) -> Result<Self, LibraryError> {
        let fault = |pigment: &str, what: String| LibraryError::Figures {
            file: file.to_owned(),
            pigment: pigment.to_owned(),
            what,
        };
        if self.pigments.is_empty() {
            return Err(fault("", "a library holds at least one pigment".into()));
        }
        if !(0.0..=2.0).contains(&self.unevenness) {
            let what = format!("unevenness is 0 to 2, found `{}`", self.unevenness);
            return Err(fault("", what));
        }
        if let Some(name) = &self.reference
            && self.pigments.iter().all(|pigment| pigment.name != *name)
        {
            return Err(fault(name, "the reference is not in the library".into()));
        }
        for (index, pigment) in self.pigments.iter().enumerate() {
            let name = pigment.name.as_str();
            if self.pigments[..index].iter().any(|other| other.name == name) {
                return Err(fault(name, "the name occurs twice".into()));
            }
            if let Some([least, most]) = pigment.measured_amounts
                && !(least > 0.0 && least <= most && most.is_finite())
            {
                let what =
                    format!("measured amounts rise from above 0, found `{least}` to `{most}`");
                return Err(fault(name, what));
            }
            let curves = [
                ("absorption", &pigment.absorption, false),
                ("scattering", &pigment.scattering, false),
                ("absorption_sd", &pigment.absorption_sd, true),
                ("scattering_sd", &pigment.scattering_sd, true),
            ];
            for (curve, values, may_lack) in curves {
                if values.len() != self.grid.count() && !(may_lack && values.is_empty()) {
                    let wanted = self.grid.count();
                    let found = values.len();
                    return Err(fault(
                        name,
                        format!(
                            "{curve} has `{found}` values for {}",
                            counted(wanted, "wavelength")
                        ),
                    ));
                }
                if let Some(at) = values.iter().position(|v| !(v.is_finite() && *v >= 0.0)) {
                    let nm = self.grid.nm(at);
                    let value = values[at];
                    return Err(fault(
                        name,
                        format!("{curve} at {nm} nm must be 0 and up, found `{value}`"),
                    ));
                }
            }
        }
        Ok(self)
    }
}

/// Why a file is not a valid pigment library.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LibraryError {
    /// The file could not be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text is not JSON, or its keys are not those of a library.
    #[error("{file}: {reason}")]
    Syntax {
        /// File name as the caller gave it.
        file: String,
        /// Message of the JSON parser.
        reason: String,
    },
    /// The key `format` does not name a pigment library.
    #[error("{file}: `format` must be \"impasto-pigment-library\", found `{found}`")]
    Format {
        /// File name as the caller gave it.
        file: String,
        /// Value of the key `format`, or what the file begins with.
        found: String,
    },
    /// The file's version is newer than this program.
    #[error("{file}: this program reads pigment libraries up to version {newest}, found `{found}`")]
    Version {
        /// File name as the caller gave it.
        file: String,
        /// Version of the file.
        found: String,
        /// Newest version that can be read.
        newest: u64,
    },
    /// A value is impossible, or values are missing.
    #[error("{file}: pigment {pigment}: {what}")]
    Figures {
        /// File name as the caller gave it.
        file: String,
        /// Name of the pigment; empty where the fault is the library's.
        pigment: String,
        /// Description of the fault.
        what: String,
    },
}

impl Explain for LibraryError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::File(error) => error.hint(),
            Self::Format { .. } => Some(Hint::new(
                "`impasto fit READINGS.csv [output=LIBRARY.json]` makes a pigment library",
            )),
            Self::Version { .. } => Some(Hint::new("a newer impasto may read it")),
            Self::Syntax { .. } | Self::Figures { .. } => None,
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            _ => Fault::Input,
        }
    }
}
