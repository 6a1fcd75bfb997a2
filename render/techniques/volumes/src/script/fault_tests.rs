//! Every fault of a script once, with its place and its way out.

use documents::hint::Explain;

use super::samples::{SHORT, WHOLE};
use super::{MOST_EVENTS, Script};
use crate::drawing::MOST_REGIONS;

/// The error of a text and its hint.
fn fault(text: &str) -> [String; 2] {
    let error = Script::from_text("s.toml", text).unwrap_err();
    [error.to_string(), error.hint().unwrap().to_string()]
}

/// Asserts that `text` has an error that begins with `wanted`, and its hint with `hint`.
fn assert_fault(text: &str, wanted: &str, hint: &str) {
    let [error, told] = fault(text);
    assert!(error.starts_with(wanted), "{text}\n{error}\nnot {wanted}");
    assert!(told.starts_with(hint), "{text}\n{error}\n{told}\nnot {hint}");
}

#[test]
fn faults_of_the_header() {
    for (from, to, wanted, hint) in [
        (
            "paint-volumes",
            "strokes",
            "s.toml, line 1: format takes \"paint-volumes\", found `\"strokes\"`",
            "a script begins",
        ),
        (
            "format = \"paint-volumes\"",
            "",
            "s.toml, line 1: format takes \"paint-volumes\", found `nothing`",
            "a script begins",
        ),
        (
            "version = 1",
            "version = 2\nnew = 1",
            "s.toml, line 2: version takes 1 to 1, found `2`",
            "a newer impasto",
        ),
        (
            "version = 1",
            "version = \"1\"",
            "s.toml, line 2: version takes 1 to 1, found `\"1\"`",
            "a newer impasto",
        ),
        ("version = 1", "", "s.toml, line 1: the key `version` is missing", "add a line `version`"),
        (
            "subject = \"shape:sphere\"",
            "",
            "s.toml, line 1: the key `subject` is missing",
            "add a line `subject`",
        ),
        (
            "shape:sphere",
            "shape:spere",
            "s.toml, line 3: subject takes the name of a shape after `shape:`, found `spere`",
            "did you mean shape:sphere?",
        ),
        (
            "shape:sphere",
            "shape:cow",
            "s.toml, line 3: subject takes the name of a shape",
            "shapes are still-life, village",
        ),
        (
            "shape:sphere",
            "other.toml",
            "s.toml, line 3: subject takes a model or a photograph, found `other.toml`",
            "name the model or photograph that the other script paints",
        ),
        (
            "shape:sphere",
            "",
            "s.toml, line 3: subject takes a path of 1 to 1024 bytes",
            "subject = ",
        ),
        (
            "shape:sphere",
            "/etc/jug.glb",
            "s.toml, line 3: subject takes a path below the script's folder, found `/etc/jug.glb`",
            "put the file beside",
        ),
        (
            "shape:sphere",
            "../jug.glb",
            "s.toml, line 3: subject takes a path below the script's folder",
            "put the file beside",
        ),
        (
            "shape:sphere",
            "a/../../jug.glb",
            "s.toml, line 3: subject takes a path below",
            "put the file beside",
        ),
        (
            "shape:sphere",
            "C:jug.glb",
            "s.toml, line 3: subject takes a path below",
            "put the file beside",
        ),
        (
            "shape:sphere",
            "a\\\\jug.glb",
            "s.toml, line 3: subject takes a path below",
            "put the file beside",
        ),
        (
            "seconds = 1",
            "seconds = -1",
            "s.toml, line 4: seconds takes 0 to 3600, found `-1`",
            "the least is 0",
        ),
        (
            "seconds = 1",
            "seconds = 4000",
            "s.toml, line 4: seconds takes 0 to 3600, found `4000`",
            "the most is 3600",
        ),
        (
            "seconds = 1",
            "seconds = nan",
            "s.toml, line 4: seconds takes 0 to 3600, found `NaN`",
            "write a number",
        ),
        (
            "seconds = 1",
            "seconds = \"one\"",
            "s.toml, line 4: seconds: invalid type: text \"one\", expected a number",
            "write a value",
        ),
        (
            "seconds = 1",
            "second = 1",
            "s.toml, line 4: second: unknown key `second`",
            "did you mean seconds?",
        ),
        (
            "seconds = 1",
            "seconds = 1\nseconds = 2",
            "s.toml, line 5: duplicate key",
            "a line of TOML",
        ),
        ("seconds = 1", "seconds = ", "s.toml, line 4: ", "a line of TOML"),
        (
            "seconds = 1",
            "seconds = 1\nunit_mm = 0",
            "s.toml, line 5: unit_mm takes a number above 0, up to 1000000, found `0`",
            "write a number above 0",
        ),
        (
            "seconds = 1",
            "seconds = 1\npreset = \"washd\"",
            "s.toml, line 5: preset: unknown word `washd`",
            "did you mean washed?",
        ),
    ] {
        assert!(SHORT.contains(from), "{from}");
        assert_fault(&SHORT.replace(from, to), wanted, hint);
    }
}

