//! `impasto paint`, `relight` and `gpu` from end to end: timelapses, layers, TIFF, scripts that mix on a
//! palette or continue a painting, and invalid or extreme scripts (exit status, location of the
//! fault, and no files left behind).
//!
//! The program also runs in a child process, where it is killed while it saves, or has no graphics
//! driver. A test cannot find the program of another package, so the child is this test binary. It
//! runs one ignored test that calls the program.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use calibrate::PigmentId;
use image::AnimationDecoder;
use image::codecs::gif::GifDecoder;
use suite::program::{Run, impasto};

use paint::amount::mm_from_quanta;
use paint::document::Document;
use paint::file;
use paint::layer::SLOTS;

/// A script with most actions, on a canvas of 120 x 80 cells.
pub(crate) const SCRIPT: &str = r##"{
  "format": "strokes", "version": 1, "title": "A trial",
  "canvas": {"width_mm": 24, "height_mm": 16, "cell_mm": 0.2},
  "palette": {"W": "Lead White", "Y": "Chrome Yellow", "B": "Prussian Blue", "R": "Vermilion"},
  "brushes": {"flat": {"shape": "flat", "size_mm": 5}, "knife": {"shape": "knife", "size_mm": 4}},
  "actions": [
    {"load": {"brush": "flat", "recipe": {"W": 3, "B": 1}, "vehicle": 0.2, "amount_mm": 0.3}},
    {"stroke": {"brush": "flat", "samples": [[0, 3, 4, 0.4], [0.5, 20, 5, 0.6, 10, 0, 45]]}},
    {"dry": {"fraction": 0.8}},
    {"load": {"brush": "knife", "recipe": {"Y": 1}, "amount_mm": 0.5}},
    {"stroke": {"brush": "knife", "samples": [[0, 12, 2, 0.5], [0.5, 12, 14, 0.5]]}},
    {"stroke": {"brush": "flat", "samples": [[0, 9, 9, 1]]}},
    {"undo": {}},
    {"redo": {}},
    {"light": {"illuminant": "A", "observer": "1931-2", "azimuth_deg": 90, "elevation_deg": 30,
      "ambient": 0.5, "relief": 1}}
  ]
}"##;

/// Writes [`SCRIPT`] with `from` replaced by `to` into `folder`. Returns its path.
pub(crate) fn script(folder: &Path, from: &str, to: &str) -> String {
    assert!(from.is_empty() || SCRIPT.matches(from).count() == 1, "`{from}` stands once");
    let path = folder.join("script.json");
    let text = if from.is_empty() { SCRIPT.to_owned() } else { SCRIPT.replace(from, to) };
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

pub(crate) fn place(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().unwrap().to_owned()
}

fn done(run: &Run) {
    assert_eq!(run.status, 0, "{}", run.err);
    // Highlights of gloss are brighter than sRGB white. The program remarks on this.
    let expected =
        run.err.lines().all(|line| line.contains("outside sRGB") || line.starts_with("Wrote "));
    assert!(expected, "{}", run.err);
}

#[test]
fn the_same_script_gives_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let names = ["painting.exr", "picture.png", "spectral.exr"];
    let files = ["a-", "b-"].map(|run| names.map(|name| place(folder, &format!("{run}{name}"))));
    for [painting, picture, spectral] in &files {
        let run = impasto(&[
            "paint",
            &script,
            "--backend",
            "cpu",
            "--output",
            painting,
            "--picture",
            picture,
            "--spectral",
            spectral,
            "--json",
        ]);
        done(&run);
        let json = run.json();
        assert_eq!(json["canvas"], serde_json::json!([120, 80]));
        assert_eq!((json["actions"].as_u64(), json["strokes"].as_u64()), (Some(9), Some(3)));
        assert!(json["substeps"].as_u64() > Some(100), "{json}");
    }
    for (a, b) in files[0].iter().zip(&files[1]) {
        let a = std::fs::read(a).unwrap();
        let b = std::fs::read(b).unwrap();
        assert!(a.len() > 1000 && a == b, "{} and {} bytes", a.len(), b.len());
    }
    // Without changes, `relight` gives the picture that `paint` wrote.
    let again = place(folder, "again.png");
    let run = impasto(&["relight", &files[0][0], "--backend", "cpu", "--picture", &again]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.out.contains("light A") && run.out.contains("dry 0"), "{}", run.out);
    assert!(std::fs::read(&again).unwrap() == std::fs::read(&files[0][1]).unwrap(), "not the same");
}

