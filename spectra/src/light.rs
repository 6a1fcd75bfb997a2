//! Lights as text.

use std::path::Path;

use crate::black_body::black_body;
use crate::daylight::daylight;
use crate::illuminant::{Illuminant, IlluminantError};
use crate::instrument::{bytes_of, split_file_and_name, split_file_and_sheet};
use crate::lamp::{LampError, lamp_from_bytes};
use documents::file::{self, FileError};
use documents::hint::{Explain, Fault, Hint};

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
    if !file::is_there(Path::new(split_file_and_sheet(file).0)) {
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

/// Names of lights that trade and older tables use, with those of the CIE or temperatures. TL84, TL83,
/// CWF and the like are lamps of viewing booths; the lamp U35 has 3500 K, between FL12 and FL11.
const OTHER_NAMES: [(&str, &str); 15] = [
    ("TL84", "FL11"),
    ("TL83", "FL12"),
    ("TL85", "FL10"),
    ("U30", "FL12"),
    ("U40", "FL11"),
    ("U50", "FL10"),
    ("CWF", "FL2"),
    ("WWF", "FL4"),
    ("INCA", "A"),
    ("INC", "A"),
    ("TUNGSTEN", "A"),
    ("DAYLIGHT", "D65"),
    ("HORIZON", "2300K"),
    ("LED", "LED-B3"),
    ("CIE A", "A"),
];

/// A question after the light that `text` may mean, with a space behind it, or nothing.
fn did_you_mean(text: &str) -> String {
    let letters = text.trim().to_uppercase();
    if let Ok(kelvin) = text.trim().parse::<f64>()
        && (500.0..=25_000.0).contains(&kelvin)
    {
        let daylight = if kelvin >= 4000.0 { format!(" or D{kelvin}K") } else { String::new() };
        let d65 = if kelvin == 6500.0 { " or D65" } else { "" };
        return format!("did you mean {kelvin}K{daylight}{d65}? ");
    }
    let known = OTHER_NAMES.iter().find(|(other, _)| *other == letters);
    // A path is no name.
    let is_name = !text.contains(['/', '\\', '.', '#']);
    // F1 to F12 are FL1 to FL12 since CIE 15:2018.
    let fluorescent = letters.strip_prefix('F').map(|number| format!("FL{number}"));
    let fluorescent = fluorescent.filter(|name| Illuminant::names().any(|known| known == name));
    let question = match known {
        _ if fluorescent.is_some() => fluorescent.map(|name| format!("did you mean {name}?")),
        Some((_, name)) => Some(format!("did you mean {name}?")),
        None if is_name => documents::did_you_mean(text, Illuminant::names()),
        None => None,
    };
    question.map_or_else(String::new, |question| question + " ")
}

impl Explain for LightError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Unknown { text } => Some(Hint::verbatim(
                did_you_mean(text)
                    + "use a name such as D65, A, FL11 or LED-B3, a black body as 5600K, daylight as D5600K (4000 to 25000), or the path of a lamp's file (an instrument's, or two columns `nm,power`)",
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_trade_and_bare_temperatures_are_understood() {
        let question = |text: &str| light_from_text(text).unwrap_err().hint().unwrap().to_string();
        for (text, wanted) in [
            ("F11", "did you mean FL11? use"),
            ("TL84", "did you mean FL11? use"),
            ("cwf", "did you mean FL2? use"),
            ("LED-C3", "did you mean LED-B3 or "),
            ("6500", "did you mean 6500K or D6500K or D65? use"),
            ("5000", "did you mean 5000K or D5000K? use"),
            ("3000", "did you mean 3000K? use"),
            // Neither temperatures of lights nor names.
            ("400", "use a name"),
            ("30000", "use a name"),
            ("no/such/lamp.csv", "use a name"),
            ("./LED-B3", "use a name"),
        ] {
            assert!(question(text).starts_with(wanted), "{text}: {}", question(text));
        }
        // There is no FL13.
        assert!(!question("F13").contains("FL13"), "{}", question("F13"));
        for (other, name) in OTHER_NAMES {
            assert!(light_from_text(name).is_ok(), "{name}");
            assert!(question(other).starts_with(&format!("did you mean {name}? ")), "{other}");
        }
    }
}
