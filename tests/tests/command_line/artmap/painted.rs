//! `impasto artmap paint`: samples painted by the engine.

use serde_json::json;
use suite::program::repository;

use super::{Folder, artmap, done};

impl Folder {
    /// A style of dabs on a canvas of few and large cells.
    fn small_style(&self) -> String {
        let text = done(&["paint", "--show-style", "dabs"]).out;
        let small = text
            .replace("name = \"dabs\"", "name = \"small dabs\"")
            .replace("side_cells = 300", "side_cells = 36")
            .replace("cell_mm = 0.18", "cell_mm = 0.3");
        let changed = ["small dabs", "= 36", "= 0.3"].iter().all(|word| small.contains(word));
        assert!(changed, "{small}");
        self.write("small.toml", small)
    }
}

#[test]
fn tones_are_painted_in_the_pigments_of_a_library_and_shown_again() {
    let folder = Folder::new();
    let style = folder.small_style();
    let [output, sheet] = ["s.exr", "s.png"].map(|name| folder.file(name));
    let oils = repository("measurements/van-gogh-oils.pigments.json");
    let arguments =
        ["paint", "--style", &style, "--tones", "3", "--output", &output, "--sheet", &sheet];
    let told = done(&[&arguments[..], &["--pigments", &oils, "--json"]].concat()).json();
    let samples = told["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 3);
    let lightness = |index: usize| samples[index]["lightness"].as_f64().unwrap();
    assert!(lightness(0) + 5.0 < lightness(1) && lightness(1) + 5.0 < lightness(2), "{told}");
    for (index, sample) in samples.iter().enumerate() {
        assert_eq!(sample["name"], format!("tone {}", index + 1));
        assert_eq!((&sample["size"], &sample["mm_per_texel"]), (&json!([36, 36]), &json!(0.3)));
        let [mean, most] = ["mean", "greatest"].map(|of| sample["height_mm"][of].as_f64().unwrap());
        assert!(0.02 < mean && mean < most && most < 5.0, "{mean} {most}");
    }
    let pigments: Vec<&str> =
        told["pigments"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    assert!(pigments.len() >= 3 && pigments.contains(&"Zinc White"), "{pigments:?}");
    assert_eq!(done(&["show", &output, "--json"]).json(), told, "the file holds all that was told");
    // Colours above, relief below.
    let sheet = image::open(&sheet).unwrap();
    let side = 8 * 36;
    assert_eq!((sheet.width(), sheet.height()), (48 + 3 * side + 32, 48 + 2 * side + 16));

    // The shipped oils are the default, and the same command gives the same bytes.
    let again = folder.file("again.exr");
    let human = done(&["paint", "--style", &style, "--tones", "3", "--output", &again]);
    assert!(human.out.contains("3 tones in the style small dabs"), "{}", human.out);
    assert!(folder.bytes("s.exr") == folder.bytes("again.exr"), "the same bytes");
    let run = ["paint", "--style", &style, "--tones", "3", "--seed", "9", "--output", &again];
    done(&run);
    assert!(folder.bytes("s.exr") != folder.bytes("again.exr"), "another seed");
}

#[test]
fn wrong_styles_hues_and_tones_are_refused_before_anything_is_written() {
    let folder = Folder::new();
    let style = folder.small_style();
    let text = String::from_utf8(folder.bytes("small.toml")).unwrap();
    let odd = folder.write("odd.toml", text.replace("jitter", "gitter"));
    let wide = folder.write("wide.toml", text.replace("jitter = ", "jitter = 7"));
    let output = folder.file("s.exr");
    let files = folder.names();
    for (more, words) in [
        (
            &["--style", "oils"][..],
            &["no style called `oils`", "hint: choose --style among oil-flat"][..],
        ),
        (&["--style", "none.toml"], &["none.toml: cannot be read"]),
        (&["--style", &odd], &["odd.toml, line ", "gitter", "--show-style oil-flat"]),
        (&["--style", &wide], &["strokes.jitter is 0 to 1, found `70.5`"]),
        (&["--style", &style, "--hue", "mud"], &["found `mud`"]),
        (&["--style", &style, "--tones", "1"], &["2 to 12 tones, found `1`", "leave --tones out"]),
        (&["--style", &style, "--tones", "13"], &["found `13`"]),
        (&["--style", &style, "--pigments", "none.json"], &["none.json: cannot be read"]),
        (&["--style", &style, "--sheet", &output], &["two outputs have this file name"]),
        (&["--style", &style, "--sheet", "s.jpg"], &["ends in .png or .exr", "try s.png"]),
    ] {
        let run = artmap(&[&["paint", "--output", &output], more].concat());
        assert_eq!(run.status, 2, "{more:?}: {}", run.err);
        for word in words {
            assert!(run.err.contains(word), "{more:?}: `{word}` is not in {}", run.err);
        }
    }
    assert_eq!(folder.names(), files, "nothing was written");
    let run = artmap(&["paint", "--style", "dabs"]);
    assert!(run.status == 2 && run.err.contains("--output"), "{}", run.err);
}

#[test]
fn a_library_of_few_pigments_is_refused_with_what_it_lacks() {
    let folder = Folder::new();
    let style = folder.small_style();
    let oils = repository("measurements/van-gogh-oils.pigments.json");
    let white = folder.file("white.json");
    let run = suite::program::impasto(&[
        "library",
        "subset",
        &oils,
        "Zinc White",
        "Lead White",
        "--output",
        &white,
    ]);
    assert_eq!(run.status, 0, "{}", run.err);
    let output = folder.file("s.exr");
    let run = artmap(&["paint", "--style", &style, "--pigments", &white, "--output", &output]);
    assert_ne!(run.status, 0, "{}", run.out);
    assert!(run.err.contains("error: ") && run.err.contains("hint: "), "{}", run.err);
    assert!(!folder.names().contains(&"s.exr".to_owned()), "nothing was written");
}
