//! A light as a user writes it.

use std::path::Path;

use crate::black_body::black_body;
use crate::daylight::daylight;
use crate::illuminant::{Illuminant, IlluminantError};
use crate::lamp::{LampError, lamp_from_bytes};

/// The light that `text` names.
///
/// | text | light |
/// |---|---|
/// | `D65`, `FL11`, `LED-B3` .. | a CIE illuminant, [`Illuminant::named`] |
/// | `5600K` | a black body, [`black_body`] |
/// | `D5600K` | CIE daylight, [`daylight`] |
/// | `FILE`, `FILE#NAME` | a file of an instrument, [`lamp_from_bytes`] |
///
/// # Errors
/// [`LightError`].
///
/// ```
/// let bulb = spectra::light_from_text("5600K").unwrap();
/// assert_eq!(bulb.name(), "black body 5600 K");
/// ```
pub fn light_from_text(text: &str) -> Result<Illuminant, LightError> {
    if let Ok(known) = Illuminant::named(text) {
        return Ok(known);
    }
    if let Some(number) = text.strip_suffix(['K', 'k']) {
        if let Ok(kelvin) = number.parse() {
            return Ok(black_body(kelvin)?);
        }
        if let Some(Ok(kelvin)) = number.strip_prefix(['D', 'd']).map(str::parse) {
            return Ok(daylight(kelvin)?);
        }
    }
    // A whole name that is a file wins over the part before a `#`.
    let (file, spectrum) = match text.rsplit_once('#') {
        Some((file, spectrum)) if !Path::new(text).is_file() => (file, Some(spectrum)),
        _ => (text, None),
    };
    if !Path::new(file).is_file() {
        return Err(LightError::Unknown { text: text.to_owned() });
    }
    let bytes = std::fs::read(file)
        .map_err(|error| LightError::Read { path: file.to_owned(), reason: error.to_string() })?;
    Ok(lamp_from_bytes(file, &bytes, spectrum)?)
}

/// Why a text names no light.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LightError {
    /// Neither a name, a temperature nor a file.
    #[error("neither a CIE illuminant, a temperature nor a file of a lamp: `{text}`")]
    Unknown {
        /// The text.
        text: String,
    },
    /// The file cannot be read.
    #[error("{path}: {reason}")]
    Read {
        /// The file.
        path: String,
        /// What the system said.
        reason: String,
    },
    /// The lamp's file is faulty.
    #[error(transparent)]
    Lamp(#[from] LampError),
    /// The temperature gives no light.
    #[error(transparent)]
    Illuminant(#[from] IlluminantError),
}

impl LightError {
    /// What to try instead.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        let fixed = match self {
            Self::Unknown { .. } => {
                "use a name such as D65, A, FL11 or LED-B3, a black body as 5600K, daylight as D5600K (4000 to 25000), or the path of a lamp's file (an instrument's, or two columns `nm,power`)"
            }
            Self::Illuminant(_) => {
                "daylight is defined from D4000K to D25000K, a black body from 500K"
            }
            Self::Lamp(error) => return error.hint(),
            Self::Read { .. } => return None,
        };
        Some(fixed.to_owned())
    }
}
