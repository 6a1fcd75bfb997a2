//! Formats of instruments: every fixture is recognized and gives the known values, with the reader
//! and with `impasto color`.

use calibrate::{ReadingOptions, Readings, ReadingsError};
use spectra::instrument::{Format, MeasuredQuantity, MeasuredSpectrum, Role, Unit, read};
use suite::near::assert_near;
use suite::program::{Run, impasto};

use super::{fixture, fixtures};

const NM: [f64; 7] = [400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0];
const MADDER: [f64; 7] = [20.0, 10.5, 12.0, 15.25, 60.0, 70.0, 75.0];
const SLATE: [f64; 7] = [50.0, 40.0, 30.0, 25.0, 20.0, 15.0, 12.5];

/// File, format, names of its spectra, and the reading of a perfect white.
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
        let is_main = |record: &&MeasuredSpectrum| record.role == Role::Main;
        let mains: Vec<&MeasuredSpectrum> = found.spectra.iter().filter(is_main).collect();
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
    let record = |file: &str| {
        let bytes = std::fs::read(fixture(file)).unwrap();
        read(file, &bytes, None).unwrap().spectra.remove(0)
    };
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
            let lab = |json: &serde_json::Value| {
                [0, 1, 2].map(|axis| json[index]["lab"][axis].as_f64().unwrap())
            };
            assert_near(file, &lab(&found), &lab(&sheet), 1e-6);
        }
    }
}

#[test]
fn noise_at_the_ends_is_cut_and_said_and_inside_it_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("ends.dpt");
    let color = |bad: &[f64]| {
        let steps = (0..31).map(|i| 340.0 + 13.5 * f64::from(i));
        let noise = |nm: f64| if bad.contains(&nm) { -0.05 } else { 0.5 };
        let lines: String = steps.map(|nm| format!("{nm},{}\n", noise(nm))).collect();
        std::fs::write(&file, lines).unwrap();
        impasto(&["color", file.to_str().unwrap()])
    };
    let run = color(&[340.0, 367.0, 704.5, 731.5]);
    assert_eq!(run.status, 0, "{}", run.err);
    let said = "ends: cut to 380.5 to 691 nm; beyond, readings are not from 0 to 2\n";
    assert!(run.err.contains(said), "{}", run.err);
    let run = color(&[691.0]);
    assert!(run.status == 1 && run.err.contains("column `691 nm`"), "{}", run.err);
    // A file without wavelengths in the middle of the visible band has no ends to cut off.
    std::fs::write(&file, "340,0.5\n360,-0.1\n380,0.5\n").unwrap();
    let run = impasto(&["color", file.to_str().unwrap()]);
    assert!(run.status == 1 && run.err.contains("column `360 nm`"), "{}", run.err);
    let most: Vec<f64> = (0..31).map(|i| 340.0 + 13.5 * f64::from(i)).skip(10).collect();
    let run = color(&most);
    assert!(
        run.status == 1 && run.err.contains("most of its 31 are not, found `21`"),
        "{}",
        run.err
    );
    let run = impasto(&["color", &fixture("spectrasuite.txt")]);
    assert!(run.err.contains("spectrasuite: cut to 400 to 700 nm"), "{}", run.err);
}

#[test]
fn readings_just_below_zero_count_as_zero_and_are_said() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("dark.dpt");
    let color = |least: f64| {
        let steps = (0..31).map(|i| 400.0 + 10.0 * f64::from(i));
        let lines = steps.map(|nm| format!("{nm},{}\n", if nm < 425.0 { least } else { 0.5 }));
        std::fs::write(&file, lines.collect::<String>()).unwrap();
        impasto(&["color", file.to_str().unwrap()])
    };
    let zero = color(0.0);
    let below = color(-0.019);
    assert_eq!((below.status, &below.out), (0, &zero.out), "{}", below.err);
    let said = "dark: 3 readings just below zero count as 0";
    assert!(below.err.contains(said) && !zero.err.contains(said), "{}", below.err);
    let far = color(-0.021);
    assert!(far.status == 1 && far.err.contains("column `400 nm`"), "{}", far.err);
}

#[test]
fn a_jaz_file_holds_its_own_white_and_dark() {
    let jaz = fixture("madder.jaz");
    let [white, dark] = ["R", "D"].map(|letter| format!("{jaz}#madder ({letter})"));
    let lab = |run: &Run| {
        assert_eq!(run.status, 0, "{}", run.err);
        let json = run.json();
        assert_eq!(json.as_array().unwrap().len(), 1, "one sample: {}", run.out);
        [0, 1, 2].map(|axis| json[0]["lab"][axis].as_f64().unwrap())
    };
    let processed = impasto(&["color", &jaz, "--json"]);
    assert!(!processed.err.contains("left out"), "{}", processed.err);
    let counts = impasto(&["color", &jaz, "--white", &white, "--dark", &dark, "--json"]);
    assert_eq!(counts.json()[0]["sample"], "madder (S)");
    assert_near("S against R and D", &lab(&counts), &lab(&processed), 1e-9);
    // In a file that states no roles, the name in `--white` finds the white.
    let columns = fixture("columns.txt");
    let slate = format!("{columns}#Slate");
    let run =
        impasto(&["color", &columns, "--white", &slate, "--dark", "0", "--tile", "0.3", "--json"]);
    assert_eq!((run.json()[0]["sample"].as_str(), lab(&run).len()), (Some("Madder"), 3));
}

#[test]
fn files_in_memory_give_the_readings_of_files_on_the_disk() {
    let folder = tempfile::tempdir().unwrap();
    // Its column is no amount: only its spectra can be read.
    let remark = b"sample,film,backing,Blue,400,500,600\nA,paint,white,much,0.1,0.2,0.3\n".to_vec();
    let files = fixtures().into_iter().chain([("remark.csv".to_owned(), remark)]);
    for (name, bytes) in files {
        let path = folder.path().join(&name);
        std::fs::write(&path, &bytes).unwrap();
        let path = path.to_str().unwrap();
        let options = ReadingOptions::default();
        let files = [(path, bytes)];
        let told = |readings: Result<Readings, ReadingsError>| readings.map_err(|e| e.to_string());
        let whole = told(Readings::open_all(&[path], &options));
        assert_eq!(told(Readings::from_files(&files, &options)), whole, "{name}");
        let spectra = told(Readings::open_spectra(&[path], &options));
        assert_eq!(told(Readings::spectra_from_files(&files, &options)), spectra, "{name}");
    }
}
