//! The library of calibrated pigments on one wavelength grid, its JSON file and the settings of its fit.
//! You also find here the library that ships with impasto: the oils of Van Gogh's palette.

use std::io::{self, Read};
use std::ops::{Index, IndexMut};
use std::path::Path;

use documents::file::{FileError, read, write_whole};
use documents::hint::Explain;
use documents::{counted, excerpt, is_hidden, name_list, name_violation, question};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use sha2::{Digest, Sha256};
use spectra::Grid;
use spectra::optics::{Surface, UnevenFilm};

use crate::color_index::{fitting, one_of, traditional_names};
use crate::recipe::{Curves, PigmentId, Recipe};

/// We allow this range for a part. Sums with larger parts lose their small terms to rounding.
const PARTS: std::ops::RangeInclusive<f64> = 0.0..=1e12;
/// We can normalise parts only if their sum is at least this.
const LEAST_TOTAL: f64 = 1e-12;

/// Output of `impasto fit` for `measurements/van-gogh-oils.csv`.
const VAN_GOGH_OILS: &str = include_str!("../../../measurements/van-gogh-oils.pigments.json");

/// Calibrated pigments that you can mix, with their sources.
///
/// ```
/// use pigment::{PigmentLibrary, Viewing};
///
/// let oils = PigmentLibrary::van_gogh_oils();
/// let color = oils.color([("Zinc White", 9.0), ("Cobalt Blue", 1.0)], &Viewing::default())?;
/// assert_eq!(color.hex(), "#5798e3");
/// # Ok::<(), pigment::ColorError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PigmentLibrary {
    /// Title of the library.
    pub title: String,
    /// Licence of the values.
    pub licence: String,
    /// Source of the measurements.
    pub source: String,
    /// Wavelengths of all K and S.
    pub grid: Grid,
    /// Meaning of the amounts in a recipe.
    #[serde(default)]
    pub amounts: AmountKind,
    /// Name of the pigment with S = 1 at every wavelength. `None` for absolute amounts, which have no such
    /// pigment.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<String>,
    /// Surface of the measured films (Saunderson correction).
    pub saunderson: Surface,
    /// Unevenness of the measured films, see [`UnevenFilm`], 0 to 2. You can see it only from absolute
    /// amounts.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub unevenness: f64,
    /// Measurement files from which the library was made.
    #[serde(default)]
    pub inputs: Vec<Input>,
    /// Settings of the fit. `None` for a library made otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub settings: Option<FitSettings>,
    /// The pigments, at least one, no two with the same name.
    pub pigments: Vec<Pigment>,
    /// Errors of the fit. `None` for a library made otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub evidence: Option<Evidence>,
}

impl PigmentLibrary {
    /// A library of relative amounts without pigments. Title, licence and source are empty.
    #[must_use]
    pub fn empty(grid: Grid, surface: Surface) -> Self {
        Self {
            title: String::new(),
            licence: String::new(),
            source: String::new(),
            grid,
            amounts: AmountKind::Relative,
            reference: None,
            saunderson: surface,
            unevenness: 0.0,
            inputs: Vec::new(),
            settings: None,
            pigments: Vec::new(),
            evidence: None,
        }
    }

    /// Finds a pigment by `name`. We try, in this order, all in any letter case, and take the first that fits:
    ///
    /// 1. the name itself,
    /// 2. the start of a name (`cobalt` for `Cobalt Blue`),
    /// 3. a Colour Index name (`PB29`, `Pigment Blue 29`) that the library states, or that tradition gives a paint
    ///    of this name,
    /// 4. words, each the start of a word of a name (`umber`, `blue phthalo`), and the word of a hue (`blue`), which
    ///    Colour Index names state too.
    ///
    /// ```
    /// use pigment::PigmentLibrary;
    ///
    /// let oils = PigmentLibrary::van_gogh_oils();
    /// assert_eq!(oils.find("PB29")?, oils.find("Ultramarine")?);
    /// let blues = oils.find("blue").unwrap_err().to_string();
    /// assert_eq!(blues, "`blue` may be Cobalt Blue, Ultramarine or Prussian Blue");
    /// # Ok::<(), pigment::RecipeError>(())
    /// ```
    ///
    /// # Errors
    /// [`RecipeError`] if no pigment or several match.
    pub fn find(&self, name: &str) -> Result<PigmentId, RecipeError> {
        let name = name.trim();
        let named = self.pigments.iter().map(|p| (p.name.as_str(), p.color_index.as_deref()));
        match fitting(&named.collect::<Vec<_>>(), name)[..] {
            [index] => Ok(PigmentId(index)),
            [] => Err(RecipeError::UnknownPigment {
                name: name.to_owned(),
                traditional: traditional_names(name),
                known: self.pigments.iter().map(|p| p.name.clone()).collect(),
            }),
            ref several => Err(RecipeError::Ambiguous {
                name: name.to_owned(),
                names: several.iter().map(|index| self.pigments[*index].name.clone()).collect(),
            }),
        }
    }

