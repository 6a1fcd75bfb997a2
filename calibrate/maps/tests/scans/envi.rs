//! ENVI scans of every order and number type, and scans that we refuse with the key, the numbers
//! and a remedy.
//!
//! Headers of any content give an error or a header, never a panic.

use std::path::Path;

use maps::cube::envi::EnviHeader;
use maps::cube::{Cube, CubeOptions, CubeScale};
use maps::pixel_maps::Mask;
use proptest::prelude::*;

use crate::written::{
    BANDS, LINES, SAMPLES, by_200, bytes, check, check_block, header, in_order, refused, told,
    value, write_envi,
};

#[test]
fn every_order_number_type_and_byte_order_is_read() {
    for interleave in ["bsq", "bil", "bip"] {
        for data_type in [1, 2, 3, 4, 5, 12, 13, 14, 15] {
            for is_big in [false, true] {
                let folder = tempfile::tempdir().unwrap();
                let place = format!("{interleave}, type {data_type}, big endian {is_big}");
                let text = header(interleave, data_type, "");
                let text =
                    text.replace("byte order = 0", &format!("byte order = {}", u8::from(is_big)));
                let text = text.replace("header offset = 0", "header offset = 11");
                let mut data = vec![0xff; 11];
                let numbers = in_order(interleave).into_iter();
                data.extend(numbers.flat_map(|value| bytes(data_type, value, is_big)));
                let path = write_envi(folder.path(), "scan", &text, &data);
                let cube = Cube::open_with(&path, &by_200()).unwrap();
                check(&cube, 1.0 / 200.0, &place);
                let narrow = cube.between(450.0..=650.0).unwrap();
                assert_eq!(narrow.wavelengths_nm(), [500.0, 600.5], "{place}");
                let block = narrow.read(2..3, 1..2).unwrap();
                let expected = [1, 2].map(|band| f32::from(value(2, 1, band)) / 200.0);
                let mut pairs = block.values.iter().zip(expected);
                assert!(pairs.all(|(a, b)| (a - b).abs() < 1e-6), "{place}: {:?}", block.values);
            }
        }
    }
}

fn fractions(folder: &Path, more: &str) -> std::path::PathBuf {
    let values = in_order("bil").into_iter().map(|value| f32::from(value) / 200.0);
    let data: Vec<u8> = values.flat_map(f32::to_le_bytes).collect();
    write_envi(folder, "scan", &header("bil", 4, more), &data)
}

#[test]
fn data_are_found_by_every_name_and_headers_by_data() {
    for (head, data) in [
        ("scan.hdr", "scan.img"),
        ("scan.hdr", "scan.DAT"),
        ("scan.hdr", "scan"),
        ("scan.img.hdr", "scan.img"),
        ("scan.bil.hdr", "scan.bil"),
        ("scan.HDR", "scan.bsq"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let written = fractions(folder.path(), "");
        std::fs::rename(written.with_extension("raw"), folder.path().join(data)).unwrap();
        std::fs::rename(&written, folder.path().join(head)).unwrap();
        for path in [folder.path().join(head), folder.path().join(data), folder.path().to_owned()] {
            if path.ends_with("scan.HDR") || head != "scan.HDR" || path.is_file() {
                let cube = Cube::open(&path).unwrap_or_else(|error| panic!("{path:?}: {error}"));
                check(&cube, 1.0 / 200.0, &format!("{head}, {data}"));
            }
        }
    }
}

#[test]
fn of_several_data_files_the_one_of_the_right_size_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = fractions(folder.path(), "");
    std::fs::write(folder.path().join("scan.img"), [1, 2, 3]).unwrap();
    check(&Cube::open(&path).unwrap(), 1.0 / 200.0, "scan.raw beside scan.img");
}

