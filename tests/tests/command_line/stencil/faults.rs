//! Faulty input is refused before anything is written. The error names the place and the way out.

use std::path::Path;

use suite::program::{impasto, repository};

use super::{SMALL, done, folder, path, stencil};

/// A script over the box. Its last line is the 9th.
const SCRIPT: &str = "format = \"paint-volumes\"\nversion = 1\nsubject = \"box.obj\"\n\
    seconds = 0.5\ngrid.cell = 0.2\n[[pour]]\nat = [0.0, 1.0, 0.0]\nfor_s = 0.2\n\
    amount_mm3 = 20.0\n";

/// Runs the verb, checks status and words, and that `p.png` is not written.
#[track_caller]
fn refused(picture: &str, arguments: &[&str], status: u8, words: &[&str]) {
    let run = stencil(&[arguments, &["--picture", picture]].concat());
    assert_eq!(run.status, status, "{arguments:?}: {}{}", run.out, run.err);
    for word in words {
        assert!(run.err.contains(word), "{arguments:?}: `{word}` is not in {}", run.err);
    }
    let way_out = run.err.contains("hint: ") || run.err.contains("--help");
    assert!(way_out, "{arguments:?}: {}", run.err);
    assert!(!Path::new(picture).exists(), "{arguments:?} has written a picture");
}

#[test]
fn subjects_that_paint_cannot_lie_on_are_refused() {
    let folder = folder();
    let picture = path(&folder, "p.png");
    let points = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n\
        property float z\nend_header\n0 0 0\n1 0 0\n";
    for (name, text, status, words) in [
        ("points.ply", points, 1, &["points.ply", "no triangle", "points and lines"][..]),
        ("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", 1, &["line.obj", "has an area"]),
        ("dot.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", 1, &["dot.obj", "at one point"]),
        ("nan.obj", "v 0 0 0\nv nan 0 0\nv 1 0 1\nf 1 2 3\n", 1, &["nan.obj", "line 2", "`nan`"]),
        ("text.png", "no picture", 1, &["text.png", "not a PNG"]),
    ] {
        let file = path(&folder, name);
        std::fs::write(&file, text).unwrap();
        let scene = [&[&file[..]], &SMALL[..], &["--pour", "0.5,0.5"]].concat();
        refused(&picture, &scene, status, words);
    }
    let gone = path(&folder, "gone.obj");
    refused(&picture, &[&gone, "--pour", "0.5,0.5"], 2, &["gone.obj", "cannot be read"]);
    let cow = ["shape:cow", "--pour", "0.5,0.5"];
    refused(&picture, &cow, 1, &["`cow`", "shape:", "still-life"]);
}

