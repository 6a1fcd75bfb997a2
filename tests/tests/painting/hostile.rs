//! `impasto paint` with invalid or extreme scripts: exit status, the location of the fault in
//! the error message, and no files left behind.

use std::path::Path;

use suite::program::{Run, impasto};

use super::program::{SCRIPT, place, script};

/// Runs `impasto paint` on the script with `from` replaced by `to`.
fn paint(folder: &Path, from: &str, to: &str) -> Run {
    let script = script(folder, from, to);
    impasto(&["paint", &script, "--backend", "cpu", "--picture", &place(folder, "out.png")])
}

const STROKE: &str = "[0, 9, 9, 1]";
const UNDO: &str = r#"{"undo": {}}"#;
const CANVAS: &str = r#""width_mm": 24, "height_mm": 16, "cell_mm": 0.2"#;
const YELLOW: &str = r#""recipe": {"Y": 1}"#;

#[test]
fn what_is_wrong_is_told_with_its_place_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let outside = r#"{"save": {"path": "../x.exr"}}"#;
    for (from, to, wanted) in [
        (STROKE, "[0, NaN, 9, 1]", vec!["script.json", "line"]),
        (STROKE, "[0, 9, Infinity, 1]", vec!["script.json", "line"]),
        (STROKE, "[0, 9, 1e999, 1]", vec!["script.json", "line"]),
        (STROKE, "[0, 9, 1e300, 1]", vec!["action 5", "stroke", "sample 0", "y", "1e300"]),
        (STROKE, "[0, 9, 9, 1.5]", vec!["action 5", "sample 0", "pressure", "`1.5`"]),
        (STROKE, "[1, 9, 9, 1], [0, 9, 9, 1]", vec!["action 5", "sample 1", "seconds"]),
        (STROKE, "", vec!["action 5", "samples"]),
        (STROKE, "[9, 9]", vec!["script.json", "line"]),
        (
            YELLOW,
            r#""recipe": {"Chrome Yelow": 1}"#,
            vec!["action 3", "Chrome Yelow", "hint:", "Chrome Yellow"],
        ),
        (YELLOW, r#""recipe": {"Viridian": 1}"#, vec!["action 3", "Viridian", "hint:", "palette"]),
        (YELLOW, r#""recipe": {}"#, vec!["action 3", "recipe"]),
        (
            r#"{"brush": "knife", "recipe""#,
            r#"{"brush": "knive", "recipe""#,
            vec!["action 3", "brush", "knive", "hint:", "knife"],
        ),
        (UNDO, outside, vec!["action 6", "save", "path", "../x.exr"]),
        (
            CANVAS,
            r#""width_mm": 1e6, "height_mm": 1e6, "cell_mm": 0.2"#,
            vec!["canvas", "cells", "hint:"],
        ),
        (CANVAS, r#""width_mm": 24, "height_mm": 16, "cell_mm": 0"#, vec!["canvas.cell_mm"]),
        (
            UNDO,
            r#"{"merge": {"layer": 1}}"#,
            vec!["script.json", "action 6 (merge)", "dry layer", "`1`"],
        ),
        (UNDO, r#"{"merge": {"layer": 7}}"#, vec!["action 6 (merge)", "dry layer", "`7`"]),
        (UNDO, r#"{"opacity": {"layer": 3, "value": 1}}"#, vec!["action 6 (opacity)", "`3`"]),
        (UNDO, r#"{"opacity": {"layer": "wet", "value": 1}}"#, vec!["action 6 (opacity)", "hint:"]),
        (UNDO, r#"{"palette": ["Viridian"]}"#, vec!["action 6 (palette)", "still wet", "hint:"]),
        (
            UNDO,
            r#"{"swap": {"layer": 0, "from": "Viridian", "to": "Minium"}}"#,
            vec!["action 6 (swap)", "Viridian"],
        ),
        (
            UNDO,
            r#"{"light": {"illuminant": "D999", "observer": "1931-2", "azimuth_deg": 90, "elevation_deg": 30, "ambient": 0.5, "relief": 1}}"#,
            vec!["action 6", "D999", "hint:"],
        ),
        (
            UNDO,
            r#"{"load": {"brush": "flat", "recipe": {"W": 1}, "amount_mm": 99}}"#,
            vec!["action 6 (load)", "`99`", "hint:"],
        ),
        (r#""version": 1"#, r#""version": 2"#, vec!["script.json", "version"]),
    ] {
        let run = paint(folder, from, to);
        assert_eq!(run.status, 1, "{to}: {}", run.err);
        for wanted in wanted {
            assert!(run.err.contains(wanted), "{to}: no `{wanted}` in {}", run.err);
        }
        assert!(!folder.join("out.png").exists(), "{to} left a picture");
        assert!(!folder.parent().unwrap().join("x.exr").exists(), "{to} wrote beyond its folder");
    }
}

#[test]
fn odd_scripts_are_painted() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (from, to, remark) in [
        (STROKE, "[0, 9, 9, 0]", ""),
        (STROKE, "[0, 9, 9, 0], [1, 20, 9, 0]", ""),
        (STROKE, "[0, -9000, 9, 1], [1, -9000, 20, 1]", ""),
        (STROKE, "[0, 9, 9, 1, 90, 90, 3600], [1, 9, 9, 1, -90, -90, -3600]", ""),
        (
            r#"{"redo": {}}"#,
            r#"{"redo": {}}, {"redo": {}}, {"redo": {}}"#,
            "2 undo or redo actions had nothing",
        ),
        (CANVAS, r#""width_mm": 0.2, "height_mm": 0.2, "cell_mm": 0.2"#, ""),
        (CANVAS, r#""width_mm": 0.2, "height_mm": 16, "cell_mm": 0.2"#, ""),
        (YELLOW, r#""recipe": {}, "vehicle": 1"#, ""),
        (UNDO, r#"{"dry": {}}, {"dry": {}}"#, ""),
    ] {
        let run = paint(folder, from, to);
        assert_eq!(run.status, 0, "{to}: {}", run.err);
        assert!(
            run.err.contains(remark)
                && run.err.lines().all(|line: &str| {
                    ["outside sRGB", "undo or redo", "Wrote "]
                        .iter()
                        .any(|part| line.contains(part))
                }),
            "{to}: {}",
            run.err
        );
        std::fs::remove_file(folder.join("out.png")).unwrap();
    }
}

#[test]
fn a_recipe_of_a_pigment_that_left_the_palette_is_refused_when_it_is_needed() {
    let folder = tempfile::tempdir().unwrap();
    let to = r#"{"wash": {"brush": "flat"}}, {"wash": {"brush": "knife"}}, {"dry": {}},
      {"palette": ["Viridian"]},
      {"load": {"brush": "flat", "recipe": {"Y": 1}, "amount_mm": 0.1}}"#;
    let run = paint(folder.path(), UNDO, to);
    assert_eq!(run.status, 1, "{}", run.err);
    for wanted in ["action 10 (load)", "Chrome Yellow is not on the palette now", "hint:"] {
        assert!(run.err.contains(wanted), "{}", run.err);
    }
}

#[test]
fn nesting_and_counts_without_end_are_refused_quickly() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let deep = format!("{}{}", "[".repeat(200_000), "]".repeat(200_000));
    let run = paint(folder, STROKE, &deep);
    assert_eq!(run.status, 1, "{}", run.err.len());
    assert!(run.err.len() < 2000, "{} bytes of error", run.err.len());
    // A stroke of 8 m, mostly off the canvas, is painted; one of 5.5 km has too many sub-steps.
    let run = paint(folder, STROKE, "[0, -2000, 9, 1], [1, 2000, 9, 1], [2, -2000, 9, 1]");
    assert_eq!(run.status, 0, "{}", run.err);
    let many = "[0, -23000, 9, 1], [0, 23000, 9, 1], ".repeat(60);
    let run = paint(folder, STROKE, &format!("{many}[0, 9, 9, 1]"));
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("action 5 (stroke)") && run.err.contains("sub-steps"), "{}", run.err);
    assert!(run.err.contains("hint:"), "{}", run.err);
}

#[test]
fn what_a_script_saves_is_checked_before_it_paints() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("taken"), "a file").unwrap();
    let save = r#"{"save": {"path": "first.png"}}, {"save": {"path": "taken/a.exr"}}"#;
    let run = paint(folder, UNDO, save);
    assert_eq!(run.status, 2, "{}", run.err);
    for wanted in ["script.json", "action 7 (save)", "taken"] {
        assert!(run.err.contains(wanted), "{}", run.err);
    }
    assert!(!folder.join("first.png").exists(), "the first save was carried out");
    let good = r#"{"save": {"path": "sub/a.exr"}}, {"save": {"path": "sub/a.png"}}"#;
    let run = paint(folder, UNDO, good);
    assert_eq!(run.status, 0, "{}", run.err);
    let bytes = std::fs::read(folder.join("sub/a.exr")).unwrap();
    let document = paint::file::read("a.exr", &bytes).unwrap();
    assert_eq!((document.title.as_str(), document.dry.len()), ("A trial", 1));
    assert!(folder.join("sub/a.png").exists(), "no picture");
    assert!(SCRIPT.contains(document.title.as_str()));
}

#[test]
fn a_ground_made_from_a_picture_is_not_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let picture = folder.join("out.png");
    image::GrayImage::from_fn(16, 16, |x, _| image::Luma([(x * 16) as u8])).save(&picture).unwrap();
    let before = std::fs::read(&picture).unwrap();
    let to =
        format!(r#"{CANVAS}, "ground": {{"kind": "image", "path": "out.png", "depth_mm": 0.2}}"#);
    let run = paint(folder, CANVAS, &to);
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("is an input file, which is never overwritten"), "{}", run.err);
    assert!(std::fs::read(&picture).unwrap() == before, "written over");
}
