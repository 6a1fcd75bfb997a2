//! Zarr arrays, as xarray and others lay them out.

use std::path::Path;

use maps::cube::{Cube, CubeOptions};
use maps::pixel_maps::Mask;
use serde_json::{Value, json};

use crate::written::{BANDS, LINES, SAMPLES, check, refused, told, value};

fn write(path: &Path, bytes: &[u8]) {
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, bytes).unwrap();
}

fn describe(folder: &Path, document: &Value) {
    write(&folder.join("zarr.json"), document.to_string().as_bytes());
}

fn reflectance(line: usize, sample: usize, band: usize) -> f32 {
    f32::from(value(line, sample, band)) / 200.0
}

/// Writes the group of a cube with chunks of 2 rows, 3 columns and 3 bands, without packing, in the
/// order of axes `axes`: 0 is the row, 1 the column, 2 the band.
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
            let number = if inside { reflectance(line, sample, band) } else { f32::NAN };
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

/// Message and hint of opening a group whose description of an array was changed.
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
    let named =
        |name: &str| CubeOptions { variable: Some(name.to_owned()), ..CubeOptions::default() };
    check(&Cube::open_with(folder.path(), &named("reflectance")).unwrap(), 1.0 / 200.0, "named");
    let (found, _) = refused(folder.path(), &named("counts"));
    assert!(
        found.contains("has no array `counts` of three axes, only raw, reflectance"),
        "{found}"
    );
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
