//! The command `impasto artmap`: `build`, `check` and `show` for maps of samples, and `paint`,
//! which paints samples.

mod sampled;

use graphics::export::png8;
use graphics::field::Field;
use serde_json::json;
use suite::program::{Run, impasto, repository};
use tempfile::TempDir;

struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// Path of a file in the folder. It need not exist.
    fn file(&self, name: &str) -> String {
        self.0.path().join(name).display().to_string()
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) -> String {
        std::fs::write(self.0.path().join(name), content).unwrap();
        self.file(name)
    }

    fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.0.path().join(name)).unwrap()
    }

    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<_> = names.collect();
        names.sort();
        names
    }

    /// A picture of 200 x 120 pixels. Left of x = 100 there are light strokes at 60 degrees, 10 px
    /// apart, and right of it dark ones at 120 degrees, 8 px apart.
    fn strokes(&self) -> String {
        let colors = (0..200 * 120).map(|i| {
            let x = (i % 200) as f32;
            let y = (i / 200) as f32;
            let (degrees, spacing, grey) =
                if x < 100.0 { (60.0_f32, 10.0, 0.5) } else { (120.0, 8.0, 0.1) };
            let (sin, cos) = degrees.to_radians().sin_cos();
            let across = (y * cos - x * sin) / spacing;
            let light = 1.0 + 0.2 * (std::f32::consts::TAU * across).cos();
            let [r, g, b] = [1.0, 0.9, 0.7].map(|channel| channel * grey * light);
            [r, g, b, 1.0]
        });
        let picture = Field::from_values(200, 120, colors.collect());
        self.write("strokes.png", png8(&picture, 1.0).unwrap().bytes)
    }
}

/// Marks on the picture of [`Folder::strokes`].
const MARKS: &str = r#"painting = "strokes.png"

[[sample]]
name = "wall"
scribble = [[20, 30], [70, 90]]

[[sample]]
name = "shade"
rectangle = [106, 6, 88, 108]
spacing = [[150, 60], [150, 68]]
"#;

fn artmap(arguments: &[&str]) -> Run {
    impasto(&[&["artmap"], arguments].concat())
}

#[track_caller]
fn done(arguments: &[&str]) -> Run {
    let run = artmap(arguments);
    assert_eq!(run.status, 0, "{arguments:?}: {}", run.err);
    run
}

impl Folder {
    /// Samples of four spacings and more, painted in dabs with `tones` tones, in the file `name`.
    fn painted(&self, name: &str, tones: &str, seed: &str) -> String {
        let text = done(&["paint", "--show-style", "dabs"]).out;
        let small = text
            .replace("side_cells = 300", "side_cells = 64")
            .replace("cell_mm = 0.18", "cell_mm = 0.36");
        assert!(small.contains("= 64") && small.contains("= 0.36"), "{small}");
        let style = self.write("style.toml", small);
        let output = self.file(name);
        done(&["paint", "--style", &style, "--tones", tones, "--seed", seed, "--output", &output]);
        output
    }
}

