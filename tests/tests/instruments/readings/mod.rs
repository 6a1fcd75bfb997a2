//! Text formats of instruments, read by the library and by the program. Every fixture is recognized
//! and gives the known values. Tables may be written as instruments and people do: headings of
//! names and wavelengths, lines above the table, falling wavelengths, decimal commas. Files with
//! faults or with other quantities are refused with the place and a hint, and damaged bytes never
//! make a reader panic.
mod layouts;
mod stated;
mod workbooks;

pub(super) use workbooks::workbook;

use std::path::PathBuf;

use calibrate::{ReadingOptions, Readings, ReadingsError};
use proptest::prelude::*;
use spectra::instrument::{Format, MeasuredQuantity, MeasuredSpectrum, Role, Unit, read};
use suite::golden::assert_near;
use suite::program::{Run, impasto};

fn fixture(name: &str) -> String {
    suite::program::repository(&format!("tests/fixtures/instruments/{name}"))
}

fn fixtures() -> Vec<(String, Vec<u8>)> {
    let mut paths: Vec<PathBuf> =
        std::fs::read_dir(fixture("")).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let named = paths.into_iter().map(|path| {
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        (name, std::fs::read(path).unwrap())
    });
    named.filter(|(name, _)| name != "README.md" && name != "sheet.csv").collect()
}

const NM: [f64; 7] = [400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0];
const MADDER: [f64; 7] = [20.0, 10.5, 12.0, 15.25, 60.0, 70.0, 75.0];
const SLATE: [f64; 7] = [50.0, 40.0, 30.0, 25.0, 20.0, 15.0, 12.5];

