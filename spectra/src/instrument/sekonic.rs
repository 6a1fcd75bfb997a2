//! CSV files of Sekonic's light spectrometers (C-700, C-800, C-7000): rows of a key and a
//! value, with the spectrum once at 5 nm and once at 1 nm. A file of several readings has a
//! column for each.

use super::error::InstrumentError;
use super::measured::{MeasuredQuantity, MeasuredSpectrum, Role, Unit, stem};
use super::number::{Decimal, required_number};
use super::points::{Duplicates, Point, ordered};
use super::text::lines;

/// Start of a line of the spectrum: `Spectral Data 380[nm],0.001`.
const SPECTRAL: &str = "Spectral Data";

/// The readings of a Sekonic file, each at the finest step of the file.
pub(super) fn read(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let head =
        lines(text).find(|(_, line)| line.starts_with(SPECTRAL)).map_or("", |(_, line)| line);
    let separator = [';', '\t', ','].into_iter().find(|&c| head.contains(c)).unwrap_or(',');
    let decimal =
        if separator != ',' && head.contains(',') { Decimal::Comma } else { Decimal::Point };
    let mut details: Vec<(String, Vec<String>)> = Vec::new();
    let mut tables: Vec<Vec<Row>> = Vec::new();
    let mut last_nm = f64::INFINITY;
    for (line, text) in lines(text) {
        let mut cells = text.split(separator).map(|cell| cell.trim().trim_matches('"'));
        let Some(key) = cells.next().filter(|key| !key.is_empty()) else { continue };
        let Some(nm) = key.strip_prefix(SPECTRAL) else {
            details.push((key.to_owned(), cells.map(str::to_owned).collect()));
            continue;
        };
        let nm = nm.trim().trim_end_matches("[nm]");
        let nm = required_number(file, line, "a wavelength in nm", nm, Decimal::Point)?;
        let values = cells
            .map(|cell| required_number(file, line, "a number", cell, decimal))
            .collect::<Result<Vec<f64>, _>>()?;
        // A smaller wavelength starts the next table.
        if nm < last_nm {
            tables.push(Vec::new());
        }
        last_nm = nm;
        if let Some(table) = tables.last_mut() {
            table.push(Row { line, nm, values });
        }
    }
    // The table with the most rows; the first of several.
    let finest = tables.into_iter().rev().max_by_key(Vec::len).unwrap_or_default();
    let Some(first) = finest.first() else { return Ok(Vec::new()) };
    (0..first.values.len()).map(|column| spectrum(file, column, &finest, &details)).collect()
}

struct Row {
    line: usize,
    nm: f64,
    values: Vec<f64>,
}

fn spectrum(
    file: &str,
    column: usize,
    rows: &[Row],
    details: &[(String, Vec<String>)],
) -> Result<MeasuredSpectrum, InstrumentError> {
    let mut points = Vec::new();
    for row in rows {
        let line = row.line;
        let nm = row.nm;
        let value = *row
            .values
            .get(column)
            .ok_or_else(|| InstrumentError::line(file, line, "a value for every reading", ""))?;
        points.push(Point { line, nm, value });
    }
    let ordered = ordered(file, points, Duplicates::Refuse)?;
    let detail = |(key, values): &(String, Vec<String>)| {
        Some((key.clone(), values.get(column).filter(|value| !value.is_empty())?.clone()))
    };
    let details: Vec<(String, String)> = details.iter().filter_map(detail).collect();
    let title = details.iter().find(|(key, _)| key == "Title").map(|(_, title)| title.clone());
    Ok(MeasuredSpectrum {
        name: title.unwrap_or_else(|| stem(file)),
        quantity: MeasuredQuantity::Power,
        role: Role::Main,
        unit: Unit::Unstated,
        wavelengths_nm: ordered.wavelengths_nm,
        values: ordered.values,
        line: rows.first().map_or(1, |row| row.line),
        details,
        remarks: ordered.remarks,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "Date Saved,1/2/2021\nTitle,lamp one,lamp two\nTcp [K],3000,4000\n\n\
                        Spectral Data 380[nm],1,2\nSpectral Data 385[nm],3,4\n\n\
                        Spectral Data 380[nm],1,2\nSpectral Data 381[nm],1.5,2\n\
                        Spectral Data 385[nm],3,4\n\nPeak,1\n";

    #[test]
    fn the_finest_table_is_taken_for_every_reading() {
        let records = read("f", FILE).unwrap();
        let names: Vec<_> = records.iter().map(|record| record.name.as_str()).collect();
        assert_eq!(names, ["lamp one", "lamp two"]);
        assert_eq!(records[0].wavelengths_nm, [380.0, 381.0, 385.0]);
        assert_eq!(records[0].values, [1.0, 1.5, 3.0]);
        assert_eq!(records[1].values, [2.0, 2.0, 4.0]);
        assert_eq!(records[1].details[1], ("Tcp [K]".to_owned(), "4000".to_owned()));
        assert_eq!((records[0].line, records[0].quantity), (8, MeasuredQuantity::Power));
    }

    #[test]
    fn decimal_commas_are_read_between_semicolons() {
        let records = read("a/lamp.csv", "Spectral Data 380[nm];0,5\nSpectral Data 385[nm];1\n");
        let records = records.unwrap();
        assert_eq!(
            (records[0].values.as_slice(), records[0].name.as_str()),
            (&[0.5, 1.0][..], "lamp")
        );
    }

    #[test]
    fn faults_name_the_line() {
        for (text, fault) in [
            ("Spectral Data 380[nm],x\n", "f, line 1: expected a number, found `x`"),
            ("\nSpectral Data 3x0[nm],1\n", "f, line 2: expected a wavelength in nm, found `3x0`"),
            (
                "Spectral Data 380[nm],1,2\nSpectral Data 385[nm],1\n",
                "f, line 2: expected a value for every",
            ),
            ("Spectral Data 380[nm],1\nSpectral Data 380[nm],2\n", "f, line 2: the wavelength 380"),
        ] {
            let error = read("f", text).unwrap_err().to_string();
            assert!(error.starts_with(fault), "{error}");
        }
        assert_eq!(read("f", "Title,x\n").unwrap(), []);
    }
}
