//! Folders of Specim cameras, counts with white and dark readings, files that you read yourself,
//! and Zarr arrays.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use maps::cube::{Cube, CubeError, CubeOptions, CubeValues, DarkReading, ReadAt, ScanFile};
use maps::pixel_maps::Mask;
use serde_json::{Value, json};

use crate::written::{
    BANDS, LINES, SAMPLES, by_200, bytes, check, check_block, header, in_order, refused, told,
    value, write_envi,
};

fn dark(sample: usize, band: usize) -> f64 {
    100.0 + 3.0 * sample as f64 + 7.0 * band as f64
}

/// Light of the white of a column and band.
fn light(sample: usize, band: usize) -> f64 {
    2000.0 + 100.0 * sample as f64 - 200.0 * band as f64
}

fn write_counts(
    folder: &Path,
    name: &str,
    lines: usize,
    more: &str,
    count: impl Fn(usize, usize, usize) -> f64,
) -> PathBuf {
    let mut data = Vec::new();
    for line in 0..lines {
        for band in 0..BANDS {
            for sample in 0..SAMPLES {
                data.extend((count(line, sample, band).round() as u16).to_le_bytes());
            }
        }
    }
    let text = header("bil", 12, more).replace("lines = 5", &format!("lines = {lines}"));
    write_envi(folder, name, &text, &data)
}

fn reflectance(line: usize, sample: usize, band: usize) -> f64 {
    f64::from(value(line, sample, band)) / 200.0
}

/// Writes a camera's folder with counts. The white alternates around its mean.
fn write_folder(folder: &Path) -> PathBuf {
    let capture = folder.join("capture");
    std::fs::create_dir_all(&capture).unwrap();
    write_counts(&capture, "WHITEREF_042", 4, "", |line, sample, band| {
        dark(sample, band) + light(sample, band) + swing(line)
    });
    write_counts(&capture, "DARKREF_042", 2, "", |_, sample, band| dark(sample, band));
    write_counts(&capture, "042", LINES, "", |line, sample, band| {
        dark(sample, band) + light(sample, band) * reflectance(line, sample, band)
    })
}

fn swing(line: usize) -> f64 {
    if line.is_multiple_of(2) { 10.0 } else { -10.0 }
}

/// Checks reflectances from counts, which are rounded to whole numbers.
fn check_near(cube: &Cube) {
    let block = cube.read(1..LINES, 1..SAMPLES).unwrap();
    let mut pixels = block.iter();
    for line in 1..LINES {
        for sample in 1..SAMPLES {
            let (values, mask) = pixels.next().unwrap();
            assert_eq!(mask, Mask::Mapped, "{line} {sample}");
            for (band, found) in values.iter().enumerate() {
                let expected = reflectance(line, sample, band);
                let far = (f64::from(*found) - expected).abs();
                assert!(far < 0.51 / light(sample, band), "{line} {sample} {band}: {found}");
            }
        }
    }
}

