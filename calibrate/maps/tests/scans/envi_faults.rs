//! ENVI scans that are refused, each with the key, the numbers and a way out.

use maps::cube::{Cube, CubeOptions, CubeScale};

use crate::written::{BANDS, LINES, SAMPLES, header, in_order, refused, told, write_envi};

/// Message and hint of opening a scan of type u8 whose header was changed.
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
        ("Nanometers", "Index", "`wavelength` has the unit `Index`, which is no length"),
        ("Nanometers", "Micrometers", "which are no Micrometers: these look like nm"),
        (" 700}", " 700", "line 10: `wavelength` opens a brace that is never closed"),
        (
            "header offset",
            "file type = ENVI Spectral Library\nheader offset",
            "`file type` is `envi spectral library`, no cube",
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
    // Numbers of one byte need no order.
    let folder = tempfile::tempdir().unwrap();
    let text = header("bil", 12, "").replace("byte order = 0\n", "");
    let path = write_envi(folder.path(), "scan", &text, &[0; 2 * LINES * SAMPLES * BANDS]);
    let (found, hint) = refused(&path, &CubeOptions::default());
    assert!(found.ends_with("`byte order` is missing"), "{found}");
    assert!(hint.contains("byte order = 0"), "{hint}");
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
    assert!(found.contains("the values are no reflectances: the largest read is `"), "{found}");
    assert!(hint.contains("`white_reading = FILE`") && hint.contains("`scale = 10000`"), "{hint}");
    let more = "data units = Radiance (uW/cm2/sr/nm)\n";
    let data: Vec<u8> = in_order("bil").iter().flat_map(|v| f32::from(*v).to_le_bytes()).collect();
    let path = write_envi(folder.path(), "radiance", &header("bil", 4, more), &data);
    let (found, _) = refused(&path, &CubeOptions::default());
    assert!(found.contains("the values are no reflectances"), "{found}");
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
        (b"hello", "is no cube that can be read, and no header is beside it", "scan.hdr"),
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