/// Every case of `faults.txt`: lines after the shortest script, then the error after `! ` and the
/// hint after `? `, as far as they are compared.
#[test]
fn every_fault_names_its_place_and_the_way_out() {
    let cases: Vec<&str> = include_str!("faults.txt").split("\n\n").collect();
    assert!(cases.len() > 60, "{}", cases.len());
    for case in cases {
        let (text, rest) = case.split_once("\n! ").unwrap();
        let (wanted, hint) = rest.split_once("\n? ").unwrap();
        assert_fault(&format!("{SHORT}{text}"), &format!("s.toml, {wanted}"), hint.trim_end());
    }
}

#[test]
fn limits_say_what_fits() {
    let many = |text: &str, count: usize| format!("{SHORT}{}", text.repeat(count));
    let volume = "[[volume]]\ncentre = [0, 0, 0]\nradius = 1\ndetail = 1\n";
    let regions: String =
        (0..=MOST_REGIONS).map(|index| format!("[[region]]\nname = \"r{index}\"\n")).collect();
    for (text, wanted, hint) in [
        (
            many(volume, 4097),
            "s.toml, line 16389: [[volume]] 4097 takes at most 4096 tables, found `4097`",
            "the first 4096 fit",
        ),
        (
            many(&volume.replace("= 1\n", "= 5\n"), 200),
            "s.toml, line 788: [[volume]] 196, detail takes at most 2000000 particles in all volumes, found `5: 2007432 so far`",
            "detail = 4 fits for all 200",
        ),
        (
            many("[[dry]]\nat_s = 1\n", MOST_EVENTS + 1),
            "s.toml, line 20005: [[dry]] 10001 takes at most 10000 tables",
            "the first 10000 fit",
        ),
        (
            format!("{SHORT}{regions}"),
            "s.toml, line 133: [[region]] 65 takes at most 64 tables, found `65`",
            "the first 64 fit",
        ),
        (format!("{SHORT}#{}", "x".repeat(16 << 20)), "s.toml: it has 16777", "divide it"),
    ] {
        let [error, told] = fault(&text);
        assert!(error.starts_with(wanted), "{error}\nnot {wanted}");
        assert!(told.starts_with(hint), "{told}\nnot {hint}");
    }
    assert!(Script::from_text("s.toml", &many(volume, 4096)).is_ok());
}

#[test]
fn files_that_are_missing_or_no_text_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("none.toml");
    let error = Script::open(&missing).unwrap_err().to_string();
    assert!(error.contains("none.toml"), "{error}");
    let bytes = folder.path().join("bytes.toml");
    std::fs::write(&bytes, b"a = 1\nb = \"\xff\"").unwrap();
    let error = Script::open(&bytes).unwrap_err().to_string();
    assert!(
        error.ends_with("bytes.toml, line 2: this is no UTF-8 text, found byte `0xff`"),
        "{error}"
    );
}

#[test]
fn a_script_in_memory_is_checked_before_it_is_written() {
    let mut own = Script::from_text("s.toml", WHOLE).unwrap();
    own.pushes[0].strength = f64::INFINITY;
    let error = own.to_text().unwrap_err();
    assert_eq!(error.to_string(), "[[push]] 1, strength takes 0 to 1000000, found `inf`");
}