    /// Indices of all pigments of the library, in order.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = PigmentId> + Clone + use<> {
        (0..self.pigments.len()).map(PigmentId)
    }

    /// Pigments that recipes and maps take if you name none: those with measured K and S. If there is at
    /// most one of them, then also those whose S was assumed from a masstone.
    #[must_use]
    pub fn usual_pigments(&self) -> Vec<PigmentId> {
        let measured: Vec<PigmentId> = self.ids().filter(|id| self[*id].identified).collect();
        if measured.len() > 1 { measured } else { self.ids().collect() }
    }

    /// Index of the reference white. `None` if the library has none.
    #[must_use]
    pub fn reference_id(&self) -> Option<PigmentId> {
        let name = self.reference.as_ref()?;
        self.ids().find(|&id| self[id].name == *name)
    }

    /// K and S of one pigment, with their grid.
    ///
    /// # Panics
    /// If `pigment` belongs to a larger library.
    #[must_use]
    pub fn curves(&self, pigment: PigmentId) -> Curves {
        let Pigment { absorption, scattering, .. } = self[pigment].clone();
        Curves { grid: self.grid, absorption, scattering }
    }

    /// Mean colour error of the fit in CIEDE2000, as its evidence records it. You can expect a mixture to
    /// be about this far from its prediction. `None` for a library made otherwise.
    #[must_use]
    pub fn mean_error(&self) -> Option<f64> {
        self.evidence.as_ref().map(|evidence| evidence.delta_e.mean)
    }

    /// Film model that predicts the measured films: their surface and unevenness.
    #[must_use]
    pub fn film(&self) -> UnevenFilm {
        UnevenFilm { surface: self.saunderson, unevenness: self.unevenness }
    }

    /// Recipe of pigments by name, each with its parts. We look up names by [`Self::find`].
    ///
    /// # Errors
    /// [`RecipeError`] for a name that matches no pigment or several.
    pub fn recipe<N: AsRef<str>>(
        &self,
        parts: impl IntoIterator<Item = (N, f64)>,
    ) -> Result<Recipe, RecipeError> {
        parts.into_iter().map(|(name, part)| Ok((self.find(name.as_ref())?, part))).collect()
    }

    /// K and S of a recipe. We normalise the parts in a relative library to sum 1, so that you get the same
    /// film at a given thickness for any total of the parts.
    ///
    /// # Errors
    /// [`RecipeError::Parts`] unless every part is 0 to 1e12 and they sum to 1e-12 or more.
    ///
    /// # Panics
    /// If a pigment belongs to a larger library.
    pub fn mix(&self, recipe: impl AsRef<[(PigmentId, f64)]>) -> Result<Curves, RecipeError> {
        let parts = self.parts(recipe)?;
        let weighted = parts.iter().map(|&(id, part)| {
            let pigment = &self[id];
            (part, pigment.absorption.as_slice(), pigment.scattering.as_slice())
        });
        Ok(Curves::weighted_sum(self.grid, weighted))
    }

    /// Parts of a recipe, as we weight K and S by them. In a relative library they sum to 1.
    ///
    /// # Errors
    /// [`RecipeError::Parts`] unless every part is 0 to 1e12 and they sum to 1e-12 or more.
    pub fn parts(
        &self,
        recipe: impl AsRef<[(PigmentId, f64)]>,
    ) -> Result<Vec<(PigmentId, f64)>, RecipeError> {
        let parts = recipe.as_ref();
        if let Some((_, part)) = parts.iter().find(|(_, part)| !PARTS.contains(part)) {
            return Err(RecipeError::Parts(*part));
        }
        let total: f64 = parts.iter().map(|(_, part)| part).sum();
        if total < LEAST_TOTAL {
            return Err(RecipeError::Parts(total));
        }
        let scale = if self.amounts == AmountKind::Relative { 1.0 / total } else { 1.0 };
        Ok(parts.iter().map(|&(id, part)| (id, part * scale)).collect())
    }

    /// The library that ships with impasto: 20 oil paints of Van Gogh's palette, which we calibrated from
    /// the readings of Geldof and others (2018, CC0).
    ///
    /// # Panics
    /// Never: a test reads the library that is compiled in.
    #[must_use]
    pub fn van_gogh_oils() -> Self {
        Self::from_json("van-gogh-oils.pigments.json", VAN_GOGH_OILS)
            .expect("the shipped library is valid")
    }
}