#[test]
fn options_out_of_range_are_refused_by_their_names() {
    let folder = folder();
    let [picture, model] = ["p.png", "box.obj"].map(|name| path(&folder, name));
    let library = repository("measurements/van-gogh-oils.pigments.json");
    let pigments = ["--pigments", &library];
    let nine = "Ultramarine,Viridian,Minium,Vermilion,Bone Black,Lead White,Cobalt Blue,\
        Emerald Green,Prussian Blue";
    let gif = path(&folder, "a.gif");
    for (status, options, words) in [
        (2, &["--pour", "0.01,0.02", "--width", "64"][..], &[][..]),
        (1, &["--pour", "0.5,0.5", "--pour", "0.01,0.02"], &["--pour number 2", "0.010, 0.020"]),
        (2, &["--pour", "0.5"], &["X,Y,MM3", "`0.5`", "--pour 0.5,0.6"]),
        (2, &["--pour", "-0.1,0.5"], &["shares of 0 to 1", "`-0.1,0.5`"]),
        (2, &["--pour", "0.5,0.5", "--at", "-1"], &["--at takes 0 to", "`-1`"]),
        (2, &["--pour", "0.5,0.5", "--rate", "-5"], &["--rate", "0.1 to 100", "`-5`"]),
        (2, &["--pour", "0.5,0.5", "--stages", &model], &["box.obj is a file"]),
        (2, &["--pour", "0.5,0.5,-3"], &["more than 0 mm3", "`0.5,0.5,-3`"]),
        (2, &["--pour", "0.5,0.5", "--set", "grid.cell=0.00002"], &["grid.cell", "fits"]),
        (
            2,
            &["--pour", "0.5,0.5", "--set", "drawing.tint=[1, 0]"],
            &["drawing.tint", "rise from 0 to 1", "is even"],
        ),
        (2, &["--pour", "0.5,0.5", "--set", "gloss=1"], &["unknown key `gloss`"]),
        (2, &["--pour", "0.5,0.5", "--set", "gloss"], &["KEY=VALUE", "motion.microstructure"]),
        (2, &["--pour", "0.5,0.5", "--paint", "Ultramarine=1"], &["LIBRARY"]),
        (2, &["--pour", "0.5,0.5", "--ground", "paper"], &["LIBRARY"]),
        (2, &["--pour", "0.5,0.5", "--at", "9"], &["--at takes 0 to", "`9`", "--seconds"]),
        (2, &["--pour", "0.5,0.5", "--supersample", "2"], &["--supersample needs pigments"]),
        (2, &["--pour", "0.5,0.5", "--show", "everything"], &["everything", "hatching"]),
        (
            1,
            &[&["--pour", "0.5,0.5", "--paint", "Mauve=1"], &pigments[..]].concat(),
            &["--palette or --paint", "`Mauve`", "Viridian"],
        ),
        (
            1,
            &[&["--pour", "0.5,0.5", "--palette", nine], &pigments[..]].concat(),
            &["--palette or --paint", "at most 8", "leave out 1"],
        ),
        (
            2,
            &[&["--pour", "0.5,0.5", "--paint", "Viridian=0"], &pigments[..]].concat(),
            &["parts above 0", "`Viridian=0`"],
        ),
        (2, &[&["--pour", "0.5,0.5"], &pigments[..]].concat(), &["no pigment", "--palette"]),
        (2, &["--pour", "0.5,0.5", "--mask", &picture], &["p.png: two outputs"]),
        (2, &["--pour", "0.5,0.5", "--mask", &model], &["ends in .png or .exr"]),
        (2, &[], &["nothing is poured", "--pour 0.5,0.5"]),
    ] {
        // The first fault is an option given twice.
        refused(&picture, &[&[&model[..]], &SMALL[..], options].concat(), status, words);
    }
    let long = ["--seconds", "3600", "--rate", "60", "--animation", &gif];
    let words = ["--seconds", "100000 frames", "1666.6 seconds fit"];
    refused(&picture, &[&[&model, "--pour", "0.5,0.5"], &long[..]].concat(), 2, &words);
    let early = [&model, "--pour", "0.5,0.5", "--seconds", "-1"];
    refused(&picture, &early, 2, &["--seconds takes 0 to 3600", "`-1`"]);
    let run = stencil(&[&model, "--pour", "0.5,0.5"]);
    assert!(run.status == 2 && run.err.contains("nothing would be written"), "{}", run.err);
    assert!(run.err.contains("--picture") && run.err.contains("--animation"), "{}", run.err);
}

