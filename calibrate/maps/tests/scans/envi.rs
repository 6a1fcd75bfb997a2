//! ENVI scans of every order and number type.

use maps::cube::{Cube, CubeOptions};
use maps::pixel_maps::Mask;

use crate::written::{
    BANDS, LINES, SAMPLES, by_200, bytes, check, check_block, header, in_order, value, write_envi,
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

/// Writes the scan as f32 fractions.
fn fractions(folder: &std::path::Path, more: &str) -> std::path::PathBuf {
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
    let numbers = || in_order("bip").into_iter();
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
    let remark = &cube.remarks()[0];
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

#[test]
fn bad_bands_are_left_out_and_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = fractions(folder.path(), "bbl = {1, 0, 1, 1}\n");
    let cube = Cube::open(&path).unwrap();
    assert_eq!(cube.wavelengths_nm(), [400.0, 600.5, 700.0]);
    assert_eq!(cube.remarks(), ["1 of 4 bands are marked as bad and left out (bbl)"]);
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
    let mut set = |line: usize, sample: usize, band: usize, value: f32| {
        let at = ((line * BANDS + band) * SAMPLES + sample) * 4;
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
    };
    set(0, 0, 3, -1.0);
    set(1, 2, 0, f32::NAN);
    set(2, 3, 1, 1.5);
    set(4, 6, 2, -0.2);
    std::fs::write(&data, &bytes).unwrap();
    let cube = Cube::open(&path).unwrap();
    let block = cube.read_rows(0..LINES).unwrap();
    let mut found: Vec<_> = block.mask.iter().enumerate().collect();
    found.retain(|(_, mask)| **mask != Mask::Mapped);
    let at = |line: usize, sample: usize| line * SAMPLES + sample;
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
    assert!(!left.places.contains(&(3, 2)), "a pixel that is no number");
    assert_ne!(damaged.sign().unwrap(), sign, "another pixel");
}
