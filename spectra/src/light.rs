//! Lights as text.

use std::path::Path;

use crate::black_body::black_body;
use crate::daylight::daylight;
use crate::file::FileError;
use crate::hint::{Explain, Fault, Hint};
use crate::illuminant::{Illuminant, IlluminantError};
use crate::instrument::{bytes_of, split_file_and_name, split_file_and_sheet};
use crate::lamp::{LampError, lamp_from_bytes};

/// Returns the light that `text` names.
///
/// | text | light |
/// |---|---|
/// | `D65`, `FL11`, `LED-B3` .. | a CIE illuminant, [`Illuminant::named`] |
/// | `5600K` | a black body, [`black_body`] |
/// | `D5600K` | CIE daylight, [`daylight`] |
/// | `FILE`, `FILE#NAME` | a file of an instrument, [`lamp_from_bytes`] |
///
/// # Errors
/// [`LightError`] if `text` is none of these, or the file is faulty.
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
    let (file, spectrum) = split_file_and_name(text);
    if !Path::new(split_file_and_sheet(file).0).is_file() {
        return Err(LightError::Unknown { text: text.to_owned() });
    }
    Ok(lamp_from_bytes(file, &bytes_of(file)?, spectrum)?)
}

/// A text that does not name a light.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LightError {
    /// The text is neither a name, a temperature nor the path of a file.
    #[error("neither a CIE illuminant, a temperature nor a file of a lamp: `{text}`")]
    Unknown {
        /// The text that was given.
        text: String,
    },
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file of the lamp is faulty.
    #[error(transparent)]
    Lamp(#[from] LampError),
    /// The temperature is outside the defined range.
    #[error(transparent)]
    Illuminant(#[from] IlluminantError),
}

impl Explain for LightError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Unknown { .. } => Some(Hint::new(
                "use a name such as D65, A, FL11 or LED-B3, a black body as 5600K, daylight as D5600K (4000 to 25000), or the path of a lamp's file (an instrument's, or two columns `nm,power`)",
            )),
            Self::Illuminant(error) => error.hint(),
            Self::Lamp(error) => error.hint(),
            Self::File(error) => error.hint(),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            Self::Lamp(error) => error.fault(),
            Self::Unknown { .. } | Self::Illuminant(_) => Fault::Setting,
        }
    }
}