#[test]
fn counts_of_a_folder_become_reflectance_by_column_and_band() {
    let folder = tempfile::tempdir().unwrap();
    let scan = write_folder(folder.path());
    let cube = Cube::open(folder.path()).unwrap();
    check_near(&cube);
    assert_eq!(cube.values(), CubeValues::ByBands);
    let remark = &cube.remarks()[0].text;
    assert!(remark.contains("042.hdr") && remark.contains("white and dark"), "{remark}");
    // The swing of 10 counts over four lines, in reflectance of the mean light of all columns.
    let sd = (400.0_f64 / 3.0).sqrt();
    for (band, found) in cube.white_sd().unwrap().iter().enumerate() {
        let mean = light(3, band);
        assert!((found - sd / mean).abs() < 1e-6, "band {band}: {found}");
    }
    assert_eq!(cube.black_sd(), Some(&[0.0; BANDS][..]));
    check_near(&Cube::open(folder.path().join("capture")).unwrap());
    // The header alone needs the readings by settings.
    let (found, _) = refused(&scan, &CubeOptions::default());
    assert!(found.contains("the values are not reflectances"), "{found}");
    let capture = folder.path().join("capture");
    let options = CubeOptions {
        white_reading: Some(capture.join("WHITEREF_042.hdr")),
        dark_reading: DarkReading::File(capture.join("DARKREF_042.hdr")),
        ..CubeOptions::default()
    };
    check_near(&Cube::open_with(&scan, &options).unwrap());
    let half = CubeOptions { tile: 0.5, ..options.clone() };
    let cube = Cube::open_with(&scan, &half).unwrap();
    let found = cube.read(2..3, 2..3).unwrap().values[1];
    assert!((f64::from(found) - reflectance(2, 2, 1) / 2.0).abs() < 1e-3, "{found}");
    let none = CubeOptions { dark_reading: DarkReading::Missing, ..options };
    let (found, hint) = refused(&scan, &none);
    assert!(found.ends_with("the white reading needs a dark reading"), "{found}");
    assert!(hint.contains("`dark_reading = FILE`"), "{hint}");
}

#[test]
fn the_cameras_own_reflectance_comes_first() {
    let folder = tempfile::tempdir().unwrap();
    write_folder(folder.path());
    let results = folder.path().join("results");
    std::fs::create_dir(&results).unwrap();
    let values = in_order("bil").into_iter().map(|value| f32::from(value) / 400.0);
    let data: Vec<u8> = values.flat_map(f32::to_le_bytes).collect();
    write_envi(&results, "REFLECTANCE_042", &header("bil", 4, ""), &data);
    let cube = Cube::open(folder.path()).unwrap();
    check(&cube, 1.0 / 400.0, "results");
    assert!(cube.remarks()[0].text.starts_with("the camera's reflectance is read"));
}

#[test]
fn one_column_of_readings_serves_all_columns() {
    let folder = tempfile::tempdir().unwrap();
    let [white, dark] = [("white", 2100_u16), ("dark", 100)].map(|(name, count)| {
        let text = header("bil", 12, "").replace("samples = 7", "samples = 1");
        let text = text.replace("lines = 5", "lines = 1");
        let data: Vec<u8> = [count; BANDS].into_iter().flat_map(u16::to_le_bytes).collect();
        write_envi(folder.path(), name, &text, &data)
    });
    let scan = write_counts(folder.path(), "scan", LINES, "", |line, sample, band| {
        100.0 + 10.0 * f64::from(value(line, sample, band))
    });
    let options = CubeOptions {
        white_reading: Some(white),
        dark_reading: DarkReading::File(dark),
        ..CubeOptions::default()
    };
    let cube = Cube::open_with(&scan, &options).unwrap();
    check_block(&cube.read_rows(0..LINES).unwrap(), 1.0 / 200.0, "one column");
}

/// Message of opening a folder with changed files.
fn refused_folder(change: impl Fn(&Path)) -> (String, String) {
    let folder = tempfile::tempdir().unwrap();
    write_folder(folder.path());
    change(&folder.path().join("capture"));
    refused(folder.path(), &CubeOptions::default())
}

