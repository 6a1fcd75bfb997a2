//! All verbs share one vocabulary: old spellings do the same as new ones, tables are CSV too, and
//! every verb says what it wrote.

use std::path::Path;

use suite::program::{Run, impasto, repository};

fn oils() -> String {
    repository("measurements/van-gogh-oils.csv")
}

fn library() -> String {
    repository("measurements/van-gogh-oils.pigments.json")
}

fn place(folder: &Path, name: &str) -> String {
    folder.join(name).display().to_string()
}

fn done(arguments: &[&str]) -> Run {
    let run = impasto(arguments);
    assert_eq!(run.status, 0, "{arguments:?}: {}", run.err);
    run
}

/// Counts of a spectrometer for white, dark and a swatch.
fn counts(folder: &Path) -> [String; 3] {
    [("white.txt", 20_000.0), ("dark.txt", 200.0), ("swatch.txt", 9_000.0)].map(|(name, light)| {
        let path = place(folder, name);
        std::fs::write(
            &path,
            (0..31)
                .map(|step: u32| format!("{} {}\n", 400 + 10 * step, light + f64::from(step)))
                .collect::<String>(),
        )
        .unwrap();
        path
    })
}

/// Asserts that two commands give the same results, and returns their remarks.
fn same(new: &[&str], old: &[&str]) {
    assert_eq!(done(new).out, done(old).out, "{new:?} and {old:?}");
}

#[test]
fn old_spellings_of_the_laboratory_do_what_the_new_ones_do() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let oils = oils();
    let library = library();
    let fit = ["fit", &oils, "--method", "weighted", "--csv"];
    same(
        &[&fit[..], &["--white", "Lead White"]].concat(),
        &[&fit[..], &["--reference", "Lead White"]].concat(),
    );
    let plan = ["Viridian", "Cobalt", "--white", "Zinc White", "--swatches", "6", "--json"];
    same(
        &[&["plan", &library], &plan[..]].concat(),
        &[&["plan"], &plan[..], &["--prior", &library]].concat(),
    );
    let [white, dark, swatch] = counts(folder);
    let new = ["--white-reading", &white, "--dark-reading", &dark, "--tile", "0.98"];
    let old = ["--white", &white, "--dark", &dark, "--tile", "0.98"];
    for verb in [&["color", &swatch, "--json"][..], &["match", &library, &swatch, "--json"]] {
        same(&[verb, &new[..]].concat(), &[verb, &old[..]].concat());
    }
    for (verb, words) in
        [("convert", &[][..]), ("subset", &["Zinc White", "Lead White", "Viridian"][..])]
    {
        let [new, old] =
            [("--white", "new.json"), ("--reference", "old.json")].map(|(option, name)| {
                let out = place(folder, name);
                let head = ["library", verb, &library];
                done(&[&head[..], words, &[option, "Lead White", "-o", &out]].concat());
                std::fs::read(out).unwrap()
            });
        assert_eq!(new, old, "{verb}");
    }
    let part = place(folder, "part.json");
    done(&["library", "subset", &library, "Zinc White", "Lead White", "-o", &part]);
    let [new, old] =
        [("--white", "new.json"), ("--reference", "old.json")].map(|(option, name)| {
            let out = place(folder, name);
            done(&["library", "merge", &library, &part, option, "Lead White", "-o", &out]);
            std::fs::read(out).unwrap()
        });
    assert_eq!(new, old, "merge");
    let demo = place(folder, "demo");
    done(&["demo", "--out", &demo]);
    assert!(Path::new(&demo).is_dir(), "demo --out");
    for spelling in ["-o", "--output", "--out"] {
        let out = place(folder, spelling.trim_start_matches('-'));
        done(&["report", &library, spelling, &out]);
        assert!(Path::new(&out).join("report.html").exists(), "{spelling}");
    }
}

#[test]
fn old_spellings_are_not_in_the_help() {
    let cases: [(&[&str], &[&str]); 9] = [
        (&["fit"], &["--reference", "--dark "]),
        (&["plan"], &["--prior"]),
        (&["color"], &["--white ", "--dark "]),
        (&["report"], &["--out ", "--white "]),
        (&["library", "convert"], &["--reference"]),
        (&["paint"], &["--library"]),
        (&["watercolor"], &["--pigments"]),
        (&["painterly"], &["--pigments"]),
        (&["stencil"], &["--pigments"]),
    ];
    for (verb, old) in cases {
        let help = done(&[verb, &["--help"]].concat()).out;
        for word in old {
            assert!(!help.contains(word), "{verb:?} tells {word}: {help}");
        }
    }
}

