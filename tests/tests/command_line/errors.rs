//! Errors of the program: exit status 2 if it cannot run, 1 if it refuses the data, and the same
//! for the same fault in every verb, as docs/guide/command-line.md says. `impasto fit` refuses
//! files with one fault each, with place and reason and without an output file. Files that could be
//! taken for something else are reported, and none gives a wrong result silently.

use suite::program::{Run, impasto, repository};

fn oils() -> String {
    repository("measurements/van-gogh-oils.csv")
}

fn library() -> String {
    repository("measurements/van-gogh-oils.pigments.json")
}

#[test]
fn an_unknown_pigment_is_refused_with_those_there_are() {
    let run = impasto(&["mix", &library(), "Titanium White=1"]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("`Titanium White`") && run.err.contains("Viridian"), "{}", run.err);
    let run = impasto(&["fit", &oils(), "--reference", "Titanium White"]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("`Titanium White`") && run.err.contains("Lead White"), "{}", run.err);
}

#[test]
fn a_name_that_fits_two_pigments_is_refused() {
    let run = impasto(&["mix", &library(), "Eosin=1"]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("Eosin Lake (wax)"), "{}", run.err);
}

#[test]
fn a_file_that_is_not_there_could_not_run() {
    let run = impasto(&["fit", "no-such-file.csv"]);
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("no-such-file.csv: cannot be read"), "{}", run.err);
}

#[test]
fn an_output_that_cannot_be_written_is_told_before_the_fit() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("no/such/folder/library.json");
    let run = impasto(&["fit", &oils(), "--output", output.to_str().unwrap()]);
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("cannot be written"), "{}", run.err);
    assert!(!run.err.contains("readings in"), "nothing was read before: {}", run.err);
}

#[test]
fn an_output_that_is_there_stays_whole_when_the_fit_fails() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("library.json");
    std::fs::write(&output, "mine").unwrap();
    let run = impasto(&[
        "fit",
        &oils(),
        "--saunderson",
        "0.03,0.6",
        "--output",
        output.to_str().unwrap(),
    ]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert_eq!(std::fs::read_to_string(&output).unwrap(), "mine");
}

#[test]
fn wrong_options_could_not_run() {
    let library = library();
    let oils = oils();
    for arguments in [
        vec!["fit"],
        vec!["paint", "x"],
        vec!["fit", oils.as_str(), "--saunderson", "0.03"],
        vec!["fit", oils.as_str(), "--saunderson", "1.5,0.6"],
        vec!["fit", oils.as_str(), "--smoothness", "-1"],
        vec!["fit", oils.as_str(), "--smoothness", "NaN"],
        vec!["fit", oils.as_str(), "--unevenness", "much"],
        vec!["validate", oils.as_str(), "--folds", "1"],
        vec!["mix", library.as_str(), "Zinc White"],
        vec!["mix", library.as_str(), "Zinc White=1", "--thickness", "0"],
        vec!["mix", library.as_str(), "Zinc White=1", "--thickness", "1", "--over", "grey"],
        vec!["mix", library.as_str(), "Zinc White=1", "--illuminant", "D64"],
        vec!["mix", library.as_str(), "Zinc White=1", "--observer", "3"],
        vec!["quadrature", "--method", "library"],
        vec!["quadrature", "--nodes", "0"],
    ] {
        let run = impasto(&arguments);
        assert_eq!(run.status, 2, "{arguments:?}: {}", run.err);
        assert!(
            run.err.starts_with("error:") || run.err.contains("Usage"),
            "{arguments:?}: {}",
            run.err
        );
    }
}

#[test]
fn parts_that_make_no_mixture_are_refused() {
    for recipe in [["Zinc White=0"], ["Zinc White=-1"], ["Zinc White=NaN"], ["Zinc White=1e20"]] {
        let run = impasto(&["mix", &library(), recipe[0]]);
        assert_eq!(run.status, 2, "{recipe:?}: {}", run.err);
    }
}

