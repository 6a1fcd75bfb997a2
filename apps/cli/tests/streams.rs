//! The built program among others: streams, the default library, completions and manual pages.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn repository(file: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    root.join(file).display().to_string()
}

fn oils() -> Vec<u8> {
    std::fs::read(repository("measurements/van-gogh-oils.pigments.json")).unwrap()
}

/// Runs the program with `input` on its standard input.
fn piped(arguments: &[&str], input: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_impasto"))
        .args(arguments)
        .env_remove("IMPASTO_LIBRARY")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    // A program that reads nothing closes the pipe.
    let _ = pipe.write_all(input);
    drop(pipe);
    child.wait_with_output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn standard_input_is_a_library_a_measurement_file_or_a_target() {
    let listed = piped(&["library", "list", "-", "--csv"], &oils());
    assert!(listed.status.success(), "{}", text(&listed.stderr));
    assert_eq!(text(&listed.stdout).lines().count(), 21, "{}", text(&listed.stdout));
    let spectra = b"sample,400,500,600,700\nwhite,1,1,1,1\n";
    let color = piped(&["color", "-", "--csv"], spectra);
    assert!(text(&color.stdout).contains("white,"), "{}", text(&color.stderr));
    let library = repository("measurements/van-gogh-oils.pigments.json");
    let found = piped(&["match", &library, "-", "--count", "1", "--csv"], spectra);
    assert!(text(&found.stdout).starts_with("target,recipe,pigment"), "{}", text(&found.stderr));
    assert!(text(&found.stdout).contains("\nwhite,1,"), "{}", text(&found.stdout));
    let wrong = piped(&["fit", "-"], b"no table");
    assert_eq!(wrong.status.code(), Some(1));
    assert!(text(&wrong.stderr).contains("error: -"), "{}", text(&wrong.stderr));
}

#[test]
fn a_file_goes_to_standard_output_and_all_else_to_the_error_stream() {
    let made = piped(&["library", "convert", "-", "--white", "Lead White", "-o", "-"], &oils());
    assert!(made.status.success(), "{}", text(&made.stderr));
    let library: serde_json::Value = serde_json::from_slice(&made.stdout).unwrap();
    assert_eq!(library["reference"], "Lead White");
    assert!(text(&made.stderr).contains("20 pigments"), "{}", text(&made.stderr));
    let quiet = piped(&["library", "export", "-", "--to", "gpl", "-o", "-", "-q"], &oils());
    assert!(text(&quiet.stdout).starts_with("GIMP Palette"), "{}", text(&quiet.stdout));
    let script = r#"{"format": "strokes", "version": 1, "title": "A",
        "canvas": {"width_mm": 4, "height_mm": 4, "cell_mm": 0.2}, "palette": {"W": "Lead White"},
        "brushes": {}, "actions": []}"#;
    let picture = piped(&["paint", "-", "--backend", "cpu", "-o", "-"], script.as_bytes());
    assert!(picture.stdout.starts_with(b"\x89PNG"), "{}", text(&picture.stderr));
    let twice = piped(&["paint", "-", "-o", "-", "--spectral", "-"], script.as_bytes());
    assert_eq!(twice.status.code(), Some(2), "one output takes one file");
}

#[test]
fn standard_input_is_a_model_a_photograph_or_toml() {
    let small = ["--width", "32", "--backend", "cpu", "-o", "-"];
    let picture = |verb: &[&str], input: &[u8]| {
        let made = piped(&[verb, &small].concat(), input);
        assert!(made.stdout.starts_with(b"\x89PNG"), "{verb:?}: {}", text(&made.stderr));
        made.stdout
    };
    let obj = b"# a tent\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1 0\n\
        f 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\n";
    let ply = b"ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n\
        property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n\
        -1 0 -1\n1 0 -1\n1 0 1\n-1 0 1\n0 1 0\n3 0 4 1\n3 1 4 2\n3 2 4 3\n3 3 4 0\n";
    let painted = picture(&["watercolor", "-"], obj);
    assert!(painted == picture(&["watercolor", "-"], ply), "one tent in two formats");
    let photograph = std::fs::read(repository("docs/images/photograph.png")).unwrap();
    assert!(painted != picture(&["watercolor", "-"], &photograph), "another subject");
    picture(&["stencil", "-", "--pour", "0.5,0.5"], obj);
    let script = "# a sphere\nformat = \"paint-volumes\"\nversion = 1\n\
        subject = \"shape:sphere\"\nseconds = 0.1\n[[pour]]\npicked = [0.5, 0.5]\namount_mm3 = 9\n";
    let sphere = picture(&["stencil", "-"], script.as_bytes());
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("sphere.toml").display().to_string();
    std::fs::write(&file, script).unwrap();
    assert!(sphere == picture(&["stencil", &file], b""), "the script");
    let settings = b"[edges]\nstrength = 5.0\n";
    let tent = ["watercolor", "shape:sphere"];
    let strong = picture(&[&tent[..], &["--settings", "-"]].concat(), settings);
    assert!(strong != picture(&tent, b""), "the settings were read");
    let path = b"frames = 1\n[[keyframe]]\neye = [0.0, 1.0, 6.0]\ntarget = [0.0, 0.0, 0.0]\n\
        [[keyframe]]\neye = [0.0, 2.0, 6.0]\ntarget = [0.0, 0.0, 0.0]\n";
    let seen = picture(&["stencil", &file, "--camera", "-"], path);
    assert!(seen != sphere, "another camera");
    for wrong in [&b"no model\n"[..], b""] {
        let refused = piped(&[&["watercolor", "-"], &small[..]].concat(), wrong);
        assert_eq!(refused.status.code(), Some(1), "{}", text(&refused.stderr));
        let message = text(&refused.stderr);
        assert!(message.contains("error: -: ") && message.contains(".ply"), "{message}");
    }
}

