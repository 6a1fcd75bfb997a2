//! The verb, from a scan to maps and pictures.

use std::path::Path;

use serde_json::Value;
use suite::program::{Run, impasto};

use crate::scan::written;

fn map(scan: &Path, more: &[&str]) -> Run {
    let scan = scan.display().to_string();
    impasto(&[&["map", &scan], more].concat())
}

/// A figure of a pigment, or of the group that holds it.
fn figure(json: &Value, pigment: &str, figure: &str) -> f64 {
    let rows = json["palette"].as_array().unwrap();
    let row = rows.iter().find(|row| row["pigment"].as_str().unwrap().contains(pigment)).unwrap();
    row[figure].as_f64().unwrap()
}

#[test]
fn pigments_of_a_scan_are_found_with_their_shares() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written(folder.path(), 12, 1.0);
    let out = folder.path().join("maps.zarr").display().to_string();
    let pictures = folder.path().join("pictures");
    let run = map(&scan, &["-o", &out, "--pictures", &pictures.display().to_string(), "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    let json = run.json();
    // Parts of six patches, and shares averaged over them.
    for (pigment, present, share) in [
        ("Lead White", 3.0 / 6.0, 2.4 / 6.0),
        ("Chrome Yellow", 2.0 / 6.0, 1.7 / 6.0),
        ("Vermilion", 2.0 / 6.0, 1.3 / 6.0),
        ("Viridian", 1.0 / 6.0, 0.5 / 6.0),
        ("Ultramarine", 1.0 / 6.0, 0.1 / 6.0),
    ] {
        let found = figure(&json, pigment, "present");
        assert!((found - present).abs() < 0.05, "{pigment} present: {found}, not {present}");
        let found = figure(&json, pigment, "mean_share");
        assert!((found - share).abs() < 0.03, "{pigment} share: {found}, not {share}");
    }
    let groups: Vec<&Value> = json["groups"].as_object().unwrap().values().collect();
    let whites = groups.iter().any(|group| group.to_string().contains("Lead White"));
    assert!(whites, "the whites are alike from 400 to 700 nm: {groups:?}");
    let page = std::fs::read_to_string(pictures.join("maps.html")).unwrap();
    let parts = page.split("<th>").skip(1);
    let headings: Vec<&str> = parts.map(|part| part.split("</th>").next().unwrap()).collect();
    let distinct: std::collections::BTreeSet<&&str> = headings.iter().collect();
    assert!(headings.len() == 5 && distinct.len() == 5, "{headings:?}");
    assert!(
        page.contains("presence-vermilion.png") && pictures.join("presence-vermilion.png").exists()
    );
}

#[test]
fn a_library_that_is_exact_tells_whites_apart() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written(folder.path(), 6, 1.0);
    let json = map(&scan, &["--model-error", "0.02", "--json"]).json();
    assert_eq!(json["groups"], serde_json::json!({}), "{json}");
    assert!(!json.to_string().contains("-0.0"), "a part of nothing is 0: {json}");
    assert!((figure(&json, "Lead White", "survey_part") - 0.5).abs() < 0.1, "{json}");
    let wrong = map(&scan, &["--model-error", "7"]);
    assert!(wrong.status != 0 && wrong.err.contains("0.001 to 1"), "{}", wrong.err);
}

#[test]
fn maps_of_another_run_are_refused_and_those_of_this_one_continued() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written(folder.path(), 6, 1.0);
    let out = folder.path().join("maps.zarr");
    let text = out.display().to_string();
    assert_eq!(map(&scan, &["--out", &text]).status, 0);
    let again = map(&scan, &["-o", &text]);
    assert_eq!(again.status, 2, "{}", again.err);
    assert!(again.err.contains("holds maps") && again.err.contains("--resume"), "{}", again.err);
    let other = map(&scan, &["-o", &text, "--resume", "--at-most", "2"]);
    assert!(other.status != 0, "{}", other.out);
    // What a killed run has not written.
    let mask = out.join("mask/c/0/0");
    let whole = std::fs::read(&mask).unwrap();
    std::fs::remove_file(&mask).unwrap();
    let resumed = map(&scan, &["-o", &text, "--resume"]);
    assert_eq!(resumed.status, 0, "{}", resumed.err);
    assert_eq!(std::fs::read(&mask).unwrap(), whole);
}