#[test]
fn a_library_with_a_fault_is_refused_with_the_reason() {
    let sound = std::fs::read_to_string(library()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("library.json");
    for (from, to, word) in [
        ("impasto-pigment-library", "palette", "`format`"),
        ("\"version\": 1", "\"version\": 2", "up to version 1, found `2`"),
        ("\"title\"", "\"tittle\"", "unknown field `tittle`"),
        ("\"count\": 31", "\"count\": 30", "`31` values for 30 wavelengths"),
        ("\"absorption\": [", "\"absorption\": [-", "must be 0 and up"),
        ("\"name\": \"Bone Black\"", "\"name\": \"Viridian\"", "occurs twice"),
        ("\"k2\": 0.6", "\"k2\": 1.6", "1.6"),
        ("\"reference\": \"Zinc White\"", "\"reference\": \"Chalk\"", "not in the library"),
        ("{", "[", "not a pigment library"),
    ] {
        assert!(sound.contains(from), "{from}");
        std::fs::write(&path, sound.replacen(from, to, 1)).unwrap();
        let run = impasto(&["library", "list", path.to_str().unwrap()]);
        assert_eq!(run.status, 1, "{from}: {}", run.err);
        assert!(run.err.contains("library.json") && run.err.contains(word), "{from}: {}", run.err);
    }
}

#[test]
fn a_lamp_with_a_fault_is_refused_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let lamp = folder.path().join("lamp.csv");
    std::fs::write(&lamp, "nm,power\n400,1\n500,-2\n").unwrap();
    let run = impasto(&["mix", &library(), "Viridian=1", "--illuminant", lamp.to_str().unwrap()]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("lamp.csv: power") && run.err.contains("500 nm"), "{}", run.err);
    assert!(run.err.contains("`-2`") && run.err.contains("hint: "), "{}", run.err);
}

#[test]
fn a_misspelt_option_is_not_taken_for_a_value() {
    for arguments in [vec!["fit", "--dpi", "x.csv"], vec!["mix", "--thicknes", "1", "A=1"]] {
        let run = impasto(&arguments);
        assert_eq!(run.status, 2, "{}", run.err);
        assert!(run.err.contains(arguments[1]) && !run.err.contains("'-- "), "{}", run.err);
    }
    let wrong_verb = impasto(&["library", "lst"]);
    assert!(wrong_verb.err.contains("'list'") && !wrong_verb.err.contains("left out"));
}

#[test]
fn all_verbs_are_in_the_help_and_the_short_help_is_short() {
    let whole = impasto(&["--help"]).out;
    for verb in ["completions", "man", "fit", "match"] {
        assert!(whole.contains(&format!("\n  {verb} ")), "{verb}: {whole}");
    }
    let [short, long] = ["-h", "--help"].map(|help| impasto(&["fit", help]).out);
    let at = |text: &str| short.find(text).unwrap_or_else(|| panic!("{text}: {short}"));
    assert!(at("--white <PIGMENT>") < at("Files of instruments:"), "{short}");
    assert!(at("Files of instruments:") < at("--format"), "{short}");
    assert!(long.contains("--least-light") && !short.contains("--least-light"), "{long}");
}

#[test]
fn help_is_a_result() {
    for arguments in [vec!["--help"], vec!["fit", "--help"], vec!["library", "list", "--help"]] {
        let run = impasto(&arguments);
        assert_eq!((run.status, run.err.as_str()), (0, ""), "{arguments:?}");
        assert!(run.out.contains("Usage"), "{}", run.out);
    }
}

#[test]
fn an_input_is_never_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("oils.csv");
    std::fs::copy(oils(), &file).unwrap();
    let before = std::fs::read(&file).unwrap();
    // This is another path of the input file.
    let round_about = folder.path().join("./oils.csv");
    let run = impasto(&["fit", file.to_str().unwrap(), "--output", round_about.to_str().unwrap()]);
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("never overwritten"), "{}", run.err);
    assert_eq!(std::fs::read(&file).unwrap(), before);
}

#[test]
fn an_output_that_is_a_folder_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let run = impasto(&["fit", &oils(), "--output", folder.path().to_str().unwrap()]);
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("expected a regular file"), "{}", run.err);
}

#[cfg(unix)]
#[test]
fn a_link_keeps_pointing_and_a_file_keeps_its_mode() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("real.json");
    std::fs::write(&target, "old").unwrap();
    std::fs::set_permissions(&target, std::fs::Permissions::from_mode(0o640)).unwrap();
    let link = folder.path().join("link.json");
    std::os::unix::fs::symlink(&target, &link).unwrap();
    let run = impasto(&["fit", &oils(), "--output", link.to_str().unwrap()]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink(), "the link is still one");
    assert!(std::fs::read_to_string(&target).unwrap().starts_with('{'), "its target was written");
    assert_eq!(std::fs::metadata(&target).unwrap().permissions().mode() & 0o777, 0o640);
}

