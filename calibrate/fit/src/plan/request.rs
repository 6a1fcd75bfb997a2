//! Which swatches to plan: the options of a plan, which every program fills in its own way.
//!
//! Comments of the fields are the help texts of the command line and the descriptions of the schema.

use documents::request::{RequestError, from_text};
use pigment::PigmentLibrary;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::fit::ExpectedNoise;

/// Options of [`plan`](super::plan). [`Self::run`] plans.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(description = "Options of a plan of swatches")]
pub struct PlanRequest {
    /// A black, for shades
    pub black: Option<String>,
    /// Number of swatches, or `fewest` for one swatch per unknown [default: masstones, two tints each, a
    /// shade each with a black, and one cross each]
    #[serde(deserialize_with = "read_count")]
    #[schemars(schema_with = "count_schema")]
    pub swatches: Option<SwatchCount>,
    /// Time in minutes for all swatches: plan as many as fit in it, up to the default number
    pub minutes: Option<f64>,
    /// Time in minutes to weigh, mix, lay and read one swatch, by which `minutes` counts
    pub minutes_each: f64,
    /// Grams of paint per swatch
    pub grams: f64,
    /// Smallest step of the balance in grams; no part is smaller than fifty steps, so that each is
    /// weighed to 1 %
    pub balance: f64,
    /// Expected noise of a swatch's reflectance as CONSTANT,EVEN, both standard deviations. CONSTANT is the
    /// noise of the instrument, equal at every reflectance. EVEN is the noise of weighing, mixing and film.
    /// It looks equally large at every reflectance, so it is smaller in the dark [default: 0.002 for
    /// CONSTANT; for EVEN the residual of the prior's own fit, else 0.01]
    #[serde(serialize_with = "write_noise", deserialize_with = "read_noise")]
    #[schemars(schema_with = "noise_schema")]
    pub noise: Option<ExpectedNoise>,
    /// Library of the same or similar paint, by which the swatches are chosen. Names of pigments may then
    /// be abbreviated to their start. Without one the design is the usual one.
    #[serde(skip)]
    pub prior: Option<PigmentLibrary>,
}

impl Default for PlanRequest {
    fn default() -> Self {
        Self {
            black: None,
            swatches: None,
            minutes: None,
            minutes_each: 10.0,
            grams: 10.0,
            balance: 0.01,
            noise: None,
            prior: None,
        }
    }
}

/// Number of swatches that you want.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SwatchCount {
    /// A number that you choose.
    Number(usize),
    /// One for each unknown of a wavelength, see [`PaintSet::unknowns`](super::PaintSet::unknowns).
    Fewest,
}

impl Serialize for SwatchCount {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(count) => count.serialize(serializer),
            Self::Fewest => FEWEST.serialize(serializer),
        }
    }
}

const FEWEST: &str = "fewest";

fn read_count<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<SwatchCount>, D::Error> {
    from_text(deserializer, |text| match text {
        FEWEST => Ok(Some(SwatchCount::Fewest)),
        text => text.parse().map(|count| Some(SwatchCount::Number(count))).map_err(|_| {
            let reason = format!("takes a whole number or {FEWEST}, found `{text}`");
            RequestError::value(reason, "try [swatches=20] or [swatches=fewest]")
        }),
    })
}

fn count_schema(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "anyOf": [
            { "type": "string" },
            { "type": "integer", "minimum": 0 },
            { "type": "null" },
        ]
    })
}

fn write_noise<S: Serializer>(
    noise: &Option<ExpectedNoise>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    noise.map(|noise| [noise.constant, noise.even]).serialize(serializer)
}

fn read_noise<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<ExpectedNoise>, D::Error> {
    from_text(deserializer, |text| {
        let numbers = text.split_once(',').and_then(|(first, second)| {
            let constant = first.trim().parse::<f64>().ok()?;
            let even = second.trim().parse::<f64>().ok()?;
            Some(ExpectedNoise { constant, even })
        });
        let noise = numbers.filter(ExpectedNoise::is_possible).ok_or_else(|| {
            let wanted = "each 0 to 1 and one above 0";
            let reason = format!("takes CONSTANT,EVEN, {wanted}, found `{text}`");
            RequestError::value(reason, "try [noise=0.002,0.01]")
        });
        noise.map(Some)
    })
}

fn noise_schema(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "anyOf": [
            { "type": "string" },
            { "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 },
            { "type": "null" },
        ]
    })
}