#[test]
fn wrong_readings_are_refused_with_their_numbers() {
    let (found, hint) = refused_folder(|capture| {
        write_counts(capture, "WHITEREF_042", 1, "", |_, sample, band| dark(sample, band) - 5.0);
    });
    assert!(found.contains("`-5` above its dark"), "{found}");
    assert!(hint.contains("interchanged"), "{hint}");

    let (found, _) = refused_folder(|capture| {
        write_counts(capture, "WHITEREF_042", 1, "", |_, sample, band| {
            dark(sample, band) + if band == 2 { 4.0 } else { light(sample, band) }
        });
    });
    assert!(found.contains("too little light at 600.5 nm: `4` above its dark"), "{found}");

    let (found, _) = refused_folder(|capture| {
        write_counts(capture, "WHITEREF_042", 1, "", |_, _, _| 65535.0);
    });
    assert!(found.contains("is saturated: its largest count is `65535`"), "{found}");

    let (found, _) = refused_folder(|capture| {
        let text = header("bil", 12, "").replace("samples = 7", "samples = 6");
        write_envi(capture, "DARKREF_042", &text, &[1; 2 * LINES * 6 * BANDS]);
    });
    assert!(found.contains("the dark reading has 6 samples, expected 7"), "{found}");

    let (found, _) = refused_folder(|capture| {
        let text = header("bil", 12, "").replace("500,", "501,");
        write_envi(capture, "DARKREF_042", &text, &[1; 2 * LINES * SAMPLES * BANDS]);
    });
    assert!(found.contains("has a band at 501 nm where the scan has 500 nm"), "{found}");

    let (found, hint) = refused_folder(|capture| {
        for (name, time) in [("042", "tint = 10\n"), ("WHITEREF_042", "tint = 5\n")] {
            let path = capture.join(format!("{name}.hdr"));
            let text = std::fs::read_to_string(&path).unwrap();
            std::fs::write(&path, text + time).unwrap();
        }
    });
    assert!(found.contains("was integrated for 5 (`tint`), the scan for 10"), "{found}");
    assert!(hint.contains("does not scale with time"), "{hint}");

    let (found, _) = refused_folder(|capture| {
        for ending in ["hdr", "raw"] {
            std::fs::remove_file(capture.join(format!("DARKREF_042.{ending}"))).unwrap();
        }
    });
    assert!(found.ends_with("the white reading needs a dark reading"), "{found}");
}

#[test]
fn a_white_of_another_time_is_scaled_by_its_own_dark() {
    let folder = tempfile::tempdir().unwrap();
    write_folder(folder.path());
    let capture = folder.path().join("capture");
    // The white at half the time: half the light above a dark of its own.
    write_counts(&capture, "WHITEREF_042", 1, "tint = 5\n", |_, sample, band| {
        50.0 + light(sample, band) / 2.0
    });
    write_counts(&capture, "WHITEDARKREF_042", 1, "tint = 5\n", |_, _, _| 50.0);
    let path = capture.join("042.hdr");
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text + "tint = 10\n").unwrap();
    check_near(&Cube::open(folder.path()).unwrap());
}

#[test]
fn columns_without_light_are_not_mapped_and_told() {
    let folder = tempfile::tempdir().unwrap();
    let wide = 40;
    let text = header("bil", 12, "").replace("samples = 7", &format!("samples = {wide}"));
    let [one_line, two_lines] =
        [1, 2].map(|lines| text.replace("lines = 5", &format!("lines = {lines}")));
    let counts = |lines: usize, count: &dyn Fn(usize) -> u16| -> Vec<u8> {
        let rows = (0..lines * BANDS).flat_map(|_| 0..wide);
        rows.flat_map(|column| count(column).to_le_bytes()).collect()
    };
    let capture = folder.path().join("capture");
    std::fs::create_dir(&capture).unwrap();
    let white = counts(1, &|column| if column == 3 { 100 } else { 1100 });
    write_envi(&capture, "WHITEREF_a", &one_line, &white);
    write_envi(&capture, "DARKREF_a", &one_line, &counts(1, &|_| 100));
    write_envi(&capture, "a", &two_lines, &counts(2, &|_| 600));
    let cube = Cube::open(folder.path()).unwrap();
    let told = cube
        .remarks()
        .iter()
        .any(|remark| remark.text.starts_with("1 of 40 columns have no light"));
    assert!(told, "{:?}", cube.remarks());
    let block = cube.read_rows(0..2).unwrap();
    for (at, (values, mask)) in block.iter().enumerate() {
        match at % wide {
            3 => assert_eq!(mask, Mask::NotFinite, "pixel {at}"),
            _ => assert_eq!((values, mask), (&[0.5; BANDS][..], Mask::Mapped), "pixel {at}"),
        }
    }
}