#[test]
fn a_file_of_the_other_kind_is_told_so() {
    let run = impasto(&["fit", &library()]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("found `JSON`") && run.err.contains("hint"), "{}", run.err);
    let run = impasto(&["mix", &oils(), "Viridian=1"]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("impasto fit"), "{}", run.err);
}

#[test]
fn spectra_beyond_the_visible_have_no_color() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("uv.csv");
    std::fs::write(&file, "sample,220,270,320\na,0.1,0.2,0.3\n").unwrap();
    let run = impasto(&["color", file.to_str().unwrap()]);
    assert_eq!(run.status, 1, "{}", run.err);
    std::fs::write(&file, "sample,500,510,520\na,0.1,0.2,0.3\n").unwrap();
    let run = impasto(&["color", file.to_str().unwrap()]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("spectra from 500 to 520 nm have no colour"), "{}", run.err);
    std::fs::write(&file, "sample,450,560,670\na,0.1,0.2,0.3\n").unwrap();
    let run = impasto(&["color", file.to_str().unwrap()]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.contains("warning: spectra from 450 to 670 nm"), "{}", run.err);
}

#[test]
fn a_ground_must_be_one_spectrum() {
    fn over(ground: &str) -> Run {
        impasto(&["mix", &library(), "Viridian=1", "--thickness", "1", "--over", ground])
    }
    let run = over(&oils());
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("expected one spectrum of a ground"), "{}", run.err);
    let run = over(&format!("{}#01A", oils()));
    assert!(run.status == 1 && run.err.contains("01A bare white"), "{}", run.err);
    assert_eq!(over(&format!("{}#01A bare white", oils())).status, 0);
    let hiding = impasto(&["mix", &library(), "Viridian=1", "--over", "black"]);
    assert_eq!(hiding.status, 2, "{}", hiding.err);
}

#[test]
fn samples_fitted_exactly_are_no_proof_and_this_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("few.csv");
    std::fs::write(&file, "sample,White,Red,400,700\na,1,,0.9,0.9\nb,,1,0.1,0.6\nc,1,1,0.2,0.7\n")
        .unwrap();
    let run = impasto(&["fit", file.to_str().unwrap()]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.contains("3 samples for 3 unknowns"), "{}", run.err);
    let run = impasto(&["validate", file.to_str().unwrap()]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("would not be identified (c)"), "{}", run.err);
}

/// Runs commands that all have the same fault, and asserts one status and a message with `words`.
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
    let [library, oils, photo] = [
        "measurements/van-gogh-oils.pigments.json",
        "measurements/van-gogh-oils.csv",
        "docs/images/photograph.png",
    ]
    .map(repository);
    let [library, oils, photo] = [&library, &oils, &photo].map(String::as_str);
    let names = ["a.png", "a.json", "a.exr", "out", "painted.exr", "script.json"];
    let paths = names.map(|name| folder.path().join(name).display().to_string());
    let [png, json, exr, out, painted, script] = paths.each_ref().map(String::as_str);
    let text = r#"{"format": "strokes", "version": 1, "title": "A",
        "canvas": {"width_mm": 4, "height_mm": 4, "cell_mm": 0.2}, "palette": {"W": "Lead White"},
        "brushes": {}, "actions": []}"#;
    std::fs::write(script, text).unwrap();
    assert_eq!(impasto(&["paint", script, "-o", painted]).status, 0);

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
        &["missing.", ": cannot be read"],
        &[
            &["fit", "missing.csv"],
            &["fit", oils, "--recipes", "missing.csv"],
            &["fit", oils, "--illuminant", "missing.spdx"],
            &["light", "missing.csv#2"],
            &["mix", library, "Viridian=1", "--thickness", "1", "--over", "missing.csv#A"],
            &["match", library, "missing.ase"],
            &["match", library, "missing.csv#RAL 5012"],
            &["match", library, "50,0,0", "--cost", "missing.csv"],
            &["match", library, "50,0,0", "--target-light", "missing.csv"],
            &["correct", library, "50,0,0", "missing.csv", "--made", "Viridian=1"],
            &["painterly", "missing.png", "-o", png],
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
    let nowhere = folder.path().join("no/such/folder/a.json").display().to_string();
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

/// A small valid file. Each test makes one fault in it.
const SOUND: &str = "\
sample,film,backing,White,Red,400,410,420
a,paint,card,100,,90,91,92
b,paint,card,,100,10,11,60
c,paint,card,50,50,20,22,70
d,paint,card,90,10,40,42,80
";

/// Runs `fit` on a file of these bytes. Asserts that only a successful run leaves a library.
fn fit(bytes: &[u8]) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bad.csv");
    std::fs::write(&file, bytes).unwrap();
    let output = folder.path().join("library.json");
    let run = impasto(&["fit", file.to_str().unwrap(), "--output", output.to_str().unwrap()]);
    let left: Vec<_> = std::fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .filter(|name| name != "bad.csv")
        .collect();
    if run.status == 0 {
        assert_eq!(left, ["library.json"], "{}", run.err);
    } else {
        assert!(left.is_empty(), "half-written: {left:?}");
    }
    run
}

