//! Refusals by `impasto watercolor`: exit status, fault and hint, and no files written.

use std::path::Path;

use suite::program::{Run, impasto, repository};

use super::{Folder, watercolor};

#[track_caller]
fn refused(run: &Run, status: u8, what: &str, hint: &str) {
    let hint = format!("hint: {hint}");
    assert_eq!(run.status, status, "{what}: {}", run.err);
    assert!(run.err.contains(what), "no `{what}` in {}", run.err);
    assert!(run.err.contains(&hint), "no `{hint}` in {}", run.err);
    assert!(run.out.is_empty(), "{what}: {}", run.out);
}

/// Asserts exit status 2 and `what` in the error. Unlike [`refused`], this requires no hint.
#[track_caller]
fn misused(run: &Run, what: &str) {
    assert_eq!(run.status, 2, "{what}: {}", run.err);
    assert!(run.err.contains(what), "no `{what}` in {}", run.err);
}

#[test]
fn without_a_file_to_write_nothing_is_done() {
    let folder = Folder::new();
    let photo = folder.photograph();
    for options in [&[][..], &["--json"], &["--turntable", "4"], &["--preset", "sketch"]] {
        let run = watercolor(&photo, options);
        refused(&run, 2, "nothing would be written", "add --picture watercolor.png");
    }
    misused(&impasto(&["watercolor"]), "<SUBJECT>");
    misused(&impasto(&["watercolor", &photo, "--show-preset", "sketch"]), "cannot be used with");
}

#[test]
fn subjects_that_cannot_be_read() {
    let folder = Folder::new();
    let out = folder.file("out.png");
    let text = folder.write("text.png", "no picture");
    let stl = folder.write("model.stl", "solid");
    let broken = folder.write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    let photo = folder.photograph();
    for (subject, options, status, what, hint) in [
        (&folder.file("none.png"), &[][..], 2, "none.png", "check that the file"),
        (&folder.file("none.obj"), &[], 2, "none.obj", "check that the file"),
        (&text, &[], 1, "text.png: not a PNG, JPEG, TIFF or WebP picture", "save it as PNG"),
        (&stl, &[], 1, "model.stl: not a PNG, JPEG, TIFF or WebP picture", "save it as PNG"),
        (&stl, &["--turntable", "4"], 2, "model.stl is not a mesh", "names of meshes end in .obj"),
        (&broken, &[], 1, "broken.obj: line 4: no position `4`, there are 3", "correct that place"),
        (
            &"shape:cube".to_owned(),
            &[],
            2,
            "unknown shape `cube`",
            "shapes are still-life, village",
        ),
        (
            &"shape:still-lfe".to_owned(),
            &[],
            2,
            "unknown shape `still-lfe`",
            "did you mean still-life? shapes are",
        ),
        (
            &photo,
            &["--turntable", "4"],
            2,
            "--turntable applies to meshes only, and ",
            "names of meshes end in .obj",
        ),
        (
            &photo,
            &["--camera", "30,20"],
            2,
            "--camera applies to meshes only",
            "names of meshes end in .obj",
        ),
        (
            &photo,
            &["--height", "64"],
            2,
            "--height applies to meshes only",
            "names of meshes end in .obj",
        ),
    ] {
        refused(
            &watercolor(subject, &[&["--picture", &out], options].concat()),
            status,
            what,
            hint,
        );
        assert!(!Path::new(&out).exists(), "{what}: something was written");
    }
    let dot = folder.file("dot.png");
    image::RgbImage::new(15, 3).save(&dot).unwrap();
    let run = watercolor(&dot, &["--picture", &out]);
    refused(&run, 2, "dot.png: 15 x 3 pixels are too few", "give --width 16 or more");
    let narrow = folder.file("narrow.png");
    image::RgbImage::new(2, 200).save(&narrow).unwrap();
    let run = watercolor(&narrow, &["--width", "16384", "--picture", &out]);
    refused(&run, 2, "the picture would have 1638400 rows", "give a smaller --width");
    misused(&watercolor(&photo, &["--width", "15", "--picture", &out]), "16..=16384");
}