#[test]
fn a_map_has_a_tile_of_every_sample_that_agrees_with_the_first() {
    let folder = Folder::new();
    let samples = folder.painted("s.exr", "3", "1");
    let [map, sheet] = ["m.exr", "m.png"].map(|name| folder.file(name));
    let build = ["build", &samples, "--size", "64", "--output", &map];
    let json = done(&[&build[..], &["--sheet", &sheet, "--json"]].concat()).json();
    let tiles = json["tiles"].as_array().unwrap();
    assert_eq!((tiles.len(), json["size"].as_u64()), (3, Some(64)), "{json}");
    let lightness: Vec<f64> =
        tiles.iter().map(|tile| tile["lightness"].as_f64().unwrap()).collect();
    assert!(lightness[0] + 5.0 < lightness[1], "{json}");
    assert!(lightness[1] + 5.0 < lightness[2], "{json}");
    for tile in tiles {
        let coherence = tile["coherence"].as_f64().unwrap();
        assert!(coherence >= 0.8, "painted with the same strokes: {json}");
        assert!(tile["stroke_length"].as_f64().unwrap() > 1.0, "{json}");
    }
    assert!(json["pigments"].as_array().unwrap().len() >= 3, "{json}");
    assert_eq!(
        done(&["show", &map, "--json"]).json(),
        json,
        "the file holds everything that was printed"
    );
    // Tiles, three rows of tones in between, repeats and relief, with 12 pixels around each tile of
    // 64.
    let sheet = image::open(&sheet).unwrap();
    assert_eq!((sheet.width(), sheet.height()), (12 + 3 * 76, 12 + 6 * 76));

    let run = artmap(&["check", &map, "--json"]);
    let faults = run.json()["faults"].as_array().unwrap().len();
    assert_eq!(run.status, u8::from(faults > 0), "{}", run.err);

    let again = folder.file("again.exr");
    let human = done(&["build", &samples, "--size", "64", "--output", &again]).out;
    assert!(human.contains("3 tiles of 64 x 64 texels") && human.contains("(first)"), "{human}");
    assert!(folder.bytes("m.exr") == folder.bytes("again.exr"), "the same bytes");
    done(&["build", &samples, "--size", "64", "--seed", "5", "--output", &again]);
    assert!(folder.bytes("m.exr") != folder.bytes("again.exr"), "another seed");
}

#[test]
fn steps_of_a_map_are_pictures_in_order() {
    let folder = Folder::new();
    let samples = folder.painted("s.exr", "2", "1");
    let map = folder.file("m.exr");
    let stages = folder.file("stages");
    let build = ["build", &samples, "--size", "64", "--output", &map];
    done(&build);
    let plain = folder.bytes("m.exr");
    done(&[&build[..], &["--stages", &stages]].concat());
    assert!(folder.bytes("m.exr") == plain, "the same map");
    let names = std::fs::read_dir(&stages).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<String> = names.map(|name| name.into_string().unwrap()).collect();
    names.sort();
    let steps: Vec<&str> = names.iter().map(|name| &name[3..]).collect();
    assert_eq!(names[0], "01-sample-1.png");
    assert_eq!(steps[..4], ["sample-1.png", "sample-2.png", "features-1.png", "features-2.png"]);
    assert!(steps[4].starts_with("links-1-level-1"), "{names:?}");
    let last = format!("{stages}/{}", names[names.len() - 1]);
    assert!(last.contains("map-2-level-"), "{names:?}");
    let last = image::open(last).unwrap();
    assert_eq!((last.width(), last.height()), (64, 64));
    // There is a file instead of the folder.
    let run = artmap(&[&build[..], &["--stages", &samples]].concat());
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("this folder cannot be created"), "{}", run.err);
}

#[test]
fn samples_of_several_files_make_one_map_and_faults_are_told() {
    let folder = Folder::new();
    let samples = folder.painted("s.exr", "2", "1");
    let map = folder.file("m.exr");
    // The same samples twice make two pairs of equal tones.
    done(&["build", &samples, &samples, "--size", "64", "--output", &map]);
    let run = artmap(&["check", &map]);
    assert_eq!(run.status, 1, "{}", run.out);
    assert!(
        run.out.contains("fault: tones of `tone 1` and `tone 1 (2)` rise by 0.0"),
        "{}",
        run.out
    );
    for words in ["m.exr: the map has faults", "hint: leave one of the two samples out"] {
        assert!(run.err.contains(words), "`{words}` is not in {}", run.err);
    }
}

