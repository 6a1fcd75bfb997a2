//! Arbitrary and damaged bytes: no reader of XML or lamps panics, and every error names the file.

use proptest::prelude::*;
use spectra::instrument::{Format, read};
use spectra::lamp_from_bytes;

use super::fixture;

const FILE: &str = "some/file.dat";
const FORMATS: [Format; 3] = [Format::Cxf, Format::Tm27, Format::Sekonic];

fn check(bytes: &[u8]) -> Result<(), TestCaseError> {
    for format in FORMATS.map(Some).into_iter().chain([None]) {
        match read(FILE, bytes, format) {
            Err(error) => {
                let error = error.to_string();
                prop_assert!(error.starts_with(FILE), "{error}");
            }
            Ok(file) => {
                for record in &file.spectra {
                    let nm = &record.wavelengths_nm;
                    let values = &record.values;
                    prop_assert!(!nm.is_empty() && nm.len() == values.len());
                    prop_assert!(nm[0] > 0.0 && nm.windows(2).all(|pair| pair[0] < pair[1]));
                    prop_assert!(nm.iter().chain(values).all(|value| value.is_finite()));
                }
            }
        }
    }
    if let Err(error) = lamp_from_bytes(FILE, bytes, None) {
        prop_assert!(error.to_string().contains(FILE), "{error}");
    }
    Ok(())
}

/// A fixture with up to seven edits that change, remove, insert or repeat bytes.
fn mutated() -> impl Strategy<Value = Vec<u8>> {
    let name = prop_oneof![Just("conditions.cxf"), Just("lamp.spdx"), Just("sekonic.csv")];
    let edit = (any::<prop::sample::Index>(), 0_u8..5, any::<u8>(), 1_usize..60);
    (name, proptest::collection::vec(edit, 1..8)).prop_map(|(name, edits)| {
        let mut bytes = fixture(name);
        for (index, kind, byte, length) in edits {
            if bytes.is_empty() {
                break;
            }
            let at = index.index(bytes.len());
            let end = bytes.len().min(at + length);
            match kind {
                0 => bytes[at] = byte,
                // Digits and markup characters reach more code than arbitrary bytes.
                1 => bytes[at] = b"0123456789.-+eE<>&;,/\"' \n"[usize::from(byte) % 25],
                2 => drop(bytes.drain(at..end)),
                // No finite number.
                3 => bytes.splice(at..at, *b"1e999").for_each(drop),
                _ => bytes.splice(at..at, bytes[at..end].to_vec()).for_each(drop),
            }
        }
        bytes
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..Default::default() })]

    #[test]
    fn any_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        check(&bytes)?;
    }

    #[test]
    fn markup(text in "[<>/!&;='\" a-zCxF0-9.\\[\\]-]{0,200}") {
        check(text.as_bytes())?;
    }

    #[test]
    fn mutated_files(bytes in mutated()) {
        check(&bytes)?;
    }
}
