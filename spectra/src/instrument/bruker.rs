//! Bruker OPUS data point tables (.dpt): two or more columns of numbers without a heading.

use super::axis::Axis;
use super::columns::{ColumnLabel, table};
use super::error::InstrumentError;
use super::measured::{MeasuredQuantity, MeasuredSpectrum, Unit, stem};

/// An abscissa above this must be a wavenumber: no colour instrument measures longer
/// wavelengths.
const LONGEST_NM: f64 = 3300.0;

pub(super) fn read(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let table = table(file, text)?;
    let Some((_, first)) = table.rows.first() else { return Ok(Vec::new()) };
    let wide = table.rows.iter().any(|(_, row)| row[0] > LONGEST_NM);
    let axis = if wide { Axis::Wavenumbers } else { Axis::Nanometres };
    let unit = if wide { "as wavenumbers in 1/cm" } else { "as wavelengths in nm" };
    let remark = format!("the file does not state the unit of its first column; read {unit}");
    let width = first.len();
    (1..width)
        .map(|column| {
            let name = if width > 2 { format!("{} {column}", stem(file)) } else { stem(file) };
            let quantity = MeasuredQuantity::Unstated;
            let unit = Unit::Unstated;
            let mut record =
                table.spectrum(file, column, axis, ColumnLabel { name, quantity, unit })?;
            record.remarks.insert(0, remark.clone());
            Ok(record)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_column_is_nm_or_wavenumbers_by_its_size() {
        let found = &read("x/a.0.dpt", "25000.0,0.2\n20000.0,0.1\n").unwrap()[0];
        assert_eq!((found.name.as_str(), &found.wavelengths_nm), ("a.0", &vec![400.0, 500.0]));
        assert_eq!(found.values, [0.2, 0.1]);
        let found = &read("a.dpt", "400.0,0.2\n500.0,0.1\n").unwrap()[0];
        assert_eq!(found.wavelengths_nm, [400.0, 500.0]);
        assert!(found.remarks[0].contains("nm"), "{:?}", found.remarks);
    }
}