#[test]
fn maps_that_cannot_be_made_are_refused_and_nothing_is_written() {
    let folder = Folder::new();
    let samples = folder.painted("s.exr", "2", "1");
    let map = folder.file("m.exr");
    let damaged = folder.write("damaged.exr", &folder.bytes("s.exr")[..4000]);
    let files = folder.names();
    for (status, inputs, words) in [
        (2, &[samples.as_str(), "--size", "32"][..], &["`size` is 32", "change --size"][..]),
        (2, &[&samples, "--first", "x"], &["no sample is called `x`", "there are tone 1, tone 2"]),
        (2, &[&samples, "--follow", "99"], &["`follow` is 99", "0 to 16"]),
        (1, &[&damaged], &["damaged.exr: not an intact OpenEXR file"]),
        (2, &["none.exr"], &["none.exr: cannot be read"]),
        (2, &[&samples, "--sheet", &map], &["two outputs have this file name"]),
    ] {
        let run = artmap(&[&["build", "--output", &map], inputs].concat());
        assert_eq!(run.status, status, "{inputs:?}: {}", run.err);
        for word in words {
            assert!(run.err.contains(word), "{inputs:?}: `{word}` is not in {}", run.err);
        }
    }
    assert_eq!(folder.names(), files, "nothing was written");
    let run = artmap(&["check", &samples]);
    assert!(run.status == 1 && run.err.contains("no art map of impasto"), "{}", run.err);
}

impl Folder {
    /// A style of dabs on a canvas of few large cells.
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
    let json = done(&[&arguments[..], &["--pigments", &oils, "--json"]].concat()).json();
    let samples = json["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 3);
    let lightness: Vec<f64> =
        samples.iter().map(|sample| sample["lightness"].as_f64().unwrap()).collect();
    assert!(lightness[0] + 5.0 < lightness[1] && lightness[1] + 5.0 < lightness[2], "{json}");
    for (index, sample) in samples.iter().enumerate() {
        assert_eq!(sample["name"], format!("tone {}", index + 1));
        assert_eq!((&sample["size"], &sample["mm_per_texel"]), (&json!([36, 36]), &json!(0.3)));
        let [mean, most] = ["mean", "greatest"].map(|of| sample["height_mm"][of].as_f64().unwrap());
        assert!(0.02 < mean && mean < most && most < 5.0, "{mean} {most}");
    }
    let pigments: Vec<&str> =
        json["pigments"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    assert!(pigments.len() >= 3 && pigments.contains(&"Zinc White"), "{pigments:?}");
    assert_eq!(
        done(&["show", &output, "--json"]).json(),
        json,
        "the file holds everything that was printed"
    );
    // Colours are above, relief is below.
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
        (
            &["--style", &wide],
            &["wide.toml, style small dabs: strokes.jitter is 0 to 1, found `70.5`"],
        ),
        (&["--style", &style, "--hue", "mud"], &["found `mud`"]),
        (&["--style", &style, "--tones", "1"], &["2 to 12 tones, found `1`", "leave --tones out"]),
        (&["--style", &style, "--tones", "13"], &["found `13`"]),
        (&["--style", &style, "--pigments", "none.json"], &["none.json: cannot be read"]),
        (&["--style", &style, "--sheet", &output], &["two outputs have this file name"]),
        (&["--style", &style, "--sheet", "s.jpg"], &["ends in .png or .exr", "try s.png"]),
    ] {
        let run = artmap(&[&["paint", "--output", &output], more].concat());
        // A fault in a file is one of the data.
        let is_of_file = [&odd, &wide].iter().any(|file| more.contains(&file.as_str()));
        assert_eq!(run.status, if is_of_file { 1 } else { 2 }, "{more:?}: {}", run.err);
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
    let run =
        impasto(&["library", "subset", &oils, "Zinc White", "Lead White", "--output", &white]);
    assert_eq!(run.status, 0, "{}", run.err);
    let output = folder.file("s.exr");
    let run = artmap(&["paint", "--style", &style, "--pigments", &white, "--output", &output]);
    assert_ne!(run.status, 0, "{}", run.out);
    assert!(run.err.contains("error: ") && run.err.contains("hint: "), "{}", run.err);
    assert!(!folder.names().contains(&"s.exr".to_owned()), "nothing was written");
}