#[test]
fn looks_that_are_none() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let out = folder.file("out.png");
    let [key, range, color, torn, scan] = [
        ("key.toml", "[edges]\n# too much\nstronger = 1\n"),
        ("range.toml", "\n[edges]\nstrength = 99\n"),
        ("colour.toml", "[paper]\ncolour = \"red\"\n"),
        ("torn.toml", "[paper\n"),
        ("scan.toml", "[paper]\nscan = \"none.png\"\n"),
    ]
    .map(|(name, text)| folder.write(name, text));
    let none = folder.file("none.toml");
    for (option, value, status, what, hint) in [
        ("--settings", none.as_str(), 2, "none.toml: cannot be read", "check that the file"),
        (
            "--settings",
            &key,
            1,
            "key.toml, line 3: edges.stronger: unknown key `stronger`",
            "it takes the keys",
        ),
        (
            "--settings",
            &range,
            1,
            "range.toml, line 3: edges.strength takes 0 to 10, found `99`",
            "3 is usual",
        ),
        (
            "--settings",
            &color,
            1,
            "colour.toml, line 2: paper.colour takes a colour written #rrggbb, found `red`",
            "#fbf9f4 is usual",
        ),
        ("--settings", &torn, 1, "torn.toml, line 1: ", "a line of TOML"),
        ("--settings", &scan, 2, "none.png", "put this file where it is named"),
        (
            "--set",
            "edges.strength",
            2,
            "--set takes KEY=VALUE, found `edges.strength`",
            "try --set edges.strength=2",
        ),
        (
            "--set",
            "edges.strength=99",
            2,
            "--set edges.strength=99, line 1: edges.strength takes 0 to 10",
            "3 is usual",
        ),
        (
            "--set",
            "edges.strength=NaN",
            2,
            "edges.strength takes 0 to 10, found `NaN`",
            "3 is usual",
        ),
        (
            "--set",
            "edges.stronger=1",
            2,
            "--set edges.stronger=1, line 1: edges.stronger: unknown key `stronger`",
            "it takes the keys",
        ),
        ("--set", "edge.strength=1", 2, "unknown key `edge`", "did you mean edges?"),
        ("--set", "edges.strength=much", 2, "invalid type: text \"much\"", "3 is usual"),
        ("--set", "edges.strength=", 2, "invalid type: text \"\"", "3 is usual"),
        ("--set", "flow.seed=-1", 2, "--set flow.seed=-1, line 1: ", "1 is usual"),
        ("--set", "paper.kind=velvet", 2, "unknown word `velvet`", "it takes the words"),
        (
            "--set",
            "dry_brush.colour=blue",
            2,
            "dry_brush.colour takes a colour written #rrggbb, found `blue`",
            "#506a8c is usual",
        ),
        ("--set", "coherence.method=none", 2, "unknown word `none`", ""),
    ] {
        refused(&watercolor(&photo, &["--picture", &out, option, value]), status, what, hint);
        assert!(!Path::new(&out).exists(), "{what}: something was written");
    }
    let mesh = folder.pyramid();
    let run = watercolor(&mesh, &["--picture", &out, "--settings", &scan]);
    refused(&run, 2, "none.png", "put this file where it is named");
    for option in ["--preset", "--show-preset"] {
        let run = impasto(&["watercolor", option, "oil"]);
        misused(&run, "[possible values: portrait, landscape, sketch]");
    }
}

#[test]
fn cameras_that_see_nothing() {
    let folder = Folder::new();
    let mesh = folder.pyramid();
    let out = folder.file("out.png");
    let with =
        |options: &[&str]| watercolor(&mesh, &[&["--picture", &out, "--camera"], options].concat());
    for camera in
        ["30", "30,91", "30,-91", "30,20,0", "30,20,171", "1,2,3,4", "a,b", "", "NaN,20", "inf,1"]
    {
        let what = format!("or a .toml file, found `{camera}`");
        refused(&with(&[camera]), 2, &what, "try --camera 30,20");
    }
    let keyframe = "[[keyframe]]\neye = [0.0, 0.0, 9.0]\ntarget = [0.0, 0.0, 0.0]\n";
    let [torn, empty, none, shut, sound] = [
        ("torn.toml", "frames = 2\nframes = 3\n".to_owned()),
        ("empty.toml", "frames = 2\n".to_owned()),
        ("none.toml", format!("frames = 0\n{keyframe}")),
        ("shut.toml", format!("frames = 2\n{keyframe}field_of_view_deg = 0.0\n")),
        ("sound.toml", format!("frames = 2\n{keyframe}")),
    ]
    .map(|(name, text)| folder.write(name, text));
    let shape = "a path has `frames` and [[keyframe]] tables";
    refused(&with(&[&folder.file("missing.toml")]), 2, "missing.toml: ", "check that the file");
    refused(&with(&[&torn]), 1, "torn.toml, line 2: ", shape);
    refused(&with(&[&empty]), 1, "empty.toml: `keyframe`: 0, not 1 to", shape);
    refused(&with(&[&none]), 1, "none.toml: `frames`: 0, not 1 to", shape);
    refused(&with(&[&shut]), 1, "`keyframe 1: field_of_view_deg`: `0` is not", shape);
    let both = with(&[&sound, "--turntable", "4"]);
    refused(&both, 2, "--turntable and ", "leave one of them out");
    assert!(!Path::new(&out).exists());
}

