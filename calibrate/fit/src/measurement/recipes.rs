//! Recipes in a file of their own. We join them to the readings by the names of samples.

use std::collections::BTreeMap;

use documents::hint::Explain;
use documents::name_list;

use super::column::{Column, TableKind};
use super::csv_rows::CsvRows;
use super::error::MeasurementError;
use super::table::{Film, MeasurementTable, Reading};
use spectra::csv_table::CellPlace;

/// An error lists at most this many names.
const NAMES: usize = 12;

/// Recipes from a CSV: one row for each sample, or for each reading of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipes {
    /// Names of the pigments, in order of their columns.
    pub pigments: Vec<String>,
    file: String,
    /// Name of the reading and its row, in order of the file.
    rows: Vec<(String, Reading)>,
    /// Which of film, backing and thickness the file states.
    columns: StatedColumns,
    remarks: Vec<String>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct StatedColumns {
    film: bool,
    backing: bool,
    thickness: bool,
}

impl Recipes {
    /// Reads the recipes in `bytes`, the content of `file`. Columns are `sample`, then optionally `film`,
    /// `backing`, `thickness_mm`, and one for each pigment. If you pass `pigments`, we read only columns
    /// headed as one of them. If you read one sample several times, e.g. over two backings or bare, a
    /// column `reading` holds the name of each reading in the measurement file.
    ///
    /// # Errors
    /// [`RecipesError`] with the row.
    pub fn from_csv(
        file: &str,
        bytes: &[u8],
        pigments: Option<&[String]>,
    ) -> Result<Self, RecipesError> {
        let table_rows = CsvRows::open(file, bytes, TableKind::Recipes, pigments)?;
        let position = |wanted: Column| table_rows.columns.iter().position(|c| *c == wanted);
        if let Some(index) = table_rows
            .columns
            .iter()
            .position(|column: &Column| matches!(column, Column::Wavelength(_)))
        {
            let place = table_rows.header_place(index);
            return Err(RecipesError::Wavelength(place));
        }
        let pigments = table_rows.pigments();
        if pigments.is_empty() {
            return Err(RecipesError::NoPigments(file.to_owned()));
        }
        let reading = position(Column::Reading);
        let mut rows: Vec<(String, Reading)> = Vec::new();
        let mut places: BTreeMap<String, u64> = BTreeMap::new();
        for (cells, row) in table_rows.rows.iter().zip(table_rows.readings()?) {
            let key =
                reading.and_then(|index| cells.cells.get(index)).filter(|name| !name.is_empty());
            let key = key.unwrap_or(&row.sample).to_owned();
            if let Some(&first) = places.get(&key) {
                let file = file.to_owned();
                let second = row.row;
                return Err(RecipesError::Repeated { file, name: key, first, second });
            }
            places.insert(key.clone(), row.row);
            rows.push((key, row));
        }
        let columns = StatedColumns {
            film: position(Column::Film).is_some(),
            backing: position(Column::Backing).is_some(),
            thickness: position(Column::Thickness).is_some(),
        };
        let remarks = table_rows.remarks();
        Ok(Self { pigments, file: file.to_owned(), rows, columns, remarks })
    }

