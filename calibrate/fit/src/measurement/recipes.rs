//! Recipes in a file of their own. We join them to the readings by the names of samples.

use std::collections::BTreeMap;

use documents::hint::Explain;
use documents::{counted, name_list};

use super::column::{Column, TableKind};
use super::conditions::{name_by_file, tells_of_means};
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
    /// column `reading` holds the name of each reading in the measurement file. You may also pass the empty
    /// form of a plan: we ignore wavelengths without readings.
    ///
    /// # Errors
    /// [`RecipesError`] with the row.
    pub fn from_csv(
        file: &str,
        bytes: &[u8],
        pigments: Option<&[String]>,
    ) -> Result<Self, RecipesError> {
        let mut table_rows = CsvRows::open(file, bytes, TableKind::Recipes, pigments)?;
        table_rows.ignore_empty_wavelengths();
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
        let has_replicates = position(Column::Replicate).is_some();
        let mut rows: Vec<(String, Reading)> = Vec::new();
        let mut places: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (cells, row) in table_rows.rows.iter().zip(table_rows.readings()?) {
            let named =
                reading.and_then(|index| cells.cells.get(index)).filter(|name| !name.is_empty());
            let key = named.unwrap_or(&row.sample).to_owned();
            let before = places.entry(key.clone()).or_default();
            // Rows of one sample may stand for its readings, if they hold one recipe.
            let is_another = |other: &Reading| {
                other.amounts == row.amounts && (has_replicates || !is_same_film(other, &row))
            };
            if let Some(&first) =
                before.iter().find(|&&at| named.is_some() || !is_another(&rows[at].1))
            {
                return Err(RecipesError::Repeated {
                    file: file.to_owned(),
                    name: key,
                    first: rows[first].1.row,
                    second: row.row,
                });
            }
            before.push(rows.len());
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
        let mut by_name: BTreeMap<&str, RecipeRows<'_>> = BTreeMap::new();
        for (name, row) in &self.rows {
            by_name.entry(name).or_default().rows.push(row);
        }
        let mut table = table;
        table.remarks.retain(|remark| !tells_of_means(remark));
        name_by_file(&mut table, |name| by_name.contains_key(name));
        for reading in &table.readings {
            if let Some(rows) = by_name.get_mut(reading.sample.as_str()) {
                rows.readings += 1;
                rows.without_backing += usize::from(reading.backing.is_empty());
            }
        }
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
        let unread = distinct(self.rows.iter().map(|(name, _)| name.as_str()));
        let unread: Vec<String> = unread.into_iter().filter(|name| !known.contains(name)).collect();
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
        let in_order: Vec<&str> =
            by_name.iter().filter(|(_, rows)| rows.is_in_order()).map(|(name, _)| *name).collect();
        if !in_order.is_empty() {
            remarks.push(format!(
                "{}: readings of one name are joined to its rows in the order of the files: {}",
                self.file,
                name_list(&in_order, NAMES, ", ")
            ));
        }
        let mut readings: Vec<Reading> = Vec::new();
        for reading in table.readings {
            let Some(rows) = by_name.get_mut(reading.sample.as_str()) else {
                if reading.film == Film::None {
                    let amounts = vec![0.0; self.pigments.len()].into();
                    readings.push(Reading { amounts, ..reading });
                }
                continue;
            };
            let Some(row) = rows.next_of(&reading) else {
                return Err(RecipesError::Ambiguous {
                    file: self.file.clone(),
                    name: reading.sample,
                    rows: rows.rows.len(),
                    readings: rows.readings,
                });
            };
            readings.push(Reading {
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
            });
        }
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

/// Rows of one name, and the number of readings of this name.
#[derive(Default)]
struct RecipeRows<'a> {
    rows: Vec<&'a Reading>,
    readings: usize,
    /// Number of readings that state no backing.
    without_backing: usize,
    /// Number of readings that have a row.
    joined: usize,
}

impl<'a> RecipeRows<'a> {
    /// Whether only the order tells which row a reading belongs to.
    fn is_in_order(&self) -> bool {
        self.without_backing == self.rows.len()
            && self.readings == self.rows.len()
            && !are_alike(&self.rows)
    }

    /// The row of `reading`. `None` if several rows may be meant.
    fn next_of(&mut self, reading: &Reading) -> Option<&'a Reading> {
        let at = self.joined;
        self.joined += 1;
        if are_alike(&self.rows) {
            return self.rows.first().copied();
        }
        if self.is_in_order() {
            return self.rows.get(at).copied();
        }
        let states_backing = !reading.backing.is_empty();
        let is_of_film = |row: &&&Reading| {
            !states_backing || (row.film == reading.film && row.backing == reading.backing)
        };
        let of_film: Vec<&Reading> = self.rows.iter().filter(is_of_film).copied().collect();
        of_film.first().copied().filter(|_| are_alike(&of_film))
    }
}

