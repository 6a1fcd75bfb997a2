//! The library as a JSON file.

use serde_json::{Map, Value};

use super::json::to_text;
use super::pigment_library::PigmentLibrary;

const FORMAT: &str = "impasto-pigment-library";
const VERSION: u64 = 1;

impl PigmentLibrary {
    /// The library as JSON text; the same library gives the same bytes.
    ///
    /// # Panics
    /// Never: a library holds only what JSON can say.
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

    /// The library in `text`, the content of `file`.
    ///
    /// # Errors
    /// [`LibraryError`]: no JSON, another format, a newer version, an unknown or
    /// missing key, or figures that are no K and S.
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
            reason: error.to_string(),
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
        // Older versions will be upgraded here, one step each.
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
                return Err(fault(name, "the name stands twice".into()));
            }
            let curves = [
                ("absorption", &pigment.absorption, false),
                ("scattering", &pigment.scattering, false),
                ("absorption_sd", &pigment.absorption_sd, true),
                ("scattering_sd", &pigment.scattering_sd, true),
            ];
            for (curve, values, may_lack) in curves {
                if values.len() != self.grid.count() && !(may_lack && values.is_empty()) {
                    let (wanted, found) = (self.grid.count(), values.len());
                    return Err(fault(
                        name,
                        format!("{curve} has `{found}` values for {wanted} wavelengths"),
                    ));
                }
                if let Some(at) = values.iter().position(|v| !(v.is_finite() && *v >= 0.0)) {
                    let (nm, value) = (self.grid.nm(at), values[at]);
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

/// Why a file is no library.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LibraryError {
    /// No JSON, or keys that do not fit.
    #[error("{file}: {reason}")]
    Syntax {
        /// The file.
        file: String,
        /// What the parser said.
        reason: String,
    },
    /// Another kind of file.
    #[error("{file}: `format` must be \"impasto-pigment-library\", found `{found}`")]
    Format {
        /// The file.
        file: String,
        /// What stands there.
        found: String,
    },
    /// Another version.
    #[error("{file}: this program reads pigment libraries up to version {newest}, found `{found}`")]
    Version {
        /// The file.
        file: String,
        /// Its version.
        found: String,
        /// The newest known.
        newest: u64,
    },
    /// Figures that cannot be.
    #[error("{file}: pigment {pigment}: {what}")]
    Figures {
        /// The file.
        file: String,
        /// The pigment.
        pigment: String,
        /// What is wrong.
        what: String,
    },
}

impl LibraryError {
    /// What to try, where there is something.
    #[must_use]
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::Format { .. } => {
                Some("`impasto fit READINGS.csv --output LIBRARY.json` makes a pigment library")
            }
            Self::Version { .. } => Some("a newer impasto may read it"),
            _ => None,
        }
    }
}