/// File, format, names of its spectra, and the value of a perfect white.
const FILES: [(&str, Format, &[&str], f64); 18] = [
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
    ("tuples.jdx", Format::Jcamp, &["Paints N=1", "Paints N=2"], 100.0),
    ("madder.asd.txt", Format::Asd, &["madder"], 1.0),
    ("madder.sed", Format::SpectralEvolution, &["madder"], 100.0),
    ("madder.sig", Format::Svc, &["madder"], 100.0),
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
        assert_eq!(read(file, bytes, Some(format)).unwrap(), found, "{file}: format given");
        let mains: Vec<&MeasuredSpectrum> =
            found.spectra.iter().filter(|record| record.role == Role::Main).collect();
        let found_names: Vec<&str> = mains.iter().map(|record| record.name.as_str()).collect();
        assert_eq!(found_names, names, "{file}");
        for (record, paint) in mains.iter().zip([MADDER, SLATE]) {
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
    fn record(file: &str) -> MeasuredSpectrum {
        let bytes = std::fs::read(fixture(file)).unwrap();
        read(file, &bytes, None).unwrap().spectra.remove(0)
    }
    for (file, quantity, unit) in [
        ("two.qtx", MeasuredQuantity::Reflectance, Unit::Percent),
        ("madder.sp", MeasuredQuantity::Reflectance, Unit::Percent),
        ("madder.ttt", MeasuredQuantity::Reflectance, Unit::Percent),
        ("madder.asd.txt", MeasuredQuantity::Reflectance, Unit::Fraction),
        ("madder.sed", MeasuredQuantity::Reflectance, Unit::Percent),
        ("madder.sig", MeasuredQuantity::Reflectance, Unit::Percent),
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
fn every_file_gives_the_same_colors() {
    let sheet = impasto(&["color", &fixture("sheet.csv"), "--json"]).json();
    for (file, format, names, _) in FILES {
        let run = impasto(&["color", &fixture(file), "--json"]);
        assert_eq!(run.status, 0, "{file}: {}", run.err);
        assert!(run.err.contains(format.title()), "the format is not named: {}", run.err);
        let found = run.json();
        for (index, name) in names.iter().enumerate() {
            assert_eq!(found[index]["sample"], *name, "{file}");
            let [found, wanted] = [&found, &sheet]
                .map(|json| [0, 1, 2].map(|axis| json[index]["lab"][axis].as_f64().unwrap()));
            assert_near(file, &found, &wanted, 1e-6);
        }
    }
}

#[test]
fn noise_at_the_ends_is_cut_and_said_and_inside_it_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("ends.dpt");
    let color = |bad: &[f64]| {
        let steps = (0..31).map(|i| 340.0 + 13.5 * f64::from(i));
        let lines: String = steps
            .map(|nm| format!("{nm},{}\n", if bad.contains(&nm) { -0.05 } else { 0.5 }))
            .collect();
        std::fs::write(&file, lines).unwrap();
        impasto(&["color", file.to_str().unwrap()])
    };
    let run = color(&[340.0, 367.0, 704.5, 731.5]);
    assert_eq!(run.status, 0, "{}", run.err);
    let said = "ends: cut to 380.5 to 691 nm; beyond, readings are not from 0 to 2\n";
    assert!(run.err.contains(said), "{}", run.err);
    let run = color(&[691.0]);
    assert!(run.status == 1 && run.err.contains("column `691 nm`"), "{}", run.err);
    // Without wavelengths in the middle of the visible band, there are no ends to cut off.
    std::fs::write(&file, "340,0.5\n360,-0.1\n380,0.5\n").unwrap();
    let run = impasto(&["color", file.to_str().unwrap()]);
    assert!(run.status == 1 && run.err.contains("column `360 nm`"), "{}", run.err);
    let most: Vec<f64> = (0..31).map(|i| 340.0 + 13.5 * f64::from(i)).skip(10).collect();
    let run = color(&most);
    assert!(run.status == 1 && run.err.contains("and 21 of its 31 are not"), "{}", run.err);
    let run = impasto(&["color", &fixture("spectrasuite.txt")]);
    assert!(run.err.contains("spectrasuite: cut to 400 to 700 nm"), "{}", run.err);
}

#[test]
fn readings_just_below_zero_count_as_zero_and_are_said() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("dark.dpt");
    let [zero, below, far] = [0.0, -0.019, -0.021].map(|least| {
        let steps = (0..31).map(|i| 400.0 + 10.0 * f64::from(i));
        let lines = steps.map(|nm| format!("{nm},{}\n", if nm < 425.0 { least } else { 0.5 }));
        std::fs::write(&file, lines.collect::<String>()).unwrap();
        impasto(&["color", file.to_str().unwrap()])
    });
    assert_eq!((below.status, &below.out), (0, &zero.out), "{}", below.err);
    let said = "dark: 3 readings just below zero count as 0";
    assert!(below.err.contains(said) && !zero.err.contains(said), "{}", below.err);
    assert!(far.status == 1 && far.err.contains("column `400 nm`"), "{}", far.err);
}

#[test]
fn a_jaz_file_holds_its_own_white_and_dark() {
    let jaz = fixture("madder.jaz");
    let [white, dark] = ["R", "D"].map(|letter| format!("{jaz}#madder ({letter})"));
    fn lab(run: &Run) -> [f64; 3] {
        assert_eq!(run.status, 0, "{}", run.err);
        let json = run.json();
        assert_eq!(json.as_array().unwrap().len(), 1, "one sample: {}", run.out);
        [0, 1, 2].map(|axis| json[0]["lab"][axis].as_f64().unwrap())
    }
    let processed = impasto(&["color", &jaz, "--json"]);
    assert!(!processed.err.contains("left out"), "{}", processed.err);
    let counts = impasto(&["color", &jaz, "--white", &white, "--dark", &dark, "--json"]);
    assert_eq!(counts.json()[0]["sample"], "madder (S)");
    assert_near("S against R and D", &lab(&counts), &lab(&processed), 1e-9);
    // In a file that states no roles, `--white` finds the white by its name.
    let columns = fixture("columns.txt");
    let slate = format!("{columns}#Slate");
    let run =
        impasto(&["color", &columns, "--white", &slate, "--dark", "0", "--tile", "0.3", "--json"]);
    assert_eq!((run.json()[0]["sample"].as_str(), lab(&run).len()), (Some("Madder"), 3));
}

#[test]
fn files_in_memory_give_the_readings_of_files_on_the_disk() {
    let folder = tempfile::tempdir().unwrap();
    // Its column is not an amount, so you can only read its spectra.
    let remark = b"sample,film,backing,Blue,400,500,600\nA,paint,white,much,0.1,0.2,0.3\n".to_vec();
    let files = fixtures().into_iter().chain([("remark.csv".to_owned(), remark)]);
    for (name, bytes) in files {
        let path = folder.path().join(&name);
        std::fs::write(&path, &bytes).unwrap();
        let path = path.to_str().unwrap();
        let options = ReadingOptions::default();
        let files = [(path, bytes)];
        fn with_message(readings: Result<Readings, ReadingsError>) -> Result<Readings, String> {
            readings.map_err(|e| e.to_string())
        }
        let whole = with_message(Readings::open_all(&[path], &options));
        assert_eq!(with_message(Readings::from_files(&files, &options)), whole, "{name}");
        let spectra = with_message(Readings::open_spectra(&[path], &options));
        assert_eq!(with_message(Readings::spectra_from_files(&files, &options)), spectra, "{name}");
    }
}

fn color(name: &str, content: &str) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(name);
    std::fs::write(&file, content).unwrap();
    impasto(&["color", file.to_str().unwrap(), "--json"])
}

