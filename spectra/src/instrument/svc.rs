//! Spectra Vista `.sig`: a first line in comment signs, lines `key= value`, a line `data=`, and rows
//! of wavelength, white, sample and reflectance in percent.
//!
//! Without the last column the file holds power or counts. Where the software did not remove the
//! overlap of the detectors, the wavelengths go back once or twice beyond 900 nm.

use super::axis::Axis;
use super::columns::{ColumnLabel, below, table};
use super::error::InstrumentError;
use super::measured::{MeasuredQuantity, MeasuredSpectrum, Role, Unit, stem};
use super::text::lines;

/// Start of the first line.
const FIRST: &str = "/*** Spectra Vista";

pub(super) fn is_text(text: &str) -> bool {
    text.trim_start().starts_with(FIRST)
}

/// Reflectance, or sample and white, in the band of the first detector.
pub(super) fn read(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let is_data = |line: &str| line.trim_start().starts_with("data=");
    let Some((at, _)) = lines(text).find(|(_, line)| is_data(line)) else { return Ok(Vec::new()) };
    let stated = lines(text).take(at - 1).filter_map(|(_, line)| line.split_once('='));
    let details: Vec<(String, String)> =
        stated.map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned())).collect();
    let detail = |name: &str| {
        let found = details.iter().find(|(key, _)| key == name);
        found.map_or("", |(_, value)| value.as_str())
    };
    let data = below(text, at);
    let mut table = table(file, &data)?;
    let Some(&(line, ref first)) = table.rows.first() else { return Ok(Vec::new()) };
    let width = first.len();
    if !(3..=4).contains(&width) {
        let expected = "wavelength, white, sample and reflectance";
        let text = lines(text).nth(line - 1).map_or("", |(_, line)| line);
        return Err(InstrumentError::line(file, line, expected, text));
    }
    let back = table.rows.windows(2).position(|pair| pair[1].1[0] <= pair[0].1[0]);
    let overlap = back.filter(|&at| table.rows[at].1[0] > 900.0).map(|at| {
        let nm = table.rows[at].1[0];
        table.rows.truncate(at + 1);
        format!("the detectors overlap from {nm} nm on; longer wavelengths are left out")
    });
    let name = stem(file);
    let raw = match MeasuredQuantity::of_words(detail("units")) {
        MeasuredQuantity::Unstated => MeasuredQuantity::Counts,
        stated => stated,
    };
    let columns = if width == 4 {
        vec![(3, name, MeasuredQuantity::Reflectance, Unit::Percent, Role::Main)]
    } else {
        let white = format!("{name} (white)");
        vec![
            (2, name, raw, Unit::Unstated, Role::Main),
            (1, white, raw, Unit::Unstated, Role::White),
        ]
    };
    columns
        .into_iter()
        .map(|(column, name, quantity, unit, role)| {
            let label = ColumnLabel { name, quantity, unit };
            let mut record = table.spectrum(file, column, Axis::Nanometres, label)?;
            record.remarks.extend(overlap.clone());
            Ok(MeasuredSpectrum { role, details: details.clone(), ..record })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "/*** Spectra Vista SIG Data ***/\nname= leaf.sig\nunits= Radiance, Radiance\n\
        data= \n400.0  100.00  10.00  10.00\n500.0  100.00  20.00  20.00\n980.0  1.00  0.5  50\n\
        970.0  1.00  0.5  50\n";

    #[test]
    fn reflectance_in_percent_is_read_up_to_the_overlap() {
        let found = &read("a/leaf.sig", FILE).unwrap()[0];
        assert!(is_text(FILE));
        assert_eq!((found.name.as_str(), found.line), ("leaf", 5));
        assert_eq!(found.wavelengths_nm, [400.0, 500.0, 980.0]);
        assert_eq!(found.values, [10.0, 20.0, 50.0]);
        assert_eq!((found.quantity, found.unit), (MeasuredQuantity::Reflectance, Unit::Percent));
        assert!(found.remarks[0].contains("980 nm"), "{:?}", found.remarks);
    }

    #[test]
    fn files_without_reflectance_hold_power_or_counts() {
        let text =
            FILE.replace("  10.00\n", "\n").replace("  20.00\n", "\n").replace("  50\n", "\n");
        let found = read("f", &text).unwrap();
        assert_eq!((found[0].quantity, found[1].role), (MeasuredQuantity::Power, Role::White));
        assert_eq!(found[0].values, [10.0, 20.0, 0.5]);
        let found = read("f", &text.replace("Radiance", "Counts")).unwrap();
        assert_eq!(found[0].quantity, MeasuredQuantity::Counts);
    }

    #[test]
    fn faults_name_their_line() {
        for (old, new, at) in [
            ("20.00\n", "x\n", 6),
            ("  20.00\n", "\n", 6),
            ("980.0", "450.0", 7),
            ("400.0  100.00  10.00", "400", 6),
        ] {
            let found = read("f", &FILE.replacen(old, new, 1));
            let Err(InstrumentError::Line { line, .. } | InstrumentError::Order { line, .. }) =
                found
            else {
                panic!("{new}: {found:?}")
            };
            assert_eq!(line, at, "{new}");
        }
    }
}