#[test]
fn files_that_cannot_be_written() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let mesh = folder.pyramid();
    let out = folder.file("out.png");
    let [gif, mp4, jpg] = ["out.gif", "out.mp4", "out.jpg"].map(|name| folder.file(name));
    let turn = ["--width", "32", "--turntable", "3"];
    let turned = |options: &[&str]| watercolor(&mesh, &[&turn, options].concat());
    let moves = "add --turntable 60";
    refused(
        &watercolor(&photo, &["--animation", &gif]),
        2,
        "--animation and --frames need a mesh",
        moves,
    );
    refused(&watercolor(&mesh, &["--animation", &gif]), 2, "and a camera that moves", moves);
    refused(
        &turned(&["--animation", &mp4]),
        2,
        "expected an animation whose name ends in .gif, .png or .apng",
        "try ",
    );
    refused(
        &turned(&["--animation", &gif, "--rate", "0"]),
        2,
        "0.1 to 100 frames a second, found `0`",
        "25 is usual",
    );
    refused(
        &turned(&["--animation", &out, "--picture", &out]),
        2,
        "the picture and the animation have this file name",
        "give each its own file name",
    );
    refused(
        &watercolor(&photo, &["--picture", &jpg]),
        2,
        "expected a file name that ends in .png or .tif or .tiff or .exr",
        "try ",
    );
    refused(
        &watercolor(&photo, &["--picture", &photo]),
        2,
        "photo.png: is an input",
        "give the output",
    );
    misused(
        &watercolor(&photo, &["--picture", &folder.file("no/such.png")]),
        "such.png: cannot be written",
    );
    misused(&turned(&["--animation", &folder.file("no/such.gif")]), "such.gif: cannot be written");
    let taken = folder.write("taken", "a file");
    misused(&turned(&["--frames", &taken]), "taken");
    misused(&watercolor(&photo, &["--stages", &taken]), "taken: this folder cannot be created");
    assert_eq!(folder.names("."), ["photo.png", "pyramid.obj", "taken"]);

    // A mask is an input too. A subject in the folder of stages may not be overwritten.
    let mask = folder.mask();
    let run = watercolor(&photo, &["--density-mask", &mask, "--picture", &mask]);
    refused(&run, 2, "mask.png: is an input", "give the output");
    let before = std::fs::read(&photo).unwrap();
    std::fs::create_dir(folder.file("stages")).unwrap();
    let inside = folder.write("stages/02-regions.png", &before);
    let run = watercolor(&inside, &["--stages", &folder.file("stages")]);
    refused(&run, 2, "02-regions.png: is an input", "give the output");
    assert_eq!(folder.names("stages"), ["02-regions.png"], "no stage was written");
    assert!(std::fs::read(&inside).unwrap() == before);

    // Frames of unknown origin stay, and nothing else is written.
    std::fs::create_dir(folder.file("theirs")).unwrap();
    folder.write("theirs/frame-0002.png", "whose?");
    let run = turned(&["--frames", &folder.file("theirs"), "--picture", &out]);
    refused(&run, 2, "frame-0002.png: the folder holds frames", "name an empty folder");
    folder.write("theirs/animation.json", "{}");
    let run = turned(&["--frames", &folder.file("theirs"), "--picture", &out]);
    refused(&run, 2, "animation.json: missing field", "name an empty folder, or remove this one");
    assert_eq!(folder.names("theirs"), ["animation.json", "frame-0002.png"]);
    assert!(!Path::new(&out).exists(), "a picture was written beside");
}

#[test]
fn masks_and_pigments_where_they_do_not_belong() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let mesh = folder.pyramid();
    let out = folder.file("out.png");
    let exr = folder.file("out.exr");
    let stages = folder.file("stages");
    for option in ["--dry-brush-mask", "--density-mask"] {
        let run = watercolor(&mesh, &["--picture", &out, option, &folder.file("none.png")]);
        refused(&run, 2, "none.png", "check that the file");
        let run = watercolor(&photo, &["--picture", &out, option, &folder.file("none.png")]);
        refused(&run, 2, "none.png", "check that the file");
    }
    let folder_of_maps = folder.file("maps");
    for (option, value) in
        [("--output", &exr), ("--spectral", &exr), ("--pigment-maps", &folder_of_maps)]
    {
        let run = watercolor(&photo, &["--stages", &stages, option, value]);
        refused(&run, 2, &format!("{option} needs pigments"), "name a LIBRARY after the subject");
    }
    for (option, value) in [("--palette", "Vermilion"), ("--over", "0.9"), ("--illuminant", "A")] {
        misused(&watercolor(&photo, &["--picture", &out, option, value]), "<LIBRARY>");
    }
    let library = repository("measurements/van-gogh-oils.pigments.json");
    let with = |options: &[&str]| {
        watercolor(
            &photo,
            &[&["--picture", &out, "--stages", &stages, "--pigments", &library], options].concat(),
        )
    };
    refused(&with(&["--palette", "Vermilion,Mauvein"]), 1, "`Mauvein`", "");
    refused(
        &with(&["--palette", "Vermilion,Vermilion"]),
        2,
        "once, found `Vermilion` again",
        "leave the second out",
    );
    refused(&with(&["--over", "1.5"]), 2, "--over takes 0 to 1", "try --over 0.85");
    refused(&with(&["--illuminant", "D66x"]), 2, "D66x", "");
    let missing = folder.file("none.json");
    misused(
        &watercolor(&photo, &["--picture", &out, "--pigments", &missing]),
        "none.json: cannot be read",
    );
    let text = folder.write("text.json", "{}");
    let run = watercolor(&photo, &["--picture", &out, "--pigments", &text]);
    assert!(run.status == 1 && run.err.contains("text.json"), "{}", run.err);
    let left = folder.names(".");
    assert_eq!(left, ["photo.png", "pyramid.obj", "text.json"], "something was written");
}