fn colors(run: &Run) -> Vec<(String, Vec<f64>)> {
    assert_eq!(run.status, 0, "{}", run.err);
    let json = run.json();
    let samples = json.as_array().unwrap().iter().map(|sample| {
        let lab = [0, 1, 2].iter().map(|axis| sample["lab"][axis].as_f64().unwrap()).collect();
        (sample["sample"].as_str().unwrap().to_owned(), lab)
    });
    samples.collect()
}

const PLAIN: &str = "sample,400,500,600,700\nRed,0.1,0.2,0.6,0.7\nBlue,0.5,0.4,0.2,0.1\n";

#[test]
fn every_way_to_write_a_table_gives_the_same_colors() {
    let expected = colors(&color("plain.csv", PLAIN));
    fn heading(name: &str) -> String {
        PLAIN.replace("sample", name)
    }
    fn comma(separator: &str) -> String {
        let lines = PLAIN.lines().map(|line| {
            let cells = line.split(',').map(|cell| format!("\"{}\"", cell.replace('.', ",")));
            cells.collect::<Vec<_>>().join(separator) + "\r\n"
        });
        lines.collect()
    }
    let falling = "Name;700;600;500;400\nRed;0,7;0,6;0,2;0,1\nBlue;0,1;0,2;0,4;0,5\n";
    let words = PLAIN.replacen("400,500,600,700", "400[nm],500[nm],600[nm],700[nm]", 1);
    let minolta = "Konica Minolta\n\nData Name\tL*(D65)\tSCI 400nm\tSCI 500nm\tSCI 600nm\tSCI 700nm\t\
                   SCE 400nm\tSCE 500nm\tSCE 600nm\tSCE 700nm\n\
                   Red\t50\t10\t20\t60\t70\t9\t19\t59\t69\nBlue\t60\t50\t40\t20\t10\t49\t39\t19\t9\n";
    let nix = "sep=;\nNix Toolkit;1.0\nOriginal Color Name;User Color Name;Mode;R400 nm;R500 nm;\
               R600 nm;R700 nm\nx;Red;M0;0,1;0,2;0,6;0,7\ny;Blue;M0;0,5;0,4;0,2;0,1\n";
    let unnamed = nix.replace(";Red;", ";;").replace(";Blue;", ";;").replace("\nx", "\nRed");
    for (way, content) in [
        ("name", heading("Name")),
        ("id", heading("SAMPLE_ID")),
        ("one word", heading("SampleName")),
        ("data name", heading("Data Name")),
        ("color name", heading("Color Name")),
        ("name in quotes", heading("\"Name\"")),
        ("wavelength in front", heading("wavelength").replace(',', "\t")),
        ("no heading", heading("")),
        (
            "row numbers",
            PLAIN.replace("sample", ",Name").replace("Red", "1,Red").replace("Blue", "2,Blue"),
        ),
        (
            "a column a sample",
            "wavelength\tRed\tBlue\n400\t0.1\t0.5\n500\t0.2\t0.4\n600\t0.6\t0.2\n700\t0.7\t0.1\n"
                .to_owned(),
        ),
        ("a column a sample with films", "wavelength\tRed\tBlue\nfilm\tpaint\tpaint\n400\t0,1\t0,5\n500\t0,2\t0,4\n600\t0,6\t0,2\n700\t0,7\t0,1\n".to_owned()),
        ("title", format!("My paints\nDate,1.1.2026\nName,Anna\n\n{}", heading("Name"))),
        ("quoted commas", comma(",")),
        ("commas between semicolons", comma(";")),
        ("falling", falling.to_owned()),
        ("units", words),
        ("Konica Minolta", minolta.to_owned()),
        ("Nix", nix.to_owned()),
        ("Nix, own names missing", unnamed.replace("\ny", "\nBlue")),
    ] {
        let found = colors(&color("table.csv", &content));
        for ((name, lab), (expected_name, expected_lab)) in found.iter().zip(&expected) {
            assert_eq!(name, expected_name, "{way}");
            assert_near(way, lab, expected_lab, 1e-9);
        }
        assert_eq!(found.len(), 2, "{way}");
    }
}

