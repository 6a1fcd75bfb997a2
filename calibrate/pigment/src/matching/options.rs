//! Options of a search for recipes with pigments given by name, and the prices that put the cheapest of equally
//! near recipes first.

use std::path::Path;

use documents::file::{FileError, read};
use documents::hint::Explain;
use spectra::csv_table::RowNumbers;

use super::request::{
    FilmKind, MatchError, MatchRequest, RequiredPigment, Thickness, USUAL_SPECTRUM_TOLERANCE,
    USUAL_TOLERANCE,
};
use super::target::{Metric, ViewingCondition};
use crate::color::Backing;
use crate::evaluate::{Remark, check_visible_band};
use crate::library::{AmountKind, PigmentLibrary};
use crate::recipe::PigmentId;

/// A pigment that every recipe must contain, by name.
#[derive(Debug, Clone, PartialEq)]
pub struct RequiredName {
    /// Name of the pigment.
    pub name: String,
    /// Fixed share of the whole, above 0 and up to 1. `None` if the search chooses it.
    pub share: Option<f64>,
}

/// Origin of the tolerance of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ToleranceOrigin {
    /// The options state it.
    Given,
    /// It is the mean error of the library's fit: recipes that differ by less are equally good.
    Library,
    /// It is the usual one of the metric: the library records no error, or a smaller one.
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

/// Options of [`PigmentLibrary::recipes_for`].
///
/// ```
/// use pigment::MatchOptions;
///
/// let options = MatchOptions { at_most: 3, whole_parts: Some(12), ..MatchOptions::default() };
/// assert_eq!(options.count, 5);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct MatchOptions {
    /// Measure of the difference from the target. Default: CIEDE2000.
    pub metric: Metric,
    /// Lights under which recipes are judged, each once. When matching by spectrum, lights under which
    /// differences are reported. Default: D65 for the CIE 1931 observer.
    pub conditions: Vec<ViewingCondition>,
    /// Thickness of the film. By default it hides. For absolute amounts the search chooses a thickness
    /// from nearly clear to nearly hiding.
    pub thickness: Option<Thickness>,
    /// Bare ground under a film that does not hide. Default: a perfect white.
    pub over: Option<Backing>,
    /// Names of the pigments that may take part. Empty: all pigments with known S.
    pub only: Vec<String>,
    /// Pigments that must take part.
    pub with: Vec<RequiredName>,
    /// Names of pigments that must not take part.
    pub without: Vec<String>,
    /// Most pigments of one recipe, 1 to 8. Default: 4.
    pub at_most: usize,
    /// Least share of a pigment that takes part, 0 to below 1. Default: 1/50.
    pub least_share: f64,
    /// Most parts of a recipe in whole parts, 1 to 1000. Default: shares of any size.
    pub whole_parts: Option<u32>,
    /// Prices of pigments. If there are any, each pigment that may take part needs one.
    pub prices: PriceList,
    /// Difference within which recipes count as equally near, 0 to 1000, in the unit of the metric. Default:
    /// the mean error of the library's fit ([`PigmentLibrary::mean_error`]) in CIEDE2000, or 0.05 if it
    /// records none. By spectrum 0.2 % of reflectance.
    pub tolerance: Option<f64>,
    /// Whether absolute amounts may lie outside the range that was measured of each pigment. Default: no.
    pub beyond_measured: bool,
    /// Number of recipes to return, 1 and up. Default: 5.
    pub count: usize,
}

impl Default for MatchOptions {
    fn default() -> Self {
        Self {
            metric: Metric::default(),
            conditions: vec![ViewingCondition::default()],
            thickness: None,
            over: None,
            only: Vec::new(),
            with: Vec::new(),
            without: Vec::new(),
            at_most: 4,
            least_share: 0.02,
            whole_parts: None,
            prices: PriceList::default(),
            tolerance: None,
            beyond_measured: false,
            count: 5,
        }
    }
}