/// Asserts that the file is refused with an error that contains all of `words`.
fn refused(bytes: &[u8], words: &[&str]) {
    let run = fit(bytes);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.out.is_empty(), "{}", run.out);
    assert!(run.err.contains("error: ") && run.err.contains("bad.csv"), "{}", run.err);
    for word in words {
        assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
    }
}

fn changed(from: &str, to: &str) -> Vec<u8> {
    assert!(SOUND.contains(from), "the sound file holds `{from}`");
    SOUND.replacen(from, to, 1).into_bytes()
}

#[test]
fn the_sound_file_is_fitted() {
    let run = fit(SOUND.as_bytes());
    assert_eq!(run.status, 0, "{}", run.err);
}

#[test]
fn decimal_commas_unquoted() {
    refused(&changed("10,11,60", "10,5,11,2,60,1"), &["row 3", "8 cells", "`11`", "decimal"]);
}

#[test]
fn quoted_decimal_commas_among_decimal_points() {
    refused(&changed("10,11,60", "\"10,5\",11.5,60"), &["row 3", "`410`", "`11.5`"]);
    let plain = fit(SOUND.replace("10,11,60", "10.5,11,60").as_bytes());
    let quoted = fit(SOUND.replace("10,11,60", "\"10,5\",11,60").as_bytes());
    assert_eq!((quoted.status, &quoted.out), (0, &plain.out), "{}", quoted.err);
}

#[test]
fn semicolons_without_a_sample_column() {
    let unnamed: Vec<_> = SOUND.lines().map(|row| row.split_once(',').unwrap().1).collect();
    let file = unnamed.join("\n").replace(',', ";");
    refused(file.as_bytes(), &["row 1", "no column `sample`"]);
}

#[test]
fn points_among_decimal_commas() {
    let file = SOUND.replace(',', ";").replace("10;11;60", "10,5;1.011;60");
    refused(file.as_bytes(), &["row 3", "`410`", "`1.011`"]);
}

#[test]
fn semicolons_tabs_and_decimal_commas_are_read() {
    let plain = fit(SOUND.replace("10,11,60", "10.5,11,60").as_bytes());
    for separator in [";", "\t"] {
        let file = SOUND.replace(',', separator);
        let cells = ["10", "11", "60"].join(separator);
        assert!(file.contains(&cells), "{file}");
        let run = fit(file.replace(&cells, &cells.replace("10", "10,5")).as_bytes());
        assert_eq!((run.status, &run.out), (0, &plain.out), "{}", run.err);
    }
}

#[test]
fn missing_sample_column() {
    let unnamed: Vec<_> = SOUND.lines().map(|row| row.split_once(',').unwrap().1).collect();
    refused(unnamed.join("\n").as_bytes(), &["row 1", "no column `sample`"]);
}

#[test]
fn another_heading_of_names_is_told() {
    let run = fit(&changed("sample,", "paint,"));
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.contains("samples are named by the column `paint`"), "{}", run.err);
}

#[test]
fn no_wavelengths_at_all() {
    refused(b"sample,White\na,1\n", &["no column `400 (a wavelength in nm)`"]);
}

#[test]
fn repeated_wavelength() {
    refused(&changed("400,410,420", "400,410,410nm"), &["row 1", "410 nm occurs twice"]);
}

#[test]
fn repeated_pigment() {
    refused(&changed("White,Red", "Red,Red"), &["`Red` occurs twice", "4", "5"]);
}

#[test]
fn wavelengths_in_no_order() {
    refused(&changed("400,410,420", "420,400,410"), &["row 1", "410 nm after 400 nm", "hint"]);
}

#[test]
fn percent_mixed_with_fractions() {
    let two = SOUND.replace("20,22,70", "0.20,0.22,0.70").replace("40,42,80", "0.4,0.42,0.8");
    refused(two.as_bytes(), &["row 4", "`0.7`", "hint", "--percent"]);
}

