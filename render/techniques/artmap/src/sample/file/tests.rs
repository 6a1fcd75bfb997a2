use std::sync::Arc;

use documents::hint::Explain;
use graphics::field::Field;
use paint::layer::Slots;
use pigment::{PigmentId, PigmentLibrary};

use super::*;
use crate::sample::passage::Sample;
use crate::texel::{PaintOfSamples, TexelPaint};

/// Numbers that lose bits in anything but lossless storage.
fn number(index: usize) -> f32 {
    0.001 + (index as f32 * 0.618_034).fract() / 3.0
}

fn sample(name: &str, width: usize, height: usize) -> Sample {
    let field = |act: &dyn Fn(usize) -> f32| {
        Field::from_values(width, height, (0..width * height).map(act).collect())
    };
    let color = (0..width * height).map(|i| [number(i), -number(i + 7), number(i + 9)]).collect();
    let paint = (0..width * height).map(|i| TexelPaint {
        pigments_mm: [number(i), 0.0, number(i + 3), 0.0, 0.0, 0.0, 0.0, number(i + 5)],
        vehicle_mm: number(i + 1),
    });
    Sample {
        name: name.to_owned(),
        color: Field::from_values(width, height, color),
        paint: Some(Field::from_values(width, height, paint.collect())),
        height_mm: Some(field(&|i| number(2 * i))),
        mask: Field::from_values(width, height, (0..width * height).map(|i| i % 5 > 0).collect()),
        spacing: 7.25,
        mm_per_texel: Some(0.15),
        guessed_relief: false,
    }
}

fn set() -> SampleSet {
    let mut library = PigmentLibrary::van_gogh_oils();
    library.pigments[2].name = "R".to_owned();
    let mut slots = Slots::default();
    (slots[0], slots[2], slots[7]) = (Some(PigmentId(1)), Some(PigmentId(2)), Some(PigmentId(4)));
    let mut bare = sample("l\u{f6}ss", 9, 40);
    (bare.height_mm, bare.mm_per_texel, bare.guessed_relief) = (None, None, true);
    SampleSet {
        samples: vec![sample("tone 1", 33, 21), bare],
        paint: Some(PaintOfSamples { library: Arc::new(library), slots }),
        provenance: "a test".to_owned(),
    }
}

#[test]
fn samples_come_back_bit_for_bit_and_files_are_the_same_bytes() {
    let mut plain = set();
    plain.paint = None;
    plain.samples.iter_mut().for_each(|sample| sample.paint = None);
    // Texels that are masked out may hold anything.
    plain.samples[0].color[(0, 0)] = [f32::INFINITY, -1e30, 0.0];
    for set in [set(), plain] {
        let bytes = write(&set).unwrap();
        assert!(read("a.exr", &bytes).unwrap() == set);
        assert_eq!(write(&set).unwrap(), bytes);
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("samples.exr");
    set().save(&path).unwrap();
    assert!(SampleSet::open(&path).unwrap() == set());
}

/// Replaces `from` in the bytes by `to` of the same length.
fn replaced(bytes: &[u8], from: &str, to: &str) -> Vec<u8> {
    assert_eq!(from.len(), to.len(), "same length");
    let at = bytes.windows(from.len()).position(|window| window == from.as_bytes()).unwrap();
    let mut bytes = bytes.to_vec();
    bytes[at..at + to.len()].copy_from_slice(to.as_bytes());
    bytes
}

#[test]
fn bad_files_are_refused_with_their_place_and_a_way_out() {
    let bytes = write(&set()).unwrap();
    let refused = |bytes: &[u8]| {
        let error = read("a.exr", bytes).unwrap_err();
        assert!(error.to_string().starts_with("a.exr: "), "{error}");
        assert!(error.hint().is_some(), "{error}");
        error
    };
    let error = refused(&replaced(&bytes, "\"version\":1", "\"version\":9"));
    assert!(matches!(error, TexelFileError::Version { ref found, newest: 1, .. } if found == "9"));
    let error = refused(&replaced(&bytes, "impasto-samples", "impasto-simples"));
    assert!(matches!(error, TexelFileError::Format { .. }), "{error}");
    let error = refused(&replaced(&bytes, "\"width\":33", "\"width\":32"));
    assert!(error.to_string().contains("part `sample.000` has `33 x 21` texels"), "{error}");
    let error = refused(&replaced(&bytes, "\"height\":40", "\"height\":99"));
    assert!(error.to_string().contains("part `sample.001`"), "{error}");
    let error = refused(&replaced(&bytes, "\"spacing\":7.25", "\"spacing\":-7.2"));
    assert!(error.to_string().contains("spacing of sample `tone 1`"), "{error}");
    let error = refused(&replaced(&bytes, "mask\0", "masc\0"));
    assert!(matches!(error, TexelFileError::Channel { .. }), "{error}");
    let error = refused(&replaced(&bytes, "\"relief\":true,", "\"relief\":null,"));
    assert!(matches!(error, TexelFileError::Header { .. }), "{error}");
}

#[test]
fn a_missing_channel_is_named() {
    let bytes = write(&set()).unwrap();
    let json = replaced(&bytes, "\"relief\":false", "\"relief\":true ");
    let error = read("a.exr", &json).unwrap_err();
    let TexelFileError::Channel { part, channel, reason, .. } = &error else { panic!("{error}") };
    assert_eq!((&**part, &**channel, &**reason), ("sample.001", "height", "is missing"));
}

#[test]
fn truncated_and_damaged_files_are_errors_and_never_panics() {
    let bytes = write(&set()).unwrap();
    for cut in (0..bytes.len()).step_by(97).chain([bytes.len() - 1]) {
        assert!(read("a.exr", &bytes[..cut]).is_err(), "{cut} of {}", bytes.len());
    }
    for at in (0..bytes.len()).step_by(61) {
        let mut bytes = bytes.clone();
        bytes[at] ^= 0x55;
        // A flipped number may be possible; it must only not panic.
        let _ = read("a.exr", &bytes);
    }
}

#[test]
fn inconsistent_sets_are_not_written() {
    let refused = |change: &dyn Fn(&mut SampleSet)| {
        let mut set = set();
        change(&mut set);
        write(&set).unwrap_err().to_string()
    };
    assert!(refused(&|set| set.samples.clear()).contains("there are none"));
    let sizes = refused(&|set| set.samples[0].mask = Field::filled(3, 3, true));
    assert!(sizes.contains("fields of sample `tone 1` differ in size"), "{sizes}");
    assert!(refused(&|set| set.samples[1].paint = None).contains("has no paint"));
    assert!(refused(&|set| set.paint = None).contains("paint of no library"));
    assert!(refused(&|set| set.samples[0].spacing = f64::NAN).contains("cannot be saved"));
    let color = refused(&|set| set.samples[0].color[(1, 0)] = [f32::NAN; 3]);
    assert!(color.contains("sample `tone 1`, channel `B` is impossible at x 1, y 0"), "{color}");
    let stray = refused(&|set| {
        if let Some(paint) = &mut set.samples[0].paint {
            paint[(2, 2)].pigments_mm[1] = 0.1;
        }
    });
    assert!(stray.contains("paint of no pigment in slot 1"), "{stray}");
}