#[test]
fn keys_are_read_whatever_their_case_with_comments_between() {
    let folder = tempfile::tempdir().unwrap();
    let path = fractions(folder.path(), "");
    let text = std::fs::read_to_string(&path).unwrap();
    let text = text
        .replace("samples", "Samples ")
        .replace("data type", "Data   Type")
        .replace("interleave = bil", "INTERLEAVE=BIL")
        .replace("lines =", "; a comment = 3\n\ndescription = {\n samples = 9}\nlines =")
        .replace("{400, 500,\n", "{\n 400 ,500\n; within the list\n,")
        .replace('\n', "\r\n");
    std::fs::write(&path, format!("\u{feff}{text}fwhm = {{ 9, 9, 10, 11.5 }}\r\n")).unwrap();
    let cube = Cube::open(&path).unwrap();
    check(&cube, 1.0 / 200.0, "a header of another hand");
    assert_eq!(cube.fwhm_nm(), Some(&[9.0, 9.0, 10.0, 11.5][..]));
}

#[test]
fn scale_factor_percent_and_gains_give_reflectance() {
    let folder = tempfile::tempdir().unwrap();
    let counts: Vec<u8> =
        numbers().flat_map(|value| (i16::from(value) * 50).to_le_bytes()).collect();
    let more = "Reflectance Scale Factor = 10000.0\n";
    let path = write_envi(folder.path(), "scaled", &header("bip", 2, more), &counts);
    check(&Cube::open(&path).unwrap(), 1.0 / 200.0, "scale factor");

    let percent: Vec<u8> =
        numbers().flat_map(|value| (f32::from(value) / 2.0).to_le_bytes()).collect();
    let path = write_envi(folder.path(), "percent", &header("bip", 4, ""), &percent);
    let cube = Cube::open(&path).unwrap();
    check(&cube, 1.0 / 200.0, "percent");
    let remark = &cube.remarks()[0].text;
    assert!(remark.ends_with("are taken for percent"), "{remark}");

    let more = "data reflectance gain values = {1e-4, 1e-4, 1e-4, 2e-4}\n\
                data reflectance offset values = {0, 0, 0, 0.01}\n";
    let path = write_envi(folder.path(), "gains", &header("bip", 2, more), &counts);
    let block = Cube::open(&path).unwrap().read(1..2, 2..3).unwrap();
    let raw = [0, 1, 2, 3].map(|band| f32::from(value(1, 2, band)) * 50.0);
    let expected = [raw[0] * 1e-4, raw[1] * 1e-4, raw[2] * 1e-4, raw[3] * 2e-4 + 0.01];
    for (found, expected) in block.values.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-6, "gains: {:?}", block.values);
    }
}

fn numbers() -> std::vec::IntoIter<u8> {
    in_order("bip").into_iter()
}

#[test]
fn bad_bands_are_left_out_and_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = fractions(folder.path(), "bbl = {1, 0, 1, 1}\n");
    let cube = Cube::open(&path).unwrap();
    assert_eq!(cube.wavelengths_nm(), [400.0, 600.5, 700.0]);
    assert_eq!(cube.remarks().len(), 1);
    assert_eq!(cube.remarks()[0].text, "1 of 4 bands are marked as bad and left out (bbl)");
    let found = cube.read(3..4, 4..5).unwrap().values;
    assert_eq!(found, [0, 2, 3].map(|band| f32::from(value(3, 4, band)) / 200.0));
}

#[test]
fn bands_are_sorted_by_wavelength() {
    let folder = tempfile::tempdir().unwrap();
    let path = fractions(folder.path(), "");
    let text = std::fs::read_to_string(&path).unwrap();
    let text = text.replace("{400, 500,\n 600.5,\n 700}", "{0.7, 0.5, 0.6, 0.4}");
    std::fs::write(&path, text.replace("Nanometers", "Micrometers")).unwrap();
    let cube = Cube::open(&path).unwrap();
    assert_eq!(cube.wavelengths_nm(), [400.0, 500.0, 600.0, 700.0]);
    let found = cube.read(3..4, 4..5).unwrap().values;
    assert_eq!(found, [3, 1, 2, 0].map(|band| f32::from(value(3, 4, band)) / 200.0));
}

