//! The options of a fit and of a validation. Every program fills them in its own way.
//!
//! Comments of the fields are the help texts of the command line and the descriptions of the schema.

use documents::request::{RequestError, from_text};
use pigment::evaluate::Viewing;
use pigment::library::{AmountKind, PigmentLibrary};
use pigment::remark::Remark;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use spectra::optics::{Specular, Surface};

use crate::fit::{Method, Smoothness};
use crate::leave_out::LeaveOut;
use crate::observation::BelowSurface;
use crate::readings::Readings;

/// Options of a fit. [`Self::run`] fits.
///
/// ```
/// use calibrate::FitRequest;
/// use calibrate::fit::Method;
///
/// let request = FitRequest { method: Method::Weighted, ..FitRequest::default() };
/// assert!(request.reference.is_none());
/// ```
///
/// Absolute amounts always take the method `refined`, and no reference. If you state no surface, we take k2
/// = 0.6, and k1 = 0.03, or less if a reading is lower. For absolute amounts we take k1 = 0 and the k2 that
/// predicts unseen films best. K and S do not depend on the light and the observer, which only set the
/// colour errors.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(description = "Options of a fit")]
pub struct FitRequest {
    /// Method of the fit
    pub method: Method,
    /// Meaning of the amounts
    pub amounts: AmountKind,
    /// The white whose S is 1 [default: the pigment called white that occurs in most samples]
    pub reference: Option<String>,
    /// Surface reflection as K1,K2, or none [default: 0.03,0.6, with a smaller k1 if a reading is below
    /// 0.03; in a fit of absolute amounts k1 = 0 and the k2 that predicts best]
    #[serde(serialize_with = "write_surface", deserialize_with = "read_surface")]
    #[schemars(schema_with = "surface_schema")]
    pub surface: Option<Surface>,
    /// Whether the readings include the specular reflection [default: as the files say, else included]
    pub specular: Option<Specular>,
    /// Treatment of a reading below k1. If you set this without `surface`, k1 stays 0.03 even if readings
    /// are lower [default: refuse]
    pub below_surface: Option<BelowSurface>,
    /// Smoothness of K and S over wavelength: auto, none, or a weight such as 10
    #[serde(serialize_with = "write_smoothness", deserialize_with = "read_smoothness")]
    #[schemars(schema_with = "word_or_number")]
    pub smoothness: Smoothness,
    /// Unevenness of the films in a fit of absolute amounts: auto, or the standard deviation of log
    /// thickness such as 0.25
    #[serde(serialize_with = "write_unevenness", deserialize_with = "read_unevenness")]
    #[schemars(schema_with = "word_or_number")]
    pub unevenness: Option<f64>,
    /// A sample to leave out (may be repeated)
    pub exclude: Vec<String>,
    /// Light and observer of the colour errors
    pub viewing: Viewing,
    /// Title, licence and source of the library
    pub provenance: Provenance,
}

/// Title, licence and source of a fitted library.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Provenance {
    /// Title of the library [default: the first file's name]
    pub title: Option<String>,
    /// Licence of the library
    pub licence: String,
    /// Source of the measurements
    pub source: String,
}

impl Default for Provenance {
    fn default() -> Self {
        let not_stated = "not stated".to_owned();
        Self { title: None, licence: not_stated.clone(), source: not_stated }
    }
}

/// Options of a validation. [`Self::run`] validates.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(description = "Options of a validation")]
pub struct ValidationRequest {
    /// Options of the fits
    pub fit: FitRequest,
    /// Leave this out at a time [default: mixture, or sample if there are no mixtures]
    pub leave_out: Option<LeaveOut>,
    /// Deal the mixtures (or samples) at random into this many groups (the same every time), and leave out one
    /// group at a time [default: one mixture at a time; for absolute amounts, 10 groups]
    pub folds: Option<usize>,
    /// Leave out only mixtures with this pigment (may be repeated)
    pub with: Vec<String>,
}

