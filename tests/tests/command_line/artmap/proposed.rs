//! Marks that `impasto artmap sample --propose` writes.

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
}

#[test]
fn fewer_passages_than_asked_for_are_told() {
    let folder = Folder::new();
    let (picture, marks) = (folder.strokes(), folder.file("m.toml"));
    let run = done(&["sample", &picture, "--propose", "60", "--output", &marks]);
    assert!(run.err.contains("only "), "{}", run.err);
}

#[test]
fn proposals_go_to_a_file_of_marks() {
    let folder = Folder::new();
    let (picture, output) = (folder.strokes(), folder.file("s.exr"));
    let run = artmap(&["sample", &picture, "--propose", "2", "--output", &output]);
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("s.exr: expected a file name that ends in .toml"), "{}", run.err);
    assert_eq!(folder.names(), ["strokes.png"]);
}