#[test]
fn faults_of_scripts_name_file_line_key_value_and_way_out() {
    let folder = folder();
    let [picture, script, mask] = ["p.png", "s.toml", "m.png"].map(|name| path(&folder, name));
    for (from, to, status, words) in [
        ("at = [0.0, 1.0, 0.0]", "at = [0.0, 5.0, 0.0]", 1, &["line 6", "[[pour]] 1", "is 4"][..]),
        ("at = [0.0, 1.0, 0.0]", "at = [0.0, nan, 0.0]", 1, &["line 7", "at", "NaN"]),
        ("at = [0.0, 1.0, 0.0]", "picked = [0.01, 0.02]", 1, &["line 6", "no surface"]),
        ("box.obj", "other.toml", 1, &["line 3", "subject", "`other.toml`"]),
        ("box.obj", "gone.obj", 1, &["line 3", "subject takes a file", "gone.obj"]),
        ("seconds = 0.5", "seconds = -1", 1, &["line 4", "seconds", "`-1`"]),
        ("cell = 0.2", "cell = 0.00002", 2, &["line 5", "grid.cell", "`0.00002`", "fits"]),
        ("version = 1", "version = 2", 1, &["line 2", "`2`", "newer"]),
        ("amount_mm3", "amount", 1, &["line 9", "unknown key `amount`", "amount_mm3"]),
        ("[[pour]]", "[[puor]]", 1, &["unknown key `puor`", "pour"]),
        (
            "[[pour]]",
            "[[volume]]\ncentre = [0.0, 1.0, 0.0]\nradius = 0.0\n[[pour]]",
            1,
            &["line 8", "[[volume]] 1, radius", "`0`"],
        ),
        (
            "[[pour]]",
            "[[region]]\nname = \"a\"\nshells = [1.0, 0.9]\ntint = [0.0, 0.7, 0.3]\n[[pour]]",
            1,
            &["line 9", "[[region]] 1, tint", "rise"],
        ),
        (
            "[[pour]]",
            "[[volume]]\ncentre = [0.0, 1.0, 0.0]\nradius = 0.2\nfrom_s = 0.4\n[[split]]\n\
             at_s = 0.1\nvolume = 1\n[[pour]]",
            1,
            &["line 10", "[[split]] 1", "volume 1 is not there"],
        ),
        (
            "amount_mm3 = 20.0",
            "amount_mm3 = 20.0\nrecipe = { B = 1 }",
            1,
            &["line 10", "[palette]"],
        ),
    ] {
        assert!(SCRIPT.contains(from), "{from}");
        std::fs::write(&script, SCRIPT.replacen(from, to, 1)).unwrap();
        let all = [&["s.toml", "hint"], words].concat();
        refused(&picture, &[&script, "--width", "64", "--mask", &mask], status, &all);
        assert!(!Path::new(&mask).exists(), "{to}");
    }
    std::fs::write(&script, SCRIPT).unwrap();
    let words = ["s.toml: is an input file", "another file name"];
    refused(&picture, &[&script, "--script-out", &script], 2, &words);
    assert_eq!(std::fs::read_to_string(&script).unwrap(), SCRIPT);
    let more = [&script[..], "--width", "64", "--pour", "0.01,0.02"];
    refused(&picture, &more, 1, &["--pour number 1", "no surface"]);
}

#[test]
fn the_guide_has_a_row_for_every_setting() {
    let printed = done(&["--show-preset", "sketch"]).out;
    let guide = std::fs::read_to_string(repository("docs/guide/volumes.md")).unwrap();
    let mut group = String::new();
    let mut count = 0;
    for line in printed.lines() {
        if let Some(name) = line.strip_prefix('[') {
            group = format!("{}.", name.split(']').next().unwrap());
        } else if let Some((key, _)) = line.split_once(" = ").filter(|_| !line.starts_with('#')) {
            let name = format!("`{group}{key}`");
            assert!(
                guide.lines().any(|line: &str| line.starts_with('|') && line.contains(&name)),
                "{name} has no row"
            );
            count += 1;
        }
    }
    assert!(count > 40, "{count} settings");
}

#[test]
fn the_help_names_only_options_of_the_verb() {
    for verb in ["stencil", "watercolor", "painterly"] {
        let help = impasto(&[verb, "--help"]).out;
        let words = help.split(|letter: char| !(letter.is_ascii_alphanumeric() || letter == '-'));
        let named: Vec<&str> = words.filter(|word| word.starts_with("--")).collect();
        let lines = help.lines().map(str::trim_start).filter(|line| line.starts_with('-'));
        let listed: Vec<&str> = lines.flat_map(|line| line.split([' ', ',', '['])).collect();
        assert!(named.len() > 20, "{verb}: {named:?}");
        let others: Vec<_> = named.into_iter().filter(|option| !listed.contains(option)).collect();
        assert!(others.is_empty(), "{verb}: {others:?}");
    }
}
