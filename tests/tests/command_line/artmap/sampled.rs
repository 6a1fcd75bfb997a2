//! `impasto artmap sample` of pictures by marks, and `impasto artmap show`.

use graphics::export::png8;
use graphics::field::Field;
use serde_json::{Value, json};

use super::{Folder, MARKS, artmap, done};

/// Number of a JSON value.
#[track_caller]
fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn marked_samples_are_upright_of_one_spacing_and_dark_to_light() {
    let folder = Folder::new();
    let picture = folder.strokes();
    let marks = folder.write("marks.toml", MARKS);
    let [output, sheet, marked] = ["s.exr", "s.png", "m.png"].map(|name| folder.file(name));
    let arguments = ["sample", &picture, "--marks", &marks, "--output", &output];
    let told =
        done(&[&arguments[..], &["--sheet", &sheet, "--marked", &marked, "--json"]].concat());
    let told = told.json();
    assert_eq!(
        (&told["provenance"], &told["pigments"]),
        (&json!("picture strokes.png"), &json!([]))
    );
    let [shade, wall] = [&told["samples"][0], &told["samples"][1]];
    assert_eq!((&shade["name"], &wall["name"]), (&json!("shade"), &json!("wall")));
    assert!(number(&shade["lightness"]) + 20.0 < number(&wall["lightness"]), "{told}");
    for (sample, degrees) in [(shade, 120.0), (wall, 60.0)] {
        let direction = &sample["direction"];
        assert!((number(&direction["degrees"]) - degrees).abs() < 2.0, "{direction}");
        assert!(
            direction["turned"] == true && number(&direction["coherence"]) > 0.7,
            "{direction}"
        );
    }
    assert_eq!(
        (&wall["spacing_source"], &shade["spacing_source"]),
        (&json!("estimated"), &json!("marked"))
    );
    assert!((number(&wall["spacing_px"]) - 10.0).abs() < 0.5, "{wall}");
    assert!(number(&wall["sharpness"]) > 0.5 && shade["sharpness"].is_null(), "{told}");
    // The smaller spacing of two is that of the set.
    assert_eq!((number(&told["spacing"]), number(&shade["scale"][0])), (8.0, 1.0));
    assert!((number(&wall["scale"][0]) - 0.8).abs() < 0.04, "{wall}");
    assert_eq!(shade["bounds"], json!([106, 6, 88, 108]));
    assert_eq!((&shade["pixels"], &shade["regions_under"]), (&json!(88 * 108), &json!(0)));
    // The wall is half of the picture.
    let [left, _, width, height] = [0, 1, 2, 3].map(|i| number(&wall["bounds"][i]));
    assert!(left < 3.0 && (90.0..=106.0).contains(&width) && height > 112.0, "{wall}");

    let shown = done(&["show", &output, "--json"]).json();
    assert_eq!((&shown["provenance"], &shown["spacing"]), (&told["provenance"], &told["spacing"]));
    for (shown, told) in [(&shown["samples"][0], shade), (&shown["samples"][1], wall)] {
        for key in ["name", "size", "texels", "colour", "mm_per_texel", "height_mm"] {
            assert_eq!(shown[key], told[key], "{key}");
        }
    }
    let marked = image::open(&marked).unwrap().into_rgb8();
    assert_eq!(marked.dimensions(), (200, 120));
    // The first mark is orange, on a wall of white and yellow.
    let [r, g, b] = marked.get_pixel(45, 60).0;
    assert!(r > 220 && (120..200).contains(&g) && b < 30, "{r} {g} {b}");
    assert!(image::open(&sheet).unwrap().width() > 100, "a sheet");
}

#[test]
fn relief_is_guessed_only_if_asked_for_and_that_is_told() {
    let folder = Folder::new();
    let picture = folder.strokes();
    let marks = folder.write("marks.toml", MARKS);
    let output = folder.file("s.exr");
    let arguments = ["sample", &picture, "--marks", &marks, "--output", &output];
    let plain = done(&[&arguments[..], &["--json"]].concat()).json();
    assert_eq!(plain["samples"][0]["height_mm"], Value::Null, "{plain}");
    done(&[&arguments[..], &["--guess-relief", "0.2"]].concat());
    let told = done(&["show", &output, "--json"]).json();
    for sample in told["samples"].as_array().unwrap() {
        assert_eq!(sample["guessed_relief"], json!(true), "{told}");
        let greatest = number(&sample["height_mm"]["greatest"]);
        assert!((0.15..=0.2001).contains(&greatest), "{told}");
    }
    let table = done(&["show", &output]).out;
    assert!(table.contains("mm (guessed)"), "{table}");
    let run = artmap(&[&arguments[..], &["--guess-relief", "0"]].concat());
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("--guess-relief 0.2 is usual for oil"), "{}", run.err);
}

