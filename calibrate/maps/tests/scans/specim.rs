//! Folders of Specim cameras, and counts with white and dark readings.

use std::path::{Path, PathBuf};

use maps::cube::{Cube, CubeOptions, CubeValues, DarkReading};
use maps::pixel_maps::Mask;

use crate::written::{
    BANDS, LINES, SAMPLES, check, check_block, header, in_order, refused, value, write_envi,
};

/// Dark of a column and band.
fn dark(sample: usize, band: usize) -> f64 {
    100.0 + 3.0 * sample as f64 + 7.0 * band as f64
}

/// Light of the white of a column and band.
fn light(sample: usize, band: usize) -> f64 {
    2000.0 + 100.0 * sample as f64 - 200.0 * band as f64
}

/// Writes a BIL scan of u16 counts.
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

/// Writes a camera's folder with counts; the white alternates around its mean.
fn write_folder(folder: &Path) -> PathBuf {
    let capture = folder.join("capture");
    std::fs::create_dir_all(&capture).unwrap();
    let swing = |line: usize| if line.is_multiple_of(2) { 10.0 } else { -10.0 };
    write_counts(&capture, "WHITEREF_042", 4, "", |line, sample, band| {
        dark(sample, band) + light(sample, band) + swing(line)
    });
    write_counts(&capture, "DARKREF_042", 2, "", |_, sample, band| dark(sample, band));
    write_counts(&capture, "042", LINES, "", |line, sample, band| {
        dark(sample, band) + light(sample, band) * reflectance(line, sample, band)
    })
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
    let remark = &cube.remarks()[0];
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
    assert!(found.contains("the values are no reflectances"), "{found}");
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
    assert!(cube.remarks()[0].starts_with("the camera's reflectance is read"));
}

#[test]
fn one_column_of_readings_serves_all_columns() {
    let folder = tempfile::tempdir().unwrap();
    let narrow = |name: &str, count: u16| {
        let text = header("bil", 12, "").replace("samples = 7", "samples = 1");
        let text = text.replace("lines = 5", "lines = 1");
        let data: Vec<u8> = [count; BANDS].into_iter().flat_map(u16::to_le_bytes).collect();
        write_envi(folder.path(), name, &text, &data)
    };
    let scan = write_counts(folder.path(), "scan", LINES, "", |line, sample, band| {
        100.0 + 10.0 * f64::from(value(line, sample, band))
    });
    let options = CubeOptions {
        white_reading: Some(narrow("white", 2100)),
        dark_reading: DarkReading::File(narrow("dark", 100)),
        ..CubeOptions::default()
    };
    let cube = Cube::open_with(&scan, &options).unwrap();
    check_block(&cube.read_rows(0..LINES).unwrap(), 1.0 / 200.0, "one column");
}

/// Message of opening a folder whose files were changed.
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
    let text = |lines: usize| {
        let text = header("bil", 12, "").replace("samples = 7", &format!("samples = {wide}"));
        text.replace("lines = 5", &format!("lines = {lines}"))
    };
    let counts = |lines: usize, count: &dyn Fn(usize) -> u16| -> Vec<u8> {
        let rows = (0..lines * BANDS).flat_map(|_| 0..wide);
        rows.flat_map(|column| count(column).to_le_bytes()).collect()
    };
    let capture = folder.path().join("capture");
    std::fs::create_dir(&capture).unwrap();
    let white = counts(1, &|column| if column == 3 { 100 } else { 1100 });
    write_envi(&capture, "WHITEREF_a", &text(1), &white);
    write_envi(&capture, "DARKREF_a", &text(1), &counts(1, &|_| 100));
    write_envi(&capture, "a", &text(2), &counts(2, &|_| 600));
    let cube = Cube::open(folder.path()).unwrap();
    let told =
        cube.remarks().iter().any(|remark| remark.starts_with("1 of 40 columns have no light"));
    assert!(told, "{:?}", cube.remarks());
    let block = cube.read_rows(0..2).unwrap();
    for (at, (values, mask)) in block.iter().enumerate() {
        match at % wide {
            3 => assert_eq!(mask, Mask::NotFinite, "pixel {at}"),
            _ => assert_eq!((values, mask), (&[0.5; BANDS][..], Mask::Mapped), "pixel {at}"),
        }
    }
}
