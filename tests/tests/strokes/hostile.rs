//! Invalid stroke scripts give errors with location, expected range and hint, and never panic.

use documents::hint::Explain;
use paint::pose::Sample;
use paint::strokes::{Action, MAX_FILE_BYTES, MAX_SAMPLES, ScriptError, StrokeScript};
use proptest::prelude::*;

use crate::{SOUND, refused};

/// The error message of [`SOUND`] with `from` replaced by `to`, without the file name.
fn error_after(from: &str, to: &str) -> String {
    refused(from, to).to_string().split_off("a.json: ".len())
}

#[test]
fn numbers_out_of_range_are_told_with_action_sample_and_field() {
    let last = "[0.5, 60, 12, 0.6, 10, 0, 45]";
    let sample = "action 2 (stroke), sample 1, ";
    let cases = [
        (last, "[0.5, 60, 12, 1.2]", "pressure: 0 to 1, found `1.2`"),
        (last, "[0.5, 60, 12, -0.1]", "pressure: 0 to 1, found `-0.1`"),
        (last, "[-1, 60, 12, 0]", "seconds: 0 to 1000000, found `-1`"),
        (last, "[0.5, 1e9, 12, 0]", "x: -100000 to 100000, found `1e9`"),
        (last, "[0.5, 0, -1e9, 0]", "y: -100000 to 100000, found `-1e9`"),
        (last, "[0.5, 0, 0, 0, 91]", "tilt x: -90 to 90, found `91`"),
        (last, "[0.5, 0, 0, 0, 0, -91]", "tilt y: -90 to 90, found `-91`"),
        (last, "[0.5, 0, 0, 0, 0, 0, 1e5]", "twist: -3600 to 3600, found `100000`"),
    ];
    for (from, to, wanted) in cases {
        assert_eq!(error_after(from, to), format!("{sample}{wanted}"));
    }
    let back = error_after("[[0, 10, 10, 0.2], [0.5,", "[[2, 10, 10, 0.2], [0.5,");
    assert_eq!(back, format!("{sample}seconds: not before the last sample's 2, found `0.5`"));
    let cases = [
        (
            "\"samples\": [[0, 10, 10, 0.2], [0.5, 60, 12, 0.6, 10, 0, 45]]",
            "\"samples\": []",
            "action 2 (stroke), samples: at least one, found `0`",
        ),
        ("\"keep\": 0.2", "\"keep\": 2", "action 3 (wipe), keep: 0 to 1, found `2`"),
        ("\"fraction\": 0.5", "\"fraction\": 0", "action 5 (dry), fraction: above 0, found `0`"),
        ("\"W\": 3", "\"W\": -3", "action 1 (load), recipe, W: 0 to 1000000, found `-3`"),
        ("\"vehicle\": 0.2", "\"vehicle\": 1.2", "action 1 (load), vehicle: 0 to 1, found `1.2`"),
        (
            "\"amount_mm\": 0.3",
            "\"amount_mm\": 1e4",
            "action 1 (load), amount_mm: 0 to 100, found `10000`",
        ),
        (
            "{\"W\": 3, \"B\": 1}",
            "{}",
            "action 1 (load), recipe: parts that sum to more than 0, found `0`",
        ),
        (
            "\"elevation_deg\": 30",
            "\"elevation_deg\": 0",
            "action 10 (light), elevation_deg: above 0, found `0`",
        ),
        ("\"value\": 0.5", "\"value\": -1", "action 11 (opacity), value: 0 to 1000, found `-1`"),
        (
            "{\"merge\": {\"layer\": 1}}",
            "{\"merge\": {\"layer\": 0}}",
            "action 13 (merge), layer: 1 and up: a dry layer that has one below it, found `0`",
        ),
        ("\"size_mm\": 12", "\"size_mm\": 0", "brushes.big.size_mm: 0.2 to 100, found `0`"),
        ("\"size_mm\": 12", "\"size_mm\": 1e3", "brushes.big.size_mm: 0.2 to 100, found `1000`"),
        ("\"cell_mm\": 0.1", "\"cell_mm\": 0", "canvas.cell_mm: 0.001 to 10, found `0`"),
        ("\"width_mm\": 100", "\"width_mm\": -1", "canvas.width_mm: 0.001 to 1000000, found `-1`"),
        (
            "{\"W\": \"Zinc White\", \"B\": \"Prussian Blue\"}",
            "[]",
            "palette: 1 to 8 pigments, found `0`",
        ),
        (
            "\"scattering_per_mm\": 50",
            "\"scattering_per_mm\": 0",
            "medium.scattering_per_mm: 0.001 to 1000000, found `0`",
        ),
    ];
    for (from, to, wanted) in cases {
        assert_eq!(error_after(from, to), wanted);
    }
}

