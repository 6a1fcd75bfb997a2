//! Options of a search for recipes with pigments given by name, and the prices that put the cheapest of equally
//! near recipes first.

use std::path::Path;

use documents::file::{FileError, read};
use documents::from_spreadsheet_cell;
use documents::hint::Explain;
use documents::request::{RequestError, from_text, refused};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::ser::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::json;
use spectra::csv_table::RowNumbers;

use super::limits::{
    FilmKind, MatchError, RecipeLimits, RequiredPigment, Thickness, USUAL_SPECTRUM_TOLERANCE,
    USUAL_TOLERANCE,
};
use super::target::{Metric, ViewingCondition};
use crate::color::{Backing, BackingError, THICKEST};
use crate::evaluate::{Remark, check_visible_band};
use crate::library::{AmountKind, PigmentLibrary};
use crate::recipe::PigmentId;

/// Minimum share of each pigment if the request does not state one.
const USUAL_LEAST_SHARE: f64 = 0.02;
/// Greatest minimum share that a balance sets. A mass that it can hardly weigh is one pigment, or two halves.
const MOST_OF_A_BALANCE: f64 = 0.5;

/// A pigment that every recipe must contain, by name. JSON may hold the name alone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(from = "RequiredForm")]
pub struct RequiredName {
    /// Name of the pigment.
    pub name: String,
    /// Fixed share of the whole, above 0 and up to 1. `None` if the search chooses it.
    pub share: Option<f64>,
}

/// A required pigment in JSON.
#[derive(Deserialize, JsonSchema)]
#[serde(untagged)]
enum RequiredForm {
    /// Its name; the search chooses the share.
    Name(String),
    /// Its name and share.
    Shared {
        name: String,
        #[serde(default)]
        share: Option<f64>,
    },
}

impl From<RequiredForm> for RequiredName {
    fn from(form: RequiredForm) -> Self {
        match form {
            RequiredForm::Name(name) => Self { name, share: None },
            RequiredForm::Shared { name, share } => Self { name, share },
        }
    }
}

/// Origin of the tolerance of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ToleranceOrigin {
    /// The options state it.
    Given,
    /// It is the mean error of the library's fit: recipes that differ by less are equally good.
    Library,
    /// It is the default of the metric, because the library records no error or a smaller one.
    Usual,
}

impl ToleranceOrigin {
    /// Name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Given => "given",
            Self::Library => "library",
            Self::Usual => "usual",
        }
    }
}

/// Options of a search for recipes, which every program fills in its own way. [`Self::run`] searches. Comments of
/// the fields are the help texts of the command line and the descriptions of the schema.
///
/// ```
/// use pigment::MatchRequest;
///
/// let request = MatchRequest { at_most: 3, whole_parts: Some(12), ..MatchRequest::default() };
/// assert_eq!(request.count, 5);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(description = "Options of a search for recipes")]
pub struct MatchRequest {
    /// Match the color under the lights, or the spectrum of a measured target
    #[serde(rename = "by")]
    pub metric: Metric,
    /// Use only these pigments (may be repeated) [default: all whose S is known]
    pub only: Vec<String>,
    /// A pigment that every recipe must contain, with a share if that is fixed (may be repeated)
    pub with: Vec<RequiredName>,
    /// A pigment that no recipe may contain (may be repeated)
    pub without: Vec<String>,
    /// Maximum number of pigments of a recipe, 1 to 8
    pub at_most: usize,
    /// Minimum share of each pigment of a recipe, such as 0.01 or 1/100 [default: 1/50, about the least that
    /// a palette knife can cut off; for a mass in grams, what `balance` can weigh]
    #[serde(deserialize_with = "read_share")]
    #[schemars(schema_with = "text_or_number")]
    pub least_share: Option<f64>,
    /// Give recipes in whole parts whose sum is at most N
    pub whole_parts: Option<u32>,
    /// Total mass of the mixture in grams; amounts are then by mass
    pub grams: Option<f64>,
    /// Step of the balance in grams: no pigment of a mass is lighter, unless a minimum share is given
    pub balance: f64,
    /// Price of one gram (or one unit of absolute amounts), NAME=PRICE, in any currency (may be
    /// repeated), or a CSV with the columns pigment and price
    #[schemars(with = "Vec<String>")]
    pub prices: PriceList,
    /// Difference within which recipes count as equally near, in CIEDE2000 [default: the mean error of
    /// the library's fit, or 0.05 if it records none]; by spectrum in % of reflectance [default: 0.2]
    pub tolerance: Option<f64>,
    /// Allow absolute amounts outside the range that was measured of each pigment
    pub beyond_measured: bool,
    /// Number of recipes to show for each target
    pub count: usize,
    /// Thickness of the film, or LEAST:MOST to let the search choose; 1 is where the reference white
    /// has S d = 1 (for absolute amounts, all amounts together) [default: hiding; for absolute
    /// amounts from nearly clear to nearly hiding]
    #[serde(serialize_with = "write_thickness", deserialize_with = "read_thickness")]
    #[schemars(schema_with = "text_or_numbers")]
    pub thickness: Option<Thickness>,
    /// Measured reflectance of the ground, as in `mix` [default: white]
    #[serde(serialize_with = "write_ground", deserialize_with = "read_ground")]
    #[schemars(schema_with = "text_or_number")]
    pub over: Option<Backing>,
    /// Lights under which recipes are judged, each once, with their weights. A match by spectrum uses them
    /// only to report colour differences.
    pub conditions: Vec<ViewingCondition>,
}

