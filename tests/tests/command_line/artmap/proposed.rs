//! Marks that `impasto artmap sample --propose` writes.

use graphics::export::png8;
use graphics::field::Field;

use super::{Folder, artmap, done};

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
    let told = done(&["sample", &picture, "--marks", &marks, "--output", &output, "--json"]).json();
    let samples = told["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 2, "{told}");
    // One scribble lies on each side.
    let left = |index: usize| samples[index]["bounds"][0].as_f64().unwrap();
    assert!(left(0) > 80.0 && left(1) < 10.0, "{told}");
    assert!(image::open(&marked).unwrap().width() == 200, "the picture with its marks");
    let told = done(&["sample", &picture, "--propose", "2", "--output", &marks, "--json"]).json();
    assert_eq!(told["samples"].as_array().unwrap().len(), 2, "{told}");
    assert_eq!(told["without_spacing"], serde_json::json!([]));
}

#[test]
fn passages_whose_spacing_must_be_marked_are_told() {
    let folder = Folder::new();
    // Blotches of 5 px without any order.
    let color = |i: usize| {
        let column = i % 200 / 5;
        let row = i / 200 / 5;
        let mixed = (column * 7919 + row * 104_729) as u32;
        let mixed = (mixed ^ (mixed >> 7)).wrapping_mul(0x9E37_79B1) >> 24;
        let grey = 0.3 + 0.1 * mixed as f32 / 255.0;
        [grey, grey, grey, 1.0]
    };
    let picture = Field::from_values(200, 120, (0..200 * 120).map(color).collect());
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
