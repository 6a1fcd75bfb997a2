//! Datacolor QTX: lines `KEY=value`, starting with `STD_` for a standard and with `BAT_` for a
//! batch. Reflectance is in percent, from `REFLLOW` nm in steps of `REFLINTERVAL`.

use super::decode::{Decimal, lines, required_number};
use super::measured::{InstrumentError, MeasuredSpectrum, Role, Unit};
use super::points::{Duplicates, Point, ordered};
use super::quantity::MeasuredQuantity;

pub(super) fn read(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let mut records = Vec::new();
    let mut keys: [Section; 2] = Default::default();
    let mut lines = lines(text).peekable();
    while let Some((number, line)) = lines.next() {
        let Some((key, value)) = line.split_once('=') else { continue };
        let key = key.trim().to_ascii_uppercase();
        let (kind, key) = match key.split_once('_') {
            Some(("STD", key)) => (0, key),
            Some(("BAT", key)) => (1, key),
            _ => continue,
        };
        let section = &mut keys[kind];
        if key != "R" {
            let value = value.trim().trim_end_matches(',').trim();
            section.values.push((number, key.to_owned(), value.to_owned()));
            continue;
        }
        let mut values = vec![(number, value)];
        // A long list may continue in the following lines.
        while let Some(more) = lines.next_if(|(_, line): &(usize, &str)| {
            !line.contains('=') && !line.trim_start().starts_with('[')
        }) {
            values.push(more);
        }
        let word = ["standard", "batch"][kind];
        let name = format!("{word} {}", records.len() + 1);
        records.push(section.spectrum(file, &values, name)?);
        section.values.clear();
    }
    Ok(records)
}

/// Keys since the last spectrum of the same kind.
#[derive(Default)]
struct Section {
    /// Line, key and value of each.
    values: Vec<(usize, String, String)>,
}

impl Section {
    fn number(&self, file: &str, at: usize, key: &'static str) -> Result<f64, InstrumentError> {
        let found = self.values.iter().rev().find(|(_, k, _)| k == key);
        let (line, text) = found.map_or((at, ""), |(line, _, text)| (*line, text));
        let expected = match key {
            "REFLPOINTS" => "a number of wavelengths (REFLPOINTS)",
            "REFLLOW" => "the first wavelength (REFLLOW)",
            _ => "the step of wavelengths (REFLINTERVAL)",
        };
        required_number(file, line, expected, text, Decimal::Point)
    }

    fn spectrum(
        &self,
        file: &str,
        lists: &[(usize, &str)],
        unnamed: String,
    ) -> Result<MeasuredSpectrum, InstrumentError> {
        let at = lists[0].0;
        let [count, low, step] =
            ["REFLPOINTS", "REFLLOW", "REFLINTERVAL"].map(|key| self.number(file, at, key));
        let count = count?;
        let low = low?;
        let step = step?;
        let mut points = Vec::new();
        for &(line, list) in lists {
            // In files joined without a line end the heading of the next section follows here.
            let list = list.split('[').next().unwrap_or_default();
            for cell in list.trim().trim_end_matches(',').split(',') {
                if list.trim().is_empty() {
                    continue;
                }
                let value = required_number(file, line, "a reflectance", cell, Decimal::Point)?;
                let nm = low + step * points.len() as f64;
                points.push(Point { line, nm, value });
            }
        }
        let found = points.len();
        if found as f64 != count {
            let line = lists[lists.len() - 1].0;
            let file = file.to_owned();
            let what = "reflectances";
            let expected = count.max(0.0) as usize;
            return Err(InstrumentError::Count { file, line, what, expected, found });
        }
        let ordered = ordered(file, points, Duplicates::Refuse)?;
        let pairs = self.values.iter();
        let name = pairs.clone().rev().find(|(_, key, value)| key == "NAME" && !value.is_empty());

        Ok(MeasuredSpectrum {
            name: name.map_or(unnamed, |(_, _, name)| name.clone()),
            quantity: MeasuredQuantity::Reflectance,
            role: Role::Main,
            unit: Unit::Percent,
            wavelengths_nm: ordered.wavelengths_nm,
            values: ordered.values,
            line: name.map_or(at, |(line, _, _)| *line),
            point_lines: Vec::new(),
            details: pairs
                .filter(|(_, key, _)| key != "NAME" && !key.starts_with("REFL"))
                .map(|(_, key, value)| (key.clone(), value.clone()))
                .collect(),
            remarks: ordered.remarks,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "[STANDARD_DATA 0]\nSTD_NAME=Red\nSTD_REFLPOINTS=3,\nSTD_REFLINTERVAL=10,\n\
        STD_REFLLOW=400,\nSTD_VIEWING=SCI\nSTD_R= 3.1, 3.2, 3.3\n[BATCH_DATA 0]\nSTD_NAME=Red\n\
        BAT_NAME= Red try\nBAT_REFLPOINTS=2,\nBAT_REFLINTERVAL=20,\nBAT_REFLLOW=500,\nBAT_R=1,\n2,\n";

    #[test]
    fn standards_and_batches_are_read() {
        let found = read("f", FILE).unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!((found[0].name.as_str(), found[0].line), ("Red", 2));
        assert_eq!(found[0].wavelengths_nm, [400.0, 410.0, 420.0]);
        assert_eq!(found[0].values, [3.1, 3.2, 3.3]);
        assert_eq!(found[0].details, [("VIEWING".to_owned(), "SCI".to_owned())]);
        assert_eq!((found[1].name.as_str(), &found[1].values), ("Red try", &vec![1.0, 2.0]));
        assert_eq!((found[1].unit, &found[1].wavelengths_nm), (Unit::Percent, &vec![500.0, 520.0]));
    }

    #[test]
    fn faults_name_their_line() {
        let cut = read("f", &FILE.replace("3.1, 3.2, 3.3", "3.1, 3.2"));
        assert!(
            matches!(cut, Err(InstrumentError::Count { line: 7, expected: 3, found: 2, .. })),
            "{cut:?}"
        );
        for (old, new, at) in [
            ("3.2", "x", 7),
            ("STD_REFLLOW=400", "STD_REFLLOW=four", 5),
            ("STD_REFLLOW=400,\n", "", 6),
            ("STD_REFLINTERVAL=10", "STD_REFLINTERVAL=0", 7),
        ] {
            let found = read("f", &FILE.replace(old, new));
            let line = match found {
                Err(
                    InstrumentError::Line { line, .. } | InstrumentError::Duplicate { line, .. },
                ) => line,
                other => panic!("{other:?}"),
            };
            assert_eq!(line, at, "{old} {new}");
        }
    }
}
