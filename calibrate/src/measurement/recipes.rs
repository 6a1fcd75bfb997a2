//! Recipes apart from readings: which pigments a sample holds, joined to the readings by name.

use std::collections::BTreeMap;

use super::column::{Column, Wanted};
use super::csv::Sheet;
use super::error::MeasurementError;
use super::table::{Film, MeasurementTable, Reading};
use spectra::csv_table::CellPlace;

/// How many names an error lists.
const NAMES: usize = 12;

/// The recipes of a CSV: one row a sample, or a reading of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipes {
    /// The pigments, in order of their columns.
    pub pigments: Vec<String>,
    file: String,
    /// In order of the file: the reading's name, and the row.
    rows: Vec<(String, Reading)>,
    /// Which of film, backing and thickness the file has a column for.
    tells: Tells,
    remarks: Vec<String>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Tells {
    film: bool,
    backing: bool,
    thickness: bool,
}

impl Recipes {
    /// The recipes in `bytes`, the content of `file`: columns `sample`, then optionally `film`,
    /// `backing`, `thickness_mm`, and one per pigment. Where one sample was read several times,
    /// over two backings or bare, a column `reading` holds the name of each in the measurement
    /// file.
    ///
    /// # Errors
    /// [`RecipesError`], with the row.
    pub fn from_csv(file: &str, bytes: &[u8]) -> Result<Self, RecipesError> {
        let sheet = Sheet::open(file, bytes, Wanted::Recipes)?;
        let position = |wanted: Column| sheet.columns.iter().position(|c| *c == wanted);
        let is_wavelength = |column: &Column| matches!(column, Column::Wavelength(_));
        if let Some(index) = sheet.columns.iter().position(is_wavelength) {
            let place = CellPlace::new(file, 1, &sheet.headers[index]);
            return Err(RecipesError::Wavelength { place });
        }
        let pigments = sheet.pigments();
        if pigments.is_empty() {
            return Err(RecipesError::NoPigments { file: file.to_owned() });
        }
        let reading = position(Column::Reading);
        let mut rows: Vec<(String, Reading)> = Vec::new();
        let mut places: BTreeMap<String, u64> = BTreeMap::new();
        for (cells, row) in sheet.rows.iter().zip(sheet.readings()?) {
            let key = reading.and_then(|index| cells.get(index)).filter(|name| !name.is_empty());
            let key = key.unwrap_or(&row.sample).to_owned();
            if let Some(&first) = places.get(&key) {
                let (file, second) = (file.to_owned(), row.row);
                return Err(RecipesError::Repeated { file, name: key, first, second });
            }
            places.insert(key.clone(), row.row);
            rows.push((key, row));
        }
        let tells = Tells {
            film: position(Column::Film).is_some(),
            backing: position(Column::Backing).is_some(),
            thickness: position(Column::Thickness).is_some(),
        };
        let remarks = sheet.remarks();
        Ok(Self { pigments, file: file.to_owned(), rows, tells, remarks })
    }

