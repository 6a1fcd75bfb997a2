//! Every format in: the values of the made-up files, from the library and through `color`.

use spectra::instrument::{Format, MeasuredQuantity, Unit, read};
use suite::near::assert_near;
use suite::program::impasto;

use super::{fixture, fixtures};

const NM: [f64; 7] = [400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0];
const MADDER: [f64; 7] = [20.0, 10.5, 12.0, 15.25, 60.0, 70.0, 75.0];
const SLATE: [f64; 7] = [50.0, 40.0, 30.0, 25.0, 20.0, 15.0, 12.5];

/// File, format, names of its spectra, and what a perfect white reads.
const FILES: [(&str, Format, &[&str], f64); 14] = [
    ("two.cgats", Format::Cgats, &["Madder", "Slate"], 1.0),
    ("two.ti3", Format::Cgats, &["Madder", "Slate"], 100.0),
    ("madder.sp", Format::Cgats, &["madder"], 100.0),
    ("spectrolino.txt", Format::Cgats, &["Madder", "Slate"], 1.0),
    ("two.qtx", Format::Qtx, &["Madder", "Slate"], 100.0),
    ("spectrasuite.txt", Format::OceanOptics, &["spectrasuite"], 100.0),
    ("oceanview.txt", Format::OceanOptics, &["oceanview"], 100.0),
    ("madder.jaz", Format::OceanOptics, &["madder"], 100.0),
    ("points.jdx", Format::Jcamp, &["Madder", "Slate"], 100.0),
    ("packed.jdx", Format::Jcamp, &["Madder"], 100.0),
    ("wavenumbers.jdx", Format::Jcamp, &["Madder"], 1.0),
    ("madder.ttt", Format::Avantes, &["madder"], 100.0),
    ("madder.dpt", Format::Bruker, &["madder"], 1.0),
    ("columns.txt", Format::Columns, &["Madder", "Slate"], 100.0),
];

#[test]
fn every_file_is_known_by_its_content_and_holds_what_it_holds() {
    let all = fixtures();
    for (file, format, names, white) in FILES {
        let bytes = &all.iter().find(|(name, _)| name == file).unwrap().1;
        let found = read(file, bytes, None).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(found.format, format, "{file}");
        assert_eq!(read(file, bytes, Some(format)).unwrap(), found, "{file}: told or found");
        let found_names: Vec<&str> = found.records.iter().map(|r| r.name.as_str()).collect();
        assert_eq!(found_names, names, "{file}");
        for (record, paint) in found.records.iter().zip([MADDER, SLATE]) {
            // SpectraSuite's file begins with two wavelengths of noise.
            let skip = record.values.len() - NM.len();
            assert_eq!(skip, if file == "spectrasuite.txt" { 2 } else { 0 }, "{file}");
            assert_near(file, &record.wavelengths_nm[skip..], &NM, 1e-9);
            let percent: Vec<f64> = record.values.iter().map(|v| v * 100.0 / white).collect();
            assert_near(file, &percent[skip..], &paint, 1e-9);
        }
    }
    let compared: Vec<&str> = FILES.iter().map(|(file, ..)| *file).collect();
    for (name, _) in &all {
        assert!(compared.contains(&name.as_str()), "{name} is compared nowhere");
    }
}

#[test]
fn what_the_files_say_of_themselves_is_kept() {
    let record = |file: &str| {
        let bytes = std::fs::read(fixture(file)).unwrap();
        read(file, &bytes, None).unwrap().records.remove(0)
    };
    for (file, quantity, unit) in [
        ("two.qtx", MeasuredQuantity::Reflectance, Unit::Percent),
        ("madder.sp", MeasuredQuantity::Reflectance, Unit::Percent),
        ("madder.ttt", MeasuredQuantity::Reflectance, Unit::Percent),
        ("packed.jdx", MeasuredQuantity::Reflectance, Unit::Percent),
        ("two.cgats", MeasuredQuantity::Unstated, Unit::Unstated),
        ("madder.jaz", MeasuredQuantity::Unstated, Unit::Unstated),
    ] {
        let record = record(file);
        assert_eq!((record.quantity, record.unit), (quantity, unit), "{file}");
    }
    let details = record("spectrolino.txt").details;
    let angle = details.iter().find(|(key, _)| key == "MEASUREMENT_SOURCE").unwrap();
    assert!(angle.1.contains("ObserverAngle=10\u{b0}"), "{angle:?}");
}

#[test]
fn every_file_gives_the_same_colours() {
    let sheet = impasto(&["color", &fixture("sheet.csv"), "--json"]).json();
    for (file, format, names, _) in FILES {
        let run = impasto(&["color", &fixture(file), "--json"]);
        assert_eq!(run.status, 0, "{file}: {}", run.err);
        assert!(run.err.contains(format.title()), "the format is said: {}", run.err);
        let found = run.json();
        for (index, name) in names.iter().enumerate() {
            assert_eq!(found[index]["sample"], *name, "{file}");
            let lab = |json: &serde_json::Value| {
                [0, 1, 2].map(|axis| json[index]["lab"][axis].as_f64().unwrap())
            };
            assert_near(file, &lab(&found), &lab(&sheet), 1e-6);
        }
    }
}

#[test]
fn noise_where_no_colour_is_made_is_cut_and_said() {
    let run = impasto(&["color", &fixture("spectrasuite.txt")]);
    assert!(run.err.contains("2 wavelengths at the ends are cut off"), "{}", run.err);
    assert!(run.err.contains("400 to 700 nm"), "{}", run.err);
}
