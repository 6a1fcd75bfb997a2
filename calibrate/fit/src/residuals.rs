//! Errors of a library's predictions for mixtures that its fit had not seen, and their JSON file.

use std::collections::BTreeMap;
use std::path::Path;

use documents::file::{FileError, read, write_whole};
use documents::hint::Explain;
use pigment::digits::rounded;
use pigment::fit_settings::FitSettings;
use pigment::library::{Input, to_text};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use spectra::optics::Surface;
use spectra::{Extrapolation, Grid, Interpolation, Reflectance, Spectrum};

const FORMAT: &str = "impasto-residuals";
const VERSION: u64 = 1;
/// Output of `impasto validate` for the measurements from which the shipped library was fitted.
const VAN_GOGH_OILS: &str = include_str!("../../../measurements/van-gogh-oils.residuals.json");

/// A measured mixture, and its prediction by a fit of the other samples. Both are films that hide.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeftOutMixture {
    /// Name of the sample.
    pub sample: String,
    /// Pigments with their shares, sum 1.
    pub shares: BTreeMap<String, f64>,
    /// Measured reflectance at each wavelength, 0 to 1.
    pub measured: Vec<f64>,
    /// Predicted reflectance at each wavelength, 0 to 1.
    pub predicted: Vec<f64>,
}

/// Measured and predicted reflectances of mixtures that we left out of a fit in turn. They show how
/// far a library's predictions of mixtures err.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Residuals {
    /// Wavelengths of all spectra.
    pub grid: Grid,
    /// Surface of the films (Saunderson correction).
    pub saunderson: Surface,
    /// Settings of the fits.
    pub settings: FitSettings,
    /// Number of groups that were left out in turn, or `None` for each mixture by itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub folds: Option<usize>,
    /// Files of the measurements.
    #[serde(default)]
    pub inputs: Vec<Input>,
    /// The mixtures, in order of the files.
    pub mixtures: Vec<LeftOutMixture>,
}

impl Residuals {
    /// Errors of the predictions of the Van Gogh oils, for mixtures left out one by one.
    ///
    /// # Panics
    /// Never: a test reads the file that is compiled in.
    #[must_use]
    pub fn van_gogh_oils() -> Self {
        Self::from_json("van-gogh-oils.residuals.json", VAN_GOGH_OILS)
            .expect("the shipped residuals are valid")
    }

    /// Copy with all numbers rounded to six significant digits, as the file has them.
    #[must_use]
    pub fn rounded(mut self) -> Self {
        for mixture in &mut self.mixtures {
            let lists = [&mut mixture.measured, &mut mixture.predicted];
            let values = lists.into_iter().flatten().chain(mixture.shares.values_mut());
            values.for_each(|value| *value = rounded(*value));
        }
        self
    }

    /// The residuals as JSON text. Equal residuals give equal bytes.
    ///
    /// # Panics
    /// Never: every value has a JSON form.
    #[must_use]
    pub fn to_json(&self) -> String {
        let mut file = Map::new();
        file.insert("format".into(), FORMAT.into());
        file.insert("version".into(), VERSION.into());
        let Value::Object(content) = serde_json::to_value(self).expect("residuals are JSON") else {
            unreachable!("a struct becomes an object")
        };
        file.extend(content);
        to_text(&Value::Object(file))
    }

    /// SHA-256 of [`Residuals::to_json`], in hexadecimal.
    #[must_use]
    pub fn sha256(&self) -> String {
        Input::new("", self.to_json().as_bytes()).sha256
    }