impl Default for MatchRequest {
    fn default() -> Self {
        Self {
            metric: Metric::default(),
            only: Vec::new(),
            with: Vec::new(),
            without: Vec::new(),
            at_most: 4,
            least_share: None,
            whole_parts: None,
            grams: None,
            balance: 0.01,
            prices: PriceList::default(),
            tolerance: None,
            beyond_measured: false,
            count: 5,
            thickness: None,
            over: None,
            conditions: vec![ViewingCondition::default()],
        }
    }
}

impl MatchRequest {
    /// Looks up these options in `library`: limits of its recipes, with remarks about the choices that were made.
    ///
    /// # Errors
    /// [`MatchError`] if a name is unknown, or options exclude each other.
    pub fn limits(
        &self,
        library: &PigmentLibrary,
    ) -> Result<(RecipeLimits, Vec<Remark>), MatchError> {
        self.check_lights()?;
        let mut remarks = Vec::new();
        let film = self.film(library, &mut remarks)?;
        let mut limits = RecipeLimits {
            metric: self.metric,
            at_most: self.at_most,
            least_share: self.least_share_of_each()?,
            whole_parts: self.whole_parts,
            tolerance: self.tolerance_for(library).0,
            count: self.count,
            ..RecipeLimits::new(library, self.conditions.clone(), film)
        };
        if self.beyond_measured {
            limits.amounts.clear();
        }
        self.choose_pigments(library, &mut limits, &mut remarks)?;
        limits.costs = self.prices.of_library(library, &limits.allowed)?;
        if self.count == 0 {
            return Err(MatchError::Number {
                what: "the number of recipes is 1 or more",
                value: 0.0,
                hint: "leave [count] out for 5 recipes",
            });
        }
        remarks.extend(check_visible_band(library.grid)?);
        Ok((limits, remarks))
    }

    /// Difference within which recipes of `library` count as equally near, and its origin.
    #[must_use]
    pub fn tolerance_for(&self, library: &PigmentLibrary) -> (f64, ToleranceOrigin) {
        let by_spectrum = self.metric.spectrum_weights().is_some();
        match (self.tolerance, library.mean_error()) {
            (Some(given), _) => (given, ToleranceOrigin::Given),
            (None, _) if by_spectrum => (USUAL_SPECTRUM_TOLERANCE, ToleranceOrigin::Usual),
            (None, Some(error)) if error > USUAL_TOLERANCE => (error, ToleranceOrigin::Library),
            (None, _) => (USUAL_TOLERANCE, ToleranceOrigin::Usual),
        }
    }

    /// The minimum share of each pigment.
    fn least_share_of_each(&self) -> Result<f64, MatchError> {
        if !(self.balance > 0.0 && self.balance < 1e9) {
            return Err(MatchError::Number {
                what: "the step of a balance is above 0 g",
                value: self.balance,
                hint: "try [balance=0.01]",
            });
        }
        Ok(match (self.least_share, self.grams) {
            (Some(given), _) => given,
            (None, Some(grams)) if grams > 0.0 => (self.balance / grams).min(MOST_OF_A_BALANCE),
            (None, _) => USUAL_LEAST_SHARE,
        })
    }

