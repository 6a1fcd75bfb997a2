//! `impasto artmap build`, `check` and `show`: maps of samples.

use super::{Folder, artmap, done};

impl Folder {
    /// Samples of four spacings and more, painted in dabs: `name` with `tones` tones.
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
    let told = done(&[&build[..], &["--sheet", &sheet, "--json"]].concat()).json();
    let tiles = told["tiles"].as_array().unwrap();
    assert_eq!((tiles.len(), told["size"].as_u64()), (3, Some(64)), "{told}");
    let number = |index: usize, key: &str| tiles[index][key].as_f64().unwrap();
    assert!(number(0, "lightness") + 5.0 < number(1, "lightness"), "{told}");
    assert!(number(1, "lightness") + 5.0 < number(2, "lightness"), "{told}");
    for index in 0..3 {
        assert!(number(index, "coherence") >= 0.8, "painted with the same strokes: {told}");
        assert!(number(index, "stroke_length") > 1.0, "{told}");
    }
    assert!(told["pigments"].as_array().unwrap().len() >= 3, "{told}");
    assert_eq!(done(&["show", &map, "--json"]).json(), told, "the file holds all that was told");
    // Tiles, three rows of tones between, repeats, relief; 12 pixels around each tile of 64.
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
    // A file in the place of the folder.
    let run = artmap(&[&build[..], &["--stages", &samples]].concat());
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("this folder cannot be created"), "{}", run.err);
}

#[test]
fn samples_of_several_files_make_one_map_and_faults_are_told() {
    let folder = Folder::new();
    let samples = folder.painted("s.exr", "2", "1");
    let map = folder.file("m.exr");
    // The same samples twice: two pairs of equal tones.
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