#[derive(Debug)]
struct Memory(Vec<u8>);

impl ReadAt for Memory {
    fn bytes(&self) -> u64 {
        self.0.len() as u64
    }

    fn read_exact_at(&self, buffer: &mut [u8], position: u64) -> io::Result<()> {
        let from = usize::try_from(position).unwrap_or(usize::MAX);
        let part = self.0.get(from..).and_then(|rest| rest.get(..buffer.len()));
        buffer.copy_from_slice(part.ok_or(io::ErrorKind::UnexpectedEof)?);
        Ok(())
    }
}

fn file(name: &str, bytes: impl Into<Vec<u8>>) -> ScanFile {
    ScanFile { name: PathBuf::from(name), contents: Arc::new(Memory(bytes.into())) }
}

fn data(interleave: &str) -> Vec<u8> {
    in_order(interleave).into_iter().flat_map(|value| bytes(12, value, false)).collect()
}

#[test]
fn header_and_data_are_read_wherever_they_lie() {
    for interleave in ["bsq", "bil", "bip"] {
        for name in ["scan.img", "scan", "other.dat"] {
            let files =
                [file(name, data(interleave)), file("scan.hdr", header(interleave, 12, ""))];
            let cube = Cube::of_files(&files, &by_200()).unwrap();
            check(&cube, 1.0 / 200.0, &format!("{interleave}, {name}"));
            assert_eq!(cube.path(), Path::new("scan.hdr"));
        }
    }
}

#[test]
fn of_several_data_files_the_one_of_the_right_size_is_read() {
    let files = [
        file("scan", [0; 7]),
        file("scan.hdr", header("bil", 12, "")),
        file("scan.img", data("bil")),
        file("scan.raw", [0; 9]),
    ];
    check(&Cube::of_files(&files, &by_200()).unwrap(), 1.0 / 200.0, "scan.img");
}

#[test]
fn readings_are_among_the_files() {
    let small = header("bip", 12, "")
        .replace("samples = 7", "samples = 1")
        .replace("lines = 5", "lines = 1");
    let files = [
        file("scan.hdr", header("bil", 12, "")),
        file("scan.raw", data("bil")),
        file("white.hdr", small.clone()),
        file("white.raw", reading(200)),
        file("dark.hdr", small),
        file("dark.raw", reading(0)),
    ];
    let options = CubeOptions {
        white_reading: Some("white.hdr".into()),
        dark_reading: DarkReading::File("dark.hdr".into()),
        ..CubeOptions::default()
    };
    check(&Cube::of_files(&files, &options).unwrap(), 1.0 / 200.0, "white and dark");
    let missing = CubeOptions { white_reading: Some("lost.hdr".into()), ..options };
    let (message, _) = told(&Cube::of_files(&files[..2], &missing).unwrap_err());
    assert_eq!(message, "lost.hdr: is not among the files");
}

fn reading(value: u8) -> Vec<u8> {
    (0..BANDS).flat_map(|_| bytes(12, value, false)).collect()
}

#[test]
fn files_that_are_no_scan_are_refused() {
    let refused = |files: &[ScanFile]| told(&Cube::of_files(files, &by_200()).unwrap_err());
    let both = "give the header (.hdr) and its data file together";
    let (message, hint) = refused(&[head()]);
    assert_eq!(message, "scan.hdr: the data of this header are not beside it");
    assert_eq!(hint, both);
    let (message, hint) = refused(&[file("scan.img", data("bil"))]);
    assert_eq!(
        message,
        "scan.img: is not a cube that can be read, and no header of ENVI is beside it"
    );
    assert_eq!(hint, both);
    let (message, _) = refused(&[head(), file("b.hdr", "ENVI\n")]);
    assert_eq!(message, "scan.hdr: is one of 2 headers of ENVI");
    let (message, hint) = refused(&[file("a.mat", "MATLAB 5.0 MAT-file")]);
    assert_eq!(message, "a.mat: is a MATLAB file");
    assert!(hint.contains("export ENVI"), "{hint}");
    assert_eq!(refused(&[]).0, "scan: no file is given");
    let short = data("bil");
    let error = Cube::of_files(&[head(), file("scan.raw", &short[2..])], &by_200()).unwrap_err();
    assert!(matches!(error, CubeError::Size { .. }), "{error}");
}