    fn check_lights(&self) -> Result<(), MatchError> {
        let names: Vec<String> = self
            .conditions
            .iter()
            .map(|condition| condition.viewing.illuminant.name().to_owned())
            .collect();
        let repeated = (1..names.len()).find(|&at| names[..at].contains(&names[at]));
        repeated.map_or(Ok(()), |at| Err(MatchError::RepeatedLight(names[at].clone())))
    }

    fn film(
        &self,
        library: &PigmentLibrary,
        remarks: &mut Vec<Remark>,
    ) -> Result<FilmKind, MatchError> {
        if self.thickness.is_none() && library.amounts == AmountKind::Relative {
            let hidden = self.over.is_some();
            return if hidden { Err(MatchError::HiddenGround) } else { Ok(FilmKind::Hiding) };
        }
        if self.over.is_none() {
            let note = Remark::note("over a perfect white");
            remarks.push(note.with_hint("name the paper or ground with [over]"));
        }
        let (ground, warning) = self.over.clone().unwrap_or_default().on_grid(library.grid)?;
        remarks.extend(warning);
        Ok(match self.thickness {
            None => RecipeLimits::usual_film(library, ground),
            Some(thickness) => FilmKind::Over { ground, thickness },
        })
    }

    /// Sets allowed and required pigments, and remarks on pigments with unknown S.
    fn choose_pigments(
        &self,
        library: &PigmentLibrary,
        limits: &mut RecipeLimits,
        remarks: &mut Vec<Remark>,
    ) -> Result<(), MatchError> {
        if !self.only.is_empty() {
            limits.allowed = find_all(library, &self.only)?;
        }
        for RequiredName { name, share } in &self.with {
            let pigment = library.find(name)?;
            limits.required.retain(|known| known.pigment != pigment);
            limits.required.push(RequiredPigment { pigment, share: *share });
            limits.allowed.push(pigment);
        }
        let without = find_all(library, &self.without)?;
        let both = limits.required.iter().find(|required| without.contains(&required.pigment));
        if let Some(RequiredPigment { pigment, .. }) = both {
            let name = library[*pigment].name.clone();
            return Err(MatchError::RequiredAndExcluded(name));
        }
        limits.allowed.retain(|pigment| !without.contains(pigment));
        limits.allowed.sort_unstable();
        limits.allowed.dedup();
        let [used, left_out] = [true, false].map(|allowed| -> Vec<&str> {
            let of_those = library.ids().filter(|id| {
                !library[*id].identified
                    && limits.allowed.contains(id) == allowed
                    && !without.contains(id)
            });
            of_those.map(|id| library[id].name.as_str()).collect()
        });
        if !used.is_empty() {
            let text =
                format!("S is not known of {}; recipes with it are a guess", used.join(", "));
            remarks.push(Remark::warning(text));
        }
        if !left_out.is_empty() && self.only.is_empty() {
            let text = format!(
                "we do not know S of {}, and use them only for colours that the other pigments do not reach",
                left_out.join(", ")
            );
            remarks.push(Remark::note(text));
        }
        Ok(())
    }
}

impl MatchRequest {
    /// Pigments of unknown S that take no part, and were neither left out nor named.
    pub(super) fn unknown(
        &self,
        library: &PigmentLibrary,
        limits: &RecipeLimits,
    ) -> Result<Vec<PigmentId>, MatchError> {
        if !self.only.is_empty() {
            return Ok(Vec::new());
        }
        let without = find_all(library, &self.without)?;
        let others = library.ids().filter(|id| !limits.allowed.contains(id));
        Ok(others.filter(|id| !without.contains(id)).collect())
    }
}

pub(super) fn find_all(
    library: &PigmentLibrary,
    names: &[String],
) -> Result<Vec<PigmentId>, MatchError> {
    names.iter().map(|name| Ok(library.find(name)?)).collect()
}