impl Index<PigmentId> for PigmentLibrary {
    type Output = Pigment;

    fn index(&self, pigment: PigmentId) -> &Pigment {
        &self.pigments[pigment.0]
    }
}

impl IndexMut<PigmentId> for PigmentLibrary {
    fn index_mut(&mut self, pigment: PigmentId) -> &mut Pigment {
        &mut self.pigments[pigment.0]
    }
}

/// Meaning of the amounts in a recipe.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum AmountKind {
    /// Shares of a mixture, for films that hide or are read over two backings
    ///
    /// Only the ratios of the shares count. K and S are relative to the S of the reference white.
    #[default]
    Relative,
    /// Amounts (mL, g) spread on a fixed area of a known backing
    ///
    /// K and S are per unit of amount.
    Absolute,
}

/// One calibrated pigment of a library.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pigment {
    /// Name of the pigment, unique in its library.
    pub name: String,
    /// Colour Index name, for example `PB29`. `None` if unknown.
    #[serde(rename = "colour_index", default, skip_serializing_if = "Option::is_none")]
    pub color_index: Option<String>,
    /// K at each wavelength of the library's grid, 0 and up.
    pub absorption: Vec<f64>,
    /// S at each wavelength of the library's grid, 0 and up.
    pub scattering: Vec<f64>,
    /// Standard deviation of K at each wavelength, empty if unknown.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub absorption_sd: Vec<f64>,
    /// Standard deviation of S at each wavelength, empty if unknown.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub scattering_sd: Vec<f64>,
    /// Whether we know S. If not, `scattering` is 1 at every wavelength, and `notes` say so.
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub identified: bool,
    /// Whether you guessed K and S from a colour. They are then not measured.
    #[serde(default, skip_serializing_if = "is_no")]
    pub guessed: bool,
    /// Least and greatest amount above 0 of the measured films. Only absolute amounts have such limits,
    /// and files of older versions do not state them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured_amounts: Option<[f64; 2]>,
    /// Warnings about the pigment, in words for you.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

fn yes() -> bool {
    true
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_yes(value: &bool) -> bool {
    *value
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_no(value: &bool) -> bool {
    !*value
}

/// Errors of a fit over all its samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evidence {
    /// Name of the light under which colour errors are computed.
    pub illuminant: String,
    /// Name of the observer for which colour errors are computed.
    pub observer: String,
    /// Root mean square error of measured reflectance.
    pub rms: f64,
    /// Summary of the colour errors in CIEDE2000.
    pub delta_e: crate::evaluate::Summary,
    /// Colour error of each sample, in order of the file.
    pub per_sample: Vec<SampleEvidence>,
    /// Quantities that the data do not identify, and inconsistent data, in words.
    pub warnings: Vec<String>,
}

/// Error of a fit for one sample.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SampleEvidence {
    /// Name of the sample.
    pub sample: String,
    /// CIEDE2000 between measured and fitted colour.
    pub delta_e: f64,
}

/// A file from which the library was made.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// Path of the file, as the user named it.
    pub path: String,
    /// SHA-256 of the bytes, in hexadecimal.
    pub sha256: String,
}

impl Input {
    /// Record of the file `path` with the content of `reader`. We never hold the whole content in memory.
    ///
    /// # Errors
    /// The error of `reader`.
    pub fn of_reader(path: impl Into<String>, mut reader: impl Read) -> io::Result<Self> {
        let mut hasher = Sha256::new();
        let mut buffer = vec![0; 1 << 16];
        loop {
            let length = match reader.read(&mut buffer) {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                other => other?,
            };
            if length == 0 {
                break;
            }
            hasher.update(&buffer[..length]);
        }
        let sha256 = hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Self { path: path.into(), sha256 })
    }

    /// Record of the file `path` with the given content.
    #[must_use]
    pub fn new(path: impl Into<String>, content: &[u8]) -> Self {
        let sha256 = Sha256::digest(content).iter().map(|byte| format!("{byte:02x}")).collect();
        Self { path: path.into(), sha256 }
    }
}

