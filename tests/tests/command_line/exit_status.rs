//! Exit status: the same fault has the same status in every verb, as docs/guide/command-line.md says.

use suite::program::{impasto, repository};

/// Runs the commands, which all have one fault, and asserts one status and a message with `words`.
fn all(status: u8, words: &[&str], commands: &[&[&str]]) {
    for arguments in commands {
        let run = impasto(arguments);
        assert_eq!(run.status, status, "{arguments:?}: {}{}", run.out, run.err);
        for word in words {
            assert!(run.err.contains(word), "{arguments:?}: `{word}` is missing: {}", run.err);
        }
    }
}

#[test]
fn the_same_fault_has_the_same_status_in_every_verb() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name).display().to_string();
    let library = repository("measurements/van-gogh-oils.pigments.json");
    let oils = repository("measurements/van-gogh-oils.csv");
    let photo = repository("docs/images/photograph.png");
    let library = library.as_str();
    let oils = oils.as_str();
    let photo = photo.as_str();
    let png = place("a.png");
    let json = place("a.json");
    let exr = place("a.exr");
    let out = place("out");
    let png = png.as_str();
    let json = json.as_str();
    let exr = exr.as_str();
    let out = out.as_str();
    let painted = place("painted.exr");
    let painted = painted.as_str();
    let script = place("script.json");
    let text = r#"{"format": "strokes", "version": 1, "title": "A",
        "canvas": {"width_mm": 4, "height_mm": 4, "cell_mm": 0.2}, "palette": {"W": "Lead White"},
        "brushes": {}, "actions": []}"#;
    std::fs::write(&script, text).unwrap();
    assert_eq!(impasto(&["paint", &script, "-o", painted]).status, 0);

    let absent = &["Viridan", "did you mean Viridian?"];
    all(
        1,
        absent,
        &[
            &["mix", library, "Viridan=1"],
            &["match", library, "50,0,0", "--only", "Viridan"],
            &["library", "show", library, "Viridan"],
            &["library", "subset", library, "Viridan", "-o", json],
            &["library", "rename", library, "Viridan=Green", "-o", json],
            &["library", "convert", library, "--white", "Viridan", "-o", json],
            &["report", library, "--pair", "Viridan", "Minium", "-o", out],
            &["plan", library, "Viridan", "--white", "Zinc White"],
            &["fit", oils, "--white", "Viridan"],
            &["relight", painted, "--swap", "all:Lead White=Viridan", "-o", png],
            &["watercolor", photo, library, "--palette", "Viridan", "-o", png],
            &["painterly", photo, library, "--palette", "Viridan", "-o", png],
            &["paint", "--from", photo, "--palette", "Viridan", "-o", png],
            &["stencil", photo, library, "--pour", "0.5,0.5,9", "--palette", "Viridan", "-o", png],
        ],
    );
    all(
        2,
        &["F11", "did you mean FL11?"],
        &[
            &["mix", library, "Viridian=1", "--illuminant", "F11"],
            &["match", library, "50,0,0", "--illuminant", "F11"],
            &["color", oils, "--illuminant", "F11"],
            &["fit", oils, "--illuminant", "F11"],
            &["quadrature", "--illuminant", "F11"],
            &["library", "list", library, "--illuminant", "F11"],
            &["library", "diff", library, library, "--illuminant", "F11"],
            &["report", library, "--illuminant", "F11", "-o", out],
            &["relight", painted, "--illuminant", "F11", "-o", png],
            &["watercolor", photo, library, "--illuminant", "F11", "-o", png],
            &[
                "stencil",
                photo,
                library,
                "--pour",
                "0.5,0.5,9",
                "--paint",
                "Viridian",
                "--illuminant",
                "F11",
                "-o",
                png,
            ],
        ],
    );
    all(
        2,
        &["missing."],
        &[
            &["fit", "missing.csv"],
            &["mix", "missing.json", "Viridian=1"],
            &["library", "list", "missing.json"],
            &["library", "merge", library, "missing.json", "-o", json],
            &["color", "missing.csv"],
            &["relight", "missing.exr", "-o", png],
            &["paint", "missing.json", "-o", png],
            &["paint", "--from", "missing.png", "-o", png],
            &["watercolor", "missing.png", "-o", png],
            &["watercolor", photo, "--settings", "missing.toml", "-o", png],
            &["painterly", "missing.obj", "-o", png],
            &["painterly", photo, "--settings", "missing.toml", "-o", png],
            &["stencil", photo, "--pour", "0.5,0.5,9", "--settings", "missing.toml", "-o", png],
            &["stencil", "missing.toml", "-o", png],
            &["artmap", "show", "missing.exr"],
            &["artmap", "build", "missing.exr", "-o", exr],
            &["artmap", "paint", "--style", "missing.toml", "-o", exr],
        ],
    );
    all(
        2,
        &["scael"],
        &[
            &["watercolor", photo, "--set", "scael=1", "-o", png],
            &["painterly", photo, "--set", "scael=1", "-o", png],
            &["stencil", photo, "--pour", "0.5,0.5,9", "--set", "scael=1", "-o", png],
        ],
    );
    all(
        2,
        &["unknown key `strenght`", "did you mean strength?"],
        &[&["watercolor", photo, "--set", "edges.strenght=1", "-o", png]],
    );
    let nowhere = place("no/such/folder/a.json");
    all(
        2,
        &["cannot be"],
        &[
            &["fit", oils, "-o", &nowhere],
            &["library", "subset", library, "Zinc White", "-o", &nowhere],
            &["plan", "Viridian", "--white", "W", "-o", &nowhere],
        ],
    );
}

#[test]
fn presets_and_other_words_are_asked_after() {
    for arguments in [
        ["watercolor", "a.png", "--preset", "portrayt", "-o", "b.png"],
        ["painterly", "a.png", "--preset", "impresionist", "-o", "b.png"],
        ["stencil", "a.png", "--preset", "grisaile", "-o", "b.png"],
    ] {
        let run = impasto(&arguments);
        assert_eq!(run.status, 2, "{arguments:?}: {}", run.err);
        assert!(run.err.contains("a similar value exists"), "{arguments:?}: {}", run.err);
    }
}

#[test]
fn messages_hold_no_types_long_numbers_or_temporary_paths() {
    let photo = repository("docs/images/photograph.png");
    for (arguments, word) in [
        (["watercolor", &photo, "--set", "edges=3", "-o", "a.png"], "expected a table of keys"),
        (["painterly", &photo, "--set", "overlap=3", "-o", "a.png"], "expected a table of keys"),
        (["watercolor", &photo, "--set", "edges.strength=1e300", "-o", "a.png"], "found `"),
        (["watercolor", &photo, "--set", "edges.strength=much", "-o", "a.png"], "a number"),
        (["watercolor", &photo, "--stages", "/proc/nowhere", "-o", "a.png"], "cannot be"),
    ] {
        let run = impasto(&arguments);
        assert_eq!(run.status, 2, "{arguments:?}: {}", run.err);
        assert!(run.err.contains(word), "{arguments:?}: {}", run.err);
        for fault in ["struct ", "f32", "Settings", ".impasto", "000000000000"] {
            assert!(!run.err.contains(fault), "{arguments:?}: {}", run.err);
        }
    }
}