#[test]
fn a_file_after_the_white_of_a_fit_is_still_a_reading() {
    let folder = tempfile::tempdir().unwrap();
    let [white, dark, swatch] = counts(folder.path());
    let arguments = ["fit", &swatch, "--white", &white, "--dark", &dark];
    let run = impasto(&arguments);
    assert!(run.err.contains("is read as --white-reading"), "{}", run.err);
    let alone = impasto(&["color", &swatch, "--dark-reading", &dark]);
    assert_eq!(alone.status, 2, "{}", alone.err);
    assert!(alone.err.contains("add --white-reading FILE"), "{}", alone.err);
}

#[test]
fn old_spellings_of_the_painter_do_what_the_new_ones_do() {
    // There is a small map `m.exr` and a small style.
    let folder = super::painterly::folder();
    let folder = folder.path();
    let map = place(folder, "m.exr");
    let style = place(folder, "style.toml");
    let library = library();
    let photo = repository("docs/images/photograph.png");
    let script = place(folder, "a.json");
    let text = r#"{"format": "strokes", "version": 1, "title": "A",
        "canvas": {"width_mm": 8, "height_mm": 6, "cell_mm": 0.2}, "palette": {"W": "Lead White"},
        "brushes": {"b": {"shape": "flat", "size_mm": 3}},
        "actions": [{"load": {"brush": "b", "recipe": {"W": 1}, "amount_mm": 0.3}},
        {"stroke": {"brush": "b", "samples": [[0, 2, 2, 0.5], [0.5, 6, 3, 0.5]]}}]}"#;
    std::fs::write(&script, text).unwrap();
    let commands: [(&[&str], &str, &[&str]); 5] = [
        (&["paint", &script], "--library", &["--backend", "cpu"]),
        (&["paint", "--from", &photo], "--library", &["--width-mm", "12", "--backend", "cpu"]),
        (&["watercolor", &photo], "--pigments", &["--width", "48", "--backend", "cpu"]),
        (
            &["painterly", "shape:sphere"],
            "--pigments",
            &["--map", &map, "--width", "48", "--backend", "cpu"],
        ),
        (
            &["stencil", "shape:sphere"],
            "--pigments",
            &["--width", "48", "--backend", "cpu", "--pour", "0.5,0.5,2", "--paint", "Viridian"],
        ),
    ];
    for (index, (head, option, tail)) in commands.into_iter().enumerate() {
        let [new, old, picture] =
            ["new.exr", "old.exr", "new.png"].map(|name| place(folder, &format!("{index}{name}")));
        let run = done(&[head, &[&library], tail, &["-o", &new, "-o", &picture]].concat());
        for file in [&new, &picture] {
            assert!(run.err.contains(&format!("Wrote {file}")), "{head:?}: {}", run.err);
        }
        assert!(std::fs::read(&picture).unwrap().starts_with(b"\x89PNG"), "{head:?}");
        done(&[head, &[option, &library], tail, &["--output", &old]].concat());
        assert!(std::fs::read(&new).unwrap() == std::fs::read(&old).unwrap(), "{head:?}");
        let twice = impasto(&[head, &[&library, option, &library], tail, &["-o", &new]].concat());
        assert_eq!(twice.status, 2, "{head:?}: {}", twice.err);
    }
    let new = place(folder, "new.exr");
    let old = place(folder, "old.exr");
    let dabs = ["artmap", "paint", "--style", &style, "--tones", "2", "-o"];
    done(&[&dabs[..], &[&new, &library]].concat());
    done(&[&dabs[..], &[&old, "--pigments", &library]].concat());
    assert!(std::fs::read(&new).unwrap() == std::fs::read(&old).unwrap(), "artmap paint");
}