#[test]
fn a_painting_is_relit_under_a_lamp_and_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let painting = place(folder, "a.exr");
    done_with_lines(&impasto(&["paint", &script, "--backend", "cpu", "--output", &painting]));
    let lamp = place(folder, "lamp.csv");
    let lines: Vec<String> = (380..=780).step_by(10).map(|nm| format!("{nm},{nm}")).collect();
    std::fs::write(&lamp, lines.join("\n")).unwrap();
    let relit = place(folder, "b.exr");
    let picture = place(folder, "b.png");
    done_with_lines(&impasto(&[
        "relight",
        &painting,
        "--backend",
        "cpu",
        "--illuminant",
        &lamp,
        "--output",
        &relit,
        "--picture",
        &picture,
        "--swap",
        "all:Chrome Yellow=Minium",
        "--opacity",
        "0=0.5",
    ]));
    let again = place(folder, "c.png");
    let run = impasto(&["relight", &relit, "--backend", "cpu", "--picture", &again, "--json"]);
    done(&run);
    assert_eq!(run.json()["layers"][0]["opacity"], 0.5);
    assert!(std::fs::read(&again).unwrap() == std::fs::read(&picture).unwrap(), "not the same");
    // If the lamp's file is missing, `relight` is refused unless you name another light.
    std::fs::remove_file(&lamp).unwrap();
    let run = impasto(&["relight", &relit, "--backend", "cpu"]);
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("lamp.csv") && run.err.contains("hint:"), "{}", run.err);
    done_with_lines(&impasto(&["relight", &relit, "--backend", "cpu", "--illuminant", "D65"]));
}

fn done_with_lines(run: &Run) {
    done(run);
    assert!(!run.out.is_empty(), "no output");
}

#[test]
fn exports_are_checked_before_anything_is_painted() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let exr = place(folder, "a.exr");
    let file = place(folder, "file");
    std::fs::write(&file, "not a folder").unwrap();
    let below = place(folder, "file/maps");
    for (arguments, wanted) in [
        (vec!["--picture", &exr, "--output", &exr], "two exports have this file name"),
        (vec!["--picture", "a.jpg"], "that ends in .png or .tif or .tiff or .exr"),
        (vec!["--output", "a.jpg"], "that ends in .png, .tif, .ora or .exr"),
        (vec!["--pigment-maps", &below], "cannot be created"),
        (vec!["--output", "/no/such/folder/a.exr"], "cannot be written"),
        (vec![], "nothing would be written"),
    ] {
        let mut all = vec!["paint", &script, "--backend", "cpu"];
        all.extend(arguments);
        let run = impasto(&all);
        assert_eq!(run.status, 2, "{all:?}: {}", run.err);
        assert!(run.err.contains(wanted), "{all:?}: {}", run.err);
        assert!(!Path::new(&exr).exists(), "{all:?} left a file");
    }
}

#[test]
fn pigment_maps_sum_all_layers() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let maps = place(folder, "maps");
    let painting = place(folder, "painting.exr");
    let to = ["--pigment-maps", &maps, "--output", &painting];
    done_with_lines(&impasto(&[&["paint", &script, "--backend", "cpu"][..], &to].concat()));
    let mut names: Vec<String> = std::fs::read_dir(&maps)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert!(names.iter().any(|name| name.ends_with(".png")), "{names:?}");
    assert!(names.iter().any(|name| name.ends_with(".csv")), "{names:?}");
    assert!(names.iter().all(|name| !name.starts_with('.')), "{names:?}");

    let document = file::read("a.exr", &std::fs::read(&painting).unwrap()).unwrap();
    let dry = document.dry.iter().map(|layer| (&layer.slots, &layer.paint));
    let layers: Vec<_> = dry.chain([(&document.slots, &document.wet)]).collect();
    assert!(layers.len() > 1, "no dry layer to sum");
    let recipe = std::fs::read_to_string(Path::new(&maps).join("painting.recipe.csv")).unwrap();
    let quantum_mm3 = mm_from_quanta(1, document.cell_mm) * document.cell_mm.powi(2);
    for line in recipe.lines().skip(1) {
        let mut fields = line.split(',');
        let name = fields.next().unwrap();
        let volume = fields.next().unwrap();
        let volume: f64 = volume.parse().unwrap();
        let held = layers.iter().map(|(slots, paint)| {
            let place = if name == "vehicle" {
                Some(SLOTS)
            } else {
                slots.iter().position(|slot: &Option<PigmentId>| {
                    slot.is_some_and(|pigment| document.library[pigment].name == name)
                })
            };
            place.map_or(0, |place| paint.totals()[place])
        });
        let wanted = held.sum::<u64>() as f64 * quantum_mm3;
        assert!((volume - wanted).abs() <= 1e-5 * wanted, "{name}: {volume} for {wanted}");
    }
    assert!(recipe.contains("Prussian Blue") && recipe.contains("Chrome Yellow"), "{recipe}");
}

