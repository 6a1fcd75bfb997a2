//! CxF3 files (conditions, encodings, a round trip of arbitrary names and values), lamps read from
//! instrument files, and counts referenced to a white and a dark. Damaged bytes never make a reader
//! panic, and every error names the file.
mod referencing;

use std::path::Path;

use documents::hint::Explain;
use proptest::prelude::*;
use spectra::instrument::{
    ChoiceError, CxfHead, Format, InstrumentError, MeasuredQuantity, MeasuredSpectrum, Unit, read,
    write_cxf,
};
use spectra::{
    Grid, Illuminant, LampError, LightError, Reflectance, Spectrum, lamp_from_bytes,
    light_from_text,
};
use suite::program::impasto;

fn fixture(name: &str) -> Vec<u8> {
    let path = suite::program::repository(&format!("tests/fixtures/instruments_xml/{name}"));
    std::fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Reads the spectra in `bytes` and detects the format.
fn records(file: &str, bytes: &[u8]) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    read(file, bytes, None).map(|file| file.spectra)
}

const HEAD: CxfHead<'_> = CxfHead {
    creator: "impasto",
    description: "a test",
    geometry: "made up",
    creation_date: Some("2024-01-01T00:00:00Z"),
};

#[test]
fn conditions_and_kinds_are_told_apart() {
    let found = records("conditions.cxf", &fixture("conditions.cxf")).unwrap();
    let spectra: Vec<_> = found.iter().map(|r| (r.name.as_str(), r.quantity, r.line)).collect();
    assert_eq!(
        spectra,
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
        // In an attribute, readers of XML turn a bare line break or tab into a space.
        prop_assert!(!text.contains(['\t', '\r']), "{text}");
        prop_assert_eq!(text.split('\n').filter(|line: &&str| line.contains("<Object ") && line.contains("Id=\"object")).count(), paints.len());
        prop_assert_eq!(found.spectra.len(), paints.len());
        for (number, ((name, values), record)) in (1..).zip(paints.iter().zip(&found.spectra)) {
            let name: String = name.chars().map(|c: char| match c {
                '\t' | '\n' | '\r' | ' '..='\u{fffd}' | '\u{10000}'.. => c,
                _ => '\u{fffd}',
            }).collect();
            // Characters that nobody sees are blanks. If the name is empty, the object is called by its Id.
            let name = documents::plain_name(&name);
            let name = if name.is_empty() { format!("object{number}") } else { name };
            prop_assert_eq!(&record.name, &name);
            prop_assert_eq!(&record.values, values);
            let nm: Vec<f64> = grid.wavelengths_nm().collect();
            prop_assert_eq!(&record.wavelengths_nm, &nm);
            prop_assert_eq!((record.quantity, record.unit), (MeasuredQuantity::Reflectance, Unit::Fraction));
        }
    }
}

fn at(light: &Illuminant, nm: usize) -> f64 {
    light.power().values()[nm - 360]
}

#[test]
fn a_tm27_lamp_keeps_its_line() {
    let lamp = lamp_from_bytes("lamp.spdx", &fixture("lamp.spdx"), None).unwrap();
    assert_eq!((at(&lamp, 360), at(&lamp, 544), at(&lamp, 830)), (0.2, 1.0, 0.4));
    assert_eq!(records("f", &fixture("lamp.spdx")).unwrap()[0].name, "made-up lamp");
}

#[test]
fn a_sekonic_lamp_is_read_at_its_finest() {
    let bytes = fixture("sekonic.csv");
    let lamp = lamp_from_bytes("sekonic.csv", &bytes, None).unwrap();
    assert_eq!((at(&lamp, 381), at(&lamp, 382)), (0.21, 0.25));
    let text = String::from_utf8(bytes).unwrap();
    let wide: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert_eq!(lamp_from_bytes("sekonic.csv", &wide, None).unwrap(), lamp, "UTF-16");
}

#[test]
fn a_light_meters_file_is_a_lamp_and_no_reflectance() {
    let lamp = lamp_from_bytes("li180.txt", &fixture("li180.txt"), None).unwrap();
    for (nm, wanted) in [(380, 0.88), (430, 0.93), (780, 2.0)] {
        assert!((at(&lamp, nm) - wanted).abs() < 1e-12, "{nm}");
    }
    let folder = tempfile::tempdir().unwrap();
    let file =
        write(folder.path(), "li180.txt", std::str::from_utf8(&fixture("li180.txt")).unwrap());
    let run = impasto(&["color", &file]);
    assert_eq!(run.status, 1, "{}", run.err);
    for word in ["li180 is the power of a light", "--illuminant"] {
        assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
    }
}

#[test]
fn a_lamp_is_chosen_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("conditions.cxf");
    std::fs::write(&file, fixture("conditions.cxf")).unwrap();
    let file = file.to_str().unwrap();
    let lamp = light_from_text(&format!("{file}#Viewing lamp")).unwrap();
    assert_eq!((at(&lamp, 450), at(&lamp, 700)), (0.0015, 0.004));
    let several = light_from_text(file).unwrap_err();
    assert!(
        matches!(
            several,
            LightError::Lamp(LampError::Choice(ChoiceError::Several { count: 3, .. }))
        ),
        "{several}"
    );
    assert!(several.hint().unwrap().to_string().contains("#Viewing lamp"), "{several}");
    let paint = light_from_text(&format!("{file}#Blue & white (M0)")).unwrap_err();
    assert!(matches!(paint, LightError::Lamp(LampError::Quantity { .. })), "{paint}");
}

#[test]
fn a_refused_lamp_says_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let spectra = write(folder.path(), "grey.csv", "sample,400,500,600,700\ngrey,1,1,1,1\n");
    let lamp = write(folder.path(), "paint.txt", "nm\treflectance\n400\t0.1\n700\t0.2\n");
    let run = impasto(&["color", &spectra, "--illuminant", &lamp]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("paint.txt: `") && run.err.contains("`reflectance`"), "{}", run.err);
    assert!(run.err.contains("hint: a lamp is a spectrum of power"), "{}", run.err);
}

fn write(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

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
                // This is not a finite number.
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