fn head() -> ScanFile {
    file("scan.hdr", header("bil", 12, ""))
}

fn write(path: &Path, bytes: &[u8]) {
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, bytes).unwrap();
}

fn describe(folder: &Path, document: &Value) {
    write(&folder.join("zarr.json"), document.to_string().as_bytes());
}

fn zarr_reflectance(line: usize, sample: usize, band: usize) -> f32 {
    f32::from(value(line, sample, band)) / 200.0
}

/// Writes the group of a cube with chunks of 2 rows, 3 columns and 3 bands, without packing. `axes`
/// is the order of axes, where 0 is the row, 1 the column and 2 the band.
fn write_group(folder: &Path, axes: [usize; 3], transpose: Option<[usize; 3]>) {
    let names = ["y", "x", "wavelength"];
    let sizes = [LINES, SAMPLES, BANDS];
    let chunk = [2, 3, 3];
    let shape = axes.map(|axis| sizes[axis]);
    let chunks = axes.map(|axis| chunk[axis]);
    let mut codecs = vec![json!({"name": "bytes", "configuration": {"endian": "little"}})];
    if let Some(order) = transpose {
        codecs.insert(0, json!({"name": "transpose", "configuration": {"order": order}}));
    }
    let cube = folder.join("reflectance");
    describe(
        &cube,
        &json!({
            "zarr_format": 3, "node_type": "array", "shape": shape, "data_type": "float32",
            "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": chunks}},
            "chunk_key_encoding": {"name": "default", "configuration": {"separator": "/"}},
            "fill_value": "NaN", "codecs": codecs, "attributes": {},
            "dimension_names": axes.map(|axis| names[axis]),
        }),
    );
    let order = transpose.unwrap_or([0, 1, 2]);
    let counts = [0, 1, 2].map(|at| shape[at].div_ceil(chunks[at]));
    for index in 0..counts.iter().product() {
        let at =
            [index / (counts[1] * counts[2]), index / counts[2] % counts[1], index % counts[2]];
        let stored = order.map(|axis| chunks[axis]);
        let mut bytes = Vec::new();
        for number in 0..stored.iter().product() {
            let place = [
                number / (stored[1] * stored[2]),
                number / stored[2] % stored[1],
                number % stored[2],
            ];
            let mut by_role = [0; 3];
            for (place, axis) in place.into_iter().zip(order) {
                by_role[axes[axis]] = at[axis] * chunks[axis] + place;
            }
            let inside = (0..3).all(|role| by_role[role] < sizes[role]);
            let [line, sample, band] = by_role;
            let number = if inside { zarr_reflectance(line, sample, band) } else { f32::NAN };
            bytes.extend(number.to_le_bytes());
        }
        write(&cube.join(format!("c/{}/{}/{}", at[0], at[1], at[2])), &bytes);
    }
    let nm = [400.0_f64, 500.0, 600.5, 700.0];
    let coordinate = folder.join("wavelength");
    describe(
        &coordinate,
        &json!({
            "zarr_format": 3, "node_type": "array", "shape": [BANDS], "data_type": "float64",
            "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": [3]}},
            "chunk_key_encoding": {"name": "v2"}, "fill_value": 0.0,
            "codecs": [{"name": "bytes", "configuration": {"endian": "big"}}],
            "attributes": {"units": "nm"}, "dimension_names": ["wavelength"],
        }),
    );
    let bytes: Vec<u8> = nm.iter().flat_map(|nm| nm.to_be_bytes()).collect();
    write(&coordinate.join("0"), &bytes[..24]);
    write(&coordinate.join("1"), &[&bytes[24..], &[0; 16]].concat());
    describe(folder, &json!({"zarr_format": 3, "node_type": "group", "attributes": {}}));
}

