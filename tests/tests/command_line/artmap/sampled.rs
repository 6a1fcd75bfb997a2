//! `impasto artmap sample` of pictures by marks and of paintings that impasto made, marks that it writes
//! with `--propose`, and its refusals with exit status, place and a way out.

use graphics::export::png8;
use graphics::field::Field;
use serde_json::{Value, json};
use suite::program::impasto;

use super::{Folder, MARKS, artmap, done};

#[track_caller]
fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

#[test]
fn marked_samples_are_upright_of_one_spacing_and_dark_to_light() {
    let folder = Folder::new();
    let picture = folder.strokes();
    let marks = folder.write("marks.toml", MARKS);
    let [output, sheet, marked] = ["s.exr", "s.png", "m.png"].map(|name| folder.file(name));
    let arguments = ["sample", &picture, "--marks", &marks, "--output", &output];
    let run = done(&[&arguments[..], &["--sheet", &sheet, "--marked", &marked, "--json"]].concat());
    let json = run.json();
    assert_eq!(
        (&json["provenance"], &json["pigments"]),
        (&json!("picture strokes.png"), &json!([]))
    );
    let [shade, wall] = [&json["samples"][0], &json["samples"][1]];
    assert_eq!((&shade["name"], &wall["name"]), (&json!("shade"), &json!("wall")));
    assert!(number(&shade["lightness"]) + 20.0 < number(&wall["lightness"]), "{json}");
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
    assert!(number(&wall["sharpness"]) > 0.5 && shade["sharpness"].is_null(), "{json}");
    // The set has the smaller spacing of the two.
    assert_eq!((number(&json["spacing"]), number(&shade["scale"][0])), (8.0, 1.0));
    assert!((number(&wall["scale"][0]) - 0.8).abs() < 0.04, "{wall}");
    assert_eq!(shade["bounds"], json!([106, 6, 88, 108]));
    assert_eq!((&shade["pixels"], &shade["regions_under"]), (&json!(88 * 108), &json!(0)));
    // The wall is half of the picture.
    let [left, _, width, height] = [0, 1, 2, 3].map(|i| number(&wall["bounds"][i]));
    assert!(left < 3.0 && (90.0..=106.0).contains(&width) && height > 112.0, "{wall}");

    let shown = done(&["show", &output, "--json"]).json();
    assert_eq!((&shown["provenance"], &shown["spacing"]), (&json["provenance"], &json["spacing"]));
    for (shown, printed) in [(&shown["samples"][0], shade), (&shown["samples"][1], wall)] {
        for key in ["name", "size", "texels", "colour", "mm_per_texel", "height_mm"] {
            assert_eq!(shown[key], printed[key], "{key}");
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
    let json = done(&["show", &output, "--json"]).json();
    for sample in json["samples"].as_array().unwrap() {
        assert_eq!(sample["guessed_relief"], json!(true), "{json}");
        let greatest = number(&sample["height_mm"]["greatest"]);
        assert!((0.15..=0.2001).contains(&greatest), "{json}");
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
    let [first, second] = ["a.exr", "b.exr"].map(|name| {
        let output = folder.file(name);
        let sheet = folder.file(&format!("{name}.png"));
        let arguments = ["sample", &picture, "--marks", &marks, "--density", "width"];
        let more = ["--over", "mean-shift", "--output", &output, "--sheet", &sheet];
        done(&[arguments, more].concat())
    });
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
    let json = done(&["sample", &picture, "--marks", &marks, "--output", &output, "--json"]).json();
    let names = [0, 1].map(|index| json["samples"][index]["name"].clone());
    assert_eq!(names, [json!("#0000ff"), json!("#ff0000")]);
    assert!(number(&json["samples"][0]["regions_under"]) >= 1.0, "{json}");
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

/// Pigments of the crowded painting. This is one more than a table of samples holds.
const NINE: [&str; 9] = [
    "Zinc White",
    "Lead White",
    "Chrome Yellow",
    "Vermilion",
    "Minium",
    "Cobalt Blue",
    "Ultramarine",
    "Viridian",
    "Bone Black",
];

impl Folder {
    /// A painting of 80 x 60 cells with upright strokes 4 mm (8 cells) apart in two pigments. If it
    /// is `crowded`, there are touches of seven more below.
    fn painting(&self, crowded: bool) -> String {
        fn load(pigment: &str, mm: f64) -> Value {
            json!({"load": {"brush": "flat", "recipe": {pigment: 1}, "amount_mm": mm}})
        }
        fn stroke(samples: Value) -> Value {
            json!({"stroke": {"brush": "flat", "samples": samples}})
        }
        let wash = json!({"wash": {"brush": "flat"}});
        let mut actions: Vec<Value> = Vec::new();
        for (index, pigment) in NINE[2..].iter().enumerate().filter(|_| crowded) {
            let at = 5.0 + 4.0 * index as f64;
            actions.extend([load(pigment, 0.1), stroke(json!([[0, at, 5, 0.6]])), wash.clone()]);
            if index == 5 {
                actions
                    .extend([json!({"dry": {}}), json!({"palette": [NINE[0], NINE[1], NINE[8]]})]);
            }
        }
        for (index, pigment) in NINE[..2].iter().cycle().take(9).enumerate() {
            let x = 4.0 + 4.0 * index as f64;
            actions.push(load(pigment, 0.4));
            actions.push(stroke(json!([[0, x, 2, 0.6], [1, x, 28, 0.6]])));
            actions.push(wash.clone());
        }
        let palette = if crowded { &NINE[..8] } else { &NINE[..2] };
        let script = json!({
            "format": "strokes", "version": 1, "title": "rows",
            "canvas": {"width_mm": 40, "height_mm": 30, "cell_mm": 0.5},
            "palette": palette,
            "brushes": {"flat": {"shape": "flat", "size_mm": 3}},
            "actions": actions,
        });
        let script = self.write("p.json", script.to_string());
        let painting = self.file("p.exr");
        let run = impasto(&["paint", &script, "--backend", "cpu", "--output", &painting]);
        assert_eq!(run.status, 0, "{}", run.err);
        painting
    }
}

#[test]
fn samples_of_a_painting_carry_its_pigments_and_relief() {
    let folder = Folder::new();
    let painting = folder.painting(false);
    let output = folder.file("s.exr");
    let run = ["sample", &painting, "--spacing", "8", "--output", &output, "--json"];
    let json = done(&run).json();
    assert_eq!(json["pigments"], json!(["Zinc White", "Lead White"]));
    assert_eq!(json["provenance"], "painting `rows`");
    let whole = &json["samples"][0];
    assert_eq!((&whole["name"], &whole["spacing_source"]), (&json!("p"), &json!("set")));
    assert_eq!((&whole["mm_per_texel"], &whole["guessed_relief"]), (&json!(0.5), &json!(false)));
    let degrees = whole["direction"]["degrees"].as_f64().unwrap();
    assert!((degrees - 90.0).abs() < 3.0, "{degrees}");
    let seen = whole["direction"]["seen_in"].as_str();
    assert!([Some("colour"), Some("relief")].contains(&seen), "{seen:?}");

    // Marks on a painting are in cells.
    let marks = folder.write(
        "m.toml",
        "[[sample]]\nname = \"half\"\nrectangle = [0, 0, 40, 60]\nspacing = [[4, 9], [12, 9]]\n",
    );
    let sheet = folder.file("s.png");
    let run = ["sample", &painting, "--marks", &marks, "--output", &output, "--sheet", &sheet];
    let json = done(&[&run[..], &["--json"]].concat()).json();
    let half = &json["samples"][0];
    assert_eq!(half["bounds"], json!([0, 0, 40, 60]));
    let [mean, most] = ["mean", "greatest"].map(|of| half["height_mm"][of].as_f64().unwrap());
    assert!(0.01 < mean && mean < most, "{mean} {most}");
    let shown = done(&["show", &output]).out;
    assert!(shown.contains("strokes 8.0 texels (4 mm) apart; Zinc White, Lead White"), "{shown}");
}

#[test]
fn more_than_eight_pigments_are_refused_unless_minor_ones_are_merged() {
    let folder = Folder::new();
    let painting = folder.painting(true);
    let output = folder.file("s.exr");
    let run = ["sample", &painting, "--spacing", "8", "--output", &output];
    let refused = artmap(&run);
    assert_eq!(refused.status, 1, "{}", refused.err);
    assert!(refused.err.contains("9 pigments, samples hold 8"), "{}", refused.err);
    assert!(refused.err.contains("--merge-minor"), "{}", refused.err);
    assert!(!folder.names().contains(&"s.exr".to_owned()), "nothing was written");
    let merged = done(&[&run[..], &["--merge-minor", "--json"]].concat());
    assert!(merged.err.contains(" is below 1 % of the pigment and counts as "), "{}", merged.err);
    let json = merged.json();
    assert!(json["pigments"].as_array().unwrap().len() <= 8, "{json}");
}

#[test]
fn files_that_hold_no_painting_are_refused() {
    let folder = Folder::new();
    let painting = folder.painting(false);
    let output = folder.file("s.exr");
    done(&["sample", &painting, "--spacing", "8", "--output", &output]);
    let again = folder.file("again.exr");
    let run = artmap(&["sample", &output, "--output", &again]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("s.exr: not a painting of impasto"), "{}", run.err);
    let run = artmap(&["show", &painting]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("p.exr: no samples of impasto"), "{}", run.err);
    let bytes = folder.bytes("s.exr");
    let cut = folder.write("cut.exr", &bytes[..bytes.len() / 2]);
    let run = artmap(&["show", &cut]);
    assert!(run.status == 1 && run.err.contains("cut.exr: "), "{}", run.err);
    assert!(run.err.contains("hint: "), "{}", run.err);
    let at = bytes.windows(11).position(|part| part == b"\"version\":1").unwrap();
    let mut later = bytes;
    later[at + 10] = b'7';
    let run = artmap(&["show", &folder.write("later.exr", later)]);
    assert!(run.status == 1 && run.err.contains("samples of version `7`"), "{}", run.err);
}

#[test]
fn proposed_marks_can_be_sampled() {
    let folder = Folder::new();
    let picture = folder.strokes();
    let [marks, marked, output] = ["m.toml", "m.png", "s.exr"].map(|name| folder.file(name));
    let run =
        done(&["sample", &picture, "--propose", "2", "--output", &marks, "--marked", &marked]);
    assert!(run.out.contains("2 proposed samples"), "{}", run.out);
    assert!(run.out.contains("orange") && run.out.contains("sky blue"), "{}", run.out);
    assert!(run.err.contains("--marks"), "the next command: {}", run.err);
    let text = String::from_utf8(folder.bytes("m.toml")).unwrap();
    assert!(text.starts_with("# Marks of samples"), "{text}");
    assert!(text.contains("painting = \"strokes.png\""), "{text}");
    let json = done(&["sample", &picture, "--marks", &marks, "--output", &output, "--json"]).json();
    let samples = json["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 2, "{json}");
    // One scribble lies on each side.
    let left = [0, 1].map(|index: usize| samples[index]["bounds"][0].as_f64().unwrap());
    assert!(left[0] > 80.0 && left[1] < 10.0, "{json}");
    assert!(image::open(&marked).unwrap().width() == 200, "the picture with its marks");
    let json = done(&["sample", &picture, "--propose", "2", "--output", &marks, "--json"]).json();
    assert_eq!(json["samples"].as_array().unwrap().len(), 2, "{json}");
    assert_eq!(json["without_spacing"], serde_json::json!([]));
}

#[test]
fn passages_whose_spacing_must_be_marked_are_told() {
    let folder = Folder::new();
    // Blotches of 5 px without any order.
    let colors = (0..200 * 120).map(|i| {
        let column = i % 200 / 5;
        let row = i / 200 / 5;
        let mixed = (column * 7919 + row * 104_729) as u32;
        let mixed = (mixed ^ (mixed >> 7)).wrapping_mul(0x9E37_79B1) >> 24;
        let grey = 0.3 + 0.1 * mixed as f32 / 255.0;
        [grey, grey, grey, 1.0]
    });
    let picture = Field::from_values(200, 120, colors.collect());
    let picture = folder.write("blotches.png", png8(&picture, 1.0).unwrap().bytes);
    let marks = folder.file("m.toml");
    let run = done(&["sample", &picture, "--propose", "1", "--output", &marks]);
    assert!(run.err.contains("cannot be seen in passage 1: mark their spacing"), "{}", run.err);
}

#[test]
fn fewer_passages_than_asked_for_are_told() {
    let folder = Folder::new();
    let picture = folder.strokes();
    let marks = folder.file("m.toml");
    let run = done(&["sample", &picture, "--propose", "60", "--output", &marks]);
    assert!(run.err.contains("only "), "{}", run.err);
}

#[test]
fn proposals_go_to_a_file_of_marks() {
    let folder = Folder::new();
    let picture = folder.strokes();
    let output = folder.file("s.exr");
    let run = artmap(&["sample", &picture, "--propose", "2", "--output", &output]);
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("s.exr: expected a file name that ends in .toml"), "{}", run.err);
    assert_eq!(folder.names(), ["strokes.png"]);
}

#[test]
fn bad_marks_name_file_sample_and_way_out_and_leave_no_files() {
    let folder = Folder::new();
    let picture = folder.strokes();
    let output = folder.write("s.exr", "mine");
    let scribble = "scribble = [[20, 30], [70, 90]]";
    let rectangle = "rectangle = [106, 6, 88, 108]";
    for (from, to, words) in [
        (
            scribble,
            "scribble = [[20, 30], [70, 300]]",
            &[
                "sample `wall`, scribble: [70, 300] lies off the picture of 200 x 120",
                "[column, row]",
            ][..],
        ),
        (
            rectangle,
            "scribble = [[20, 80], [70, 40]]",
            &["sample `shade`, scribble: crosses the line of sample `wall` at", "shorten"],
        ),
        (rectangle, "rectangle = [106, 6, 88, 208]", &["sample `shade`, rectangle", "lies off"]),
        (
            "spacing",
            "spaceing",
            &["line 10: [[sample]] 2, spaceing: unknown key", "did you mean spacing?"],
        ),
        (
            "[150, 68]]",
            "[150, 60]]",
            &["sample `shade`, spacing: both points", "leave spacing out"],
        ),
        (
            "[150, 68]]",
            "[150, 110]]",
            &["sample `shade` is", "less than four times", "mark a wider"],
        ),
        ("\"shade\"", "\"wall\"", &["sample `wall`, name: another sample"]),
        (MARKS, "painting = \"x.png\"", &["there are no samples", "--propose"]),
    ] {
        assert!(MARKS.contains(from), "`{from}` is in the marks");
        let marks = folder.write("marks.toml", MARKS.replace(from, to));
        let run = artmap(&["sample", &picture, "--marks", &marks, "--output", &output]);
        assert_eq!(run.status, 1, "{to}: {}", run.err);
        assert!(run.out.is_empty() && run.err.contains("hint: "), "{to}: {}", run.err);
        for word in words {
            assert!(run.err.contains(word), "{to}: `{word}` is not in {}", run.err);
        }
    }
    assert_eq!(folder.bytes("s.exr"), b"mine", "the file that was there stays");
    let run = artmap(&["sample", "none.png", "--output", &output]);
    assert_ne!(run.status, 0, "{}", run.out);
    assert!(run.err.contains("none.png"), "{}", run.err);
}

#[test]
fn flat_colors_show_no_strokes() {
    let folder = Folder::new();
    let flat = Field::filled(60, 40, [0.3, 0.3, 0.3, 1.0]);
    let picture = folder.write("flat.png", png8(&flat, 1.0).unwrap().bytes);
    let output = folder.file("s.exr");
    let run = artmap(&["sample", &picture, "--output", &output]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("the distance between strokes cannot be seen in flat"), "{}", run.err);
    let hint =
        "spacing = [[x, y], [x, y]], or give one distance in pixels for all samples with --spacing";
    assert!(run.err.contains(hint), "{}", run.err);
    let marks = folder.file("m.toml");
    let run = artmap(&["sample", &picture, "--propose", "3", "--output", &marks]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("no passage of the picture has strokes"), "{}", run.err);
    assert_eq!(folder.names(), ["flat.png"]);
}

#[test]
fn wrong_settings_and_files_could_not_run() {
    let folder = Folder::new();
    let picture = folder.strokes();
    let marks = folder.write("marks.toml", MARKS);
    let output = folder.file("s.exr");
    let sample = ["sample", &picture, "--output", &output];
    for (arguments, words) in [
        (
            [&sample[..], &["--marks", &marks, "--reach", "11"]].concat(),
            "reach takes 0 to 10, found `11`",
        ),
        ([&sample[..], &["--spacing", "0"]].concat(), "spacing takes 1 to 1000, found `0`"),
        ([&sample[..], &["--marks", &marks, "--propose", "3"]].concat(), "cannot be used with"),
        ([&sample[..], &["--propose", "0"]].concat(), "0 is not in 1..=64"),
        ([&sample[..], &["--over", "jpeg"]].concat(), "jseg, mean-shift"),
        ([&sample[..], &["--marks", "none.toml"]].concat(), "none.toml: cannot be read"),
        ([&sample[..], &["--sheet", &picture]].concat(), "is an input file"),
        ([&sample[..], &["--sheet", &output]].concat(), "two outputs have this file name"),
        ([&sample[..], &["--marked", &output]].concat(), "two outputs have this file name"),
        (vec!["sample", &picture, "--output", "s.png"], "expected a file name that ends in .exr"),
        (vec!["sample", &picture], "--output"),
        (vec!["show", "none.exr"], "none.exr: cannot be read"),
    ] {
        let run = artmap(&arguments);
        assert_eq!(run.status, 2, "{arguments:?}: {}", run.err);
        assert!(run.err.contains(words), "{arguments:?}: `{words}` is not in {}", run.err);
    }
    assert_eq!(folder.names(), ["marks.toml", "strokes.png"], "nothing was written");
}