impl FitRequest {
    /// The request with the surface of `library`, so that both libraries can be merged. A library of absolute
    /// amounts also gives its unevenness. Unless you state another treatment, readings below the surface's own
    /// reflection are read as black.
    ///
    /// ```
    /// use calibrate::observation::BelowSurface;
    /// use calibrate::{FitRequest, PigmentLibrary};
    ///
    /// let oils = PigmentLibrary::van_gogh_oils();
    /// let request = FitRequest::default().with_surface_of(&oils);
    /// assert_eq!(request.surface, Some(oils.saunderson));
    /// assert_eq!(request.below_surface, Some(BelowSurface::Floor));
    /// ```
    #[must_use]
    pub fn with_surface_of(self, library: &PigmentLibrary) -> Self {
        let is_absolute = library.amounts == AmountKind::Absolute;
        Self {
            surface: Some(library.saunderson),
            specular: Some(library.saunderson.specular),
            below_surface: self.below_surface.or(Some(BelowSurface::Floor)),
            unevenness: if is_absolute { Some(library.unevenness) } else { self.unevenness },
            ..self
        }
    }

    /// The surface that the request states, if it does. You can exclude the specular reflection in either
    /// `surface` or `specular`.
    pub(crate) fn stated_surface(&self) -> Option<Surface> {
        self.surface.map(|surface| match self.specular {
            Some(specular @ Specular::Excluded) => Surface { specular, ..surface },
            Some(Specular::Included) | None => surface,
        })
    }

    /// The request with the geometry of `readings`, if it does not state its own, and a remark if this
    /// changes the fit.
    pub(crate) fn with_geometry_of(&self, readings: &Readings) -> (Self, Option<Remark>) {
        let stated = readings.table.geometry.as_ref();
        let stated =
            stated.filter(|_| self.specular.is_none() && self.surface != Some(Surface::NONE));
        let excluded = stated.filter(|stated| !stated.includes_specular);
        let remark = excluded.map(|stated| {
            let words = &stated.words;
            let text =
                format!("{words}: the readings are taken to exclude the specular reflection");
            Remark::note(text).with_hint("set [specular=included] if they include it")
        });
        let specular = if excluded.is_some() { Some(Specular::Excluded) } else { self.specular };
        (Self { specular, ..self.clone() }, remark)
    }
}

pub(crate) fn write_surface<S: Serializer>(
    surface: &Option<Surface>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    surface.map(|surface| [surface.k1, surface.k2]).serialize(serializer)
}

pub(crate) fn read_surface<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Surface>, D::Error> {
    from_text(deserializer, |text| text.parse().map(Some))
}

pub(crate) fn surface_schema(_: &mut SchemaGenerator) -> Schema {
    let number = json_schema!({ "type": "number", "minimum": 0, "exclusiveMaximum": 1 });
    json_schema!({
        "anyOf": [
            { "type": "string" },
            { "type": "array", "items": number, "minItems": 2, "maxItems": 2 },
            { "type": "null" },
        ]
    })
}

fn write_smoothness<S: Serializer>(
    smoothness: &Smoothness,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match smoothness {
        Smoothness::None => serializer.serialize_str("none"),
        Smoothness::Auto => serializer.serialize_str("auto"),
        Smoothness::Fixed(weight) => serializer.serialize_f64(*weight),
    }
}

fn read_smoothness<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Smoothness, D::Error> {
    from_text(deserializer, |text| match text {
        "none" => Ok(Smoothness::None),
        "auto" => Ok(Smoothness::Auto),
        text => at_least_zero(text, "try [smoothness=auto]").map(Smoothness::Fixed),
    })
}

fn write_unevenness<S: Serializer>(
    unevenness: &Option<f64>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match unevenness {
        None => serializer.serialize_str("auto"),
        Some(deviation) => serializer.serialize_f64(*deviation),
    }
}

fn read_unevenness<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    from_text(deserializer, |text| match text {
        "auto" => Ok(None),
        text => at_least_zero(text, "try [unevenness=auto]").map(Some),
    })
}

fn at_least_zero(text: &str, hint: &str) -> Result<f64, RequestError> {
    text.parse().ok().filter(|value: &f64| value.is_finite() && *value >= 0.0).ok_or_else(|| {
        RequestError::value(format!("takes a word or a number not below 0, found `{text}`"), hint)
    })
}

fn word_or_number(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "anyOf": [{ "type": "string" }, { "type": "number", "minimum": 0 }] })
}

#[cfg(test)]
mod tests {
    use super::*;
    use documents::hint::Explain;
    use documents::request::request_from_json;