#[test]
fn what_the_adapter_is_can_be_read_by_programs() {
    let json = impasto(&["gpu", "--json"]).json();
    assert!(json["adapters"].is_array() && json["why"].is_string(), "{json}");
}

fn refused(arguments: &[&str], wanted: &str) {
    let run = impasto(arguments);
    assert_eq!(run.status, 2, "{arguments:?}: {}", run.err);
    assert!(run.err.contains(wanted), "{arguments:?}: {}", run.err);
}

#[test]
fn a_timelapse_ends_with_the_picture_and_is_continued() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let [gif, png, frames] = ["film.gif", "picture.png", "film.frames"].map(|n| place(folder, n));
    let every = ["--timelapse", &gif, "--timelapse-every", "1", "--timelapse-hold", "1"];
    let base = ["paint", &script, "--backend", "cpu"];
    let run = impasto(&[&base[..], &every, &["--picture", &png, "--json"]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    let json = run.json();
    assert_eq!((json["frames"].as_u64(), json["frames_found"].as_u64()), (Some(6), Some(0)));
    assert_eq!(json["size"], serde_json::json!([120, 80]));
    assert_eq!(json["actions"].as_u64(), Some(9), "the picture is painted too");
    let whole = std::fs::read(&gif).unwrap();
    let decoder = GifDecoder::new(std::io::Cursor::new(&whole)).unwrap();
    let decoded = decoder.into_frames().collect_frames().unwrap();
    assert_eq!(decoded.len(), 6, "start, two strokes, drying, a stroke done again, the light");
    assert_eq!(decoded[5].delay().numer_denom_ms(), (1000, 1));
    let last = image::open(Path::new(&frames).join("frame-0006.png")).unwrap().into_rgb8();
    assert!(last == image::open(&png).unwrap().into_rgb8(), "the end is the picture");

    std::fs::remove_file(&gif).unwrap();
    std::fs::remove_file(Path::new(&frames).join("frame-0003.png")).unwrap();
    let run = impasto(&[&base[..], &every].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.out.contains("6 frames of 120 x 80 pixels, 5 found"), "{}", run.out);
    assert!(std::fs::read(&gif).unwrap() == whole, "the same bytes");
}

#[test]
fn timelapses_are_checked_before_anything_is_painted() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let png = place(folder, "a.png");
    let base = ["paint", &script, "--backend", "cpu", "--timelapse"];
    for (more, wanted) in [
        (&["a.mp4"][..], "ends in .gif, .png or .apng"),
        (&[&png, "--picture", &png], "two outputs have this file name"),
        (&[&png, "--timelapse-every", "0"], "every takes 1 action and up"),
        (&[&png, "--timelapse-seconds", "-1"], "seconds takes 0.01 to 86400 s"),
        (&[&png, "--timelapse-size", "3"], "size takes 16 to 16384 px"),
        (&[&png, "--timelapse-hold", "1000"], "hold takes 0 to 60 s"),
        (&[&png, "--timelapse-rate", "0"], "--timelapse-rate"),
        (&[&png, "--timelapse-every", "2", "--timelapse-count", "9"], "cannot be used with"),
        (&["/no/such/folder/a.gif"], "cannot be written"),
    ] {
        refused(&[&base[..], more].concat(), wanted);
        assert!(!Path::new(&png).exists(), "{more:?} left a file");
    }
}

