//! Scans that tests write.

use std::path::{Path, PathBuf};

use documents::hint::Explain;
use maps::cube::{Cube, CubeError, CubeOptions};

pub(crate) const LINES: usize = 5;
pub(crate) const SAMPLES: usize = 7;
pub(crate) const BANDS: usize = 4;

/// Value of a pixel of the test scan: a small whole number, so that every number type holds it.
pub(crate) fn value(line: usize, sample: usize, band: usize) -> u8 {
    u8::try_from(1 + line * 20 + sample * 3 + band % 3).unwrap()
}

/// Numbers of the scan in the order of an interleave.
pub(crate) fn in_order(interleave: &str) -> Vec<u8> {
    let mut values = Vec::new();
    match interleave {
        "bsq" => each(BANDS, LINES, SAMPLES, |b, l, s| values.push(value(l, s, b))),
        "bil" => each(LINES, BANDS, SAMPLES, |l, b, s| values.push(value(l, s, b))),
        "bip" => each(LINES, SAMPLES, BANDS, |l, s, b| values.push(value(l, s, b))),
        other => panic!("{other}"),
    }
    values
}

fn each(a: usize, b: usize, c: usize, mut call: impl FnMut(usize, usize, usize)) {
    for a_at in 0..a {
        for b_at in 0..b {
            for c_at in 0..c {
                call(a_at, b_at, c_at);
            }
        }
    }
}

/// Bytes of a number of the ENVI type `data_type`.
pub(crate) fn bytes(data_type: u8, value: u8, is_big: bool) -> Vec<u8> {
    macro_rules! bytes {
        ($type:ty) => {{
            let number = <$type>::from(value);
            if is_big { number.to_be_bytes().to_vec() } else { number.to_le_bytes().to_vec() }
        }};
    }
    match data_type {
        1 => vec![value],
        2 => bytes!(i16),
        3 => bytes!(i32),
        4 => bytes!(f32),
        5 => bytes!(f64),
        12 => bytes!(u16),
        13 => bytes!(u32),
        14 => bytes!(i64),
        15 => bytes!(u64),
        other => panic!("{other}"),
    }
}

/// Header of the test scan with more lines at its end.
pub(crate) fn header(interleave: &str, data_type: u8, more: &str) -> String {
    format!(
        "ENVI\nsamples = {SAMPLES}\nlines = {LINES}\nbands = {BANDS}\ndata type = {data_type}\n\
         interleave = {interleave}\nbyte order = 0\nheader offset = 0\n\
         wavelength units = Nanometers\nwavelength = {{400, 500,\n 600.5,\n 700}}\n{more}"
    )
}

/// Writes a header and its data. Returns the path of the header.
pub(crate) fn write_envi(folder: &Path, name: &str, header: &str, data: &[u8]) -> PathBuf {
    let path = folder.join(format!("{name}.hdr"));
    std::fs::write(&path, header).unwrap();
    std::fs::write(folder.join(format!("{name}.raw")), data).unwrap();
    path
}

/// Checks that a cube holds the test scan times `factor`.
pub(crate) fn check(cube: &Cube, factor: f32, place: &str) {
    assert_eq!((cube.lines(), cube.samples()), (LINES, SAMPLES), "{place}");
    assert_eq!(cube.wavelengths_nm(), [400.0, 500.0, 600.5, 700.0], "{place}");
    let block = cube.read_rows(0..LINES).unwrap();
    check_block(&block, factor, place);
    let part = cube.read(1..3, 2..6).unwrap();
    check_block(&part, factor, place);
}

pub(crate) fn check_block(block: &maps::cube::Block, factor: f32, place: &str) {
    let mut pixel = 0;
    for line in block.rows.clone() {
        for sample in block.columns.clone() {
            let values = block.pixel(pixel);
            assert_eq!(values.len(), BANDS, "{place}");
            for (band, found) in values.iter().enumerate() {
                let expected = f32::from(value(line, sample, band)) * factor;
                let near = (found - expected).abs() <= 1e-6 * expected.abs();
                assert!(near, "{place}: line {line}, sample {sample}, band {band}: {found}");
            }
            pixel += 1;
        }
    }
    assert_eq!(pixel, block.pixels(), "{place}");
}

/// Settings under which the values of the test scan are reflectances up to 0.52.
pub(crate) fn by_200() -> CubeOptions {
    CubeOptions { scale: maps::cube::CubeScale::White(200.0), ..CubeOptions::default() }
}

/// Message and hint of an error.
pub(crate) fn told(error: &CubeError) -> (String, String) {
    let hint = error.hint().map(|hint| hint.to_string()).unwrap_or_default();
    (error.to_string(), hint)
}

/// Message and hint of opening a cube that is refused.
pub(crate) fn refused(path: &Path, options: &CubeOptions) -> (String, String) {
    let error = Cube::open_with(path, options).map(drop).unwrap_err();
    let (message, hint) = told(&error);
    assert!(!hint.is_empty(), "no way out of: {message}");
    (message, hint)
}