#[test]
fn pixels_that_cannot_be_mapped_are_told_with_their_reason() {
    let folder = tempfile::tempdir().unwrap();
    let path = fractions(folder.path(), "data ignore value = -1\n");
    let data = path.with_extension("raw");
    let mut bytes = std::fs::read(&data).unwrap();
    for (line, sample, band, value) in
        [(0, 0, 3, -1.0_f32), (1, 2, 0, f32::NAN), (2, 3, 1, 1.5), (4, 6, 2, -0.2)]
    {
        let at = ((line * BANDS + band) * SAMPLES + sample) * 4;
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
    }
    std::fs::write(&data, &bytes).unwrap();
    let cube = Cube::open(&path).unwrap();
    let block = cube.read_rows(0..LINES).unwrap();
    let mut found: Vec<_> = block.mask.iter().enumerate().collect();
    found.retain(|(_, mask)| **mask != Mask::Mapped);
    let expected = [
        (at(0, 0), &Mask::Ignored),
        (at(1, 2), &Mask::NotFinite),
        (at(2, 3), &Mask::OutOfRange),
        (at(4, 6), &Mask::OutOfRange),
    ];
    assert_eq!(found, expected);
    // A band that is not used does not decide.
    let block = cube.between(450.0..=800.0).unwrap().read_rows(1..2).unwrap();
    assert!(block.mask.iter().all(|mask| *mask == Mask::Mapped), "{:?}", block.mask);
}

fn at(line: usize, sample: usize) -> usize {
    line * SAMPLES + sample
}

#[test]
fn saturated_pixels_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let counts: Vec<u16> =
        in_order("bil").into_iter().map(|value| u16::from(value) * 100).collect();
    let mut counts: Vec<u8> = counts.into_iter().flat_map(u16::to_le_bytes).collect();
    counts[2..4].copy_from_slice(&u16::MAX.to_le_bytes());
    let more = "reflectance scale factor = 60000\n";
    let path = write_envi(folder.path(), "scan", &header("bil", 12, more), &counts);
    let block = Cube::open(&path).unwrap().read_rows(0..1).unwrap();
    assert_eq!(block.mask[..3], [Mask::Mapped, Mask::Saturated, Mask::Mapped]);
    let last = u16::from(value(4, SAMPLES - 1, 2)) * 100;
    for (full_scale, mask) in [(last, Mask::Saturated), (last + 1, Mask::Mapped)] {
        let exact = CubeOptions { full_scale: Some(full_scale.into()), ..CubeOptions::default() };
        let block = Cube::open_with(&path, &exact).unwrap().read_rows(4..5).unwrap();
        assert_eq!(block.mask[SAMPLES - 1], mask, "{full_scale}");
    }
    let lower = CubeOptions { full_scale: Some(10_000.0), ..CubeOptions::default() };
    let block = Cube::open_with(&path, &lower).unwrap().read_rows(4..5).unwrap();
    assert_eq!(block.mask[5..], [Mask::Mapped, Mask::Saturated], "values from 10,000 on");
}

#[test]
fn blocks_of_any_size_hold_the_values_of_the_whole() {
    for interleave in ["bsq", "bil", "bip"] {
        let folder = tempfile::tempdir().unwrap();
        let data = in_order(interleave);
        let path = write_envi(folder.path(), "scan", &header(interleave, 1, ""), &data);
        let cube = Cube::open_with(&path, &by_200()).unwrap();
        for rows in 1..=LINES {
            for start in (0..LINES).step_by(rows) {
                let block = cube.read_rows(start..(start + rows).min(LINES)).unwrap();
                check_block(&block, 1.0 / 200.0, interleave);
            }
        }
        assert_eq!(cube.read_rows(2..2).unwrap().pixels(), 0, "no rows");
        assert_eq!(cube.rows_within(1, SAMPLES), 1, "at least a row");
        assert_eq!(cube.rows_within(1 << 20, SAMPLES), LINES, "at most all rows");
    }
}