/// Every setting that changes the result of a fit. We save it in the library's file.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FitSettings {
    /// Method of the fit. Absolute amounts always take their own.
    pub method: Method,
    /// Smoothing over wavelength, only `refined` and absolute amounts use it.
    pub smoothness: Smoothness,
    /// Treatment of readings below the surface's own reflection.
    pub below_surface: BelowSurface,
    /// Names of the samples that were left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub excluded: Vec<String>,
}

/// Method by which K and S are found. The crate `calibrate` describes each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// The published quadratic program, unweighted (Baxter, Wendt and Lin 2004)
    Qp,
    /// The quadratic program, its rows weighted to approximate errors of reflectance
    Weighted,
    /// Robust nonlinear refinement of `weighted`, in measured reflectance
    #[default]
    Refined,
}

/// Strength of the smoothing of K and S over wavelength.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Smoothness {
    /// No smoothing: every wavelength is fitted by itself.
    None,
    /// The weight under which the data are most likely (MacKay 1992, eq. 2.18).
    #[default]
    Auto,
    /// A given weight, 0 and up, on the squared second differences of log K and log S, in units of
    /// the residual's variance, for a wavelength step of 10 nm.
    Fixed(f64),
}

/// Treatment of a reading below the surface's own reflection k1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum BelowSurface {
    /// Fail with an error that names sample and wavelength
    ///
    /// The surface's k1 is too high for this paint.
    #[default]
    Refuse,
    /// Treat the reading as black
    ///
    /// Its internal reflectance becomes 0.001.
    Floor,
}

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

    /// Writes the library as JSON text. Equal libraries give equal bytes.
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

    /// Reads the library from `text`, the content of `file`. We use this name only in errors.
    ///
    /// # Errors
    /// [`LibraryError`] if the text is not JSON, has another format or version, an unknown or missing key, or
    /// values that no K and S can have.
    pub fn from_json(file: &str, text: &str) -> Result<Self, LibraryError> {
        let text = text.trim_start_matches('\u{feff}');
        if !text.trim_start().starts_with('{') {
            return Err(LibraryError::NoLibrary(file.to_owned()));
        }
        let syntax = |error: serde_json::Error| match error.is_eof() {
            true => LibraryError::CutOff { file: file.to_owned(), line: error.line() },
            false => LibraryError::Syntax {
                file: file.to_owned(),
                reason: documents::plain_parser_message(&error.to_string()),
            },
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
        // We will upgrade files of older versions here, one step each.
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
        if self.title.contains(is_hidden) {
            return Err(fault("", "the title needs a text without control characters".into()));
        }
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
            if let Some(wanted) = name_violation(name) {
                let found = excerpt(name);
                let what = format!("pigment number {} needs {wanted}, found `{found}`", index + 1);
                return Err(fault("", what));
            }
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

/// Writes `value` as text, indented by two spaces and ending in a new line.
#[must_use]
pub fn to_text(value: &Value) -> String {
    let mut text = String::new();
    write(value, 0, &mut text);
    text.push('\n');
    text
}

fn write(value: &Value, depth: usize, text: &mut String) {
    match value {
        Value::Array(items) if items.iter().any(|item| item.is_object() || item.is_string()) => {
            text.push('[');
            for (index, item) in items.iter().enumerate() {
                text.push_str(if index == 0 { "" } else { "," });
                new_line(text, depth + 1);
                write_inline_if_flat(item, depth + 1, text);
            }
            new_line(text, depth);
            text.push(']');
        }
        Value::Object(map) if !map.is_empty() => {
            text.push('{');
            for (index, (key, item)) in map.iter().enumerate() {
                text.push_str(if index == 0 { "" } else { "," });
                new_line(text, depth + 1);
                text.push_str(&Value::from(key.as_str()).to_string());
                text.push_str(": ");
                write(item, depth + 1, text);
            }
            new_line(text, depth);
            text.push('}');
        }
        _ => text.push_str(&value.to_string()),
    }
}

fn new_line(text: &mut String, depth: usize) {
    text.push('\n');
    text.push_str(&"  ".repeat(depth));
}

/// Writes a flat record, for example the error of one sample, on one line.
fn write_inline_if_flat(value: &Value, depth: usize, text: &mut String) {
    match value {
        Value::Object(map) if map.values().all(|v| !v.is_object() && !v.is_array()) => {
            text.push_str(&value.to_string());
        }
        _ => write(value, depth, text),
    }
}

/// Why a file is not a valid pigment library.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum LibraryError {
    /// The file could not be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text is not JSON, or it lacks the keys of a library.
    #[error("{file}: {reason}")]
    Syntax {
        /// File name as the caller gave it.
        file: String,
        /// Message of the JSON parser.
        reason: String,
    },
    /// The text is not JSON at all. Such a file often holds readings.
    #[error("{0}: this is not a pigment library, which is JSON")]
    #[hint(
        "if it holds readings, fit them first: `impasto fit READINGS.csv [output=LIBRARY.json]`"
    )]
    NoLibrary(String),
    /// The file ends within a value.
    #[error("{file}: the file is cut off in line {line}")]
    #[hint("copy it again, or fit the readings again")]
    CutOff {
        /// File name as the caller gave it.
        file: String,
        /// Last line, counted from 1.
        line: usize,
    },
    /// The key `format` does not name a pigment library.
    #[error("{file}: `format` must be \"impasto-pigment-library\", found `{found}`")]
    #[hint("`impasto fit READINGS.csv [output=LIBRARY.json]` makes a pigment library")]
    Format {
        /// File name as the caller gave it.
        file: String,
        /// Value of the key `format`.
        found: String,
    },
    /// The file's version is newer than this program.
    #[error("{file}: this program reads pigment libraries up to version {newest}, found `{found}`")]
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
    #[error("{file}: {}{what}", if pigment.is_empty() { String::new() } else { format!("pigment {pigment}: ") })]
    Figures {
        /// File name as the caller gave it.
        file: String,
        /// Name of the pigment. This is empty if the fault concerns the whole library.
        pigment: String,
        /// Description of the fault.
        what: String,
    },
}