    /// Reads residuals from their JSON file.
    ///
    /// # Errors
    /// [`ResidualsError`] if the file cannot be read or holds no valid residuals.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, ResidualsError> {
        let path = path.as_ref();
        let bytes = read(path)?;
        Self::from_json(&path.display().to_string(), &String::from_utf8_lossy(&bytes))
    }

    /// Writes the residuals to a JSON file, completely or not at all.
    ///
    /// # Errors
    /// [`FileError`] if the file cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), FileError> {
        write_whole(path.as_ref(), self.to_json().as_bytes())
    }

    /// Reads residuals from `text`, the content of `file`. We use this name only in errors.
    ///
    /// # Errors
    /// [`ResidualsError`] if the text is not JSON, has another format or version, or values that no
    /// reflectance can have.
    pub fn from_json(file: &str, text: &str) -> Result<Self, ResidualsError> {
        let format = |found: String| ResidualsError::Format { file: file.to_owned(), found };
        let text = text.trim_start_matches('\u{feff}');
        if !text.trim_start().starts_with('{') {
            return Err(format("no JSON object".to_owned()));
        }
        let syntax = |error: serde_json::Error| ResidualsError::Syntax {
            file: file.to_owned(),
            reason: documents::plain_parser_message(&error.to_string()),
        };
        let mut value: Value = serde_json::from_str(text).map_err(syntax)?;
        let object = value.as_object_mut().ok_or_else(|| format("no object".to_owned()))?;
        match object.remove("format") {
            Some(Value::String(found)) if found == FORMAT => {}
            other => return Err(format(other.map_or("nothing".to_owned(), |v| v.to_string()))),
        }
        let version = object.remove("version").unwrap_or(Value::Null);
        if version != VERSION {
            return Err(ResidualsError::Version {
                file: file.to_owned(),
                found: version.to_string(),
                newest: VERSION,
            });
        }
        let residuals: Self = serde_json::from_value(value).map_err(syntax)?;
        residuals.checked(file)
    }

    fn checked(self, file: &str) -> Result<Self, ResidualsError> {
        for mixture in &self.mixtures {
            for (list, values) in
                [("measured", &mixture.measured), ("predicted", &mixture.predicted)]
            {
                let fault = |what: String| ResidualsError::Figures {
                    file: file.to_owned(),
                    sample: mixture.sample.clone(),
                    what,
                };
                if values.len() != self.grid.count() {
                    let wanted = documents::counted(self.grid.count(), "wavelength");
                    return Err(fault(format!(
                        "{list} has `{}` values for {wanted}",
                        values.len()
                    )));
                }
                if let Some(at) = values.iter().position(|v| !(0.0..=2.0).contains(v)) {
                    let nm = self.grid.nm(at);
                    let value = values[at];
                    return Err(fault(format!(
                        "{list} at {nm} nm must be a reflectance of 0 to 2, found `{value}`"
                    )));
                }
            }
        }
        Ok(self)
    }

    /// The residuals on the wavelengths `grid`, which lie within their own. We interpolate by Sprague's
    /// polynomial, or by straight lines where there are fewer than six wavelengths.
    ///
    /// # Errors
    /// [`ResidualsError::Wavelengths`] if `grid` reaches beyond their own wavelengths.
    pub fn on_grid(&self, grid: Grid) -> Result<Self, ResidualsError> {
        if grid == self.grid {
            return Ok(self.clone());
        }
        let method = Interpolation::best_for(self.grid);
        let resampled = |values: &[f64]| -> Option<Vec<f64>> {
            let spectrum = Spectrum::<Reflectance>::new(self.grid, values.to_vec()).ok()?;
            Some(spectrum.resampled(grid, method, Extrapolation::Refuse).ok()?.into_values())
        };
        let mixtures = self.mixtures.iter().map(|mixture: &LeftOutMixture| {
            Some(LeftOutMixture {
                measured: resampled(&mixture.measured)?,
                predicted: resampled(&mixture.predicted)?,
                ..mixture.clone()
            })
        });
        let mixtures: Option<Vec<LeftOutMixture>> = mixtures.collect();
        let outside = ResidualsError::Wavelengths { found: self.grid, needed: grid };
        let mixtures = mixtures.ok_or(outside)?;
        Ok(Self { grid, mixtures, ..self.clone() })
    }
}