#[test]
fn layers_and_tiff_agree_with_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let [ora, png, tif, painting] = ["a.ora", "a.png", "a.tif", "a.exr"].map(|n| place(folder, n));
    let base = ["paint", &script, "--backend", "cpu", "--layers", &ora];
    let run = impasto(&[&base[..], &["--picture", &png, "--bits", "16"]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    let run =
        impasto(&["paint", &script, "--backend", "cpu", "--picture", &tif, "--output", &painting]);
    assert_eq!(run.status, 0, "{}", run.err);
    let [ora, png, tif] = [&ora, &png, &tif].map(|path| std::fs::read(path).unwrap());
    assert_eq!(&ora[30..54], b"mimetypeimage/openraster");
    assert!(ora.windows(png.len()).any(|part| part == png), "the merged picture");
    assert_eq!(&tif[..4], b"II*\0");
    let again = place(folder, "b.ora");
    let run = impasto(&["relight", &painting, "--backend", "cpu", "--layers", &again]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(std::fs::read(&again).unwrap() == ora, "relight writes the same layers");
    refused(&["paint", &script, "--layers", "a.png"], "that ends in .ora");
}

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
    file::read(output, &std::fs::read(output).unwrap()).unwrap()
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
    // The second script starts with clean brushes, so the whole script must wash its brush.
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

/// Runs `impasto paint` on the script with `from` replaced by `to`.
fn paint_script(folder: &Path, from: &str, to: &str) -> Run {
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
        (STROKE, "[0, 9, 1e300, 1]", vec!["action 6", "stroke", "sample 0", "y", "1e300"]),
        (STROKE, "[0, 9, 9, 1.5]", vec!["action 6", "sample 0", "pressure", "`1.5`"]),
        (STROKE, "[1, 9, 9, 1], [0, 9, 9, 1]", vec!["action 6", "sample 1", "seconds"]),
        (STROKE, "", vec!["action 6", "samples"]),
        (STROKE, "[9, 9]", vec!["script.json", "line"]),
        (
            YELLOW,
            r#""recipe": {"Chrome Yelow": 1}"#,
            vec!["action 4", "Chrome Yelow", "hint:", "Chrome Yellow"],
        ),
        (YELLOW, r#""recipe": {"Viridian": 1}"#, vec!["action 4", "Viridian", "hint:", "palette"]),
        (YELLOW, r#""recipe": {}"#, vec!["action 4", "recipe"]),
        (
            r#"{"brush": "knife", "recipe""#,
            r#"{"brush": "knive", "recipe""#,
            vec!["action 4", "brush", "knive", "hint:", "knife"],
        ),
        (UNDO, outside, vec!["action 7", "save", "path", "../x.exr"]),
        (
            CANVAS,
            r#""width_mm": 1e6, "height_mm": 1e6, "cell_mm": 0.2"#,
            vec!["canvas", "cells", "hint:"],
        ),
        (CANVAS, r#""width_mm": 24, "height_mm": 16, "cell_mm": 0"#, vec!["canvas.cell_mm"]),
        (
            UNDO,
            r#"{"merge": {"layer": 1}}"#,
            vec!["script.json", "action 7 (merge)", "dry layer", "`1`"],
        ),
        (UNDO, r#"{"merge": {"layer": 7}}"#, vec!["action 7 (merge)", "dry layer", "`7`"]),
        (UNDO, r#"{"opacity": {"layer": 3, "value": 1}}"#, vec!["action 7 (opacity)", "`3`"]),
        (UNDO, r#"{"opacity": {"layer": "wet", "value": 1}}"#, vec!["action 7 (opacity)", "hint:"]),
        (UNDO, r#"{"palette": ["Viridian"]}"#, vec!["action 7 (palette)", "still wet", "hint:"]),
        (
            UNDO,
            r#"{"swap": {"layer": 0, "from": "Viridian", "to": "Minium"}}"#,
            vec!["action 7 (swap)", "Viridian"],
        ),
        (
            UNDO,
            r#"{"light": {"illuminant": "D999", "observer": "1931-2", "azimuth_deg": 90, "elevation_deg": 30, "ambient": 0.5, "relief": 1}}"#,
            vec!["action 7", "D999", "hint:"],
        ),
        (
            UNDO,
            r#"{"load": {"brush": "flat", "recipe": {"W": 1}, "amount_mm": 99}}"#,
            vec!["action 7 (load)", "`99`", "hint:"],
        ),
        (r#""version": 1"#, r#""version": 2"#, vec!["script.json", "version"]),
    ] {
        let run = paint_script(folder, from, to);
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
        let run = paint_script(folder, from, to);
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
    let run = paint_script(folder.path(), UNDO, to);
    assert_eq!(run.status, 1, "{}", run.err);
    for wanted in ["action 11 (load)", "Chrome Yellow is not on the palette now", "hint:"] {
        assert!(run.err.contains(wanted), "{}", run.err);
    }
}

#[test]
fn nesting_and_counts_without_end_are_refused_quickly() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let deep = format!("{}{}", "[".repeat(200_000), "]".repeat(200_000));
    let run = paint_script(folder, STROKE, &deep);
    assert_eq!(run.status, 1, "{}", run.err.len());
    assert!(run.err.len() < 2000, "{} bytes of error", run.err.len());
    // A stroke of 8 m, mostly off the canvas, is painted. A stroke of 5.5 km has too many
    // sub-steps.
    let run = paint_script(folder, STROKE, "[0, -2000, 9, 1], [1, 2000, 9, 1], [2, -2000, 9, 1]");
    assert_eq!(run.status, 0, "{}", run.err);
    let many = "[0, -23000, 9, 1], [0, 23000, 9, 1], ".repeat(60);
    let run = paint_script(folder, STROKE, &format!("{many}[0, 9, 9, 1]"));
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("action 6 (stroke)") && run.err.contains("sub-steps"), "{}", run.err);
    assert!(run.err.contains("hint:"), "{}", run.err);
}

#[test]
fn what_a_script_saves_is_checked_before_it_paints() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("taken"), "a file").unwrap();
    let save = r#"{"save": {"path": "first.png"}}, {"save": {"path": "taken/a.exr"}}"#;
    let run = paint_script(folder, UNDO, save);
    assert_eq!(run.status, 2, "{}", run.err);
    for wanted in ["script.json", "action 8 (save)", "taken"] {
        assert!(run.err.contains(wanted), "{}", run.err);
    }
    assert!(!folder.join("first.png").exists(), "the first save was carried out");
    let good = r#"{"save": {"path": "sub/a.exr"}}, {"save": {"path": "sub/a.png"}}"#;
    let run = paint_script(folder, UNDO, good);
    assert_eq!(run.status, 0, "{}", run.err);
    let bytes = std::fs::read(folder.join("sub/a.exr")).unwrap();
    let document = file::read("a.exr", &bytes).unwrap();
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
    let run = paint_script(folder, CANVAS, &to);
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("is an input file, which is never overwritten"), "{}", run.err);
    assert!(std::fs::read(&picture).unwrap() == before, "written over");
}

const ARGUMENTS: &str = "IMPASTO_CHILD_ARGUMENTS";

/// Runs `impasto` with the arguments in [`ARGUMENTS`]. Without them it does nothing.
#[test]
#[ignore = "the child of the tests below"]
fn child() {
    let Ok(arguments) = std::env::var(ARGUMENTS) else { return };
    let arguments: Vec<&str> = arguments.split('\n').collect();
    let run = impasto(&arguments);
    super::studio::tell(&format!("{}\nstatus {}\n{}", run.out, run.status, run.err));
}

/// A command that runs `impasto` with `arguments` in a child process.
fn program(arguments: &[&str]) -> Command {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["--exact", "program::child", "--ignored", "--nocapture", "--test-threads=1"]);
    command.env(ARGUMENTS, arguments.join("\n")).stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// Runs `command` and returns its stderr: output, exit status and errors of the program.
fn output_of(mut command: Command) -> String {
    String::from_utf8_lossy(&command.output().unwrap().stderr).into_owned()
}

fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
fn a_painter_killed_at_any_moment_leaves_the_old_file_or_the_new_one_whole() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    // The script saves after every stroke, so most kills hit a save.
    let mut text: serde_json::Value = serde_json::from_str(SCRIPT).unwrap();
    let actions = text["actions"].as_array_mut().unwrap();
    actions.pop();
    let stroke = actions[1].clone();
    for _ in 0..500 {
        actions.push(serde_json::json!({"save": {"path": "saved.exr"}}));
        actions.push(stroke.clone());
    }
    let endless = place(folder, "endless.json");
    std::fs::write(&endless, text.to_string()).unwrap();
    let saved = folder.join("saved.exr");
    let short = script(folder, "", "");
    let saved_name = saved.to_str().unwrap();
    assert!(
        output_of(program(&["paint", &short, "--backend", "cpu", "--output", saved_name]))
            .contains("status 0")
    );
    let old = std::fs::read(&saved).unwrap();
    let mut kept = 0;
    let mut new = 0;
    for moment in 0..12 {
        std::fs::write(&saved, &old).unwrap();
        let mut child = program(&["paint", &endless, "--backend", "cpu"]).spawn().unwrap();
        // The first four children may die before their first save. The others die after it.
        while moment > 3 && std::fs::read(&saved).unwrap() == old {
            assert!(child.try_wait().unwrap().is_none(), "it ended without a save");
            std::thread::sleep(Duration::from_millis(5));
        }
        // Every second child is killed right after its first save.
        let wait = if moment > 3 && moment % 2 == 0 { 0 } else { 7 * moment };
        std::thread::sleep(Duration::from_millis(wait));
        child.kill().unwrap();
        let _ = child.wait().unwrap();
        let found = std::fs::read(&saved).unwrap();
        if found == old {
            kept += 1;
        } else {
            new += 1;
            let document = file::read("saved.exr", &found).unwrap();
            assert_eq!(document.title, "A trial");
        }
    }
    assert!(kept > 0 && new > 0, "{kept} times the old file, {new} times a new one");
    let left = files(folder);
    let strange: Vec<_> =
        left.iter().filter(|name| !name.ends_with(".json") && *name != "saved.exr").collect();
    assert!(strange.iter().all(|name| name.starts_with(".impasto-")), "{strange:?}");
}

#[test]
fn without_a_driver_the_processor_paints_unless_a_device_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let picture = place(folder, "a.png");
    let [refused, painted] = ["gpu", "auto"].map(|backend| {
        let mut run = program(&["paint", &script, "--backend", backend, "--picture", &picture]);
        for variable in ["VK_ICD_FILENAMES", "VK_DRIVER_FILES"] {
            run.env(variable, "/nowhere/driver.json");
        }
        (output_of(run), Path::new(&picture).exists())
    });
    let (refused, written) = refused;
    assert!(refused.contains("status 2"), "{refused}");
    assert!(refused.contains("hint: paint on the processor: --backend cpu"), "{refused}");
    assert!(!written, "refused, but a picture was written");
    let (painted, written) = painted;
    assert!(painted.contains("status 0") && painted.contains("on the processor"), "{painted}");
    assert!(written, "no picture");
}

/// A picture of black squares of `side` pixels, written row by row.
fn black_picture(path: &Path, side: u32) {
    let file = std::io::BufWriter::new(std::fs::File::create(path).unwrap());
    let mut encoder = png::Encoder::new(file, side, side);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Sixteen);
    encoder.set_compression(png::Compression::Fastest);
    let mut writer = encoder.write_header().unwrap();
    let mut rows = writer.stream_writer().unwrap();
    let row = vec![0; 6 * side as usize];
    for _ in 0..side {
        rows.write_all(&row).unwrap();
    }
    rows.finish().unwrap();
}

#[cfg(target_os = "linux")]
#[test]
fn a_picture_that_needs_more_memory_than_the_limit_is_refused_with_words() {
    let folder = tempfile::tempdir().unwrap();
    let output = place(folder.path(), "painted.png");
    for (name, side) in [("small.png", 64), ("large.png", 11_000)] {
        let picture = place(folder.path(), name);
        black_picture(Path::new(&picture), side);
        let painter = program(&[
            "paint",
            "--from",
            &picture,
            "-o",
            &output,
            "--width-mm",
            "20",
            "--backend",
            "cpu",
        ]);
        let mut limited = Command::new("sh");
        limited.args(["-c", "ulimit -v 700000 && exec \"$@\"", "sh"]);
        limited.arg(painter.get_program()).args(painter.get_args());
        limited.envs(painter.get_envs().filter_map(|(name, value)| Some((name, value?))));
        let found = output_of(limited);
        match side {
            64 => {
                assert!(found.contains("status 0"), "{found}");
                std::fs::remove_file(&output).unwrap();
            }
            _ => {
                assert!(found.contains("status 2"), "{found}");
                let words = "the picture needs `692` MB of memory, which the system does not give";
                assert!(found.contains(words) && found.contains("large.png"), "{found}");
                assert!(!Path::new(&output).exists(), "a file of a picture that was not read");
            }
        }
    }
}