#[test]
fn percent_and_regions_are_understood() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written(folder.path(), 6, 100.0);
    let run = map(&scan, &["--region", "0..6,8..16", "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    let json = run.json();
    assert!(figure(&json, "Chrome Yellow", "survey_part") > 0.95, "{json}");
    assert!(figure(&json, "Ultramarine", "survey_part") < 0.05, "{json}");
    let outside = map(&scan, &["--region", "0..7,0..24"]);
    assert_eq!(outside.status, 2, "{}", outside.err);
    assert!(outside.err.contains("6 x 24"), "{}", outside.err);
    let wrong = map(&scan, &["--region", "all"]);
    assert!(wrong.err.contains("--region 0..512,100..300"), "{}", wrong.err);
}

#[test]
fn a_survey_is_written_once_and_used_again() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written(folder.path(), 6, 1.0);
    let book = folder.path().join("survey.json").display().to_string();
    let first = map(&scan, &["--survey", &book, "--json"]);
    assert_eq!(first.status, 0, "{}", first.err);
    let second = map(&scan, &["--survey", &book, "--json"]);
    assert_eq!(second.json(), first.json(), "{}", second.err);
    let other = map(&scan, &["--survey", &book, "--palette", "Viridian"]);
    assert!(other.status != 0 && other.err.contains("hint"), "{}", other.err);
    let fewer = map(&scan, &["--survey", &book, "--at-most", "2"]);
    assert!(fewer.status != 0 && fewer.err.contains("survey the scan again"), "{}", fewer.err);
    let ground = map(&scan, &["--survey", &book, "--ground", "0..6,8..12"]);
    assert!(ground.status != 0 && ground.err.contains("survey the scan again"), "{}", ground.err);
    // As an earlier version wrote it.
    let text = std::fs::read_to_string(&book).unwrap();
    let earlier = text.replacen("\"version\":3", "\"version\":2", 1);
    assert_ne!(earlier, text);
    std::fs::write(&book, earlier).unwrap();
    let run = map(&scan, &["--survey", &book]);
    assert!(run.status != 0 && run.err.contains("version 2"), "{}", run.err);
    assert!(run.err.contains("survey.json") && run.err.contains("--survey"), "{}", run.err);
}

#[test]
fn ground_without_a_reflectance_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written(folder.path(), 6, 1.0);
    let data = folder.path().join("scan.bip");
    let mut bytes = std::fs::read(&data).unwrap();
    // The first four columns hold NaN.
    let pixel = bytes.len() / (6 * 24);
    for row in bytes.chunks_exact_mut(24 * pixel) {
        row[..4 * pixel]
            .chunks_exact_mut(4)
            .for_each(|b| b.copy_from_slice(&f32::NAN.to_le_bytes()));
    }
    std::fs::write(&data, bytes).unwrap();
    let run = map(&scan, &["--ground", "0..6,0..4"]);
    assert!(run.status == 2 && run.err.contains("no pixel that holds"), "{}", run.err);
    let run = map(&scan, &["--ground", "0..6,0..8"]);
    assert_eq!(run.status, 0, "{}", run.err);
}

#[test]
fn counts_without_a_white_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written(folder.path(), 6, 30_000.0);
    let run = map(&scan, &[]);
    assert!(run.status != 0 && run.err.contains("--white-reading"), "{}", run.err);
    let whites = map(&scan, &["--group", "whites"]);
    assert!(whites.status != 0, "{}", whites.out);
}

#[test]
fn spots_are_compared_with_their_mixtures() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written(folder.path(), 6, 1.0);
    let out = folder.path().join("maps.zarr").display().to_string();
    let pictures = folder.path().join("pictures");
    let shown = pictures.display().to_string();
    let spots = ["--spot", "0..6,8..12", "--spot", "3,5"];
    let run = map(&scan, &[&["-o", &out, "--pictures", &shown, "--json"][..], &spots].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    let json = run.json();
    let [yellow, green] = [&json["spots"][0], &json["spots"][1]];
    assert_eq!([&yellow["pixels"], &green["pixels"]], [24, 1]);
    assert_eq!(yellow["pigments"][0]["pigment"], "Chrome Yellow", "{yellow}");
    assert!(yellow["pigments"][0]["share"].as_f64().unwrap() > 0.98, "{yellow}");
    let names = green["pigments"].to_string();
    assert!(names.contains("Viridian") && names.contains("Lead White"), "{names}");
    for spot in [yellow, green] {
        let list = |key: &str| -> Vec<f64> { serde_json::from_value(spot[key].clone()).unwrap() };
        assert_eq!(list("measured_nm"), list("mapped_nm"), "the scan has the library's bands");
        let apart = list("measured").into_iter().zip(list("mapped")).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f64::max) < 0.03, "{spot}");
    }
    let page = std::fs::read_to_string(pictures.join("maps.html")).unwrap();
    assert_eq!(page.matches("<svg").count(), 2, "a chart each");
    let outside = map(&scan, &["--spot", "9,0"]);
    assert!(outside.status != 0 && !outside.err.is_empty(), "{}", outside.out);
    let wrong = map(&scan, &["--spot", "middle"]);
    assert!(wrong.status == 2 && wrong.err.contains("--spot 120,40"), "{}", wrong.err);
}