    #[test]
    fn a_request_is_the_same_after_json() {
        let request = FitRequest {
            method: Method::Qp,
            reference: Some("Lead White".to_owned()),
            surface: Some(Surface::new(0.02, 0.5, Specular::Included).unwrap()),
            below_surface: Some(BelowSurface::Floor),
            smoothness: Smoothness::Fixed(0.1),
            unevenness: Some(0.25),
            exclude: vec!["a".to_owned()],
            ..FitRequest::default()
        };
        for request in [request, FitRequest::default()] {
            let json = serde_json::to_string(&request).unwrap();
            assert_eq!(request_from_json::<FitRequest>(&json).unwrap(), request, "{json}");
        }
        assert_eq!(request_from_json::<FitRequest>("{}").unwrap(), FitRequest::default());
    }

    #[test]
    fn values_may_be_text_as_on_a_command_line() {
        let text = r#"{"surface": "0.03,0.6", "smoothness": "10", "unevenness": "0", "specular": "excluded"}"#;
        let request: FitRequest = request_from_json(text).unwrap();
        assert_eq!(request.smoothness, Smoothness::Fixed(10.0));
        assert_eq!(request.unevenness, Some(0.0));
        assert_eq!(request.stated_surface(), Some(Surface::of_most_paints(Specular::Excluded)));
    }

    #[test]
    fn the_instrument_that_a_file_names_decides_on_the_specular_reflection() {
        let of = |instrument: &str, request: &FitRequest| {
            let text = format!(
                "CGATS.17\nINSTRUMENTATION \"{instrument}\"\nBEGIN_DATA_FORMAT\n\
                 SAMPLE_ID SPEC_400 SPEC_500 SPEC_600\nEND_DATA_FORMAT\nBEGIN_DATA\n\
                 A 0.1 0.2 0.3\nEND_DATA\n"
            );
            let options = crate::ReadingOptions::default();
            let readings = Readings::spectra_from_files(&[("f", text)], &options).unwrap();
            let (request, remark) = request.with_geometry_of(&readings);
            (request.specular, remark.is_some())
        };
        let plain = FitRequest::default();
        assert_eq!(of("i1Pro", &plain), (Some(Specular::Excluded), true));
        assert_eq!(of("CM-700d SCI", &plain), (None, false));
        assert_eq!(of("CM-700d", &plain), (None, false));
        let stated = FitRequest { specular: Some(Specular::Included), ..FitRequest::default() };
        assert_eq!(of("i1Pro", &stated), (Some(Specular::Included), false));
        let none = FitRequest { surface: Some(Surface::NONE), ..FitRequest::default() };
        assert_eq!(of("i1Pro", &none), (None, false));
    }

    #[test]
    fn an_excluded_reflection_is_recorded_without_a_surface_too() {
        let text = r#"{"surface": [0, 0], "specular": "excluded"}"#;
        let request: FitRequest = request_from_json(text).unwrap();
        let excluded = Surface { specular: Specular::Excluded, ..Surface::NONE };
        assert_eq!(request.stated_surface(), Some(excluded));
    }

    #[test]
    fn what_a_key_does_not_take_is_refused_with_a_way_out() {
        for (json, message, hint) in [
            (
                r#"{"smoothness": -1}"#,
                "smoothness takes a word or a number not below 0, found `-1`",
                "try `smoothness = auto`",
            ),
            (
                r#"{"surface": "0.03"}"#,
                "surface takes K1,K2 or none, found `0.03`",
                "try `saunderson = 0.03,0.6`",
            ),
            (r#"{"metho": "qp"}"#, "unknown key `metho`", "did you mean method?"),
            (
                r#"{"method": "best"}"#,
                "method: unknown word `best`",
                "it takes the words qp, weighted, refined",
            ),
        ] {
            let error = request_from_json::<FitRequest>(json).unwrap_err();
            assert_eq!(
                (error.to_string().as_str(), error.hint().unwrap().to_string().as_str()),
                (message, hint)
            );
        }
        let error =
            request_from_json::<FitRequest>(r#"{"viewing": {"illuminant": "TL84"}}"#).unwrap_err();
        assert!(
            error.key.is_none() && error.hint().unwrap().to_string().contains("FL11"),
            "{error}"
        );
    }
}