    /// `table` with these recipes: readings of paint without one are left out, and that is said in
    /// its remarks, as are recipes without a reading.
    ///
    /// # Errors
    /// [`RecipesError::Twice`] if the table has pigments of its own,
    /// [`RecipesError::NoneMatched`] if no name stands in both.
    pub fn joined_to(&self, table: MeasurementTable) -> Result<MeasurementTable, RecipesError> {
        if !table.pigments.is_empty() {
            return Err(RecipesError::Twice {
                file: table.readings[0].file.to_string(),
                pigments: listed(table.pigments.iter().map(String::as_str)),
            });
        }
        let by_name: BTreeMap<&str, &Reading> =
            self.rows.iter().map(|(name, row)| (name.as_str(), row)).collect();
        let known: Vec<String> = distinct(table.readings.iter().map(|r| r.sample.as_str()));
        let (matched, unmatched): (Vec<&str>, Vec<&str>) =
            known.iter().map(String::as_str).partition(|name| by_name.contains_key(name));
        if matched.is_empty() {
            return Err(RecipesError::NoneMatched {
                file: self.file.clone(),
                recipes: listed(self.rows.iter().map(|(name, _)| name.as_str())),
                readings: listed(unmatched.into_iter()),
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
        // A bare card needs none.
        let painted = |name: &&str| {
            table.readings.iter().any(|r| r.sample == **name && r.film == Film::Paint)
        };
        let left_out: Vec<&str> = unmatched.into_iter().filter(painted).collect();
        if !left_out.is_empty() {
            let names = left_out.join(", ");
            remarks.push(format!("samples without a recipe are left out: {names}"));
        }
        if !unread.is_empty() {
            let names = unread.join(", ");
            remarks.push(format!("recipes without a reading: {names}"));
        }
        let join = |reading: Reading| {
            let Some(row) = by_name.get(reading.sample.as_str()) else {
                let amounts = vec![0.0; self.pigments.len()];
                return (reading.film == Film::None).then_some(Reading { amounts, ..reading });
            };
            Some(Reading {
                sample: row.sample.clone(),
                film: if self.tells.film { row.film } else { reading.film },
                backing: if self.tells.backing { row.backing.clone() } else { reading.backing },
                thickness_mm: if self.tells.thickness {
                    row.thickness_mm
                } else {
                    reading.thickness_mm
                },
                amounts: row.amounts.clone(),
                ..reading
            })
        };
        let readings: Vec<Reading> = table.readings.into_iter().filter_map(join).collect();
        let empty = |r: &&Reading| r.film == Film::Paint && r.amounts.iter().all(|a| *a == 0.0);
        if let Some(reading) = readings.iter().find(empty) {
            let row = self.rows.iter().find(|(_, row)| row.sample == reading.sample);
            return Err(MeasurementError::NoRecipe {
                file: self.file.clone(),
                row: row.map_or(0, |(_, row)| row.row),
                sample: reading.sample.clone(),
            }
            .into());
        }
        Ok(MeasurementTable { pigments: self.pigments.clone(), readings, remarks, ..table })
    }
}

/// The names once each, in order.
fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut seen = std::collections::BTreeSet::new();
    names.filter(|name| seen.insert(*name)).map(str::to_owned).collect()
}

/// The first names.
fn listed<'a>(names: impl ExactSizeIterator<Item = &'a str>) -> String {
    let count = names.len();
    let shown: Vec<&str> = names.take(NAMES).collect();
    let more = count - shown.len();
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    shown.join(", ") + &rest
}

/// Why recipes cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecipesError {
    /// The table is faulty.
    #[error(transparent)]
    Table(#[from] MeasurementError),
    /// A column is a wavelength.
    #[error("{place} is a wavelength; recipes hold no readings")]
    Wavelength {
        /// Where.
        place: CellPlace,
    },
    /// No column is a pigment.
    #[error("{file}, row 1: no column is a pigment")]
    NoPigments {
        /// The file.
        file: String,
    },
    /// Two rows are of one reading.
    #[error("{file}, row {second}: a recipe of `{name}` stands in row {first} already")]
    Repeated {
        /// The file.
        file: String,
        /// The name.
        name: String,
        /// The first row.
        first: u64,
        /// The second.
        second: u64,
    },
    /// The readings have recipes of their own.
    #[error("{file}: the measurement file has amounts of its own, of `{pigments}`")]
    Twice {
        /// The measurement file.
        file: String,
        /// Its pigments.
        pigments: String,
    },
    /// No name stands in both files.
    #[error(
        "{file}: no recipe has the name of a reading; recipes: {recipes}; readings: {readings}"
    )]
    NoneMatched {
        /// The file of recipes.
        file: String,
        /// Its first names.
        recipes: String,
        /// The first names of the measurement file.
        readings: String,
    },
}

impl RecipesError {
    /// What to try, where there is something.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        Some(
            match self {
                Self::Table(error) => return error.hint(),
                Self::Wavelength { .. } => "give a file that has both as FILE, without --recipes",
                Self::NoPigments { .. } => "columns of recipes: sample, then optionally reading, film, backing, thickness_mm, then one per pigment",
                Self::Repeated { .. } => "remove one; where a sample was read several times, name each reading in a column `reading`",
                Self::Twice { .. } => "leave out --recipes, or take the columns of pigments out of the measurement file",
                Self::NoneMatched { .. } => "names must be written alike in both; a column `reading` of the recipes may hold those of the measurement file",
            }
            .to_owned(),
        )
    }
}