#[test]
fn strokes_off_the_canvas_and_without_pressure_are_fine() {
    let far = SOUND.replace("[0.5, 60, 12, 0.6, 10, 0, 45]", "[0, -5000, 9000, 0, -90, 90, -360]");
    assert!(StrokeScript::from_json("a.json", far.as_bytes()).is_ok(), "a stroke off the canvas");
}

#[test]
fn a_canvas_beyond_memory_is_told_with_a_way_out() {
    let error = refused("\"cell_mm\": 0.1", "\"cell_mm\": 0.001");
    let wanted = "a.json: canvas: at most 67108864 cells, which take 6 GB, found `100000 x 80000`";
    assert_eq!(error.to_string(), wanted);
    let hint = error.hint().unwrap().to_string();
    let tried = SOUND.replace("\"cell_mm\": 0.1", &hint);
    assert!(StrokeScript::from_json("a.json", tried.as_bytes()).is_ok(), "{hint} does not help");
}

#[test]
fn names_that_nobody_declared_are_told_with_the_nearest() {
    let error = refused("{\"wash\": {\"brush\": \"big\"}}", "{\"wash\": {\"brush\": \"bigg\"}}");
    assert_eq!(error.to_string(), "a.json: action 4 (wash), brush: one of `brushes`, found `bigg`");
    assert_eq!(error.hint().unwrap().to_string(), "did you mean big?");
    let error = refused("\"shape\": \"flat\"", "\"shape\": \"flatt\"");
    assert!(
        error.to_string().contains("unknown variant `flatt`, expected one of `round`, `flat`"),
        "{error}"
    );
    let error = refused("\"kind\": \"linen\"", "\"kind\": \"linnen\"");
    assert!(
        error.to_string().contains("unknown variant `linnen`, expected one of `linen`"),
        "{error}"
    );
}

#[test]
fn json_that_does_not_fit_is_told_with_line_and_column() {
    let cases = [
        (
            "[0, 10, 10, 0.2]",
            "[0, 10, 10]",
            "line 12, column 55: invalid length 3, expected 4 to 7",
        ),
        ("[0, 10, 10, 0.2]", "[0, 1, 1, 0, 0, 0, 0, 0]", "invalid length 8, expected 4 to 7"),
        ("[0, 10, 10, 0.2]", "[NaN, 1, 1, 0]", "line 12, column 46: expected value"),
        ("[0, 10, 10, 0.2]", "[1e999, 1, 1, 0]", "number out of range"),
        ("[0, 10, 10, 0.2]", "[null, 1, 1, 0]", "invalid type: null, expected a number"),
        ("\"keep\": 0.2", "\"kept\": 0.2", "line 13, column 36: unknown field `kept`"),
        ("\"keep\": 0.2", "\"keep\": 0.2, \"keep\": 0.2", "duplicate field `keep`"),
        ("\"W\": 3,", "\"W\": 3, \"W\": 4,", "duplicate key `W`"),
        ("\"B\": \"Prussian", "\"W\": \"Prussian", "duplicate key `W`"),
        ("\"knife\": {", "\"big\": {", "duplicate key `big`"),
        ("{\"undo\": {}}", "{\"undone\": {}}", "unknown variant `undone`"),
        ("{\"undo\": {}}", "{\"undo\": {\"twice\": 1}}", "unknown field `twice`"),
        (
            "\"layer\": 0",
            "\"layer\": -1",
            "\"wet\", the number of a dry layer, from 0, or its identity",
        ),
        (
            "\"layer\": \"wet\"",
            "\"layer\": \"damp\"",
            "\"wet\", the number of a dry layer, from 0, or its identity",
        ),
        (
            "[\"Zinc White\", \"Viridian\"]",
            "[\"1\",\"2\",\"3\",\"4\",\"5\",\"6\",\"7\",\"8\",\"9\"]",
            "more than 8 pigments, at `9`",
        ),
        ("\"title\": \"A study\"", "\"title\": \"A study\", \"mood\": 1", "unknown field `mood`"),
        ("\"palette\": {", "\"pallet\": {", "unknown field `pallet`"),
    ];
    for (from, to, wanted) in cases {
        let error = refused(from, to);
        assert!(matches!(error, ScriptError::Syntax { .. }), "{error}");
        assert!(error.to_string().contains(wanted), "{error} for {wanted}");
    }
}