#[test]
fn the_table_names_each_sample_once_and_files_are_the_same_bytes() {
    let folder = Folder::new();
    let picture = folder.strokes();
    let marks = folder.write("marks.toml", MARKS);
    let run = |name: &str| {
        let output = folder.file(name);
        let sheet = folder.file(&format!("{name}.png"));
        let arguments = ["sample", &picture, "--marks", &marks, "--density", "width"];
        let more = ["--over", "mean-shift", "--output", &output, "--sheet", &sheet];
        done(&[arguments, more].concat())
    };
    let first = run("a.exr");
    let second = run("b.exr");
    assert!(
        first.err.lines().all(|line| line.starts_with("Wrote ")),
        "nothing to remark: {}",
        first.err
    );
    assert_eq!(first.out.replace("a.exr", "b.exr"), second.out);
    for name in ["wall", "shade"] {
        let line = first.out.lines().filter(|line| line.starts_with(name));
        let line: Vec<&str> = line.collect();
        assert_eq!(line.len(), 1, "{}", first.out);
        assert!(line[0].contains(" px ("), "{}", line[0]);
    }
    assert!(first.out.contains("0.80 x 1.00") || first.out.contains(" x 1.00"), "{}", first.out);
    assert!(folder.bytes("a.exr") == folder.bytes("b.exr"), "samples");
    assert!(folder.bytes("a.exr.png") == folder.bytes("b.exr.png"), "sheets");
}

#[test]
fn lines_of_a_picture_are_marks_too() {
    let folder = Folder::new();
    let picture = folder.strokes();
    let mut lines = image::RgbaImage::new(200, 120);
    for step in 0..40 {
        lines.put_pixel(30 + step, 60, image::Rgba([255, 0, 0, 255]));
        lines.put_pixel(130 + step, 60, image::Rgba([0, 0, 255, 255]));
    }
    let marks = folder.file("lines.png");
    lines.save(&marks).unwrap();
    let output = folder.file("s.exr");
    let told = done(&["sample", &picture, "--marks", &marks, "--output", &output, "--json"]).json();
    let names = [0, 1].map(|index| told["samples"][index]["name"].clone());
    assert_eq!(names, [json!("#0000ff"), json!("#ff0000")]);
    assert!(number(&told["samples"][0]["regions_under"]) >= 1.0, "{told}");
}

#[test]
fn a_picture_without_marks_is_one_sample_and_the_single_tone_is_told() {
    let folder = Folder::new();
    let picture = Field::from_values(
        80,
        60,
        (0..4800)
            .map(|i: usize| {
                let light = 0.4 + 0.3 * (std::f32::consts::TAU * (i % 80) as f32 / 5.0).cos();
                [light, light, light, 1.0]
            })
            .collect(),
    );
    let picture = folder.write("waves.png", png8(&picture, 1.0).unwrap().bytes);
    let output = folder.file("s.exr");
    let run = done(&["sample", &picture, "--output", &output]);
    assert!(run.out.contains("1 sample of waves.png, strokes 5."), "{}", run.out);
    assert!(run.err.contains("one sample has a single tone"), "{}", run.err);
    assert!(run.err.contains("too close for a map, which needs 6"), "{}", run.err);
    let run = done(&["sample", &picture, "--spacing", "10", "--output", &output]);
    assert!(run.out.contains("10.0 px (set)"), "{}", run.out);
    assert!(!run.err.contains("too close"), "{}", run.err);
}

#[test]
fn marks_of_another_picture_are_used_with_a_warning() {
    let folder = Folder::new();
    let picture = folder.strokes();
    let marks = folder.write("marks.toml", MARKS.replace("strokes.png", "else/orchard.jpg"));
    let output = folder.file("s.exr");
    let run = done(&["sample", &picture, "--marks", &marks, "--output", &output]);
    assert!(run.err.contains("marks the picture orchard.jpg, not strokes.png"), "{}", run.err);
}