/// Reads a share from 0 to 1, written as a number or as a fraction such as 1/50.
///
/// # Errors
/// [`RequestError`] for any other text. Its hint is for the key `setting`.
pub fn parse_share(text: &str, setting: &str) -> Result<f64, RequestError> {
    let numbers: Option<Vec<f64>> = text.split('/').map(|part| part.trim().parse().ok()).collect();
    let value = match numbers.as_deref() {
        Some([number]) => Some(*number),
        Some([numerator, denominator]) => Some(numerator / denominator),
        _ => None,
    };
    value.filter(|value| (0.0..=1.0).contains(value)).ok_or_else(|| {
        let example = if setting == "with" { "NAME=" } else { "" };
        RequestError::value(
            format!("takes a share from 0 to 1, found `{text}`"),
            format!("try [{setting}={example}0.25] or a fraction such as 1/4"),
        )
    })
}

fn read_share<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    from_text(deserializer, |text| parse_share(text, "least").map(Some))
}

fn write_thickness<S: Serializer>(
    thickness: &Option<Thickness>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match thickness {
        None => serializer.serialize_none(),
        Some(Thickness::Fixed(thickness)) => serializer.serialize_f64(*thickness),
        Some(Thickness::Between(least, most)) => [least, most].serialize(serializer),
    }
}

fn read_thickness<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Thickness>, D::Error> {
    from_text(deserializer, |text| {
        let numbers = text.split([':', ',']).map(|part| part.parse::<f64>().ok());
        let numbers = numbers.map(|number| number.filter(|t| *t > 0.0 && *t <= THICKEST));
        match numbers.collect::<Option<Vec<f64>>>().as_deref() {
            Some([thickness]) => Ok(Some(Thickness::Fixed(*thickness))),
            Some([least, most]) if least < most => Ok(Some(Thickness::Between(*least, *most))),
            _ => Err(RequestError::value(
                format!("takes T or LEAST:MOST, above 0 and up to 1e9, found `{text}`"),
                "try [thickness=1] or [thickness=0.2:3]",
            )),
        }
    })
}

fn write_ground<S: Serializer>(over: &Option<Backing>, serializer: S) -> Result<S::Ok, S::Error> {
    match over {
        None => serializer.serialize_none(),
        Some(Backing::Even(reflectance)) => serializer.serialize_f64(*reflectance),
        Some(Backing::Measured(_)) => Err(S::Error::custom("a measured ground has no text")),
    }
}

fn read_ground<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Backing>, D::Error> {
    from_text(deserializer, |text| {
        text.parse().map(Some).map_err(|error: BackingError| RequestError::of(&error))
    })
}

fn text_or_number(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "anyOf": [{ "type": "string" }, { "type": "number" }] })
}

fn text_or_numbers(_: &mut SchemaGenerator) -> Schema {
    let two =
        json!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 });
    json_schema!({ "anyOf": [{ "type": "string" }, { "type": "number" }, two] })
}

/// Prices of one unit of amount (for example a gram) of pigments by name, in any currency. JSON holds texts
/// `NAME=PRICE`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PriceList {
    entries: Vec<Entry>,
}

#[derive(Debug, Clone, PartialEq)]
struct Entry {
    pigment: String,
    price: f64,
    /// File and row, for errors. `None` for a price that was set by a call.
    place: Option<String>,
}

impl Serialize for PriceList {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let texts = self.entries.iter().map(|entry| format!("{}={}", entry.pigment, entry.price));
        serializer.collect_seq(texts)
    }
}

impl<'de> Deserialize<'de> for PriceList {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut prices = Self::default();
        for text in Vec::<String>::deserialize(deserializer)? {
            prices.add_text(&text).map_err(|error| refused(RequestError::of(&error)))?;
        }
        Ok(prices)
    }
}

impl PriceList {
    /// Adds a price that stands as `NAME=PRICE`.
    ///
    /// # Errors
    /// [`PriceError`] for any other text.
    pub fn add_text(&mut self, text: &str) -> Result<(), PriceError> {
        let (name, price) = text.rsplit_once('=').unwrap_or((text, ""));
        self.set(name, parse_price(price, text)?)
    }

    /// Whether the list holds no price.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Sets the price of a pigment. A later price of one pigment replaces an earlier one.
    ///
    /// # Errors
    /// [`PriceError::Price`] unless the price is a finite number of 0 and up.
    pub fn set(&mut self, pigment: impl Into<String>, price: f64) -> Result<(), PriceError> {
        let pigment = pigment.into();
        if !(price.is_finite() && price >= 0.0) {
            return Err(PriceError::Price { place: pigment, text: price.to_string() });
        }
        self.entries.push(Entry { pigment, price, place: None });
        Ok(())
    }