#[test]
fn other_formats_versions_and_encodings_are_told() {
    let error = error_after("\"format\": \"strokes\"", "\"format\": \"scribbles\"");
    assert_eq!(error, "`format` must be \"strokes\", found `\"scribbles\"`");
    let error = refused("\"version\": 1", "\"version\": 2");
    let wanted = "a.json: this program reads strokes up to version 1, found `2`";
    assert_eq!(error.to_string(), wanted);
    assert_eq!(error.hint().unwrap().to_string(), "a newer impasto may read it");
    let newer = SOUND.replace("\"version\": 1", "\"smell\": 1, \"version\": 2");
    let error = StrokeScript::from_json("a.json", newer.as_bytes()).unwrap_err();
    assert!(matches!(error, ScriptError::Version { .. }), "{error}");

    let mut bytes = SOUND.as_bytes().to_vec();
    let at = SOUND.find("Prussian").unwrap();
    bytes[at] = 0xe9;
    let error = StrokeScript::from_json("a.json", &bytes).unwrap_err();
    assert_eq!(error.to_string(), "a.json: line 8: no UTF-8, found byte `0xe9`");
    for text in ["", "[]", "null", "{", "{}"] {
        assert!(StrokeScript::from_json("a.json", text.as_bytes()).is_err(), "{text}");
    }
    let deep = "[".repeat(100_000);
    assert!(StrokeScript::from_json("a.json", deep.as_bytes()).is_err(), "nested too deeply");
}

#[test]
fn scripts_save_nowhere_but_below_their_folder() {
    for path in ["/etc/passwd.png", "../a.exr", "a/../../b.exr", "C:/a.exr", ".a.exr", "run.sh", ""]
    {
        let error = refused("out/study.exr", path);
        let wanted = format!("found `{path}`");
        assert!(error.to_string().starts_with("a.json: action 14 (save), path: "), "{error}");
        assert!(error.to_string().ends_with(&wanted), "{error}");
    }
}

#[test]
fn too_much_is_refused() {
    let long = vec![b' '; MAX_FILE_BYTES + 1];
    let error = StrokeScript::from_json("a.json", &long).unwrap_err();
    assert!(matches!(error, ScriptError::TooLong { .. }), "{error}");

    let mut script = StrokeScript::from_json("a.json", SOUND.as_bytes()).unwrap();
    let Action::Stroke(stroke) = &mut script.actions[1] else { panic!("a stroke") };
    stroke.samples = vec![stroke.samples[0]; MAX_SAMPLES];
    assert!(script.check().is_ok(), "the limit itself is fine");
    let Action::Stroke(stroke) = &mut script.actions[1] else { panic!("a stroke") };
    stroke.samples.push(stroke.samples[0]);
    let error = script.check().unwrap_err().to_string();
    assert!(error.starts_with("action 2 (stroke), samples: at most 10000000 of all"), "{error}");
}

#[test]
fn a_script_with_nan_is_not_written() {
    let sound = StrokeScript::from_json("a.json", SOUND.as_bytes()).unwrap();
    let fields: [fn(&mut Sample) -> &mut f64; 7] = [
        |s| &mut s.seconds,
        |s| &mut s.x_mm,
        |s| &mut s.y_mm,
        |s| &mut s.pressure,
        |s| &mut s.tilt_x_deg,
        |s| &mut s.tilt_y_deg,
        |s| &mut s.twist_deg,
    ];
    for (index, field) in fields.into_iter().enumerate() {
        for value in [f64::NAN, f64::INFINITY] {
            let mut script = sound.clone();
            let Action::Stroke(stroke) = &mut script.actions[1] else { panic!("a stroke") };
            *field(&mut stroke.samples[0]) = value;
            let error = script.to_json().unwrap_err().to_string();
            assert!(error.starts_with("action 2 (stroke), sample 0, "), "{index}: {error}");
        }
    }
}

fn config() -> ProptestConfig {
    ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn damage_never_panics(
        flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..5),
        length in any::<prop::sample::Index>(),
        cut in any::<bool>(),
    ) {
        let mut bytes = SOUND.as_bytes().to_vec();
        for (index, byte) in flips {
            let at = index.index(bytes.len());
            bytes[at] = byte;
        }
        bytes.truncate(if cut { length.index(bytes.len()) } else { bytes.len() });
        if let Err(error) = StrokeScript::from_json("a.json", &bytes) {
            prop_assert!(error.to_string().starts_with("a.json: "), "{}", error);
        }
    }
}