/// A recipe that cannot be mixed.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum RecipeError {
    /// No pigment has this name.
    #[error("the library has no pigment called `{name}`")]
    #[hint(
        if !traditional.is_empty(),
        verbatim,
        "{name} is {}; pigments: {}",
        name_list(traditional, traditional.len(), " or "),
        known.join(", ")
    )]
    #[hint(verbatim, "{}pigments: {}", question(name, known), known.join(", "))]
    UnknownPigment {
        /// Name that was looked up.
        name: String,
        /// Traditional names, if it is a Colour Index name.
        traditional: &'static [&'static str],
        /// Names of all pigments of the library.
        known: Vec<String>,
    },
    /// Several pigments fit this name.
    #[error("`{name}` may be {}", one_of(names))]
    #[hint("write more of the name")]
    Ambiguous {
        /// Name that was looked up.
        name: String,
        /// Names of the pigments that fit, two or more.
        names: Vec<String>,
    },
    /// A part, or the sum of all parts, is out of range.
    #[error("parts are 0 to 1e12 and sum to 1e-12 or more, found `{0}`")]
    #[fault(Setting)]
    Parts(f64),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_library_is_valid_and_has_20_pigments() {
        let oils = PigmentLibrary::van_gogh_oils();
        assert_eq!(oils.pigments.len(), 20);
        assert!(oils.find("Zinc White").is_ok(), "the reference white");
    }

    #[test]
    fn files_that_are_no_library_or_are_cut_off_say_so() {
        let whole = PigmentLibrary::van_gogh_oils().to_json();
        let lines = |count: usize| whole.lines().take(count).collect::<Vec<_>>().join("\n");
        for (text, message, hint) in [
            (
                "sample,White,400\n",
                "f: this is not a pigment library, which is JSON",
                "fit them first",
            ),
            (&lines(20), "f: the file is cut off in line 20", "copy it again"),
            (
                "{}",
                "f: `format` must be \"impasto-pigment-library\", found `nothing`",
                "impasto fit",
            ),
        ] {
            let error = PigmentLibrary::from_json("f", text).unwrap_err();
            assert_eq!(error.to_string(), message);
            assert!(error.hint().unwrap().to_string().contains(hint), "{error}");
        }
    }

    #[test]
    fn a_misspelt_pigment_is_reported_with_the_one_that_is_meant() {
        let known = ["Zinc White", "Viridian"].map(str::to_owned).to_vec();
        for (name, hint) in [
            ("Viridan", "did you mean Viridian? pigments: Zinc White, Viridian"),
            ("zink", "did you mean Zinc White? pigments: Zinc White, Viridian"),
            ("Umber", "pigments: Zinc White, Viridian"),
        ] {
            let name = name.to_owned();
            let error =
                RecipeError::UnknownPigment { name, traditional: &[], known: known.clone() };
            assert_eq!(error.hint().unwrap().to_string(), hint);
        }
    }
}