#[test]
fn the_environment_names_the_default_library() {
    let folder = tempfile::tempdir().unwrap();
    let library = folder.path().join("mine.json");
    let white = ["library", "from-rgb", "#ffffff", "--name", "My White", "-o"];
    let made = piped(&[&white[..], &[library.to_str().unwrap()]].concat(), b"");
    assert!(made.status.success(), "{}", text(&made.stderr));
    let mix = |variable: Option<&Path>| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_impasto"));
        command.args(["library", "list", "--csv"]).env_remove("IMPASTO_LIBRARY");
        if let Some(path) = variable {
            command.env("IMPASTO_LIBRARY", path);
        }
        command.output().unwrap()
    };
    let own = mix(Some(&library));
    assert!(text(&own.stdout).contains("My White"), "{}", text(&own.stderr));
    assert!(!text(&own.stderr).contains("Van Gogh"), "{}", text(&own.stderr));
    for none in [None, Some(Path::new(""))] {
        let shipped = mix(none);
        assert!(text(&shipped.stdout).contains("Viridian"), "{}", text(&shipped.stderr));
        assert!(text(&shipped.stderr).contains("IMPASTO_LIBRARY"), "{}", text(&shipped.stderr));
    }
    let missing = mix(Some(Path::new("no-such.json")));
    assert_eq!(missing.status.code(), Some(2));
    let message = text(&missing.stderr);
    assert!(
        message.starts_with("error: the default library, which IMPASTO_LIBRARY names\n"),
        "{message}"
    );
    assert!(message.contains("no-such.json: cannot be read"), "{message}");
    let named = Command::new(env!("CARGO_BIN_EXE_impasto"))
        .args(["quadrature", "own-missing.json"])
        .env("IMPASTO_LIBRARY", &library)
        .output()
        .unwrap();
    assert!(text(&named.stderr).starts_with("error: own-missing.json: cannot"), "{named:?}");
}

#[test]
fn completions_know_the_verbs_and_every_verb_has_a_manual_page() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let made = piped(&["completions", shell], b"");
        assert!(made.status.success(), "{shell}: {}", text(&made.stderr));
        let script = text(&made.stdout);
        assert!(script.contains("watercolor") && script.contains("illuminant"), "{shell}");
    }
    let bash = piped(&["completions", "bash"], b"");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("impasto.bash");
    std::fs::write(&file, &bash.stdout).unwrap();
    if let Ok(checked) = Command::new("bash").arg("-n").arg(&file).output() {
        assert!(checked.status.success(), "{}", text(&checked.stderr));
    }
    let pages = folder.path().join("man/man1");
    let made = piped(&["man", pages.to_str().unwrap()], b"");
    assert!(made.status.success(), "{}", text(&made.stderr));
    let page = |name: &str| std::fs::read_to_string(pages.join(name)).unwrap();
    for name in ["impasto.1", "impasto-fit.1", "impasto-library-merge.1", "impasto-artmap-build.1"]
    {
        let page = page(name);
        assert!(page.contains(".SH NAME") && page.contains(".SH OPTIONS"), "{name}: {page}");
        let word = name.trim_end_matches(".1");
        let version = env!("CARGO_PKG_VERSION");
        let title = format!(".TH {word} 1 \"\" \"impasto {version}\" \"Manual of impasto\"\n");
        assert!(page.contains(&title), "{name}: {page}");
        assert!(page.contains(".SH EXAMPLES\n.nf\n") || name == "impasto.1", "{name}: {page}");
    }
    let example = "\nimpasto mix oils.json \"Zinc White=9\" \"Cobalt Blue=1\"\n";
    assert!(page("impasto-mix.1").contains(example), "{}", page("impasto-mix.1"));
    let whole = page("impasto.1");
    for wanted in [".SH \"EXIT STATUS\"", ".SH ENVIRONMENT", "IMPASTO_LIBRARY", "129, 130, 143"] {
        assert!(whole.contains(wanted), "{wanted}: {whole}");
    }
    for file in std::fs::read_dir(&pages).unwrap() {
        let name = file.unwrap().file_name().into_string().unwrap();
        for other in page(&name).lines().filter_map(|line| line.strip_suffix("(1)")) {
            let other = other.replace("\\-", "-").replace("\\fB", "").replace("\\fR", "");
            assert!(pages.join(format!("{other}.1")).is_file(), "{name} refers to {other}(1)");
        }
    }
    assert!(pages.join("impasto-completions.1").exists());
}

#[test]
fn quiet_and_verbose_change_what_is_told() {
    let list = |more: &[&str]| {
        let all = [&["library", "list", "-"], more].concat();
        text(&piped(&all, &oils()).stderr)
    };
    assert_eq!(list(&["-q"]), "");
    assert!(list(&["-v"]).contains("20 pigments") && list(&["-v"]).contains("took "), "details");
    let default = piped(&["library", "list", "-q"], b"");
    assert_eq!(text(&default.stderr), "");
}
