//! Spectral Evolution `.sed`: lines `Key: value`, a line `Data:`, a line of headings that names
//! wavelength, white and sample, and rows between tabs.
//!
//! Columns are those that DARWin writes: `Wvl`, `Rad. (Ref.)`, `Rad. (Target)`, `Reflect. %` or
//! `Reflect. [1.0]`, `Tgt./Ref. %`, `Irrad. (Target)`, `Norm. DN (Target)` and `Chan.#`.

use super::axis::Axis;
use super::columns::{ColumnLabel, below, table};
use super::error::InstrumentError;
use super::measured::{MeasuredQuantity, MeasuredSpectrum, Role, Unit, stem};
use super::text::lines;

/// Whether the line `line` after the line `before` is the one of the headings.
pub(super) fn is_heading(before: &str, line: &str) -> bool {
    before.trim() == "Data:" && (line.starts_with("Wvl") || line.starts_with("Chan.#"))
}

/// The main spectrum of a file: reflectance if there is one, otherwise that of the sample.
pub(super) fn read(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let lines: Vec<(usize, &str)> = lines(text).collect();
    let found = lines.windows(2).find(|pair| is_heading(pair[0].1, pair[1].1.trim()));
    let Some([_, (at, headings)]) = found else { return Ok(Vec::new()) };
    let mut headings: Vec<String> =
        headings.trim().split('\t').map(|heading| heading.trim().to_lowercase()).collect();
    let data = below(text, *at);
    let mut table = table(file, &data)?;
    let Some(&(line, ref first)) = table.rows.first() else { return Ok(Vec::new()) };
    let wavelength = headings.iter().position(|heading| heading == "wvl");
    let Some(wavelength) = wavelength.filter(|_| headings.len() == first.len()) else {
        let expected = "a column `Wvl`, and a value for every heading";
        return Err(InstrumentError::line(file, line, expected, lines[line - 1].1));
    };
    table.rows.iter_mut().for_each(|(_, row)| row.swap(0, wavelength));
    headings.swap(0, wavelength);
    let column = |words: &[&str]| {
        headings.iter().position(|heading| words.iter().any(|word| heading.contains(word)))
    };
    let ratio = column(&["reflect", "tgt./ref", "trans"]);
    let Some(chosen) = ratio.or(column(&["(target", "tgt"])) else {
        let expected = "a column of reflectance, or of the target";
        return Err(InstrumentError::line(file, *at, expected, &headings.join(" ")));
    };
    let heading = &headings[chosen];
    let quantity = if heading.contains("dn") {
        MeasuredQuantity::Counts
    } else if heading.contains("trans") {
        MeasuredQuantity::Transmittance
    } else if ratio.is_some() {
        MeasuredQuantity::Reflectance
    } else {
        MeasuredQuantity::Power
    };
    let unit = match heading {
        _ if ratio.is_none() => Unit::Unstated,
        heading if heading.contains('%') => Unit::Percent,
        heading if heading.contains("[1.0]") => Unit::Fraction,
        _ => Unit::Unstated,
    };
    let label = ColumnLabel { name: stem(file), quantity, unit };
    let mut records = vec![table.spectrum(file, chosen, Axis::Nanometres, label)?];
    if let Some(white) = column(&["dn (ref"]) {
        let quantity = MeasuredQuantity::Counts;
        let label =
            ColumnLabel { name: format!("{} (white)", stem(file)), quantity, unit: Unit::Unstated };
        let record = table.spectrum(file, white, Axis::Nanometres, label)?;
        records.push(MeasuredSpectrum { role: Role::White, ..record });
    }
    let stated = lines[..*at].iter().filter_map(|(_, line)| line.split_once(':'));
    let details: Vec<(String, String)> = stated
        .map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned()))
        .filter(|(_, value)| !value.is_empty())
        .collect();
    records.iter_mut().for_each(|record| record.details.clone_from(&details));
    Ok(records)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "Comment:\r\nVersion: 2.4\r\nMeasurement: REFLECTANCE\r\nColumns [4]:\r\nData:\r\n\
        Wvl\tRad. (Ref.)\tRad. (Target)\tReflect. %\r\n400.0\t1.1e-002\t4.5e-005\t10.5\r\n\
        401.0\t1.2e-002\t4.6e-005\t11.5\r\n";

    #[test]
    fn reflectance_is_found_by_its_heading_with_its_unit() {
        let found = &read("a/leaf.sed", FILE).unwrap()[0];
        assert_eq!((found.name.as_str(), found.line), ("leaf", 7));
        assert_eq!(
            (&found.wavelengths_nm, &found.values),
            (&vec![400.0, 401.0], &vec![10.5, 11.5])
        );
        assert_eq!((found.quantity, found.unit), (MeasuredQuantity::Reflectance, Unit::Percent));
        assert!(found.details.contains(&("Version".to_owned(), "2.4".to_owned())));
        let fraction = &read("f", &FILE.replace("Reflect. %", "Reflect. [1.0]")).unwrap()[0];
        assert_eq!(fraction.unit, Unit::Fraction);
        let numbered = FILE.replace("Wvl\t", "Chan.#\tWvl\t").replace("\n40", "\n7\t40");
        assert_eq!(read("f", &numbered).unwrap()[0].wavelengths_nm, [400.0, 401.0]);
    }

    #[test]
    fn power_and_counts_are_no_reflectance() {
        for (heading, quantity) in [
            ("Irrad. (Target)", MeasuredQuantity::Power),
            ("Norm. DN (Target)", MeasuredQuantity::Counts),
        ] {
            let text = FILE.replace("Rad. (Target)\tReflect. %", &format!("x\t{heading}"));
            assert_eq!(read("f", &text).unwrap()[0].quantity, quantity, "{heading}");
        }
        let counts = FILE.replace("Rad. (Ref.)", "Norm. DN (Ref.)");
        assert_eq!(read("f", &counts).unwrap()[1].role, Role::White);
    }

    #[test]
    fn faults_name_their_line() {
        for (old, new, at) in [
            ("11.5", "x", 8),
            ("\t11.5", "", 8),
            ("Reflect. %", "Reflect. %\tmore", 7),
            ("Rad. (Target)\tReflect. %", "x\ty", 6),
        ] {
            let found = read("f", &FILE.replace(old, new));
            let Err(InstrumentError::Line { line, .. }) = found else { panic!("{found:?}") };
            assert_eq!(line, at, "{new}");
        }
    }
}