#[test]
fn rows_of_errors_are_lines_of_the_file() {
    for (content, place) in [
        ("Title\r\n\r\nName,400,500\r\nRed,0.1,0.2\r\n\r\nBlue,0.1,x\r\n", "row 6, column `500`"),
        ("Title\n\"a\nb\"\nName;500;400\nRed;0,1;0,2\nBlue;x;0,2\n", "row 6, column `500`"),
        (
            "Title\nName,500,400,450\nRed,0.1,0.2,0.3\n",
            "row 2, column `450`: wavelengths must rise or fall",
        ),
        ("Title\nName,500,,450\nRed,0.1,0.2,0.3\n", "row 2: column number 3 has no header"),
        (
            "Title\n\nName,Code,400,500\n,,0.1,0.2\n",
            "row 4, column `Name`: expected the sample's name",
        ),
        ("Title\nName,400,500\nRed,0.1\n", "row 3: expected 3 cells"),
        ("sample;A;B\n\nfilm;paint;none\n400;0,1;0,2\n500;0,1;x\n", "row 5, column `B`"),
        (
            "sample;A;B\n\nfilm;paint;none\n400;0,1;0,2\n500;0,1;-1\n",
            "row 5, column `B`: expected a reflectance from 0 to 2",
        ),
        ("sample;A;B\n\nfilm;paint;none\n500;0,1;0,2\n400;1;1\n450;1;1\n", "row 6, column `450`"),
    ] {
        let run = color("table.csv", content);
        assert_eq!(run.status, 1, "{content}\n{}", run.err);
        assert!(run.err.contains(place), "`{place}` is missing: {}", run.err);
    }
}

#[test]
fn columns_beside_the_names_are_told() {
    let both = "Data Name,SCI 400nm,SCI 500nm,SCI 700nm,SCE 400nm,SCE 500nm\nRed,10,20,30,9,19\n";
    let run = color("table.csv", both);
    assert!(run.err.contains("without the specular component (SCE) are left out"), "{}", run.err);
    let run = color("table.csv", "SAMPLE_ID,SAMPLE_NAME,Mode,400,500,700\n1,Red,M0,0.1,0.2,0.3\n");
    assert_eq!(colors(&run)[0].0, "Red");
    let run = color("table.csv", "sample,White,400,500,700\nRed,\"1,000\",0.1,0.2,0.3\n");
    assert_eq!(run.status, 0, "amounts take no part in colours: {}", run.err);
}