fn are_alike(rows: &[&Reading]) -> bool {
    rows.windows(2).all(|pair| is_same_film(pair[0], pair[1]))
}

fn is_same_film(a: &Reading, b: &Reading) -> bool {
    (a.film, &a.backing, a.thickness_mm) == (b.film, &b.backing, b.thickness_mm)
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
    /// A name has several rows, and we cannot tell which of them its readings belong to.
    #[error(
        "{file}: `{name}` has {} of different films, but {} in the measurement file",
        counted(*rows, "row"),
        counted(*readings, "reading")
    )]
    #[hint(
        "give each reading a name of its own, and write it in a column `reading` of the recipes, as the recipes file of a plan has it"
    )]
    Ambiguous {
        /// File name as the caller gave it.
        file: String,
        /// Name of the sample.
        name: String,
        /// Number of rows with this name.
        rows: usize,
        /// Number of readings with this name.
        readings: usize,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measurement::ScaleChoice;

    const FORM: &str = "sample,film,backing,replicate,White,Red,400,500\n\
        card,none,white,1,,,,\ncard,none,black,1,,,,\n\
        w,paint,white,1,10,,,\nw,paint,black,1,10,,,\n\
        r,paint,white,1,2,8,,\nr,paint,black,1,2,8,,\n";

    fn joined(recipes: &str, readings: &str) -> Result<MeasurementTable, RecipesError> {
        let table = MeasurementTable::from_csv("r.csv", readings.as_bytes(), ScaleChoice::ByFile);
        Recipes::from_csv("f.csv", recipes.as_bytes(), None)?.joined_to(table.unwrap())
    }

    fn readings(names: &[&str]) -> String {
        let rows = names.iter().enumerate().map(|(at, name)| format!("{name},0.{},0.5\n", at + 1));
        std::iter::once("sample,400,500\n".to_owned()).chain(rows).collect()
    }

    #[test]
    fn the_empty_form_of_a_plan_is_a_file_of_recipes() {
        let names = ["card", "card", "w", "w", "r", "r"];
        let table = joined(FORM, &readings(&names)).unwrap();
        let films: Vec<(&str, Film, &str)> =
            table.readings.iter().map(|r| (r.sample.as_str(), r.film, &*r.backing)).collect();
        let [bare, paint] = [Film::None, Film::Paint];
        assert_eq!(
            films[..3],
            [("card", bare, "white"), ("card", bare, "black"), ("w", paint, "white")]
        );
        assert_eq!(*table.readings[5].amounts, [2.0, 8.0]);
        assert_eq!(table.remarks.len(), 1, "{:?}", table.remarks);
        assert!(table.remarks[0].contains("order of the files: card, r, w"), "{:?}", table.remarks);
    }

    #[test]
    fn readings_that_state_their_backing_need_no_order() {
        let text = "sample,film,backing,400,500\nr,paint,black,0.1,0.2\nr,paint,white,0.3,0.4\n\
            r,paint,white,0.3,0.5\n";
        let table = joined(FORM, text).unwrap();
        assert_eq!(*table.readings[0].backing, *"black");
        assert_eq!(table.readings.len(), 3);
        // Recipes may leave films and backings to the readings.
        let plain = joined("sample,White,Red\nr,2,8\n", text).unwrap();
        assert_eq!(*plain.readings[0].backing, *"black");
        assert!(
            table.remarks.iter().all(|remark| !remark.contains("order")),
            "{:?}",
            table.remarks
        );
    }

    #[test]
    fn too_few_readings_of_a_name_are_refused() {
        let error = joined(FORM, &readings(&["card", "card", "w", "r", "r"])).unwrap_err();
        assert!(
            matches!(&error, RecipesError::Ambiguous { name, rows: 2, readings: 1, .. } if name == "w")
        );
        assert!(
            error.to_string().contains("`w` has 2 rows of different films, but 1 reading"),
            "{error}"
        );
    }

    #[test]
    fn filled_wavelengths_and_contradictions_are_refused() {
        let filled = FORM.replace("w,paint,white,1,10,,,", "w,paint,white,1,10,,,0.9");
        let error = joined(&filled, &readings(&["w"])).unwrap_err();
        assert!(error.to_string().contains("column `500` is a wavelength"), "{error}");
        for (other, names) in [("2,7", "r"), ("3,8", "r")] {
            let changed = FORM.replace("r,paint,black,1,2,8", &format!("r,paint,black,1,{other}"));
            let error = joined(&changed, &readings(&["r", "r"])).unwrap_err();
            let is_row = |error| matches!(error, RecipesError::Repeated { name, first: 6, second: 7, .. } if name == names);
            assert!(is_row(error));
        }
    }
}
