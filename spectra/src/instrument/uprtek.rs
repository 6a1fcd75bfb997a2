//! Light meters of UPRtek and the LI-COR LI-180: rows of a key and a value between tabs, with rows
//! such as `380nm 0.0303` for the spectrum. UPRtek gives such files the ending `.xls`.

use super::error::InstrumentError;
use super::measured::{MeasuredQuantity, MeasuredSpectrum, Role, Unit, stem};
use super::number::{Decimal, number, required_number};
use super::points::{Duplicates, Point, ordered};
use super::text::lines;

/// Key of a row and the rest of it.
fn key_and_value(line: &str) -> Option<(&str, &str)> {
    let (key, value) = line.split_once(['\t', ';']).or_else(|| line.split_once(','))?;
    Some((key.trim().trim_matches('"'), value))
}

/// The wavelength in the key of a row, such as `380nm`.
fn wavelength(key: &str) -> Option<f64> {
    number(key.strip_suffix("nm")?, Decimal::Point).filter(|nm| (100.0..=5000.0).contains(nm))
}

/// Keys of figures that stand beside the spectrum of a light.
const OF_A_LIGHT: [&str; 6] = ["Model Name", "LUX", "CCT", "PPFD", "LambdaP", "IRR"];

/// Whether a text has such rows, and figures of a light.
pub(super) fn is_text(text: &str) -> bool {
    let rows = || lines(text).filter_map(|(_, line)| key_and_value(line));
    let wavelengths = rows().filter(|(key, _)| wavelength(key).is_some()).take(2).count();
    wavelengths == 2 && rows().any(|(key, _)| OF_A_LIGHT.contains(&key))
}

/// The readings of a file, each in a column: the power of a light.
pub(super) fn read(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let mut details: Vec<(String, Vec<&str>)> = Vec::new();
    let mut tables: Vec<Vec<(usize, f64, Vec<&str>)>> = Vec::new();
    let mut last_nm = f64::INFINITY;
    for (line, text) in lines(text) {
        let Some((key, value)) = key_and_value(text) else { continue };
        let comma = !text.contains(['\t', ';']);
        let cells = value.split(|c| c == '\t' || c == ';' || (comma && c == ','));
        let cells: Vec<&str> = cells.map(|cell| cell.trim().trim_matches('"')).collect();
        let kept = cells.iter().rposition(|cell| !cell.is_empty()).map_or(0, |last| last + 1);
        let cells = cells[..kept].to_vec();
        let Some(nm) = wavelength(key) else {
            details.push((key.to_owned(), cells));
            continue;
        };
        // A smaller wavelength starts the next table.
        if nm < last_nm {
            tables.push(Vec::new());
        }
        last_nm = nm;
        if let Some(table) = tables.last_mut() {
            table.push((line, nm, cells));
        }
    }
    let finest = tables.into_iter().max_by_key(Vec::len).unwrap_or_default();
    let Some((first_line, _, first)) = finest.first() else { return Ok(Vec::new()) };
    let decimal = Decimal::of(finest.iter().flat_map(|(_, _, cells)| cells.iter().copied()));
    let mut records = Vec::new();
    for column in 0..first.len().max(1) {
        let points = finest
            .iter()
            .map(|(line, nm, cells): &(usize, f64, Vec<&str>)| {
                let cell = cells.get(column).copied().unwrap_or_default();
                let value =
                    required_number(file, *line, "a value for every reading", cell, decimal)?;
                Ok(Point { line: *line, nm: *nm, value })
            })
            .collect::<Result<Vec<Point>, InstrumentError>>()?;
        let ordered = ordered(file, points, Duplicates::Refuse)?;
        let name = stem(file);
        records.push(MeasuredSpectrum {
            name: if first.len() > 1 { format!("{name} {}", column + 1) } else { name },
            quantity: MeasuredQuantity::Power,
            role: Role::Main,
            unit: Unit::Unstated,
            wavelengths_nm: ordered.wavelengths_nm,
            values: ordered.values,
            line: *first_line,
            details: details
                .iter()
                .filter_map(|(key, cells): &(String, Vec<&str>)| {
                    Some((key.clone(), (*cells.get(column)?).to_owned()))
                })
                .collect(),
            remarks: ordered.remarks,
        });
    }
    Ok(records)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "Model Name\tLI-180\nTime\t2021/03/02_09:24:26\nPFD-R\t49.5\nI-Time\t92.0\n\
                        380nm\t27.5\n381nm\t28.5\n382nm\t29\nCCT\t5465\n";

    #[test]
    fn rows_of_wavelengths_are_the_power_of_a_light() {
        assert!(is_text(FILE) && !is_text("Model Name\tLI-180\n380nm\t1\n"));
        assert!(!is_text("nm,reflectance\n380nm,1\n381nm,1\n"), "no light");
        let found = &read("a/sky.txt", FILE).unwrap()[0];
        assert_eq!((found.name.as_str(), found.line), ("sky", 5));
        assert_eq!(
            (&found.wavelengths_nm, &found.values),
            (&vec![380.0, 381.0, 382.0], &vec![27.5, 28.5, 29.0])
        );
        assert_eq!(found.quantity, MeasuredQuantity::Power);
        assert_eq!(found.details[0], ("Model Name".to_owned(), "LI-180".to_owned()));
        let commas = FILE.replace(".5", ",5");
        assert_eq!(read("f", &commas).unwrap()[0].values, [27.5, 28.5, 29.0]);
        let csv = FILE.replace('\t', ",");
        assert_eq!(read("f", &csv).unwrap()[0].values, [27.5, 28.5, 29.0]);
        let two = read(
            "f",
            &FILE.replace("7.5", "7.5\t1").replace("8.5", "8.5\t2").replace("\t29", "\t29\t3"),
        );
        assert_eq!(two.unwrap()[1].values, [1.0, 2.0, 3.0]);
    }

    #[test]
    fn faults_name_their_line() {
        for (old, new, at) in [("28.5", "x", 6), ("\t28.5", "\t", 6), ("381nm", "380nm", 6)] {
            let found = read("f", &FILE.replace(old, new));
            let Err(InstrumentError::Line { line, .. } | InstrumentError::Duplicate { line, .. }) =
                found
            else {
                panic!("{found:?}")
            };
            assert_eq!(line, at, "{new}");
        }
    }
}