#[test]
fn arrays_of_any_order_of_axes_are_read() {
    for axes in [[0, 1, 2], [2, 0, 1], [1, 0, 2]] {
        for transpose in [None, Some([2, 0, 1]), Some([1, 2, 0])] {
            let folder = tempfile::tempdir().unwrap();
            write_group(folder.path(), axes, transpose);
            let place = format!("{axes:?}, {transpose:?}");
            check(&Cube::open(folder.path()).unwrap(), 1.0 / 200.0, &place);
            let array = folder.path().join("reflectance");
            check(&Cube::open(&array).unwrap(), 1.0 / 200.0, &place);
            check(&Cube::open(array.join("zarr.json")).unwrap(), 1.0 / 200.0, &place);
        }
    }
}

#[test]
fn missing_chunks_hold_the_fill_value() {
    let folder = tempfile::tempdir().unwrap();
    write_group(folder.path(), [0, 1, 2], None);
    std::fs::remove_file(folder.path().join("reflectance/c/0/1/0")).unwrap();
    let cube = Cube::open(folder.path()).unwrap();
    let block = cube.read_rows(0..LINES).unwrap();
    for (at, mask) in block.mask.iter().enumerate() {
        let line = at / SAMPLES;
        let sample = at % SAMPLES;
        let is_missing = line < 2 && (3..6).contains(&sample);
        assert_eq!(*mask == Mask::NotFinite, is_missing, "line {line}, sample {sample}");
    }
}

/// Message and hint of opening a group with a changed description of an array.
fn refused_array(array: &str, key: &str, changed: Value) -> (String, String) {
    let folder = tempfile::tempdir().unwrap();
    write_group(folder.path(), [0, 1, 2], None);
    let path = folder.path().join(array).join("zarr.json");
    let mut document: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    document[key] = changed;
    std::fs::write(&path, document.to_string()).unwrap();
    refused(folder.path(), &CubeOptions::default())
}

#[test]
fn arrays_of_other_kinds_are_refused() {
    let huge = 1_u64 << 40;
    for (array, key, changed, words) in [
        (
            "reflectance",
            "codecs",
            json!([{"name": "bytes"}, {"name": "blosc"}]),
            "is packed by `blosc`",
        ),
        ("reflectance", "data_type", json!("complex64"), "no real numbers"),
        ("reflectance", "dimension_names", json!(["a", "b", "c"]), "expected y, x and wavelength"),
        (
            "reflectance",
            "dimension_names",
            json!(["y", "y", "x", "wavelength"]),
            "expected y, x and wavelength",
        ),
        ("reflectance", "shape", json!([5, 7]), "holds no array of three axes"),
        ("reflectance", "shape", json!([5, 7, 3]), "has 4 wavelengths, the cube 3 bands"),
        ("reflectance", "chunk_grid", json!({"name": "rectangular"}), "has the chunk grid"),
        (
            "reflectance",
            "chunk_grid",
            json!({"name": "regular", "configuration": {"chunk_shape": [huge, 1, 1]}}),
            "more than 512 MB",
        ),
        ("wavelength", "attributes", json!({"units": "um"}), "these look like nm"),
        // Descriptions that no file backs take no memory.
        ("reflectance", "shape", json!([5, 7, huge]), "expected at most 65536 bands"),
        ("reflectance", "shape", json!([5, huge, 4]), "numbers in a row"),
        ("reflectance", "shape", json!([huge, 7, 4]), "rows of 7 pixels"),
        ("wavelength", "shape", json!([huge]), "wavelengths, the cube 4 bands"),
    ] {
        let (found, hint) = refused_array(array, key, changed);
        assert!(found.contains(words), "{words}: {found}");
        // The copy must not be packed as the original was.
        let is_packing = words.contains("blosc");
        assert!(!is_packing || hint.contains("drop_encoding().to_zarr("), "{hint}");
    }
    let folder = tempfile::tempdir().unwrap();
    write_group(folder.path(), [0, 1, 2], None);
    std::fs::remove_dir_all(folder.path().join("wavelength")).unwrap();
    let (found, _) = refused(folder.path(), &CubeOptions::default());
    assert!(found.ends_with("names no wavelengths of its 4 bands"), "{found}");
}

