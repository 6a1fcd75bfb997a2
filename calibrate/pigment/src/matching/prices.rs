//! Prices of pigments, so that the cheapest of equally near recipes comes first.

use std::path::Path;

use documents::file::{FileError, read};
use documents::hint::{Explain, Fault, Hint};
use spectra::csv_table::RowNumbers;

use super::error::MatchError;
use crate::library::PigmentLibrary;
use crate::recipe::PigmentId;

/// Prices of one unit of amount (such as a gram) of pigments by name, in any currency.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PriceList {
    entries: Vec<Entry>,
}

#[derive(Debug, Clone, PartialEq)]
struct Entry {
    pigment: String,
    price: f64,
    /// File and row, for errors; `None` for a price that was set by a call.
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
        let column = |column: &'static str| {
            let found = headers.iter().position(|header| header.eq_ignore_ascii_case(column));
            found.ok_or_else(|| PriceError::MissingColumn { file: file.to_owned(), column })
        };
        let pigment = column("pigment")?;
        let price = column("price")?;
        let mut numbers = RowNumbers::of(bytes);
        for record in reader.records() {
            let record = record.map_err(broken)?;
            let row = numbers.at(record.position().map_or(0, csv::Position::byte));
            let place = format!("{file}, row {row}");
            let cell = |column| record.get(column).unwrap_or_default();
            let price = parse_price(cell(price), &place)?;
            let pigment = cell(pigment).to_owned();
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

/// Reads a price from `text`, which stands at `place`.
///
/// # Errors
/// [`PriceError::Price`] unless it is a finite number of 0 and up.
pub fn parse_price(text: &str, place: &str) -> Result<f64, PriceError> {
    let price = text.trim().parse().ok().filter(|price: &f64| price.is_finite() && *price >= 0.0);
    price.ok_or_else(|| PriceError::Price { place: place.to_owned(), text: text.trim().to_owned() })
}

/// Prices that cannot be used.
#[derive(Debug, thiserror::Error)]
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
    MissingColumn {
        /// File name as the caller gave it.
        file: String,
        /// Name of the column.
        column: &'static str,
    },
    /// A price is not a number of 0 and up.
    #[error("{place}: expected a price of 0 or more, found `{text}`")]
    Price {
        /// File and row, or the text that states the price.
        place: String,
        /// Text of the price.
        text: String,
    },
}

impl Explain for PriceError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::File(error) => return error.hint(),
            Self::Table { .. } => return None,
            Self::MissingColumn { .. } => {
                "the first row is `pigment,price`; commas separate the columns"
            }
            Self::Price { .. } => "numbers take a decimal point, without a currency",
        }))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            _ => Fault::Input,
        }
    }
}
