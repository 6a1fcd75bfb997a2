//! Refusals of `impasto artmap sample`: exit status, place and way out.

use graphics::export::png8;
use graphics::field::Field;

use super::{Folder, MARKS, artmap};

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
    assert!(run.err.contains("the distance of strokes cannot be seen in flat"), "{}", run.err);
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
