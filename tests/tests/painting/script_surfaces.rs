//! `impasto paint` of scripts that mix on a palette or continue a painting.

use std::path::Path;

use paint::amount::mm_from_quanta;
use paint::document::Document;
use suite::program::{Run, impasto};

use super::program::place;

const HEADER: &str = r#""format": "strokes", "version": 1, "title": "A session",
  "canvas": {"width_mm": 24, "height_mm": 16, "cell_mm": 0.2},
  "palette": {"W": "Lead White", "Y": "Chrome Yellow", "B": "Prussian Blue"},
  "brushes": {"flat": {"shape": "flat", "size_mm": 5}, "knife": {"shape": "knife", "size_mm": 6}},"#;

/// Yellow and blue are squeezed onto the palette, mixed, and painted on the canvas.
const MIXED: &str = r#"
  "mixing": {"width_mm": 20, "height_mm": 16, "cell_mm": 0.2, "ground": {"kind": "panel"}},
  "actions": [
    {"squeeze": {"on": "palette", "recipe": {"Y": 1}, "x_mm": 7, "y_mm": 8, "volume_mm3": 30}},
    {"squeeze": {"on": "palette", "recipe": {"B": 1}, "x_mm": 12, "y_mm": 8, "volume_mm3": 8}},
    {"stroke": {"brush": "knife", "on": "palette",
      "samples": [[0, 4, 8, 0.6, 0, 0, 90], [1, 16, 8, 0.6, 0, 0, 90], [2, 4, 8, 0.6, 0, 0, 90]]}},
    {"stroke": {"brush": "flat", "on": "palette",
      "samples": [[0, 5, 8, 0.7, 0, 0, 90], [1, 17, 8, 0.7, 0, 0, 90], [2, 5, 8, 0.7, 0, 0, 90],
        [3, 17, 8, 0.7, 0, 0, 90], [4, 5, 8, 0.7, 0, 0, 90]]}},
    {"stroke": {"brush": "flat", "samples": [[0, 4, 8, 0.5, 0, 0, 90], [1, 20, 9, 0.5, 0, 0, 90]]}}"#;

const DRY: &str = r#"{"dry": {"fraction": 0.7}}"#;

const OVER: &str = r#"{"load": {"brush": "flat", "recipe": {"W": 1}, "amount_mm": 0.3}},
    {"stroke": {"brush": "flat", "samples": [[0, 12, 2, 0.5], [1, 12, 14, 0.5]]}}"#;

fn written(folder: &Path, name: &str, text: &str) -> String {
    let path = place(folder, name);
    std::fs::write(&path, text).unwrap();
    path
}

fn paint(script: &str, more: &[&str]) -> Run {
    let start = ["paint", script, "--backend", "cpu", "--json"];
    impasto(&[start.as_slice(), more].concat())
}

fn painted(script: &str, output: &str) -> Document {
    let run = paint(script, &["--output", output]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.lines().all(|line| line.starts_with("Wrote ")), "{}", run.err);
    paint::file::read(output, &std::fs::read(output).unwrap()).unwrap()
}

#[test]
fn paint_that_was_mixed_on_the_palette_comes_to_the_canvas() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = written(folder, "mixed.json", &format!("{{{HEADER}{MIXED}]}}"));
    let document = painted(&script, &place(folder, "mixed.exr"));
    assert_eq!((document.wet.width(), document.wet.height()), (120, 80), "the canvas alone");
    let mm3 = document.wet.totals().map(|quanta| quanta as f64 * mm_from_quanta(1, 0.2) * 0.04);
    assert!(mm3[1] > 0.01 && mm3[2] > 0.001, "yellow and blue of the heaps: {mm3:?} mm3");
    assert_eq!(document.wet.totals()[0], 0, "white was never loaded");
}

#[test]
fn a_script_goes_on_with_what_another_one_painted() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let first = written(folder, "first.json", &format!("{{{HEADER}\"actions\": [{OVER}, {DRY}]}}"));
    // The second script starts with clean brushes, so the whole script washes its brush.
    let wash = r#"{"wash": {"brush": "flat"}}"#;
    let whole = format!("{{{HEADER}\"actions\": [{OVER}, {DRY}, {wash},\n{OVER}]}}");
    let whole = written(folder, "whole.json", &whole);
    std::fs::create_dir(folder.join("before")).unwrap();
    let _ = painted(&first, &place(folder, "before/first.exr"));
    let second = format!("{{{HEADER}\"start\": \"before/first.exr\", \"actions\": [{OVER}]}}");
    let second = written(folder, "second.json", &second);
    let wanted = painted(&whole, &place(folder, "whole.exr"));
    let found = painted(&second, &place(folder, "second.exr"));
    assert!(wanted.dry.len() == 1 && wanted == found, "differs from painting at once");

    let run = paint(&second, &["--output", &place(folder, "no.exr"), "--library", &second]);
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(
        run.err.contains("has its own library") && run.err.contains("leave LIBRARY out"),
        "{}",
        run.err
    );
    let run = paint(&second, &["--output", &place(folder, "before/first.exr")]);
    assert_eq!(run.status, 2, "the painting is not written over: {}", run.err);
    for (from, to, wanted) in [
        ("before/first.exr", "before/none.exr", "none.exr"),
        (
            "\"width_mm\": 24",
            "\"width_mm\": 20",
            "canvas: as many cells as the painting has, 120 x 80, found `100 x 80`",
        ),
        (
            "\"Chrome Yellow\"",
            "\"Viridian\"",
            "palette: that of the painting, Lead White, Chrome Yellow",
        ),
    ] {
        let text = std::fs::read_to_string(&second).unwrap();
        assert_eq!(text.matches(from).count(), 1, "`{from}` stands once");
        let other = written(folder, "other.json", &text.replace(from, to));
        let run = paint(&other, &["--output", &place(folder, "no.exr")]);
        assert!(run.status != 0 && run.err.contains(wanted), "{}", run.err);
        assert!(!folder.join("no.exr").exists(), "nothing is written");
    }
}
