//! Options of reading a scan, which every program fills in its own way.
//!
//! Comments of the fields are the help texts of the command line and the descriptions of the schema.

use std::path::{Path, PathBuf};

use documents::request::{RequestError, from_text};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::error::CubeError;

/// Scale of the values of a cube. In JSON it is `file`, `fraction`, `percent`, or the number that a white reads.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum CubeScale {
    /// The file states the scale. If it does not, values up to 2 are fractions and values up to 200
    /// percent, unless they are integers.
    #[default]
    ByFile,
    /// A white reads about 1.
    Fraction,
    /// A white reads about 100.
    Percent,
    /// A white reads about this number.
    White(f64),
}

impl Serialize for CubeScale {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::ByFile => serializer.serialize_str("file"),
            Self::Fraction => serializer.serialize_str("fraction"),
            Self::Percent => serializer.serialize_str("percent"),
            Self::White(white) => serializer.serialize_f64(*white),
        }
    }
}

impl<'de> Deserialize<'de> for CubeScale {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        from_text(deserializer, |text| match text {
            "file" => Ok(Self::ByFile),
            "fraction" => Ok(Self::Fraction),
            "percent" => Ok(Self::Percent),
            text => text.parse().map(Self::White).map_err(|_| {
                let wanted = "file, fraction, percent or the number that a white reads";
                let reason = format!("takes {wanted}, found `{text}`");
                RequestError::value(reason, "try [scale=percent]")
            }),
        })
    }
}

/// Dark reading of a camera. In JSON it is the path of a scan, or 0 if it is subtracted already.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum DarkReading {
    /// There is no dark reading.
    #[default]
    Missing,
    /// The camera's program has already subtracted it.
    Subtracted,
    /// A scan with the shutter closed, at the settings of the scan.
    File(PathBuf),
}

impl Serialize for DarkReading {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Missing => serializer.serialize_none(),
            Self::Subtracted => serializer.serialize_str("0"),
            Self::File(path) => path.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for DarkReading {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        from_text(deserializer, |text| {
            Ok(match text {
                "0" => Self::Subtracted,
                path => Self::File(path.into()),
            })
        })
    }
}

/// Options of reading a scan. [`Cube::open_with`](super::Cube::open_with) reads it.
///
/// ```
/// use documents::request::request_from_json;
/// use maps::cube::{CubeOptions, CubeScale};
///
/// let options: CubeOptions = request_from_json(r#"{"scale": "percent", "full_scale": 4095}"#)?;
/// assert_eq!((options.scale, options.full_scale), (CubeScale::Percent, Some(4095.0)));
/// # Ok::<(), documents::request::RequestError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(description = "Options of reading a scan")]
pub struct CubeOptions {
    /// A scan of a white, for scans of raw counts
    #[schemars(with = "Option<String>")]
    pub white_reading: Option<PathBuf>,
    /// A scan with the shutter closed; 0 if it is subtracted already
    #[schemars(schema_with = "dark_reading_schema")]
    pub dark_reading: DarkReading,
    /// The white's own reflectance [default: 1]
    pub tile: f64,
    /// Scale of the values: fraction, percent, or the number that a white reads [default: file, which
    /// means as the file states it]
    #[schemars(schema_with = "scale_schema")]
    pub scale: CubeScale,
    /// Largest count of the detector, such as 4095 [default: guessed]
    pub full_scale: Option<f64>,
    /// Wavelengths of the bands, for scans that name none: a file, one a line, or 380..730:10
    #[schemars(with = "Option<String>")]
    pub wavelengths: Option<PathBuf>,
    /// Name of the array of a Zarr group that holds several
    pub variable: Option<String>,
    /// Folder for the unpacked values of packed images [default: the system's folder for temporary
    /// files]
    #[schemars(with = "Option<String>")]
    pub scratch: Option<PathBuf>,
}

fn dark_reading_schema(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": ["string", "null"] })
}

fn scale_schema(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "anyOf": [
            { "type": "string", "enum": ["file", "fraction", "percent"] },
            { "type": "number", "exclusiveMinimum": 0 },
        ]
    })
}

impl Default for CubeOptions {
    fn default() -> Self {
        Self {
            white_reading: None,
            dark_reading: DarkReading::Missing,
            tile: 1.0,
            scale: CubeScale::ByFile,
            full_scale: None,
            wavelengths: None,
            variable: None,
            scratch: None,
        }
    }
}

impl CubeOptions {
    /// Checks the range of every number. Messages call the scan `path`.
    pub(crate) fn check(&self, path: &Path) -> Result<(), CubeError> {
        if !(self.tile > 0.0 && self.tile <= 1.2) {
            let problem = format!(
                "the white's reflectance must be above 0 and at most 1.2, found `{}`",
                self.tile
            );
            return Err(CubeError::format(path, problem, "give a fraction, such as [tile=0.99]"));
        }
        let scale = match self.scale {
            CubeScale::White(white) => Some(white),
            _ => None,
        };
        for (name, number) in [("scale", scale), ("full_scale", self.full_scale)] {
            if let Some(found) = number.filter(|number| !(number.is_finite() && *number > 0.0)) {
                let problem =
                    format!("the setting `{name}` must be above 0 and finite, found `{found}`");
                let way_out = format!("give a number with [{name}]");
                return Err(CubeError::format(path, problem, way_out));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use documents::hint::Explain;
    use documents::request::request_from_json;

    #[test]
    fn options_are_the_same_after_json() {
        let options = CubeOptions {
            white_reading: Some("white.hdr".into()),
            dark_reading: DarkReading::File("dark.hdr".into()),
            tile: 0.99,
            scale: CubeScale::White(10_000.0),
            full_scale: Some(4095.0),
            wavelengths: Some("nm.txt".into()),
            variable: Some("reflectance".to_owned()),
            scratch: Some("/scratch".into()),
        };
        let subtracted = CubeOptions { dark_reading: DarkReading::Subtracted, ..options.clone() };
        let percent = CubeOptions { scale: CubeScale::Percent, ..CubeOptions::default() };
        let fraction = CubeOptions { scale: CubeScale::Fraction, ..CubeOptions::default() };
        for options in [options, subtracted, percent, fraction, CubeOptions::default()] {
            let json = serde_json::to_string(&options).unwrap();
            assert_eq!(request_from_json::<CubeOptions>(&json).unwrap(), options, "{json}");
        }
        assert_eq!(request_from_json::<CubeOptions>("{}").unwrap(), CubeOptions::default());
    }

    #[test]
    fn a_dark_reading_of_0_is_subtracted_already() {
        for json in [r#"{"dark_reading": "0"}"#, r#"{"dark_reading": 0}"#] {
            let options: CubeOptions = request_from_json(json).unwrap();
            assert_eq!(options.dark_reading, DarkReading::Subtracted, "{json}");
        }
    }

    #[test]
    fn a_scale_that_is_neither_word_nor_number_is_refused_with_a_way_out() {
        let error = request_from_json::<CubeOptions>(r#"{"scale": "counts"}"#).unwrap_err();
        assert_eq!(
            error.to_string(),
            "scale takes file, fraction, percent or the number that a white reads, found `counts`"
        );
        assert_eq!(error.hint().unwrap().to_string(), "try `scale = percent`");
        let error = request_from_json::<CubeOptions>(r#"{"white": "white.hdr"}"#).unwrap_err();
        assert_eq!(error.to_string(), "unknown key `white`");
    }
}