#[test]
fn nan() {
    refused(&changed("10,11,60", "10,NaN,60"), &["row 3", "`410`", "`NaN`"]);
}

#[test]
fn infinite_reflectance() {
    refused(&changed("10,11,60", "10,inf,60"), &["row 3", "`410`", "`inf`"]);
}

#[test]
fn negative_reflectance() {
    refused(&changed("10,11,60", "-60,11,60"), &["row 3", "`400`", "`-60`", "from 0 to 200 %"]);
    // Values as near to 0 as noise cost their reading only.
    let run = fit(&changed("10,11,60", "-9,11,60"));
    assert!(run.err.contains("b is left out: it reads -9 % at 400 nm (row 3)"), "{}", run.err);
}

#[test]
fn negative_amount() {
    refused(&changed("90,10,40", "90,-10,40"), &["row 5", "`Red`", "`-10`"]);
}

#[test]
fn amount_that_is_no_number() {
    refused(&changed("90,10,40", "90,some,40"), &["row 5", "`Red`", "`some`"]);
}

#[test]
fn amount_beyond_any_measure() {
    refused(&changed("90,10,40", "90,1.7e308,40"), &["row 5", "`Red`", "`1.7e308`"]);
}

#[test]
fn bare_cards_alone() {
    let run = fit(SOUND.replace("paint", "none").as_bytes());
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("no row is a film of paint"), "{}", run.err);
}

#[test]
fn control_characters_in_a_name() {
    refused(&changed("b,paint", "b\x1b[31m,paint"), &["row 3", "control characters"]);
}

#[test]
fn paint_without_a_recipe() {
    refused(&changed("50,50,20", ",,20"), &["row 4", "sample c"]);
}

#[test]
fn unknown_film() {
    refused(&changed("a,paint", "a,glass"), &["row 2", "`film`", "`glass`"]);
}

#[test]
fn empty_file() {
    refused(b"", &["holds no readings"]);
    refused(b"\n\n", &["holds no readings"]);
}

#[test]
fn header_alone() {
    refused(b"sample,White,400\n", &["holds no readings"]);
}

#[test]
fn truncated_row() {
    refused(
        &changed("d,paint,card,90,10,40,42,80\n", "d,paint,card,90,1"),
        &["row 5", "8 cells", "`5`"],
    );
}

#[test]
fn latin_1_bytes_are_read_and_said() {
    let mut bytes = changed("Red", "Gr?n");
    let at = bytes.iter().position(|&b| b == b'?').unwrap();
    bytes[at] = 0xfc;
    let run = fit(&bytes);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.contains("windows-1252"), "{}", run.err);
}

#[test]
fn contradicting_recipes_of_one_sample() {
    refused(&changed("d,paint,card,90,10", "c,paint,black,90,10"), &["row 5", "sample c", "row 4"]);
}

#[test]
fn a_reading_below_a_k1_that_was_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("dark.csv");
    std::fs::write(&file, SOUND.replace("10,11,60", "2,11,60")).unwrap();
    let path = file.to_str().unwrap();
    let run = impasto(&["fit", path, "--saunderson", "0.03,0.6"]);
    assert_eq!(run.status, 1, "{}", run.err);
    for word in ["row 3", "sample b", "400 nm", "k1 = 0.03", "--saunderson 0.019,0.6"] {
        assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
    }
    let floored =
        impasto(&["fit", path, "--saunderson", "0.03,0.6", "--below-surface", "floor", "--json"]);
    assert_eq!(floored.status, 0, "{}", floored.err);
    assert!(floored.out.contains("b (1)"), "the reading is named: {}", floored.out);
}

