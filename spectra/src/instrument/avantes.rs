//! Avantes AvaSoft text (.ttt, .trt, .txt): a few lines on the measurement, a line of headings
//! that starts with `Wave`, a line of units that starts with `[nm]`, then rows of numbers.
//!
//! Next to the processed column there may be columns with the counts of sample, dark and
//! reference.

use super::axis::Axis;
use super::columns::{ColumnLabel, below, table};
use super::error::InstrumentError;
use super::measured::{MeasuredQuantity, MeasuredSpectrum, Unit, stem};
use super::text::lines;

pub(super) fn read(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let lines: Vec<(usize, &str)> = lines(text).collect();
    let heading = lines.windows(2).find(|pair| {
        pair[0].1.trim_start().starts_with("Wave") && pair[1].1.trim_start().starts_with("[nm]")
    });
    let Some([(_, headings), (at, units)]) = heading else { return Ok(Vec::new()) };
    let data = below(text, *at);
    let table = table(file, &data)?;
    let Some((row, first)) = table.rows.first() else { return Ok(Vec::new()) };
    let cells = |line: &'_ str| -> Vec<String> {
        line.trim_end().split([';', '\t']).map(|cell| cell.trim().to_owned()).collect()
    };
    let headings = cells(headings);
    let units = cells(units);
    if headings.len() != first.len() || units.len() != first.len() {
        let expected = "a value for every heading";
        let text = lines[row - 1].1;
        return Err(InstrumentError::line(file, *row, expected, text));
    }
    let counts = ["sample", "dark", "reference", "scope"];
    let is_counts = |heading: &String| counts.contains(&heading.to_lowercase().as_str());
    let processed = (1..headings.len()).rev().find(|&column| !is_counts(&headings[column]));
    let sample = (1..headings.len()).find(|&c| headings[c].eq_ignore_ascii_case("sample"));
    let column = processed.or(sample).unwrap_or(1);
    let quantity = if is_counts(&headings[column]) {
        MeasuredQuantity::Counts
    } else {
        MeasuredQuantity::of_words(&format!("{} {}", headings[column], units[column]))
    };
    let unit = if units[column].contains('%') { Unit::Percent } else { Unit::Unstated };
    let label = ColumnLabel { name: stem(file), quantity, unit };
    let mut record = table.spectrum(file, column, Axis::Nanometres, label)?;
    let comments = lines[..*at].iter().filter_map(|(_, line)| line.split_once(':'));
    let plain = |text: &str| text.trim_matches(|c: char| c.is_whitespace() || c == '\0').to_owned();
    record.details = comments.map(|(key, value)| (plain(key), plain(value))).collect();
    Ok(vec![record])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_processed_column_and_its_unit_are_found() {
        let text = "0804016U1-\r\nIntegration time: 100.00 ms\r\nWave   ;Transmittance\r\n\
            [nm]   ;[% transmittance]\r\n300.00;3.5\r\n301.00;4.5\r\n";
        let found = &read("x.ttt", text).unwrap()[0];
        assert_eq!((found.quantity, found.unit), (MeasuredQuantity::Transmittance, Unit::Percent));
        assert_eq!((&found.wavelengths_nm, &found.values), (&vec![300.0, 301.0], &vec![3.5, 4.5]));
        assert_eq!(found.details, [("Integration time".to_owned(), "100.00 ms".to_owned())]);
        let text = "Wave;Sample;Dark;Reference;Reflectance\n[nm];[counts];[counts];[counts];[%]\n\n\
            400,5;10;1;20;47,4\n401,5;11;1;20;52,6\n";
        let found = &read("x.txt", text).unwrap()[0];
        assert_eq!((found.line, &found.values), (4, &vec![47.4, 52.6]));
        assert_eq!((found.quantity, found.unit), (MeasuredQuantity::Reflectance, Unit::Percent));
        // Columns of counts may follow the processed one.
        let behind = "Wave;Reflectance;Sample;Dark\n[nm];[%];[counts];[counts]\n\
            400;47;10;1\n401;52;11;1\n";
        assert_eq!(read("x.txt", behind).unwrap()[0].values, [47.0, 52.0]);
        let bad = read("x.txt", &text.replace("52,6", "?"));
        assert!(matches!(bad, Err(InstrumentError::Line { line: 5, .. })), "{bad:?}");
    }
}