/// Runs `color` on a fixture, with the first `from` replaced by `to`.
fn color_of(name: &str, from: &str, to: &str) -> Run {
    let bytes = std::fs::read(fixture(name)).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    assert!(text.contains(from), "{name} holds `{from}`");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(name);
    std::fs::write(&file, text.replacen(from, to, 1)).unwrap();
    impasto(&["color", file.to_str().unwrap()])
}

#[test]
fn faults_are_refused_with_file_and_line() {
    for (name, from, to, words) in [
        ("two.cgats", "0.105", "NaN", &["line 10", "`NaN`"][..]),
        ("two.cgats", "NUMBER_OF_SETS 2", "NUMBER_OF_SETS 3", &["line 12", "states 3", "`2`"]),
        ("two.cgats", "END_DATA\n", "", &["END_DATA"]),
        ("two.cgats", "SPECTRAL_NM450", "SPECTRAL_NM400", &["400 nm occurs twice", "hint"]),
        ("two.qtx", "20, 10.5", "20, ten", &["line 7", "`ten`"]),
        ("two.qtx", "20, 10.5, ", "20, ", &["line 7", "states 7", "hint"]),
        ("spectrasuite.txt", "400,00\t20", "400,00\tinf", &["line 10", "`inf`"]),
        ("madder.jaz", "500.0\t998.0", "500.0", &["line 11", "as many values"]),
        ("packed.jdx", "550F1", "550F2", &["line 13", "check"]),
        ("points.jdx", "450, 10.5", "450", &["line 17", "pairs"]),
        ("madder.ttt", "10.5000", "--", &["line 7", "`--`"]),
        ("madder.dpt", "450.00000,0.10500", "350.00000,0.10500", &["line 3", "rise or fall"]),
        (
            "madder.dpt",
            "500.00000,0.12000",
            "500.00000,-0.1200",
            &["row 3, column `500 nm`", "of madder", "`-0.12`"],
        ),
    ] {
        let run = color_of(name, from, to);
        assert_eq!(run.status, 1, "{name}, {to}: {}{}", run.out, run.err);
        assert!(run.err.contains(name) && run.out.is_empty(), "{}", run.err);
        for word in words {
            assert!(run.err.contains(word), "{name}: `{word}` is missing: {}", run.err);
        }
    }
}

#[test]
fn other_quantities_are_refused_with_the_way_out() {
    for (name, from, to, words) in [
        ("madder.sp", "REFLECTIVE", "EMISSION", &["the power of a light", "--illuminant"]),
        (
            "spectrasuite.txt",
            "Spectrum Present: Yes\r\nN",
            "Spectrum Present: No\r\nN",
            &["counts", "--white"],
        ),
    ] {
        let run = color_of(name, from, to);
        assert_eq!(run.status, 1, "{name}: {}", run.err);
        for word in words {
            assert!(run.err.contains(word), "{name}: `{word}` is missing: {}", run.err);
        }
    }
}