    /// Adds these recipes to `table`. We leave out readings of paint without a recipe, and recipes without
    /// a reading. A remark of the table says so.
    ///
    /// # Errors
    /// [`RecipesError::Twice`] if the table has pigments of its own, [`RecipesError::NoneMatched`] if no
    /// name occurs in both files.
    pub fn joined_to(&self, table: MeasurementTable) -> Result<MeasurementTable, RecipesError> {
        if !table.pigments.is_empty() {
            return Err(RecipesError::Twice {
                file: table.readings[0].file.to_string(),
                pigments: name_list(&table.pigments, NAMES, ", "),
            });
        }
        let by_name: BTreeMap<&str, &Reading> =
            self.rows.iter().map(|(name, row)| (name.as_str(), row)).collect();
        let mut table = table;
        table.name_by_file(|name| by_name.contains_key(name));
        let known: Vec<String> = distinct(table.readings.iter().map(|r| r.sample.as_str()));
        let (matched, unmatched): (Vec<&str>, Vec<&str>) =
            known.iter().map(String::as_str).partition(|name| by_name.contains_key(name));
        if matched.is_empty() {
            let names: Vec<&str> = self.rows.iter().map(|(name, _)| name.as_str()).collect();
            return Err(RecipesError::NoneMatched {
                file: self.file.clone(),
                recipes: name_list(&names, NAMES, ", "),
                readings: name_list(&unmatched, NAMES, ", "),
            });
        }
        let unread: Vec<&str> = self
            .rows
            .iter()
            .map(|(name, _)| name.as_str())
            .filter(|name| !known.iter().any(|known| known == name))
            .collect();
        let mut remarks = table.remarks;
        remarks.extend(self.remarks.clone());
        // A bare card needs no recipe.
        let left_out: Vec<&str> = unmatched
            .into_iter()
            .filter(|name: &&str| {
                table.readings.iter().any(|r| r.sample == **name && r.film == Film::Paint)
            })
            .collect();
        if !left_out.is_empty() {
            let names = left_out.join(", ");
            remarks.push(format!("samples without a recipe are left out: {names}"));
        }
        if !unread.is_empty() {
            let names = unread.join(", ");
            remarks.push(format!("recipes without a reading: {names}"));
        }
        let readings = table.readings.into_iter().filter_map(|reading: Reading| {
            let Some(row) = by_name.get(reading.sample.as_str()) else {
                let amounts = vec![0.0; self.pigments.len()].into();
                return (reading.film == Film::None).then_some(Reading { amounts, ..reading });
            };
            Some(Reading {
                sample: row.sample.clone(),
                film: if self.columns.film { row.film } else { reading.film },
                backing: if self.columns.backing { row.backing.clone() } else { reading.backing },
                thickness_mm: if self.columns.thickness {
                    row.thickness_mm
                } else {
                    reading.thickness_mm
                },
                amounts: row.amounts.clone(),
                ..reading
            })
        });
        let readings: Vec<Reading> = readings.collect();
        if let Some(reading) = readings
            .iter()
            .find(|r: &&Reading| r.film == Film::Paint && r.amounts.iter().all(|a| *a == 0.0))
        {
            let row = self.rows.iter().find(|(_, row)| row.sample == reading.sample);
            return Err(MeasurementError::NoRecipe {
                file: self.file.clone(),
                row: row.map_or(0, |(_, row)| row.row),
                sample: reading.sample.clone(),
                has_cards: readings.iter().any(|reading| reading.film == Film::None),
            }
            .into());
        }
        Ok(MeasurementTable { pigments: self.pigments.clone(), readings, remarks, ..table })
    }
}

/// Each name once, in order of first appearance.
fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut seen = std::collections::BTreeSet::new();
    names.filter(|name| seen.insert(*name)).map(str::to_owned).collect()
}

/// Recipes that cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum RecipesError {
    /// The table is faulty.
    #[error(transparent)]
    Table(#[from] MeasurementError),
    /// A column is a wavelength.
    #[error("{0} is a wavelength; recipes hold no readings")]
    #[hint("a file that holds both is a measurement file; leave out [recipes]")]
    Wavelength(CellPlace),
    /// No column is a pigment.
    #[error("{0}, row 1: no column is a pigment")]
    #[hint(
        "columns of recipes: sample, then optionally reading, film, backing, thickness_mm, then one per pigment"
    )]
    NoPigments(String),
    /// Two rows name the same reading.
    #[error("{file}, row {second}: a recipe of `{name}` stands in row {first} already")]
    #[hint(
        "remove one; where a sample was read several times, name each reading in a column `reading`"
    )]
    Repeated {
        /// File name as the caller gave it.
        file: String,
        /// Name of the reading.
        name: String,
        /// First row with this name.
        first: u64,
        /// Second row with this name.
        second: u64,
    },
    /// The measurement file has recipes of its own.
    #[error("{file}: the measurement file has amounts of its own, of `{pigments}`")]
    #[hint("leave out [recipes], or remove the pigment columns from the measurement file")]
    Twice {
        /// Name of the measurement file.
        file: String,
        /// Pigments of the measurement file.
        pigments: String,
    },
    /// No name occurs in both files.
    #[error(
        "{file}: no recipe has the name of a reading; recipes: {recipes}; readings: {readings}"
    )]
    #[hint(
        "names must be spelled alike in both; a column `reading` of the recipes may hold the names of the measurement file"
    )]
    NoneMatched {
        /// Name of the file of recipes.
        file: String,
        /// First names in the file of recipes.
        recipes: String,
        /// First names in the measurement file.
        readings: String,
    },
}
