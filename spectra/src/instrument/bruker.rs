//! Bruker OPUS data point tables (.dpt): two columns, and nothing said of them.

use super::axis::Axis;
use super::columns::{Named, table};
use super::error::InstrumentError;
use super::measured::{MeasuredQuantity, MeasuredSpectrum, Unit, stem};

/// No instrument for colour reads wavelengths beyond this; wavenumbers of light do.
const LONGEST_NM: f64 = 3300.0;

pub(super) fn read(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let table = table(file, text)?;
    let Some((_, first)) = table.rows.first() else { return Ok(Vec::new()) };
    let wide = table.rows.iter().any(|(_, row)| row[0] > LONGEST_NM);
    let axis = if wide { Axis::Wavenumbers } else { Axis::Nanometres };
    let unit = if wide { "as wavenumbers in 1/cm" } else { "as wavelengths in nm" };
    let what = format!("the file does not say what its first column counts; read {unit}");
    let width = first.len();
    (1..width)
        .map(|column| {
            let name = if width > 2 { format!("{} {column}", stem(file)) } else { stem(file) };
            let (quantity, unit) = (MeasuredQuantity::Unstated, Unit::Unstated);
            let mut record = table.record(file, column, axis, Named { name, quantity, unit })?;
            record.remarks.insert(0, what.clone());
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