#[test]
fn pixels_are_spread_over_the_scan_and_sign_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = fractions(folder.path(), "");
    let cube = Cube::open(&path).unwrap();
    let all = cube.spread(0..LINES, 0..SAMPLES, 1000).unwrap();
    assert_eq!(all.values, cube.read_rows(0..LINES).unwrap().values, "every pixel");
    assert_eq!((all.places[8], all.looked_at), ((1, 1), LINES * SAMPLES));
    let few = cube.spread(1..5, 2..7, 5).unwrap();
    assert_eq!(few.places, [(2, 3), (2, 5), (4, 3), (4, 5)]);
    assert_eq!(few.values[..BANDS], cube.read(2..3, 3..4).unwrap().values);
    let sign = cube.sign().unwrap();
    assert_eq!(sign, Cube::open(&path).unwrap().sign().unwrap());
    let narrow = Cube::open(&path).unwrap().between(450.0..=700.0).unwrap();
    assert_ne!(narrow.sign().unwrap(), sign, "other wavelengths");
    let data = path.with_extension("raw");
    let mut bytes = std::fs::read(&data).unwrap();
    bytes[4 * (BANDS * SAMPLES * 3 + 2)..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
    std::fs::write(&data, &bytes).unwrap();
    let damaged = Cube::open(&path).unwrap();
    let left = damaged.spread(0..LINES, 0..SAMPLES, 1000).unwrap();
    assert_eq!((left.places.len(), left.looked_at), (LINES * SAMPLES - 1, LINES * SAMPLES));
    assert!(!left.places.contains(&(3, 2)), "a pixel that is not a number");
    assert_ne!(damaged.sign().unwrap(), sign, "another pixel");
}

/// Number of headers that we try. Set IMPASTO_FUZZ_HEADERS to try another number.
fn cases() -> u32 {
    let asked = std::env::var("IMPASTO_FUZZ_HEADERS").ok();
    asked.and_then(|number| number.parse().ok()).unwrap_or(4000)
}

fn key() -> impl Strategy<Value = String> {
    const KNOWN: [&str; 21] = [
        "samples",
        "lines",
        "bands",
        "header offset",
        "data type",
        "interleave",
        "byte order",
        "wavelength",
        "wavelength units",
        "bbl",
        "fwhm",
        "data ignore value",
        "reflectance scale factor",
        "data reflectance gain values",
        "data reflectance offset values",
        "file type",
        "file compression",
        "major frame offsets",
        "z plot titles",
        "tint",
        "description",
    ];
    prop_oneof![
        12 => prop::sample::select(&KNOWN[..]).prop_map(str::to_owned),
        1 => "[ -~]{0,12}",
        1 => "\\PC{0,6}",
    ]
}

fn number() -> impl Strategy<Value = String> {
    prop_oneof![
        6 => (0_u32..20).prop_map(|number| number.to_string()),
        3 => (380.0_f64..1000.0).prop_map(|number| number.to_string()),
        1 => any::<u64>().prop_map(|number| number.to_string()),
        1 => any::<i64>().prop_map(|number| number.to_string()),
        1 => any::<f64>().prop_map(|number| number.to_string()),
        1 => prop::sample::select(&["NaN", "inf", "-0", "1e999", "0x10", "", "18446744073709551616"][..])
            .prop_map(str::to_owned),
    ]
}

fn list() -> impl Strategy<Value = String> {
    (
        prop::collection::vec(number(), 0..12),
        prop::sample::select(&[", ", ",\n", " ", "\n;x\n,"][..]),
    )
        .prop_map(|(numbers, between)| numbers.join(between))
}

