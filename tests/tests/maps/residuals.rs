//! Errors of left-out mixtures, from `impasto validate` to the maps.

use std::path::{Path, PathBuf};

use calibrate::{PigmentLibrary, Residuals};
use suite::program::{Run, impasto, repository};

use crate::scan::written;

const OILS: &str = "measurements/van-gogh-oils.csv";

/// Runs `impasto map`.
fn map(scan: &Path, more: &[&str]) -> Run {
    let scan = scan.display().to_string();
    impasto(&[&["map", &scan], more].concat())
}

/// Residuals as a file of `folder`.
fn file(folder: &Path, name: &str, residuals: &Residuals) -> String {
    let path = folder.join(name);
    residuals.save(&path).unwrap();
    path.display().to_string()
}

/// The library that ships under another title, for which no residuals ship.
fn renamed(folder: &Path) -> String {
    let mut oils = PigmentLibrary::van_gogh_oils();
    oils.title = "others".to_owned();
    let path = folder.join("others.json");
    oils.save(&path).unwrap();
    path.display().to_string()
}

/// Attributes of the maps at `out`.
fn attributes(out: &Path) -> serde_json::Value {
    let text = std::fs::read_to_string(out.join("zarr.json")).unwrap();
    let group: serde_json::Value = serde_json::from_str(&text).unwrap();
    group["attributes"].clone()
}

/// All files of the maps at `out` with their bytes.
fn bytes(out: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut found = Vec::new();
    let mut folders = vec![out.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => folders.push(path),
                false => {
                    let name = path.strip_prefix(out).unwrap().to_owned();
                    found.push((name, std::fs::read(&path).unwrap()));
                }
            }
        }
    }
    found.sort();
    found
}

#[test]
fn the_shipped_residuals_are_what_validate_writes_byte_for_byte() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("residuals.json");
    let oils = repository(OILS);
    let path = out.display().to_string();
    let surface = ["--saunderson", "0.03,0.6", "--below-surface", "floor"];
    let run = impasto(&[&["validate", &oils, "--residuals", &path][..], &surface].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.contains("Wrote "), "{}", run.err);
    let made = std::fs::read_to_string(&out).unwrap().replace(&oils, OILS);
    let shipped = std::fs::read_to_string(repository("measurements/van-gogh-oils.residuals.json"));
    let same = shipped.unwrap() == made;
    assert!(
        same,
        "to renew it: impasto validate {OILS} --saunderson 0.03,0.6 --below-surface floor --residuals measurements/van-gogh-oils.residuals.json"
    );
}

#[test]
fn residuals_need_films_that_hide_and_a_file_that_is_no_input() {
    let oils = repository(OILS);
    let run = impasto(&["validate", &oils, "--amounts", "absolute", "--residuals", "r.json"]);
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("relative amounts"), "{}", run.err);
    let run = impasto(&["validate", &oils, "--residuals", &oils]);
    assert!(run.status == 2 && run.err.contains("never overwritten"), "{}", run.err);
}

#[test]
fn maps_tell_the_residuals_and_are_continued_with_the_same_alone() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written(folder.path(), 6, 1.0);
    let library = renamed(folder.path());
    let mut half = Residuals::van_gogh_oils();
    half.mixtures.truncate(32);
    let file = file(folder.path(), "half.json", &half);
    let out = folder.path().join("maps.zarr");
    let path = out.display().to_string();
    let all = [&library, "--residuals", &file, "-o", &path, "--json"];
    let run = map(&scan, &all);
    assert_eq!(run.status, 0, "{}", run.err);
    let expected = serde_json::json!({
        "left_out_mixtures": 32,
        "residuals_sha256": half.sha256(),
    });
    assert_eq!(run.json()["settings"]["model_error"], expected);
    assert_eq!(attributes(&out)["settings"]["model_error"], expected);
    // What a killed run has not written is written again to the same bytes.
    let whole = bytes(&out);
    std::fs::remove_file(out.join("mask/c/0/0")).unwrap();
    let resumed = map(&scan, &[&all[..], &["--resume"]].concat());
    assert_eq!(resumed.status, 0, "{}", resumed.err);
    assert!(bytes(&out) == whole, "the bytes of one run");
    let other = map(&scan, &[&library, "-o", &path, "--resume"]);
    assert!(other.status != 0 && other.err.contains("another run"), "{}", other.err);
}

#[test]
fn a_survey_of_other_residuals_is_refused_with_both() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written(folder.path(), 6, 1.0);
    let book = folder.path().join("survey.json").display().to_string();
    let mut half = Residuals::van_gogh_oils();
    half.mixtures.truncate(32);
    let half = file(folder.path(), "half.json", &half);
    assert_eq!(map(&scan, &["--survey", &book, "--residuals", &half]).status, 0, "the first");
    for other in [&[][..], &["--model-error", "0.1"]] {
        let run = map(&scan, &[&["--survey", &book][..], other].concat());
        assert!(run.status != 0 && run.err.contains("32 left-out mixtures"), "{}", run.err);
        assert!(run.err.contains("--residuals"), "{}", run.err);
    }
}

#[test]
fn oils_that_ship_have_their_residuals_and_others_are_told_of_them() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written(folder.path(), 6, 1.0);
    let shipped = map(&scan, &["--json"]);
    let settings = &shipped.json()["settings"]["model_error"];
    assert_eq!(settings["residuals_sha256"], Residuals::van_gogh_oils().sha256(), "{settings}");
    assert!(!shipped.err.contains("validate"), "{}", shipped.err);
    let other = map(&scan, &[&renamed(folder.path()), "--json"]);
    assert_eq!(other.json()["settings"]["model_error"], 0.1);
    assert!(other.err.contains("off by 10 %") && other.err.contains("validate"), "{}", other.err);
    let stated = map(&scan, &[&renamed(folder.path()), "--model-error", "0.1"]);
    assert!(!stated.err.contains("validate"), "{}", stated.err);
}

#[test]
fn residuals_that_do_not_serve_are_refused_with_the_way_out() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written(folder.path(), 6, 1.0);
    let oils = Residuals::van_gogh_oils();
    let mut few = oils.clone();
    few.mixtures.truncate(9);
    let few = file(folder.path(), "few.json", &few);
    let narrow = oils.on_grid(spectra::Grid::from_range(420.0, 700.0, 10.0).unwrap()).unwrap();
    let narrow = file(folder.path(), "narrow.json", &narrow);
    let library = repository("measurements/van-gogh-oils.pigments.json");
    let missing = folder.path().join("missing.json").display().to_string();
    for (file, words) in [
        (&few, ["few.json", "`9` mixtures", "--model-error"]),
        (&narrow, ["narrow.json", "420", "--model-error"]),
        (&library, ["pigments.json", "impasto-residuals", "--residuals"]),
        (&missing, ["missing.json", "error", ""]),
    ] {
        let run = map(&scan, &["--residuals", file]);
        assert!(run.status != 0, "{file}: {}", run.out);
        assert!(words.iter().all(|word| run.err.contains(word)), "{words:?}: {}", run.err);
    }
    let both = map(&scan, &["--residuals", &few, "--model-error", "0.1"]);
    assert!(both.status == 2 && both.err.contains("cannot be used with"), "{}", both.err);
}