#[test]
fn the_ending_of_the_output_chooses_what_is_written() {
    let photo = repository("docs/images/photograph.png");
    let [wrong, painting] =
        ["a.jpg", "a.exr"].map(|out| impasto(&["watercolor", &photo, "--width", "48", "-o", out]));
    assert_eq!(wrong.status, 2, "{}", wrong.err);
    assert!(wrong.err.contains("try a.png for a picture, or a.exr"), "{}", wrong.err);
    assert_eq!(painting.status, 2, "{}", painting.err);
    assert!(painting.err.contains("name a LIBRARY"), "{}", painting.err);
    let two = impasto(&["watercolor", &photo, "-o", "a.png", "-o", "b.tif"]);
    assert_eq!(two.status, 2, "{}", two.err);
    assert!(two.err.contains("a.png and b.tif"), "{}", two.err);
}

#[test]
fn every_table_is_csv_too() {
    let oils = oils();
    let library = library();
    let cases: [(&[&str], &str, usize); 9] = [
        (&["fit", &oils, "--method", "weighted"], "sample,ciede2000", 83),
        (&["mix", &library, "Viridian=1"], "nm,reflectance", 32),
        (
            &["color", &oils, "--sample", "09A on white"],
            "sample,X,Y,Z,x,y,L,a,b,chroma,hue_deg,",
            2,
        ),
        (&["quadrature", "-n", "4"], "nm,X,Y,Z", 5),
        (&["library", "show", &library, "Viridian"], "nm,K,K_sd,S,S_sd", 32),
        (&["library", "diff", &library, &library], "illuminant,pigment,masstone,tint", 21),
        (
            &["library", "list", &library],
            "name,colour_index,identified,guessed,L,a,b,hex,in_gamut,notes",
            21,
        ),
        (
            &["match", &library, "50,0,0", "--only", "Zinc White", "--only", "Bone Black"],
            "target,recipe,pigment,share,delta_e_D65,hex",
            3,
        ),
        (&["plan", "Viridian", "--white", "White"], "sample,purpose,parts_White", 6),
    ];
    for (arguments, heading, lines) in cases {
        let run = done(&[arguments, &["--csv"]].concat());
        assert!(run.out.starts_with(heading), "{arguments:?}: {}", run.out);
        let mut reader = csv::Reader::from_reader(run.out.as_bytes());
        let rows = reader.records().map(Result::unwrap).count();
        assert!(rows + 1 >= lines.min(4), "{arguments:?}: {}", run.out);
        if arguments[0] != "plan" && arguments[0] != "match" {
            assert_eq!(rows + 1, lines, "{arguments:?}: {}", run.out);
        }
        let both = impasto(&[arguments, &["--csv", "--json"]].concat());
        assert_eq!(both.status, 2, "{arguments:?}: one of them");
    }
}

#[test]
fn a_file_named_twice_and_an_ending_of_another_format_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let oils = oils();
    let library = library();
    let twice = done(&["color", &oils, &oils, "--csv"]);
    assert!(twice.err.contains("named twice"), "{}", twice.err);
    let out = place(folder.path(), "oils.gpl");
    let other = done(&["library", "export", &library, "--to", "ase", "-o", &out]);
    assert!(other.err.contains("written as ase"), "{}", other.err);
    let by_ending = done(&["library", "export", &library, "-o", &out]);
    assert!(!by_ending.err.contains("written as"), "{}", by_ending.err);
    assert!(std::fs::read(&out).unwrap().starts_with(b"GIMP Palette"), "the ending is the format");
    let none = impasto(&["library", "export", &library, "-o", "oils.xyz"]);
    assert_eq!(none.status, 2, "{}", none.err);
}

#[test]
fn a_brush_that_was_never_loaded_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let script = place(folder.path(), "a.json");
    let text = r#"{"format": "strokes", "version": 1, "title": "A",
        "canvas": {"width_mm": 8, "height_mm": 6, "cell_mm": 0.2}, "palette": {"W": "Lead White"},
        "brushes": {"b": {"shape": "flat", "size_mm": 3}},
        "actions": [{"stroke": {"brush": "b", "samples": [[0, 2, 2, 0.5], [0.5, 6, 3, 0.5]]}}]}"#;
    std::fs::write(&script, text).unwrap();
    let picture = place(folder.path(), "a.png");
    let run = done(&["paint", &script, "--backend", "cpu", "-o", &picture]);
    assert!(
        run.err.contains("a.json, action 1: the brush `b` paints before it was loaded"),
        "{}",
        run.err
    );
}
