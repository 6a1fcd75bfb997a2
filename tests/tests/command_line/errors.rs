//! What cannot run, and what data deny.

use suite::program::{impasto, repository};

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
        vec!["mix", library.as_str(), "Zinc White"],
        vec!["mix", library.as_str(), "Zinc White=1", "--thickness", "0"],
        vec!["mix", library.as_str(), "Zinc White=1", "--over", "grey"],
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
    for recipe in [["Zinc White=0"], ["Zinc White=-1"], ["Zinc White=NaN"]] {
        let run = impasto(&["mix", &library(), recipe[0]]);
        assert_eq!(run.status, 1, "{recipe:?}: {}", run.err);
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
        ("\"name\": \"Zinc White\"", "\"name\": \"Bone Black\"", "stands twice"),
        ("\"k2\": 0.6", "\"k2\": 1.6", "1.6"),
        ("{", "[", "expected"),
    ] {
        assert!(sound.contains(from), "{from}");
        std::fs::write(&path, sound.replacen(from, to, 1)).unwrap();
        let run = impasto(&["library", "list", path.to_str().unwrap()]);
        assert_eq!(run.status, 1, "{from}: {}", run.err);
        assert!(run.err.contains("library.json") && run.err.contains(word), "{from}: {}", run.err);
    }
}

#[test]
fn a_lamp_with_a_fault_is_refused_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let lamp = folder.path().join("lamp.csv");
    std::fs::write(&lamp, "nm,power\n400,1\n500,-2\n").unwrap();
    let run = impasto(&["mix", &library(), "Viridian=1", "--illuminant", lamp.to_str().unwrap()]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("lamp.csv, line 3") && run.err.contains("`-2`"), "{}", run.err);
}

#[test]
fn help_is_a_result() {
    for arguments in [vec!["--help"], vec!["fit", "--help"], vec!["library", "list", "--help"]] {
        let run = impasto(&arguments);
        assert_eq!((run.status, run.err.as_str()), (0, ""), "{arguments:?}");
        assert!(run.out.contains("Usage"), "{}", run.out);
    }
}