#[test]
fn transmittance_is_reflectance_where_that_is_told() {
    let text = std::fs::read_to_string(fixture("madder.ttt")).unwrap();
    // Avantes names the quantity in two places.
    let text = text.replace("Reflectance", "Transmittance").replace("% reflectance", "%");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("madder.ttt");
    std::fs::write(&file, text).unwrap();
    let run = impasto(&["color", file.to_str().unwrap()]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(
        run.err.contains("transmittance") && run.err.contains("--as-reflectance"),
        "{}",
        run.err
    );
    let run = impasto(&["color", file.to_str().unwrap(), "--as-reflectance"]);
    let same = impasto(&["color", &fixture("madder.ttt")]);
    assert_eq!((run.status, run.out), (0, same.out), "{}", run.err);
}

#[test]
fn spectra_on_different_wavelengths_are_brought_together_or_refused() {
    let short = color_of("two.qtx", "BAT_REFLLOW=400", "BAT_REFLLOW=500");
    // They are brought together, but have no colour.
    assert_eq!(short.status, 1, "{}", short.err);
    assert!(short.err.contains("brought to 500 to 700 nm"), "{}", short.err);
    assert!(short.err.contains("have no colour"), "{}", short.err);
    let apart = color_of("two.qtx", "BAT_REFLLOW=400", "BAT_REFLLOW=750");
    assert_eq!(apart.status, 1, "{}", apart.err);
    for word in ["Madder ends at 700", "Slate begins at 750", "hint"] {
        assert!(apart.err.contains(word), "`{word}` is missing: {}", apart.err);
    }
}

#[test]
fn a_format_that_is_told_is_the_one_that_is_read() {
    let run = impasto(&["color", &fixture("madder.dpt"), "--format", "columns"]);
    assert!(run.status == 0 && run.err.contains("columns of text"), "{}", run.err);
    let run = impasto(&["color", &fixture("madder.dpt"), "--format", "qtx"]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("no spectrum in this Datacolor QTX file"), "{}", run.err);
    let run = impasto(&["color", &fixture("madder.dpt"), "--format", "csv"]);
    assert!(run.status == 1 && run.err.contains("row 1: no column `sample`"), "{}", run.err);
    let run = impasto(&["color", &fixture("madder.dpt"), "--format", "xls"]);
    assert_eq!(run.status, 2, "{}", run.err);
}

const FILE: &str = "some/file.txt";

/// Reads the bytes in every format and with the detected format. Checks the spectra or the error.
fn read_every_way(bytes: &[u8]) {
    let formats = Format::ALL.into_iter().map(Some).chain([None]);
    for format in formats {
        match read(FILE, bytes, format) {
            Ok(file) => {
                assert!(!file.spectra.is_empty(), "{format:?} without a spectrum");
                for record in file.spectra {
                    let nm = &record.wavelengths_nm;
                    assert!(nm.windows(2).all(|pair| pair[0] < pair[1]), "{format:?} {nm:?}");
                    assert!(nm.iter().all(|nm| nm.is_finite() && *nm > 0.0), "{format:?} {nm:?}");
                    let finite = record.values.iter().all(|value| value.is_finite());
                    assert!(finite && record.values.len() == nm.len(), "{format:?}");
                    assert!(record.line > 0, "{format:?}");
                }
            }
            Err(error) => assert!(error.to_string().contains(FILE), "{format:?}: {error}"),
        }
    }
}

/// Edits of a file: places, as fractions of its length, and bytes to put there.
fn edits() -> impl Strategy<Value = Vec<(f64, Vec<u8>)>> {
    let piece = prop_oneof![
        proptest::collection::vec(any::<u8>(), 0..4),
        "[0-9eE+.,;\t\n -]{0,6}".prop_map(String::into_bytes),
        "[A-Za-s%@$#=]{1,4}[0-9]{0,9}".prop_map(String::into_bytes),
    ];
    proptest::collection::vec((0.0..1.0, piece), 0..6)
}

fn cases() -> u32 {
    // The environment variable PROPTEST_CASES sets another number.
    std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(300)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn arbitrary_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        read_every_way(&bytes);
    }

    #[test]
    fn spoilt_files(which in any::<prop::sample::Index>(), edits in edits(), kept in 0.0..1.5) {
        let files = fixtures();
        let mut bytes = which.get(&files).1.clone();
        for (at, piece) in edits {
            let from = (at * bytes.len() as f64) as usize;
            let to = (from + piece.len().max(1)).min(bytes.len());
            bytes.splice(from..to, piece);
        }
        bytes.truncate((kept * bytes.len() as f64) as usize);
        read_every_way(&bytes);
    }
}