/// A file that holds no residuals, or residuals that do not suit a library.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum ResidualsError {
    /// The file could not be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text is not JSON, or its keys are not the keys of residuals.
    #[error("{file}: {reason}")]
    #[hint("`impasto validate READINGS.csv [residuals=FILE.json]` makes them")]
    Syntax {
        /// File name as the caller gave it.
        file: String,
        /// Message of the JSON parser.
        reason: String,
    },
    /// The key `format` does not name residuals.
    #[error("{file}: `format` must be \"impasto-residuals\", found `{found}`")]
    #[hint("`impasto validate READINGS.csv [residuals=FILE.json]` makes them")]
    Format {
        /// File name as the caller gave it.
        file: String,
        /// Value of the key `format`, or what the file begins with.
        found: String,
    },
    /// The file's version is newer than this program.
    #[error("{file}: this program reads residuals up to version {newest}, found `{found}`")]
    #[hint("a newer impasto may read it")]
    Version {
        /// File name as the caller gave it.
        file: String,
        /// Version of the file.
        found: String,
        /// Newest version that can be read.
        newest: u64,
    },
    /// A value is impossible, or values are missing.
    #[error("{file}: sample {sample}: {what}")]
    Figures {
        /// File name as the caller gave it.
        file: String,
        /// Name of the sample.
        sample: String,
        /// Description of the fault.
        what: String,
    },
    /// The residuals do not cover the library's wavelengths.
    #[error("the residuals have the wavelengths {found}, the library needs {needed}")]
    #[hint(
        "take the residuals of the readings from which the library was fitted, or state [model_error=0.1]"
    )]
    Wavelengths {
        /// Wavelengths of the residuals.
        found: Grid,
        /// Wavelengths of the library.
        needed: Grid,
    },
    /// Too few mixtures were left out.
    #[error("the residuals hold `{found}` mixtures, {least} are needed to tell how a library errs")]
    #[hint("validate readings of more mixtures, or state [model_error=0.1]")]
    Few {
        /// Number of mixtures.
        found: usize,
        /// Least number that is needed.
        least: usize,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
    use documents::hint::Explain;

    #[test]
    fn the_shipped_residuals_survive_their_file() {
        let oils = Residuals::van_gogh_oils();
        assert_eq!(oils.mixtures.len(), 65, "binary mixtures");
        assert_eq!(oils.to_json(), VAN_GOGH_OILS);
        assert_eq!(oils.sha256(), Input::new("", VAN_GOGH_OILS.as_bytes()).sha256);
        assert_eq!(oils.clone().rounded(), oils);
    }

    #[test]
    fn all_numbers_are_rounded_to_six_digits() {
        let mut residuals = Residuals::van_gogh_oils();
        let mixture = &mut residuals.mixtures[0];
        mixture.shares.values_mut().for_each(|share| *share = 1.0 / 3.0);
        mixture.measured[0] = 0.123_456_789;
        mixture.predicted[0] = 2.0 / 3.0;
        let rounded = residuals.rounded();
        let mixture = &rounded.mixtures[0];
        assert!(mixture.shares.values().all(|share| *share == 0.333_333), "{:?}", mixture.shares);
        assert_eq!((mixture.measured[0], mixture.predicted[0]), (0.123_457, 0.666_667));
    }

    #[test]
    fn files_that_hold_no_residuals_are_refused_with_their_name() {
        let text = VAN_GOGH_OILS;
        let first = Residuals::van_gogh_oils().mixtures[0].measured[0].to_string();
        for (broken, expected) in [
            (text.replacen("impasto-residuals", "impasto-pigment-library", 1), "`format`"),
            (text.replacen("\"version\": 1", "\"version\": 2", 1), "version 1"),
            (text.replacen(&format!("[{first},"), "[", 1), "`30` values"),
            (text.replacen(&format!("[{first},"), "[-0.1,", 1), "400 nm"),
            (text.replacen("\"mixtures\"", "\"mixture\"", 1), "mixture"),
            (text[..200].to_owned(), "a.json"),
            ("sample,400".to_owned(), "no JSON"),
        ] {
            let error = Residuals::from_json("a.json", &broken).unwrap_err();
            let words = error.to_string();
            assert!(words.starts_with("a.json") && words.contains(expected), "{words}");
        }
        let error = Residuals::from_json("a.json", "[]").unwrap_err();
        assert!(error.hint().is_some(), "a way out");
    }

    #[test]
    fn other_wavelengths_are_interpolated_within_the_own_ones() {
        let oils = Residuals::van_gogh_oils();
        let fine = oils.on_grid(Grid::from_range(420.0, 680.0, 5.0).unwrap()).unwrap();
        for (coarse, fine) in oils.mixtures.iter().zip(&fine.mixtures) {
            assert!((coarse.measured[5] - fine.measured[6]).abs() < 1e-12, "at 450 nm");
            let middle = f64::midpoint(coarse.predicted[5], coarse.predicted[6]);
            assert!((middle - fine.predicted[7]).abs() < 0.03, "at 455 nm");
        }
        let wide = Grid::from_range(380.0, 700.0, 10.0).unwrap();
        let error = oils.on_grid(wide).unwrap_err();
        assert!(matches!(error, ResidualsError::Wavelengths { .. }), "{error}");
        assert!(error.to_string().contains("380") && error.hint().is_some(), "{error}");
    }
}