/// Writes `content` to a file and runs impasto with its path in place of `FILE`.
fn run(name: &str, content: &[u8], arguments: &[&str]) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, content).unwrap();
    let path = path.display().to_string();
    let arguments: Vec<String> = arguments.iter().map(|a| a.replace("FILE", &path)).collect();
    impasto(&arguments.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Asserts that the run refused its input, with all of `words` in the error.
fn refused_by_name(run: &Run, words: &[&str]) {
    assert_eq!(run.status, 1, "{}{}", run.out, run.err);
    for word in words {
        assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
    }
}

#[test]
fn rows_are_those_of_the_file_with_crlf_and_blank_lines() {
    let rows = ["sample,Red,White,400,500,600", "a,0,1,80,82,85", "", "", "b,1,0,10,x,60"];
    for end in ["\n", "\r\n"] {
        refused_by_name(
            &run("rows.csv", rows.join(end).as_bytes(), &["fit", "FILE"]),
            &["row 5", "`x`"],
        );
        let prices = ["pigment,price", "Viridian,3", "", "Zinc White,dear"].join(end);
        let library = repository("measurements/van-gogh-oils.pigments.json");
        let matching = ["match", library.as_str(), "50,0,0", "--cost", "FILE"];
        refused_by_name(&run("prices.csv", prices.as_bytes(), &matching), &["row 4", "`dear`"]);
    }
}

#[test]
fn lamps_and_paint_are_not_taken_for_each_other() {
    let grey = repository("spectra/examples/paints.csv");
    for (name, text, words) in [
        ("narrow.csv", "nm,power\n500,1\n510,2\n", ["420 to 680 nm", "narrow.csv"]),
        ("paint.csv", "nm,%R\n400,10\n700,20\n", ["found `reflectance`", "hint: "]),
    ] {
        let lamp = run(name, text.as_bytes(), &["color", grey.as_str(), "--illuminant", "FILE"]);
        refused_by_name(&lamp, &words);
    }
    let irradiance = "Jaz Absolute Irradiance File\n>>>>>Begin Processed\nW\tD\tS\tP\n\
        400\t1\t50\t0.5\n500\t1\t50\t0.5\n700\t1\t20\t0.7\n>>>>>End\n";
    let paint = run("sun.JazIrrad", irradiance.as_bytes(), &["color", "FILE"]);
    refused_by_name(&paint, &["the power of a light", "--illuminant"]);
}

#[test]
fn pigments_can_be_named() {
    let table = "sample,White,Red,No,L,a,b,400,500,600,700\n\
        w,1,0,1,92,0,2,0.8,0.82,0.84,0.85\nr,0,1,2,40,50,30,0.05,0.06,0.5,0.6\n\
        m,0.5,0.5,3,60,30,10,0.2,0.25,0.65,0.7\n";
    let fitted = run("lab.csv", table.as_bytes(), &["fit", "FILE"]);
    assert_eq!(fitted.status, 0, "{}", fitted.err);
    assert!(fitted.out.contains("2 pigments from 3 samples"), "{}", fitted.out);
    assert!(fitted.err.contains("ignored: No, L, a, b"), "{}", fitted.err);
    let one = ["fit", "FILE", "--pigments", "White", "--pigments", "Blue"];
    refused_by_name(&run("lab.csv", table.as_bytes(), &one), &["`Blue`", "heading of a column"]);
}

#[test]
fn a_style_or_script_with_a_fault_is_told_with_its_file() {
    let style = std::fs::read_to_string(repository(
        "render/techniques/artmap/src/painted/styles/dabs.toml",
    ));
    let style = style.unwrap();
    let paint = ["artmap", "paint", "--style", "FILE", "-o", "no/such/folder.exr"];
    for (from, to, word) in [
        ("cell_mm = 0.18", "cell_mm = -1.0", "style.toml, style dabs: canvas.cell_mm is"),
        ("seed = 1", "seeds = 1", "style.toml, line "),
        ("seed = 1", "seed = -1", "style.toml, line "),
    ] {
        assert!(style.contains(from), "{from}");
        let changed = style.replacen(from, to, 1);
        refused_by_name(&run("style.toml", changed.as_bytes(), &paint), &[word]);
    }
    let script = r#"{"format": "strokes", "version": 1, "title": "A",
        "canvas": {"width_mm": 4, "height_mm": 4, "cell_mm": 0.2}, "palette": {"W": "Octarine"},
        "brushes": {}, "actions": [{"save": {"path": "a.png"}}]}"#;
    let told = run("script.json", script.as_bytes(), &["paint", "FILE"]);
    refused_by_name(&told, &["script.json: palette: a pigment of the library, found `Octarine`"]);
}

#[test]
fn a_table_without_headings_is_told_with_its_name() {
    for text in [",,\n,,\n", "\n\n;;\n", "\"\"\n1\n"] {
        let told = run("empty.csv", text.as_bytes(), &["fit", "FILE"]);
        refused_by_name(&told, &["empty.csv"]);
    }
    let told = run("two.csv", b"sample,400,700\na,0.2,0.3\nb,0.5,0.6\n", &["color", "FILE"]);
    assert_eq!(told.status, 0, "{}", told.err);
    assert!(told.err.contains("warning: spectra in steps of 300 nm"), "{}", told.err);
}
