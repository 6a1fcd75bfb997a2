//! CGATS.17 and related formats: Argyll .ti3, .sp and .cie, and the text files of GretagMacbeth
//! and X-Rite (Spectrolino, ProfileMaker, i1Profiler), which start with another line.
//!
//! A file has one or more tables. Each consists of keywords, the names of its fields between
//! `BEGIN_DATA_FORMAT` and `END_DATA_FORMAT`, and its rows between `BEGIN_DATA` and `END_DATA`. Fields are the
//! bands of the spectrum and the name of the sample. Tables without spectra are skipped.

use super::decode::{Decimal, lines, number, required_number};
use super::measured::{InstrumentError, MeasuredSpectrum, Role, Unit, stem};
use super::points::{Duplicates, Ordered, Point, ordered};
use super::quantity::MeasuredQuantity;
use crate::headings::{condition, with_condition};

pub(super) fn read(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let mut records = Vec::new();
    let mut table = Table::default();
    let mut part = Part::Keywords;
    let mut last = (1, "");
    for (number, line) in lines(text) {
        if line.trim().is_empty() {
            continue;
        }
        last = (number, line);
        let cells = words(line);
        let Some(first) = cells.first() else { continue };
        match (part, first.as_str()) {
            (Part::Keywords, "BEGIN_DATA_FORMAT") => {
                // A second table need not repeat the keywords.
                table.names.clear();
                part = Part::Names;
            }
            (Part::Names, "END_DATA_FORMAT") | (Part::Rows, "END_DATA") => {
                if part == Part::Rows {
                    records.extend(table.take(file, number)?);
                }
                part = Part::Keywords;
            }
            (Part::Keywords, "BEGIN_DATA") => {
                table.fields = Some(Fields::of(file, &table.names, &table.keywords)?);
                part = Part::Rows;
            }
            (Part::Names, _) => table.names.extend(named(number, line, cells)),
            (Part::Rows, _) => table.push(file, number, line, cells)?,
            (Part::Keywords, _) => {
                let value = cells.get(1).cloned().unwrap_or_default();
                table.keywords.push((number, first.clone(), value));
            }
        }
    }
    match part {
        Part::Keywords => Ok(records),
        Part::Names | Part::Rows => {
            let expected = if part == Part::Names { "END_DATA_FORMAT" } else { "END_DATA" };
            Err(InstrumentError::line(file, last.0, expected, last.1))
        }
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Part {
    Keywords,
    Names,
    Rows,
}

/// Splits a line into names of fields, at tabs if it contains any, otherwise at blanks.
fn named(number: usize, line: &str, words: Vec<String>) -> Vec<Cell> {
    if line.contains('\t') {
        let cells = line.trim().split('\t').map(|cell| cell.trim().trim_matches('"'));
        cells.filter(|cell| !cell.is_empty()).map(|cell| (number, cell.to_owned())).collect()
    } else {
        words.into_iter().map(|word| (number, word)).collect()
    }
}

#[derive(Default)]
struct Table {
    /// Line, keyword and value of each keyword so far.
    keywords: Vec<(usize, String, String)>,
    names: Vec<Cell>,
    fields: Option<Fields>,
    rows: Vec<Vec<Cell>>,
    /// Cells of a row that continues in the next line.
    open: Vec<Cell>,
}

impl Table {
    fn push(
        &mut self,
        file: &str,
        number: usize,
        line: &str,
        words: Vec<String>,
    ) -> Result<(), InstrumentError> {
        let width = self.names.len();
        // Names may contain spaces without quotes if tabs separate the cells.
        let tabs: Vec<&str> = line.trim_end().split('\t').collect();
        if self.open.is_empty() && tabs.len() == width && width > 1 {
            self.rows.push(
                tabs.into_iter()
                    .map(|cell| (number, cell.trim().trim_matches('"').to_owned()))
                    .collect(),
            );
            return Ok(());
        }
        self.open.extend(words.into_iter().map(|word| (number, word)));
        if self.open.len() > width {
            let expected = "as many cells as BEGIN_DATA_FORMAT names";
            return Err(InstrumentError::line(file, number, expected, line));
        }
        if self.open.len() == width {
            self.rows.push(std::mem::take(&mut self.open));
        }
        Ok(())
    }

    /// Returns the spectra of the table, which ends in line `end`, and resets it for the next.
    fn take(&mut self, file: &str, end: usize) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
        let table = std::mem::take(self);
        if let Some((line, cell)) = table.open.first() {
            let expected = "as many cells as BEGIN_DATA_FORMAT names";
            return Err(InstrumentError::line(file, *line, expected, cell));
        }
        let stated_count = table.keyword("NUMBER_OF_SETS").and_then(|sets| sets.parse().ok());
        let found = table.rows.len();
        if let Some(expected) = stated_count.filter(|sets| *sets != found) {
            let file = file.to_owned();
            let what = "rows (NUMBER_OF_SETS)";
            return Err(InstrumentError::Count { file, line: end, what, expected, found });
        }
        let Some(fields) = table.fields.as_ref().filter(|fields| fields.has_spectra()) else {
            return Ok(Vec::new());
        };
        let quantity = table.quantity();
        let details: Vec<(String, String)> = table
            .keywords
            .iter()
            .filter(|(_, key, value)| {
                key != "KEYWORD" && !key.starts_with("NUMBER_OF_") && !value.is_empty()
            })
            .map(|(_, key, value)| (key.clone(), value.clone()))
            .collect();
        let names = fields.names(&table.rows, &stem(file));
        let records = table.rows.iter().zip(names).map(|(row, name)| {
            let (ordered, unit) = fields.spectrum(file, row, quantity)?;
            Ok(MeasuredSpectrum {
                name,
                quantity,
                role: Role::Main,
                unit,
                wavelengths_nm: ordered.wavelengths_nm,
                values: ordered.values,
                line: row.first().map_or(end, |(line, _)| *line),
                point_lines: ordered.lines,
                details: details.clone(),
                remarks: ordered.remarks,
            })
        });
        records.collect()
    }

    fn keyword(&self, name: &str) -> Option<&str> {
        let found = self.keywords.iter().find(|(_, key, _)| key.eq_ignore_ascii_case(name));
        found.map(|(_, _, value)| value.as_str())
    }

    fn quantity(&self) -> MeasuredQuantity {
        use MeasuredQuantity::{Power, Reflectance, Transmittance, Unstated};
        let words = ["QUANTITY", "MEAS_TYPE", "MEASUREMENT_TYPE"];
        for value in words.iter().filter_map(|key| self.keyword(key)) {
            let upper = value.to_ascii_uppercase();
            if ["EMISSION", "AMBIENT", "AMBIENT_FLASH", "EMISSION_FLASH"].contains(&upper.as_str())
            {
                return Power;
            } else if upper.starts_with("REFLECTI") {
                return Reflectance;
            } else if upper.starts_with("TRANSMI") {
                return Transmittance;
            }
            let quantity = MeasuredQuantity::of_words(value);
            if quantity != Unstated {
                return quantity;
            }
        }
        match self.keyword("DEVICE_CLASS") {
            Some(class) if class.starts_with("DISPLAY") => return Power,
            // A printer's or a scanner's target.
            Some("OUTPUT" | "INPUT") => return Reflectance,
            _ => {}
        }
        // Argyll's samples of a display's light begin with this word.
        if self.keyword("CCSS").is_some() {
            return Power;
        }
        if self
            .keyword("DESCRIPTOR")
            .is_some_and(|text: &str| text.to_ascii_lowercase().contains("spectral power"))
        {
            Power
        } else {
            Unstated
        }
    }
}

/// Where the file gives the wavelength of a value.
#[derive(Clone, Copy, PartialEq)]
enum WavelengthSource {
    /// In the name of the value's field, e.g. `SPEC_400`, in nm.
    Nm(f64),
    /// In the field `SPECTRAL_NM`, just before the field of the value.
    FieldBefore,
}

/// The fields of a table, by column.
pub(super) struct Fields {
    /// Column of each spectral value, with the source of its wavelength.
    values: Vec<(usize, WavelengthSource)>,
    unit: Unit,
    /// Value of a perfect white, if the file states it (keyword SPECTRAL_NORM).
    norm: Option<f64>,
    name: Option<usize>,
    id: Option<usize>,
    /// Columns of conditions, each with its name.
    conditions: Vec<(usize, String)>,
    remarks: Vec<String>,
}

impl Fields {
    /// Finds the fields by their `names`, each with its line. `keywords` are triples of line,
    /// keyword and value.
    pub(super) fn of(
        file: &str,
        names: &[Cell],
        keywords: &[(usize, String, String)],
    ) -> Result<Self, InstrumentError> {
        let upper: Vec<String> = names.iter().map(|(_, name)| name.to_ascii_uppercase()).collect();
        let mut values: Vec<(usize, WavelengthSource)> = Vec::new();
        let mut unit = Unit::Unstated;
        for (column, name) in upper.iter().enumerate() {
            let follows_nm = column > 0 && upper[column - 1] == "SPECTRAL_NM";
            match wavelength(name) {
                Some(nm) => {
                    if let Some((first, _)) =
                        values.iter().find(|other| other.1 == WavelengthSource::Nm(nm))
                    {
                        let line = names[column].0;
                        let first = names[*first].0;
                        let file = file.to_owned();
                        return Err(InstrumentError::Duplicate { file, line, nm, first });
                    }
                    values.push((column, WavelengthSource::Nm(nm)));
                }
                None if follows_nm => values.push((column, WavelengthSource::FieldBefore)),
                None => continue,
            }
            if name.starts_with("SPECTRAL_PCT") {
                unit = Unit::Percent;
            } else if name.starts_with("SPECTRAL_DEC") {
                unit = Unit::Fraction;
            }
        }
        let keyword_number = |name: &str| {
            let keyword = keywords.iter().find(|(_, key, _)| key.eq_ignore_ascii_case(name))?;
            number(&keyword.2, Decimal::Point)
        };
        let mut fields = Self {
            values,
            unit,
            norm: keyword_number("SPECTRAL_NORM").filter(|norm| *norm > 0.0),
            name: position_of(&upper, &["SAMPLE_NAME", "SAMPLENAME"]),
            id: position_of(&upper, &["SAMPLE_ID", "SAMPLEID", "SAMPLE_LOC"]),
            conditions: names
                .iter()
                .enumerate()
                .filter(|(_, (_, name))| condition(name).is_some())
                .map(|(column, (_, name))| (column, name.clone()))
                .collect(),
            remarks: Vec::new(),
        };
        if let (Some(bands), Some(start), Some(end)) = (
            keyword_number("SPECTRAL_BANDS"),
            keyword_number("SPECTRAL_START_NM"),
            keyword_number("SPECTRAL_END_NM"),
        ) {
            fields.restore_exact_wavelengths(bands, start, end);
        }
        Ok(fields)
    }

    /// Restores the exact wavelengths from the keywords, because Argyll rounds the ones in field
    /// names to whole nm. This changes nothing if keywords and names disagree.
    fn restore_exact_wavelengths(&mut self, bands: f64, start: f64, end: f64) {
        let last = (self.values.len().max(2) - 1) as f64;
        let exact = |index: usize| start + (end - start) * index as f64 / last;
        if self.values.is_empty() {
        } else if bands == self.values.len() as f64 && self.values.iter().enumerate().all(|(index, value): (usize, &(usize, WavelengthSource))| matches!(value.1, WavelengthSource::Nm(nm) if (nm - exact(index)).abs() <= 0.51)) {
            for (index, value) in self.values.iter_mut().enumerate() {
                value.1 = WavelengthSource::Nm(exact(index));
            }
        } else {
            let what = format!(
                "the keywords state {bands} wavelengths from {start} to {end} nm, the names of the fields differ; the names are used"
            );
            self.remarks.push(what);
        }
    }

    pub(super) fn has_spectra(&self) -> bool {
        !self.values.is_empty()
    }

    /// The name of each row: SAMPLE_NAME if it differs between rows, otherwise SAMPLE_ID,
    /// otherwise `stem` with a number. Rows of one name that differ in a condition, such as an angle, are
    /// named by it too.
    pub(super) fn names(&self, rows: &[Vec<Cell>], stem: &str) -> Vec<String> {
        let column = |column: usize| rows.iter().map(move |row| row[column].1.as_str());
        let distinguishing = [self.name, self.id].into_iter().flatten().find(|&index| {
            let all_named = column(index).all(|name| !name.is_empty());
            let differs = rows.len() < 2 || column(index).any(|name| name != rows[0][index].1);
            all_named && differs
        });
        let plain: Vec<String> = match distinguishing {
            Some(index) => column(index).map(str::to_owned).collect(),
            None if rows.len() == 1 => vec![stem.to_owned()],
            None => (1..=rows.len()).map(|row| format!("{stem} {row}")).collect(),
        };
        let mut names = plain.clone();
        for (index, heading) in &self.conditions {
            for (at, name) in names.iter_mut().enumerate() {
                let value = &rows[at][*index].1;
                let mut others = plain.iter().zip(rows).filter(|(other, _)| **other == plain[at]);
                if !value.is_empty() && others.any(|(_, other)| other[*index].1 != *value) {
                    *name = with_condition(name, heading, value);
                }
            }
        }
        names
    }

    pub(super) fn spectrum(
        &self,
        file: &str,
        row: &[Cell],
        quantity: MeasuredQuantity,
    ) -> Result<(Ordered, Unit), InstrumentError> {
        let cells = self.values.iter().map(|(column, _)| row[*column].1.as_str());
        let decimal = Decimal::of(cells);
        let is_light = quantity == MeasuredQuantity::Power;
        let (factor, unit) = match (self.unit, self.norm) {
            _ if is_light => (1.0, Unit::Unstated),
            (Unit::Unstated, Some(1.0)) => (1.0, Unit::Fraction),
            (Unit::Unstated, Some(norm)) => (100.0 / norm, Unit::Percent),
            (unit, _) => (1.0, unit),
        };
        let mut points = Vec::with_capacity(self.values.len());
        for &(column, place) in &self.values {
            let (line, text) = &row[column];
            let value = factor * required_number(file, *line, "a value", text, decimal)?;
            let nm = match place {
                WavelengthSource::Nm(nm) => nm,
                WavelengthSource::FieldBefore => {
                    required_number(file, *line, "a wavelength", &row[column - 1].1, decimal)?
                }
            };
            if !value.is_finite() {
                return Err(InstrumentError::line(file, *line, "a value", text));
            }
            points.push(Point { line: *line, nm, value });
        }
        let mut ordered = ordered(file, points, Duplicates::Refuse)?;
        ordered.remarks.extend(self.remarks.clone());
        if factor != 1.0 {
            let what = format!("SPECTRAL_NORM: values multiplied by {factor} to give percent");
            ordered.remarks.push(what);
        }
        Ok((ordered, unit))
    }
}

fn position_of(upper: &[String], names: &[&str]) -> Option<usize> {
    upper.iter().position(|name| names.contains(&name.as_str()))
}

/// The wavelength in nm in the name of a field: `SPECTRAL_NM_400`, `SPECTRAL_NM400`,
/// `SPEC_400`, `SPECTRAL_PCT_400`, `nm400`, `400nm`, `R400`, `400`.
fn wavelength(upper: &str) -> Option<f64> {
    let bare = ["SPECTRAL_NM", "SPECTRAL_PCT", "SPECTRAL_DEC", "SPECTRAL", "SPEC", "NM", "R"]
        .iter()
        .find_map(|prefix| upper.strip_prefix(prefix))
        .unwrap_or(upper);
    let bare = bare.strip_prefix('_').unwrap_or(bare);
    let bare = bare.strip_suffix("NM").unwrap_or(bare);
    let nm = number(bare, Decimal::Point)?;
    (100.0..=5000.0).contains(&nm).then_some(nm)
}

/// Line number (from 1) and text of a cell.
pub(super) type Cell = (usize, String);

/// The words of a line, separated by blanks. Quotes around a word are removed, `""` inside
/// quotes stands for a quote, and a comment from `#` on is dropped.
pub(super) fn words(line: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut characters = line.chars().peekable();
    while let Some(&first) = characters.peek() {
        if first.is_whitespace() {
            characters.next();
            continue;
        }
        if first == '#' {
            break;
        }
        let mut text = String::new();
        if first == '"' {
            characters.next();
            while let Some(c) = characters.next() {
                if c != '"' {
                    text.push(c);
                } else if characters.next_if_eq(&'"').is_some() {
                    text.push('"');
                } else {
                    break;
                }
            }
        } else {
            while let Some(c) = characters.next_if(|c| !c.is_whitespace()) {
                text.push(c);
            }
        }
        found.push(text);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::measured::Unit;
    use super::*;

    const FILE: &str = "CGATS.17\nORIGINATOR \"x # y\" # z\nINSTRUMENTATION \"I1\"\n\
        NUMBER_OF_FIELDS 4\nBEGIN_DATA_FORMAT\nSAMPLE_ID SAMPLE_NAME SPECTRAL_NM400\nSPECTRAL_NM410\n\
        END_DATA_FORMAT\nNUMBER_OF_SETS 2\nBEGIN_DATA\n1 \"dark \"\"skin\"\"\" 0.1\n 0.2\n\
        2 white 0.8 0.9\nEND_DATA\n";

    #[test]
    fn quoted_words_comments_and_rows_of_two_lines_are_read() {
        let found = read("f", FILE).unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!((found[0].name.as_str(), found[0].line), ("dark \"skin\"", 11));
        assert_eq!(
            (&found[0].wavelengths_nm, &found[0].values),
            (&vec![400.0, 410.0], &vec![0.1, 0.2])
        );
        assert_eq!(found[0].details[0], ("ORIGINATOR".to_owned(), "x # y".to_owned()));
        assert_eq!((found[1].name.as_str(), &found[1].values), ("white", &vec![0.8, 0.9]));
        assert_eq!(
            (found[1].quantity, found[1].unit),
            (MeasuredQuantity::Unstated, Unit::Unstated)
        );
    }

    #[test]
    fn comments_within_the_data_are_dropped() {
        let text = FILE
            .replace("BEGIN_DATA\n1", "BEGIN_DATA\n# 9 nine 0.9 0.9\n1")
            .replace("0.1\n 0.2", "0.1 # of two\n# 7\n 0.2")
            .replace("0.8 0.9", "0.8 0.9 # 1.0");
        assert_eq!(text.matches('#').count(), FILE.matches('#').count() + 4, "{text}");
        let values = |text: &str| -> Vec<(String, Vec<f64>)> {
            let found = read("f", text).unwrap();
            found.into_iter().map(|record| (record.name, record.values)).collect()
        };
        assert_eq!(values(&text), values(FILE));
        // Within a word or quotes it is no comment.
        let named = FILE.replace("white", "\"white # 2\"").replace("skin", "skin#3");
        let names: Vec<String> = values(&named).into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, ["dark \"skin#3\"", "white # 2"]);
    }

    #[test]
    fn rows_of_one_name_are_told_apart_by_their_angle() {
        let text = "CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_NAME ANGLE SPECTRAL_NM400 SPECTRAL_NM410\n\
            END_DATA_FORMAT\nBEGIN_DATA\nRed 15 0.1 0.1\nRed 45 0.2 0.2\nBlue 15 0.3 0.3\nEND_DATA\n";
        let found = read("f", text).unwrap();
        let names: Vec<&str> = found.iter().map(|record| record.name.as_str()).collect();
        assert_eq!(names, ["Red ANGLE 15", "Red ANGLE 45", "Blue"]);
    }

    #[test]
    fn several_tables_and_names_with_spaces_between_tabs() {
        let text = format!(
            "CTI3\nBEGIN_DATA_FORMAT\nSAMPLE_ID RGB_R\nEND_DATA_FORMAT\nBEGIN_DATA\n1 5\nEND_DATA\n\
             LGOROWLENGTH\t10\r\nBEGIN_DATA_FORMAT\r\nSampleID\tSAMPLE_NAME\tnm400\tnm410\r\n\
             END_DATA_FORMAT\r\nBEGIN_DATA\r\n1\tlight skin\t0,5\t0,6\r\nEND_DATA\r\n{FILE}"
        );
        let found = read("f", &text).unwrap();
        let names: Vec<&str> = found.iter().map(|record| record.name.as_str()).collect();
        assert_eq!(names, ["light skin", "dark \"skin\"", "white"]);
        assert_eq!(found[0].values, [0.5, 0.6]);
    }

    #[test]
    fn keywords_give_the_measured_quantity() {
        for (keyword, quantity) in [
            ("QUANTITY \"reflectance\"", MeasuredQuantity::Reflectance),
            ("MEAS_TYPE \"EMISSION\"", MeasuredQuantity::Power),
            ("MEAS_TYPE \"TRANSMISSIVE\"", MeasuredQuantity::Transmittance),
            ("DEVICE_CLASS \"DISPLAY\"", MeasuredQuantity::Power),
            ("DEVICE_CLASS \"OUTPUT\"", MeasuredQuantity::Reflectance),
            ("CCSS", MeasuredQuantity::Power),
            ("DESCRIPTOR \"Argyll Spectral Power of F8\"", MeasuredQuantity::Power),
        ] {
            let found = read("f", &FILE.replace("CGATS.17", keyword)).unwrap();
            assert_eq!(found[0].quantity, quantity, "{keyword}");
        }
    }

    #[test]
    fn faults_name_their_line() {
        for (old, new, at) in [
            ("0.8 0.9", "0.8 nan", 13),
            ("0.8 0.9", "0.8 0.9 1.0", 13),
            ("white 0.8 0.9\nEND_DATA\n", "white 0.8", 13),
            ("2 white 0.8 0.9", "2 white 0.8", 13),
            ("NUMBER_OF_SETS 2", "NUMBER_OF_SETS 3", 14),
            ("SPECTRAL_NM410", "SPECTRAL_NM400", 7),
        ] {
            let found = read("f", &FILE.replace(old, new));
            let line = match found {
                Err(
                    InstrumentError::Line { line, .. }
                    | InstrumentError::Count { line, .. }
                    | InstrumentError::Duplicate { line, .. },
                ) => line,
                other => panic!("{other:?}"),
            };
            assert_eq!(line, at, "{new}");
        }
    }

    #[test]
    fn wavelengths_rounded_by_argyll_are_restored() {
        let found = &read("a/Red.sp", &argyll("390.0")).unwrap()[0];
        assert_eq!(found.wavelengths_nm[1], 380.0 + 10.0 / 3.0);
        assert_eq!((found.name.as_str(), found.unit), ("Red", Unit::Percent));
        assert_eq!(found.values, [20.0, 40.0, 60.0, 80.0]);
        let stale = &read("a/Red.sp", &argyll("700.0")).unwrap()[0];
        assert_eq!(stale.wavelengths_nm[1], 383.0);
        assert!(stale.remarks[0].contains("700"), "{:?}", stale.remarks);
    }

    fn argyll(end: &str) -> String {
        format!(
            "SPECT\nSPECTRAL_BANDS \"4\"\nSPECTRAL_START_NM \"380.0\"\nSPECTRAL_END_NM \"{end}\"\n\
                 SPECTRAL_NORM \"50\"\nBEGIN_DATA_FORMAT\nSPEC_380 SPEC_383 SPEC_387 SPEC_390\n\
                 END_DATA_FORMAT\nBEGIN_DATA\n10 20 30 40\nEND_DATA\n"
        )
    }

    #[test]
    fn wavelengths_in_the_field_before_their_values_are_read() {
        let text = "CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPECTRAL_NM SPECTRAL_PCT SPECTRAL_NM SPECTRAL_PCT\n\
            END_DATA_FORMAT\nBEGIN_DATA\nA 400 10,5 410 20\nEND_DATA\n";
        let found = &read("f", text).unwrap()[0];
        assert_eq!(
            (&found.wavelengths_nm, &found.values),
            (&vec![400.0, 410.0], &vec![10.5, 20.0])
        );
        assert_eq!((found.name.as_str(), found.unit), ("A", Unit::Percent));
    }

    #[test]
    fn wavelengths_are_read_in_every_spelling() {
        for name in [
            "SPECTRAL_NM_400",
            "SPECTRAL_NM400",
            "SPEC_400",
            "SPECTRAL_PCT_400",
            "NM400",
            "400NM",
            "R400",
            "400.0",
        ] {
            assert_eq!(wavelength(name), Some(400.0), "{name}");
        }
        for name in ["SPECTRAL_NM", "SAMPLE_ID", "RGB_R", "LAB_L", "NM1", "D50"] {
            assert_eq!(wavelength(name), None, "{name}");
        }
    }
}
