//! Errors of the program: exit status 2 if it cannot run, 1 if it refuses the data.

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
        ("\"name\": \"Bone Black\"", "\"name\": \"Viridian\"", "occurs twice"),
        ("\"k2\": 0.6", "\"k2\": 1.6", "1.6"),
        ("\"reference\": \"Zinc White\"", "\"reference\": \"Chalk\"", "not in the library"),
        ("{", "[", "`format`"),
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
    // Another path of the input file.
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
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.contains("warning: spectra from 500 to 520 nm"), "{}", run.err);
}

#[test]
fn a_ground_must_be_one_spectrum() {
    let over = |ground: &str| {
        impasto(&["mix", &library(), "Viridian=1", "--thickness", "1", "--over", ground])
    };
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