impl MatchOptions {
    /// Converts these options to a request for `library`, with remarks about the choices that were made.
    ///
    /// # Errors
    /// [`MatchError`] if a name is unknown, or options exclude each other.
    pub fn request(
        &self,
        library: &PigmentLibrary,
    ) -> Result<(MatchRequest, Vec<Remark>), MatchError> {
        self.check_lights()?;
        let mut remarks = Vec::new();
        let film = self.film(library, &mut remarks)?;
        let mut request = MatchRequest {
            metric: self.metric,
            at_most: self.at_most,
            least_share: self.least_share,
            whole_parts: self.whole_parts,
            tolerance: self.tolerance_for(library).0,
            count: self.count,
            ..MatchRequest::new(library, self.conditions.clone(), film)
        };
        if self.beyond_measured {
            request.amounts.clear();
        }
        self.choose_pigments(library, &mut request, &mut remarks)?;
        request.costs = self.prices.of_library(library, &request.allowed)?;
        if self.count == 0 {
            return Err(MatchError::Number {
                what: "the number of recipes is 1 or more",
                value: 0.0,
                hint: "leave [count] out for 5 recipes",
            });
        }
        remarks.extend(check_visible_band(library.grid)?);
        Ok((request, remarks))
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

    fn check_lights(&self) -> Result<(), MatchError> {
        let names: Vec<String> = self
            .conditions
            .iter()
            .map(|condition| condition.viewing.illuminant.name().to_owned())
            .collect();
        let repeated = (1..names.len()).find(|&at| names[..at].contains(&names[at]));
        repeated.map_or(Ok(()), |at| Err(MatchError::RepeatedLight { name: names[at].clone() }))
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
            None => MatchRequest::usual_film(library, ground),
            Some(thickness) => FilmKind::Over { ground, thickness },
        })
    }

    /// Sets allowed and required pigments, and remarks on pigments with unknown S.
    fn choose_pigments(
        &self,
        library: &PigmentLibrary,
        request: &mut MatchRequest,
        remarks: &mut Vec<Remark>,
    ) -> Result<(), MatchError> {
        if !self.only.is_empty() {
            request.allowed = find_all(library, &self.only)?;
        }
        for RequiredName { name, share } in &self.with {
            let pigment = library.find(name)?;
            request.required.retain(|known| known.pigment != pigment);
            request.required.push(RequiredPigment { pigment, share: *share });
            request.allowed.push(pigment);
        }
        let without = find_all(library, &self.without)?;
        let both = request.required.iter().find(|required| without.contains(&required.pigment));
        if let Some(RequiredPigment { pigment, .. }) = both {
            let name = library[*pigment].name.clone();
            return Err(MatchError::RequiredAndExcluded { name });
        }
        request.allowed.retain(|pigment| !without.contains(pigment));
        request.allowed.sort_unstable();
        request.allowed.dedup();
        let unknown = |allowed: bool| -> Vec<&str> {
            let of_those = library.ids().filter(|id| {
                !library[*id].identified
                    && request.allowed.contains(id) == allowed
                    && !without.contains(id)
            });
            of_those.map(|id| library[id].name.as_str()).collect()
        };
        let used = unknown(true);
        let left_out = unknown(false);
        if !used.is_empty() {
            let text =
                format!("S is not known of {}; recipes with it are a guess", used.join(", "));
            remarks.push(Remark::warning(text));
        }
        if !left_out.is_empty() && self.only.is_empty() {
            let text = format!("left out, their S is not known: {}", left_out.join(", "));
            remarks.push(Remark::note(text));
        }
        Ok(())
    }
}

pub(super) fn find_all(
    library: &PigmentLibrary,
    names: &[String],
) -> Result<Vec<PigmentId>, MatchError> {
    names.iter().map(|name| Ok(library.find(name)?)).collect()
}

/// Prices of one unit of amount (for example a gram) of pigments by name, in any currency.
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

impl PriceList {
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
        let broken = |reason: csv::Error| PriceError::Table { file: file.to_owned(), reason };
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
            let pigment = record.get(pigment).unwrap_or_default().to_owned();
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
                Some(place) => MatchError::PricedPigment { place: place.clone(), error },
                None => MatchError::Recipe(error),
            })?;
            found[id.index()] = Some(*price);
        }
        let missing = needed.iter().filter(|id| found[id.index()].is_none());
        let missing: Vec<String> = missing.map(|id| library[*id].name.clone()).collect();
        if !missing.is_empty() {
            return Err(MatchError::NoPrice { pigments: missing });
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

/// Reads a price from `text`, which stands at `place`.
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
    #[error("{file}: no table of prices")]
    Table {
        /// File name as the caller gave it.
        file: String,
        /// Message of the CSV parser.
        #[source]
        reason: csv::Error,
    },
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