fn written_value() -> impl Strategy<Value = String> {
    const WORDS: [&str; 10] =
        ["bil", "BSQ", "Bip", "nm", "Micrometers", "Index", "ENVI Standard", "{", "}", "{}"];
    prop_oneof![
        5 => number(),
        5 => list().prop_map(|list| format!("{{{list}}}")),
        1 => list().prop_map(|list| format!("{{{list}")),
        3 => prop::sample::select(&WORDS[..]).prop_map(str::to_owned),
        1 => "\\PC{0,20}",
    ]
}

fn free() -> impl Strategy<Value = Vec<u8>> {
    let line = (key(), written_value(), prop::sample::select(&[" = ", "=", " ", ""][..]))
        .prop_map(|(key, value, sign)| format!("{key}{sign}{value}"));
    let first = prop::sample::select(&["ENVI", "ENVI ", "\u{feff}ENVI", "envi", ""][..]);
    (first, prop::collection::vec(line, 0..16), prop::sample::select(&["\n", "\r\n", "\r"][..]))
        .prop_map(|(first, lines, end)| format!("{first}{end}{}", lines.join(end)).into_bytes())
}

/// A header that can be read, with a few of its bytes changed.
fn damaged() -> impl Strategy<Value = Vec<u8>> {
    let whole = "ENVI\nsamples = 3\nlines = 2\nbands = 2\nheader offset = 0\ndata type = 4\n\
                 interleave = bil\nbyte order = 0\nwavelength units = nm\n\
                 wavelength = {400, 500}\nfwhm = {9, 9}\nbbl = {1, 0}\n\
                 data ignore value = -1\nreflectance scale factor = 1\n";
    prop::collection::vec((0..whole.len(), any::<u8>()), 0..4).prop_map(move |changes| {
        let mut bytes = whole.as_bytes().to_vec();
        for (at, byte) in changes {
            bytes[at] = byte;
        }
        bytes
    })
}

#[test]
fn any_header_gives_an_error_or_a_result() {
    let config =
        ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(cases()) };
    let bytes = prop_oneof![
        3 => free(),
        3 => damaged(),
        1 => prop::collection::vec(any::<u8>(), 0..200),
    ];
    let mut runner = proptest::test_runner::TestRunner::new_with_rng(
        config,
        proptest::test_runner::TestRng::deterministic_rng(
            proptest::test_runner::RngAlgorithm::ChaCha,
        ),
    );
    let read = std::cell::Cell::new(0_u32);
    runner
        .run(&bytes, |bytes| {
            match EnviHeader::parse(&bytes, Path::new("scan.hdr")) {
                Ok(header) => {
                    read.set(read.get() + 1);
                    let bands = header.good.len();
                    prop_assert!(bands > 0 && header.good.contains(&true));
                    if let Some(nm) = &header.wavelengths_nm {
                        prop_assert!(nm.len() == bands && nm.iter().all(|nm| *nm >= 150.0));
                    }
                }
                Err(error) => prop_assert!(error.to_string().contains("scan.hdr")),
            }
            Ok(())
        })
        .unwrap();
    let read = read.get();
    assert!(read > cases() / 20, "only {read} of {} headers were read", cases());
}

/// Message and hint of opening a scan of type u8 with a changed header.
fn refused_header(from: &str, to: &str) -> (String, String) {
    let folder = tempfile::tempdir().unwrap();
    let text = header("bil", 1, "");
    assert!(text.contains(from), "{from}");
    let path = write_envi(folder.path(), "scan", &text.replace(from, to), &in_order("bil"));
    refused(&path, &CubeOptions { scale: CubeScale::White(200.0), ..CubeOptions::default() })
}

