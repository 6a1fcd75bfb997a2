//! CxF3 files: measurement conditions, encodings, and a round trip of arbitrary names and values.

use proptest::prelude::*;
use spectra::instrument::{CxfHead, Format, MeasuredQuantity, Unit, read, write_cxf};
use spectra::{Grid, Reflectance, Spectrum};

use super::{fixture, records};

const HEAD: CxfHead<'_> = CxfHead {
    creator: "impasto",
    description: "a test",
    geometry: "made up",
    creation_date: Some("2024-01-01T00:00:00Z"),
};

#[test]
fn conditions_and_kinds_are_told_apart() {
    let found = records("conditions.cxf", &fixture("conditions.cxf")).unwrap();
    let told: Vec<_> = found.iter().map(|r| (r.name.as_str(), r.quantity, r.line)).collect();
    assert_eq!(
        told,
        [
            ("Blue & white (M0)", MeasuredQuantity::Reflectance, 8),
            ("Blue & white (M1)", MeasuredQuantity::Reflectance, 8),
            ("Viewing lamp", MeasuredQuantity::Power, 22),
        ]
    );
    for record in &found {
        assert_eq!(record.wavelengths_nm, [400.0, 500.0, 600.0, 700.0], "{}", record.name);
    }
    assert_eq!((found[1].values[0], found[2].values[3]), (0.32, 0.004));
}

#[test]
fn utf16_is_read_like_utf8() {
    let bytes = fixture("conditions.cxf");
    let text = String::from_utf8(bytes.clone()).unwrap().replace("UTF-8", "UTF-16");
    let wide: Vec<u8> = std::iter::once(0xfeff)
        .chain(text.encode_utf16())
        .flat_map(|unit: u16| unit.to_le_bytes())
        .collect();
    assert_eq!(records("f", &wide), records("f", &bytes));
}

/// A grid of up to 39 wavelengths, and up to five paints with arbitrary names and values of 0 to 2.
fn paints() -> impl Strategy<Value = (Grid, Vec<(String, Vec<f64>)>)> {
    let whole = (360_u32..=400, 1_u32..=50).prop_map(|(s, i)| (f64::from(s), f64::from(i)));
    let odd = (200.0..2000.0_f64, 0.01..100.0_f64);
    let grid = (prop_oneof![whole, odd], 1_usize..40);
    grid.prop_flat_map(|((start_nm, step_nm), count)| {
        let grid = Grid::from_nm(start_nm, step_nm, count).unwrap();
        let value = (0_u32..=2_000_000).prop_map(|millionths| f64::from(millionths) / 1e6);
        let name = prop_oneof![any::<String>(), "[ \\t\\n\\r<>&\"'a-c]{0,12}"];
        let paint = (name, proptest::collection::vec(value, count));
        (Just(grid), proptest::collection::vec(paint, 1..6))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..Default::default() })]

    #[test]
    fn what_is_written_is_read_back((grid, paints) in paints()) {
        let spectra: Vec<Spectrum<Reflectance>> =
            paints.iter().map(|(_, values)| Spectrum::new(grid, values.clone()).unwrap()).collect();
        let named: Vec<_> = paints.iter().map(|(name, _)| name.as_str()).zip(&spectra).collect();
        let text = write_cxf(&HEAD, &named);
        let found = read("f", text.as_bytes(), None).unwrap();
        prop_assert_eq!(found.format, Format::Cxf);
        // Readers of XML turn a bare line break or tab in an attribute into a space.
        prop_assert!(!text.contains(['\t', '\r']), "{text}");
        prop_assert_eq!(text.split('\n').filter(|line: &&str| line.contains("<Object ") && line.contains("Id=\"object")).count(), paints.len());
        prop_assert_eq!(found.spectra.len(), paints.len());
        for (number, ((name, values), record)) in (1..).zip(paints.iter().zip(&found.spectra)) {
            let name: String = name.chars().map(|c: char| match c {
                '\t' | '\n' | '\r' | ' '..='\u{fffd}' | '\u{10000}'.. => c,
                _ => '\u{fffd}',
            }).collect();
            // An object with an empty name is read under its Id.
            let id = format!("object{number}");
            let name = if name.trim().is_empty() { &id } else { name.trim() };
            prop_assert_eq!(&record.name, name);
            prop_assert_eq!(&record.values, values);
            let nm: Vec<f64> = grid.wavelengths_nm().collect();
            prop_assert_eq!(&record.wavelengths_nm, &nm);
            prop_assert_eq!((record.quantity, record.unit), (MeasuredQuantity::Reflectance, Unit::Fraction));
        }
    }
}