#[test]
fn a_group_of_several_cubes_needs_a_choice() {
    let folder = tempfile::tempdir().unwrap();
    write_group(folder.path(), [0, 1, 2], None);
    let second = folder.path().join("raw");
    std::fs::create_dir(&second).unwrap();
    let document = folder.path().join("reflectance/zarr.json");
    std::fs::copy(document, second.join("zarr.json")).unwrap();
    let (found, _) = refused(folder.path(), &CubeOptions::default());
    assert!(found.ends_with("holds several cubes: raw, reflectance"), "{found}");
    check(&Cube::open_with(folder.path(), &named("reflectance")).unwrap(), 1.0 / 200.0, "named");
    let (found, _) = refused(folder.path(), &named("counts"));
    assert!(
        found.contains("has no array `counts` of three axes, only raw, reflectance"),
        "{found}"
    );
}

fn named(name: &str) -> CubeOptions {
    CubeOptions { variable: Some(name.to_owned()), ..CubeOptions::default() }
}

#[test]
fn chunks_that_were_removed_or_changed_are_noticed() {
    let folder = tempfile::tempdir().unwrap();
    write_group(folder.path(), [0, 1, 2], None);
    let chunk = folder.path().join("reflectance/c/1/0/0");
    let bytes = std::fs::read(&chunk).unwrap();
    for change in [None, Some(&bytes[..10])] {
        std::fs::write(&chunk, &bytes).unwrap();
        let cube = Cube::open(folder.path()).unwrap();
        cube.check_unchanged().unwrap();
        // Maps may lie beside the array.
        std::fs::create_dir_all(folder.path().join("maps/c")).unwrap();
        cube.check_unchanged().unwrap();
        match change {
            None => std::fs::remove_file(&chunk).unwrap(),
            Some(bytes) => std::fs::write(&chunk, bytes).unwrap(),
        }
        let (found, hint) = told(&cube.check_unchanged().unwrap_err());
        assert!(found.ends_with("reflectance: was changed while it was read"), "{found}");
        assert!(hint.contains("read the scan again"), "{hint}");
    }
}

#[test]
fn damaged_chunks_are_named() {
    let folder = tempfile::tempdir().unwrap();
    write_group(folder.path(), [0, 1, 2], None);
    let cube = Cube::open(folder.path()).unwrap();
    std::fs::write(folder.path().join("reflectance/c/1/0/0"), [0; 10]).unwrap();
    let (found, hint) = told(&cube.read_rows(2..3).unwrap_err());
    assert!(found.ends_with("c/1/0/0: a chunk has 10 bytes of numbers, expected 72"), "{found}");
    assert!(hint.contains("again"), "{hint}");
    // A chunk of a terabyte, which is not read.
    let chunk = std::fs::File::create(folder.path().join("reflectance/c/1/0/0")).unwrap();
    chunk.set_len(1 << 40).unwrap();
    let (found, _) = told(&cube.read_rows(2..3).unwrap_err());
    assert!(found.ends_with("c/1/0/0: a chunk has more than 72 stored bytes"), "{found}");
}