#[test]
fn faults_of_the_header_name_line_and_key() {
    for (from, to, message) in [
        ("samples = 7", "", "scan.hdr: `samples` is missing"),
        ("samples = 7", "samples = 0", "scan.hdr: line 2: `samples` must be at least 1, found `0`"),
        ("lines = 5", "lines = five", "line 3: `lines` must be a whole number, found `five`"),
        ("lines = 5", "lines = 5\nlines = 6", "line 4: `lines` has another value than in line 3"),
        ("bands = 4", "bands = 5", "`wavelength` has 4 numbers, but `bands` is 5"),
        ("bands = 4", "bands = 99999999999", "`bands` must be at most 65536, found `99999999999`"),
        ("data type = 1", "data type = 6", "`data type` is `6`, complex numbers"),
        ("data type = 1", "data type = 7", "must be 1, 2, 3, 4, 5, 12, 13, 14 or 15, found `7`"),
        (
            "interleave = bil",
            "interleave = bilinear",
            "`interleave` must be bsq, bil or bip, found `bilinear`",
        ),
        ("byte order = 0", "byte order = 2", "line 7: `byte order` must be 0 or 1, found `2`"),
        ("600.5", "60O.5", "line 10: `wavelength` has `60O.5` as number 3"),
        ("Nanometers", "Index", "`wavelength` has the unit `Index`, which is not a length"),
        ("Nanometers", "Micrometers", "which are not Micrometers: these look like nm"),
        (" 700}", " 700", "line 10: `wavelength` opens a brace that is never closed"),
        (
            "header offset",
            "file type = ENVI Spectral Library\nheader offset",
            "`file type` is `envi spectral library`, which is not a scan",
        ),
        (
            "header offset",
            "file compression = 1\nheader offset",
            "`file compression` says that the data are packed",
        ),
        (
            "header offset",
            "major frame offsets = {0, 8}\nheader offset",
            "data with gaps are not read",
        ),
        (
            "header offset",
            "data units = Transmittance\nheader offset",
            "`data units` is `transmittance`, no reflectance",
        ),
        ("header offset", "bbl = {0,0,0,0}\nheader offset", "`bbl` marks every band as bad"),
        (
            "header offset",
            "reflectance scale factor = 0\nheader offset",
            "must be above 0, found `0`",
        ),
        ("wavelength = ", "waves = ", "names no wavelengths of its 4 bands"),
    ] {
        let (found, _) = refused_header(from, to);
        assert!(found.contains(message), "{to}: {found}");
    }
}

#[test]
fn a_header_without_a_byte_order_means_little_endian() {
    let folder = tempfile::tempdir().unwrap();
    let more = "reflectance scale factor = 10000\n";
    for (data_type, is_told) in [(12, true), (1, false)] {
        let text = header("bil", data_type, if is_told { more } else { "" });
        let data: Vec<u8> = in_order("bil")
            .into_iter()
            .flat_map(|value| match is_told {
                true => (u16::from(value) * 50).to_le_bytes().to_vec(),
                false => vec![value],
            })
            .collect();
        let text = text.replace("byte order = 0\n", "");
        let path = write_envi(folder.path(), "scan", &text, &data);
        let options = if is_told { CubeOptions::default() } else { by_200() };
        let cube = Cube::open_with(&path, &options).unwrap();
        check(&cube, 1.0 / 200.0, "little endian");
        let remarks: Vec<String> = cube.remarks().iter().map(ToString::to_string).collect();
        let found = remarks.iter().any(|remark| remark.contains("names no byte order: 0"));
        assert_eq!(found, is_told, "{remarks:?}");
    }
}

