//! The fields of a CGATS table: the columns of the spectrum and of the sample's name.

use super::cgats_words::Cell;
use super::error::InstrumentError;
use super::measured::{MeasuredQuantity, Unit};
use super::number::{Decimal, number, required_number};
use super::points::{Duplicates, Ordered, Point, ordered};

/// Where the wavelength of a value is given.
#[derive(Clone, Copy, PartialEq)]
enum WavelengthSource {
    /// In the name of the value's field, in nm.
    Nm(f64),
    /// In the field before the value's.
    FieldBefore,
}

/// The fields of a table, by column.
pub(super) struct Fields {
    /// Column of each spectral value, with the source of its wavelength.
    values: Vec<(usize, WavelengthSource)>,
    unit: Unit,
    /// Value of a perfect white (keyword SPECTRAL_NORM), if the file states it.
    norm: Option<f64>,
    name: Option<usize>,
    id: Option<usize>,
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
                        values.iter().find(|other: &&(usize, WavelengthSource)| {
                            other.1 == WavelengthSource::Nm(nm)
                        })
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
        let found = |names: &[&str]| upper.iter().position(|name| names.contains(&name.as_str()));
        let keyword_number = |name: &str| {
            let keyword = keywords.iter().find(|(_, key, _)| key.eq_ignore_ascii_case(name))?;
            number(&keyword.2, Decimal::Point)
        };
        let mut fields = Self {
            values,
            unit,
            norm: keyword_number("SPECTRAL_NORM").filter(|norm| *norm > 0.0),
            name: found(&["SAMPLE_NAME", "SAMPLENAME"]),
            id: found(&["SAMPLE_ID", "SAMPLEID", "SAMPLE_LOC"]),
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

    /// Argyll rounds the wavelengths in field names to whole nm. Restores the exact ones from
    /// the keywords if these agree with the names.
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
    /// otherwise `stem` with a number.
    pub(super) fn names(&self, rows: &[Vec<Cell>], stem: &str) -> Vec<String> {
        let column = |column: usize| rows.iter().map(move |row| row[column].1.as_str());
        let distinguishes = |&index: &usize| {
            let all_named = column(index).all(|name| !name.is_empty());
            let differs = rows.len() < 2 || column(index).any(|name| name != rows[0][index].1);
            all_named && differs
        };
        match self.name.filter(distinguishes).or(self.id.filter(distinguishes)) {
            Some(index) => column(index).map(str::to_owned).collect(),
            None if rows.len() == 1 => vec![stem.to_owned()],
            None => (1..=rows.len()).map(|row| format!("{stem} {row}")).collect(),
        }
    }

    /// Reads the spectrum of one row, with its unit.
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

#[cfg(test)]
mod tests {
    use super::*;

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