    /// Adds the prices of a CSV file with the columns `pigment` and `price`.
    ///
    /// # Errors
    /// [`PriceError`] with the row.
    pub fn add_file(&mut self, path: impl AsRef<Path>) -> Result<(), PriceError> {
        let path = path.as_ref();
        let bytes = read(path)?;
        self.add_csv(&path.display().to_string(), &bytes)
    }

    /// Adds the prices of `bytes`, the content of a CSV file with the columns `pigment` and `price`.
    ///
    /// # Errors
    /// [`PriceError`] with the row.
    pub fn add_csv(&mut self, file: &str, bytes: &[u8]) -> Result<(), PriceError> {
        let broken = |reason: csv::Error| PriceError::Table(file.to_owned(), reason);
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(bytes);
        let headers = reader.headers().map_err(broken)?.clone();
        let pigment = header_column(file, &headers, "pigment")?;
        let price = header_column(file, &headers, "price")?;
        let mut numbers = RowNumbers::of(bytes);
        for record in reader.records() {
            let record = record.map_err(broken)?;
            let row = numbers.at(record.position().map_or(0, csv::Position::byte));
            let place = format!("{file}, row {row}");

            let price = parse_price(record.get(price).unwrap_or_default(), &place)?;
            let pigment = from_spreadsheet_cell(record.get(pigment).unwrap_or_default()).to_owned();
            self.entries.push(Entry { pigment, price, place: Some(place) });
        }
        Ok(())
    }

    /// Price of each pigment of `library`, 0 where none is known. Empty for an empty list.
    ///
    /// # Errors
    /// [`MatchError::NoPrice`] if one of `needed` has no price, [`MatchError::PricedPigment`] or
    /// [`MatchError::Recipe`] for a name that is not in the library.
    pub(super) fn of_library(
        &self,
        library: &PigmentLibrary,
        needed: &[PigmentId],
    ) -> Result<Vec<f64>, MatchError> {
        if self.is_empty() {
            return Ok(Vec::new());
        }
        let mut found: Vec<Option<f64>> = vec![None; library.pigments.len()];
        for Entry { pigment, price, place } in &self.entries {
            let id = library.find(pigment).map_err(|error| match place {
                Some(place) => MatchError::PricedPigment(place.clone(), error),
                None => MatchError::Recipe(error),
            })?;
            found[id.index()] = Some(*price);
        }
        let missing = needed.iter().filter(|id| found[id.index()].is_none());
        let missing: Vec<String> = missing.map(|id| library[*id].name.clone()).collect();
        if !missing.is_empty() {
            return Err(MatchError::NoPrice(missing));
        }
        Ok(found.into_iter().map(|price| price.unwrap_or(0.0)).collect())
    }
}

fn header_column(
    file: &str,
    headers: &csv::StringRecord,
    column: &'static str,
) -> Result<usize, PriceError> {
    let found = headers.iter().position(|header| header.eq_ignore_ascii_case(column));
    found.ok_or_else(|| PriceError::MissingColumn { file: file.to_owned(), column })
}

/// Reads a price from `text`. An error names its `place`, for example file and row.
///
/// # Errors
/// [`PriceError::Price`] unless it is a finite number of 0 and up.
pub fn parse_price(text: &str, place: &str) -> Result<f64, PriceError> {
    let price = text.trim().parse().ok().filter(|price: &f64| price.is_finite() && *price >= 0.0);
    price.ok_or_else(|| PriceError::Price { place: place.to_owned(), text: text.trim().to_owned() })
}

/// Prices that cannot be used.
#[derive(Debug, thiserror::Error, Explain)]
pub enum PriceError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is not a CSV table.
    #[error("{0}: no table of prices")]
    Table(String, #[source] csv::Error),
    /// A column is missing.
    #[error("{file}, row 1: no column `{column}`")]
    #[hint("the first row is `pigment,price`; commas separate the columns")]
    MissingColumn {
        /// File name as the caller gave it.
        file: String,
        /// Name of the column.
        column: &'static str,
    },
    /// A price is not a number of 0 and up.
    #[error("{place}: expected a price of 0 or more, found `{text}`")]
    #[hint("numbers take a decimal point, without a currency")]
    Price {
        /// File and row, or the text that states the price.
        place: String,
        /// Text of the price.
        text: String,
    },
}