#[test]
fn the_white_of_an_archive_is_guessed_where_the_file_says_reflectance() {
    let folder = tempfile::tempdir().unwrap();
    for (name, more, factor, white) in [
        ("scan", "data units = Reflectance\n", 40_u16, Some(10_000.0)),
        ("scan", "z plot titles = {Wavelength, Reflectance}\n", 250, Some(65_535.0)),
        ("scan", "description = {Reflectance * 4096}\n", 16, Some(4096.0)),
        ("wall_reflectance", "", 40, Some(10_000.0)),
        ("scan", "", 40, None),
        ("scan", "data units = DN\n", 40, None),
    ] {
        let data: Vec<u8> =
            numbers().flat_map(|value| (u16::from(value) * factor).to_le_bytes()).collect();
        let path = write_envi(folder.path(), name, &header("bip", 12, more), &data);
        match (white, Cube::open(&path)) {
            (Some(white), Ok(cube)) => {
                let scale = f64::from(factor) / white;
                check(&cube, scale as f32, more);
                let remark = cube.remarks()[0].to_string();
                let start = format!("warning: a white is taken to read {white}: ");
                assert!(remark.starts_with(&start) && remark.contains("scale"), "{remark}");
            }
            (None, Err(error)) => {
                assert!(error.to_string().contains("are not reflectances"), "{error}");
            }
            (_, found) => panic!("{name} {more}: {found:?}"),
        }
        std::fs::remove_file(&path).unwrap();
    }
}

#[test]
fn header_and_data_that_disagree_are_refused_with_both_sizes() {
    for (from, to, expected) in [
        ("lines = 5", "lines = 6", "168 bytes"),
        ("data type = 1", "data type = 12", "280 bytes"),
        ("header offset = 0", "header offset = 4", "144 bytes"),
    ] {
        let (found, _) = refused_header(from, to);
        let is_told = found.contains(expected) && found.ends_with("found `140`");
        assert!(is_told && found.contains("scan.raw"), "{to}: {found}");
    }
    let (found, _) = refused_header("lines = 5", "lines = 9999999999999999999");
    assert!(found.contains("more bytes than a file can have"), "{found}");
}

#[test]
fn missing_data_and_other_headers_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = write_envi(folder.path(), "scan", &header("bil", 1, ""), &in_order("bil"));
    std::fs::remove_file(path.with_extension("raw")).unwrap();
    let (found, hint) = refused(&path, &CubeOptions::default());
    assert!(found.ends_with("the data of this header are not beside it"), "{found}");
    assert!(hint.contains(".img"), "{hint}");

    let esri = "BYTEORDER I\nLAYOUT BIL\nNROWS 5\nNCOLS 7\nNBANDS 4\nNBITS 8\n";
    std::fs::write(&path, esri).unwrap();
    let (found, hint) = refused(&path, &CubeOptions::default());
    assert!(found.contains("the header of an Esri grid"), "{found}");
    assert!(hint.contains("ENVI"), "{hint}");

    std::fs::write(&path, "samples = 7\n").unwrap();
    let (found, _) = refused(&path, &CubeOptions::default());
    assert!(found.ends_with("the first line is not `ENVI`"), "{found}");
}

#[test]
fn counts_without_readings_are_refused_with_the_way_out() {
    let folder = tempfile::tempdir().unwrap();
    let path = write_envi(folder.path(), "scan", &header("bil", 1, ""), &in_order("bil"));
    let (found, hint) = refused(&path, &CubeOptions::default());
    assert!(found.contains("the values are not reflectances: the largest read is `"), "{found}");
    assert!(hint.contains("`white_reading = FILE`") && hint.contains("`scale = 10000`"), "{hint}");
    let more = "data units = Radiance (uW/cm2/sr/nm)\n";
    let data: Vec<u8> = in_order("bil").iter().flat_map(|v| f32::from(*v).to_le_bytes()).collect();
    let path = write_envi(folder.path(), "radiance", &header("bil", 4, more), &data);
    let (found, _) = refused(&path, &CubeOptions::default());
    assert!(found.contains("the values are not reflectances"), "{found}");
}

