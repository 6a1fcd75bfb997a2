//! Ocean Optics: SpectraSuite, OceanView and Jaz. `Key: value` lines, then data from
//! `>>>>>Begin` to `>>>>>End` or the end of the file: two columns, or in Jaz wavelength, dark,
//! reference, sample and processed (W D R S P).
//!
//! The software processes where it has a reference, into percent of it (or absorbance), and does
//! not write which; without one the values are counts.

use super::axis::Axis;
use super::columns::{Named, table};
use super::error::InstrumentError;
use super::record::{MeasuredQuantity, Record, Unit, stem};
use super::text::lines;

pub(super) fn read(file: &str, text: &str) -> Result<Vec<Record>, InstrumentError> {
    let mut records: Vec<Record> = Vec::new();
    let mut details: Vec<(String, String)> = Vec::new();
    // Lines outside the data are emptied, so that those inside keep their numbers.
    let mut data: Option<String> = None;
    let mut last = 0;
    for (number, line) in lines(text) {
        last = number;
        if line.starts_with(">>>>>Begin") {
            if let Some(data) = data.take() {
                records.extend(spectrum(file, &data, std::mem::take(&mut details), number)?);
            }
            data = Some("\n".repeat(number));
        } else if line.starts_with(">>>>>End") {
            if let Some(data) = data.take() {
                records.extend(spectrum(file, &data, std::mem::take(&mut details), number)?);
            }
        } else if let Some(data) = &mut data {
            data.push_str(line);
            data.push('\n');
        } else if let Some((key, value)) = line.split_once(':') {
            details.push((key.trim().to_owned(), value.trim().to_owned()));
        }
    }
    if let Some(data) = data {
        records.extend(spectrum(file, &data, details, last)?);
    }
    if records.len() > 1 {
        for (record, number) in records.iter_mut().zip(1..) {
            record.name = format!("{} {number}", record.name);
        }
    }
    Ok(records)
}

/// The spectrum of one block of data, which ends before `end`.
fn spectrum(
    file: &str,
    data: &str,
    details: Vec<(String, String)>,
    end: usize,
) -> Result<Option<Record>, InstrumentError> {
    let said = |start: &str| {
        let found = details.iter().find(|(key, _)| key.starts_with(start));
        found.map(|(_, value)| value.as_str())
    };
    let table = table(file, data)?;
    let announced = said("Number of Pixels").and_then(|count| count.parse::<usize>().ok());
    let found = table.rows.len();
    if let Some(wanted) = announced.filter(|count| *count != found) {
        let (file, what) = (file.to_owned(), "pixels");
        return Err(InstrumentError::Count { file, line: end, what, wanted, found });
    }
    let Some((_, first)) = table.rows.first() else { return Ok(None) };
    let letters = table.above.last().map_or(Vec::new(), |line| line.split_whitespace().collect());
    let named = |letter: &str| letters.iter().position(|l| *l == letter);
    let is_missing = |start: &str| said(start).is_some_and(|word| word == "No");
    let raw = is_missing("Reference Spectrum Present") || is_missing("Processed Spectrum Present");
    let column = if raw { named("S") } else { named("P") };
    let column = column.filter(|column| *column < first.len()).unwrap_or(first.len() - 1);
    let quantity = if raw { MeasuredQuantity::Counts } else { MeasuredQuantity::Unstated };
    let named = Named { name: stem(file), quantity, unit: Unit::Unstated };
    let mut record = table.record(file, column, Axis::Nanometres, named)?;
    record.details = details;
    Ok(Some(record))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_columns_with_decimal_commas() {
        let text = "SpectraSuite Data File\r\nUser: A\r\nReference Spectrum Present: Yes\r\n\
            Number of Pixels in Processed Spectrum: 2\r\n>>>>>Begin Processed Spectral Data<<<<<\r\n\
            400,25\t12,5\r\n401,5\t1,2E1\r\n>>>>>End Processed Spectral Data<<<<<\r\n";
        let found = &read("d/Red.txt", text).unwrap()[0];
        assert_eq!((found.name.as_str(), found.line), ("Red", 6));
        assert_eq!(found.quantity, MeasuredQuantity::Unstated);
        assert_eq!(
            (&found.wavelengths_nm, &found.values),
            (&vec![400.25, 401.5], &vec![12.5, 12.0])
        );
        let raw = &read("d/Red.txt", &text.replace("Yes", "No")).unwrap()[0];
        assert_eq!(raw.quantity, MeasuredQuantity::Counts);
        let cut = read("d/Red.txt", &text.replace("401,5\t1,2E1\r\n", ""));
        assert!(matches!(cut, Err(InstrumentError::Count { line: 7, found: 1, .. })), "{cut:?}");
        let bad = read("d/Red.txt", &text.replace("1,2E1", "1,2Z1"));
        assert!(matches!(bad, Err(InstrumentError::Line { line: 7, .. })), "{bad:?}");
    }

    #[test]
    fn jaz_gives_its_processed_column_or_its_counts() {
        let text = "Jaz Data File\nProcessed Spectrum Present: Yes\n>>>>>Begin Processed\n\
            W\tD\tR\tS\tP\n400.0\t1\t100\t50\t49.5\n401.0\t1\t100\t20\t19.2\n>>>>>End\n";
        assert_eq!(read("a.jaz", text).unwrap()[0].values, [49.5, 19.2]);
        let raw = &read("a.jaz", &text.replace("Yes", "No")).unwrap()[0];
        assert_eq!((&raw.values, raw.quantity), (&vec![50.0, 20.0], MeasuredQuantity::Counts));
    }
}