#[test]
fn scans_without_light_and_saturated_scans_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let with = |value: u16| {
        let data: Vec<u8> =
            vec![value; LINES * SAMPLES * BANDS].into_iter().flat_map(u16::to_le_bytes).collect();
        let more = "reflectance scale factor = 65535\n";
        write_envi(folder.path(), &format!("of{value}"), &header("bil", 12, more), &data)
    };
    let (found, _) = refused(&with(0), &CubeOptions::default());
    assert!(found.ends_with("all sampled values are 0 or less: the scan is dark"), "{found}");
    let (found, hint) = refused(&with(u16::MAX), &CubeOptions::default());
    assert!(found.ends_with("more than half of 35 sampled pixels are saturated"), "{found}");
    assert!(hint.contains("`full_scale`"), "{hint}");
    let wrong = CubeOptions { scale: CubeScale::White(10_000.0), ..CubeOptions::default() };
    let (found, _) = refused(&with(40_000), &wrong);
    assert!(found.contains("have reflectances below -0.1 or above 1.2"), "{found}");
    for scale in [0.0, -1.0, f64::NAN] {
        let options = CubeOptions { scale: CubeScale::White(scale), ..CubeOptions::default() };
        let (found, _) = refused(&with(40_000), &options);
        assert!(found.contains("the setting `scale` must be above 0"), "{found}");
    }
}

#[test]
fn rows_outside_and_data_that_became_shorter_are_errors() {
    let folder = tempfile::tempdir().unwrap();
    let more = "reflectance scale factor = 200\n";
    let path = write_envi(folder.path(), "scan", &header("bil", 1, more), &in_order("bil"));
    let cube = Cube::open(&path).unwrap();
    let (found, _) = told(&cube.read_rows(4..6).unwrap_err());
    assert!(found.contains("rows 4 to 6 lie outside the cube of 5 rows, 7 columns"), "{found}");
    let (found, _) = told(&cube.read(0..1, 3..8).unwrap_err());
    assert!(found.contains("columns 3 to 8 lie outside"), "{found}");
    std::fs::write(path.with_extension("raw"), [7; 30]).unwrap();
    let (found, hint) = told(&cube.read_rows(0..5).unwrap_err());
    assert!(found.contains("scan.raw: ends before byte"), "{found}");
    assert!(hint.contains("became shorter"), "{hint}");
    let error = cube.between(900.0..=1000.0).unwrap_err();
    let (found, _) = told(&error);
    assert!(found.contains("wavelengths from 900 to 1000 nm lie outside"), "{found}");
}

#[test]
fn other_kinds_of_files_are_named() {
    let folder = tempfile::tempdir().unwrap();
    for (bytes, words, advice) in [
        (&b"\x89HDF\r\n\x1a\n"[..], "is an HDF5 file", "h5py"),
        (b"MATLAB 5.0 MAT-file", "is a MATLAB file", "scipy"),
        (b"\x89PNG\r\n\x1a\n", "is one picture", "folder"),
        (b"CDF\x01", "is a NetCDF file", "xarray"),
        (b"hello", "is not a cube that can be read, and no header is beside it", "scan.hdr"),
    ] {
        let path = folder.path().join("scan.bin");
        std::fs::write(&path, bytes).unwrap();
        let (found, hint) = refused(&path, &CubeOptions::default());
        assert!(found.contains(words) && hint.contains(advice), "{found}: {hint}");
    }
    let (found, _) = refused(&folder.path().join("missing.hdr"), &CubeOptions::default());
    assert!(found.ends_with("missing.hdr: cannot be read"), "{found}");
    let empty = folder.path().join("empty");
    std::fs::create_dir(&empty).unwrap();
    let (found, hint) = refused(&empty, &CubeOptions::default());
    assert!(found.contains("holds no cube") && hint.contains("wavelengths.txt"), "{found}: {hint}");
    std::fs::write(empty.join(".zarray"), "{}").unwrap();
    let (found, _) = refused(&empty, &CubeOptions::default());
    assert!(found.ends_with("is Zarr of format 2"), "{found}");
}
