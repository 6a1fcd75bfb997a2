//! `impasto map`, from a scan to maps and pictures, and errors of left-out mixtures from `impasto validate`
//! to the maps.

use std::path::{Path, PathBuf};

use calibrate::{PigmentLibrary, Residuals};
use serde_json::Value;
use suite::program::{Run, impasto, repository};

use crate::simulated::written_scan;

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
    let scan = written_scan(folder.path(), 12, 1.0);
    let out = folder.path().join("maps.zarr").display().to_string();
    let pictures = folder.path().join("pictures");
    let run = map(&scan, &["-o", &out, "--pictures", &pictures.display().to_string(), "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    let json = run.json();
    // Amounts of six patches, and shares averaged over them.
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
    let scan = written_scan(folder.path(), 6, 1.0);
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
    let scan = written_scan(folder.path(), 6, 1.0);
    let out = folder.path().join("maps.zarr");
    let text = out.display().to_string();
    assert_eq!(map(&scan, &["--out", &text]).status, 0);
    let again = map(&scan, &["-o", &text]);
    assert_eq!(again.status, 2, "{}", again.err);
    assert!(again.err.contains("holds maps") && again.err.contains("--resume"), "{}", again.err);
    let other = map(&scan, &["-o", &text, "--resume", "--at-most", "2"]);
    assert!(other.status != 0, "{}", other.out);
    // A killed run has not written this.
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
    let scan = written_scan(folder.path(), 6, 100.0);
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
    let scan = written_scan(folder.path(), 6, 1.0);
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
    // This is how an earlier version wrote it.
    let text = std::fs::read_to_string(&book).unwrap();
    let earlier = text.replacen("\"version\":4", "\"version\":2", 1);
    assert_ne!(earlier, text);
    std::fs::write(&book, earlier).unwrap();
    let run = map(&scan, &["--survey", &book]);
    assert!(run.status != 0 && run.err.contains("version 2"), "{}", run.err);
    assert!(run.err.contains("survey.json") && run.err.contains("--survey"), "{}", run.err);
}

#[test]
fn ground_without_a_reflectance_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written_scan(folder.path(), 6, 1.0);
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
    let scan = written_scan(folder.path(), 6, 30_000.0);
    let run = map(&scan, &[]);
    assert!(run.status != 0 && run.err.contains("--white-reading"), "{}", run.err);
    let whites = map(&scan, &["--group", "whites"]);
    assert!(whites.status != 0, "{}", whites.out);
}

#[test]
fn spots_are_compared_with_their_mixtures() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written_scan(folder.path(), 6, 1.0);
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
    assert!(yellow["pigments"][0]["share"].as_f64().unwrap() > 0.95, "{yellow}");
    let names = green["pigments"].to_string();
    assert!(names.contains("Viridian") && names.contains("Lead White"), "{names}");
    for spot in [yellow, green] {
        let lists = ["measured_nm", "mapped_nm", "measured", "mapped"];
        let [measured_nm, mapped_nm, measured, mapped] =
            lists.map(|key| -> Vec<f64> { serde_json::from_value(spot[key].clone()).unwrap() });
        assert_eq!(measured_nm, mapped_nm, "the scan has the library's bands");
        let apart = measured.into_iter().zip(mapped).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f64::max) < 0.03, "{spot}");
    }
    let page = std::fs::read_to_string(pictures.join("maps.html")).unwrap();
    assert_eq!(page.matches("<svg").count(), 2, "a chart each");
    let outside = map(&scan, &["--spot", "9,0"]);
    assert!(outside.status != 0 && !outside.err.is_empty(), "{}", outside.out);
    let wrong = map(&scan, &["--spot", "middle"]);
    assert!(wrong.status == 2 && wrong.err.contains("--spot 120,40"), "{}", wrong.err);
}

const OILS: &str = "measurements/van-gogh-oils.csv";

fn map_with_residuals(scan: &Path, more: &[&str]) -> Run {
    let scan = scan.display().to_string();
    impasto(&[&["map", &scan], more].concat())
}

/// Writes residuals to a file of `folder`.
fn file(folder: &Path, name: &str, residuals: &Residuals) -> String {
    let path = folder.join(name);
    residuals.save(&path).unwrap();
    path.display().to_string()
}

/// The shipped library under another title, so that there are no residuals for it.
fn renamed(folder: &Path) -> String {
    let mut oils = PigmentLibrary::van_gogh_oils();
    oils.title = "others".to_owned();
    let path = folder.join("others.json");
    oils.save(&path).unwrap();
    path.display().to_string()
}

fn attributes(out: &Path) -> Value {
    let text = std::fs::read_to_string(out.join("zarr.json")).unwrap();
    let group: Value = serde_json::from_str(&text).unwrap();
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
    let scan = written_scan(folder.path(), 6, 1.0);
    let library = renamed(folder.path());
    let mut half = Residuals::van_gogh_oils();
    half.mixtures.truncate(32);
    let file = file(folder.path(), "half.json", &half);
    let out = folder.path().join("maps.zarr");
    let path = out.display().to_string();
    let all = [&library, "--residuals", &file, "-o", &path, "--json"];
    let run = map_with_residuals(&scan, &all);
    assert_eq!(run.status, 0, "{}", run.err);
    let expected = serde_json::json!({
        "left_out_mixtures": 32,
        "residuals_sha256": half.sha256(),
    });
    assert_eq!(run.json()["settings"]["model_error"], expected);
    assert_eq!(attributes(&out)["settings"]["model_error"], expected);
    // If a killed run has not written a file, the next run writes it with the same bytes.
    let whole = bytes(&out);
    std::fs::remove_file(out.join("mask/c/0/0")).unwrap();
    let resumed = map_with_residuals(&scan, &[&all[..], &["--resume"]].concat());
    assert_eq!(resumed.status, 0, "{}", resumed.err);
    assert!(bytes(&out) == whole, "the bytes of one run");
    let other = map_with_residuals(&scan, &[&library, "-o", &path, "--resume"]);
    assert!(other.status != 0 && other.err.contains("another run"), "{}", other.err);
}

#[test]
fn a_survey_of_other_residuals_is_refused_with_both() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written_scan(folder.path(), 6, 1.0);
    let book = folder.path().join("survey.json").display().to_string();
    let mut half = Residuals::van_gogh_oils();
    half.mixtures.truncate(32);
    let half = file(folder.path(), "half.json", &half);
    assert_eq!(
        map_with_residuals(&scan, &["--survey", &book, "--residuals", &half]).status,
        0,
        "the first"
    );
    for other in [&[][..], &["--model-error", "0.1"]] {
        let run = map_with_residuals(&scan, &[&["--survey", &book][..], other].concat());
        assert!(run.status != 0 && run.err.contains("32 left-out mixtures"), "{}", run.err);
        assert!(run.err.contains("--residuals"), "{}", run.err);
    }
}

#[test]
fn oils_that_ship_have_their_residuals_and_others_are_told_of_them() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written_scan(folder.path(), 6, 1.0);
    let shipped = map_with_residuals(&scan, &["--json"]);
    let settings = &shipped.json()["settings"]["model_error"];
    assert_eq!(settings["residuals_sha256"], Residuals::van_gogh_oils().sha256(), "{settings}");
    assert!(!shipped.err.contains("validate"), "{}", shipped.err);
    let other = map_with_residuals(&scan, &[&renamed(folder.path()), "--json"]);
    assert_eq!(other.json()["settings"]["model_error"], 0.1);
    assert!(other.err.contains("off by 10 %") && other.err.contains("validate"), "{}", other.err);
    let stated = map_with_residuals(&scan, &[&renamed(folder.path()), "--model-error", "0.1"]);
    assert!(!stated.err.contains("validate"), "{}", stated.err);
}

#[test]
fn residuals_that_do_not_serve_are_refused_with_the_way_out() {
    let folder = tempfile::tempdir().unwrap();
    let scan = written_scan(folder.path(), 6, 1.0);
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
        let run = map_with_residuals(&scan, &["--residuals", file]);
        assert!(run.status != 0, "{file}: {}", run.out);
        assert!(words.iter().all(|word| run.err.contains(word)), "{words:?}: {}", run.err);
    }
    let both = map_with_residuals(&scan, &["--residuals", &few, "--model-error", "0.1"]);
    assert!(both.status == 2 && both.err.contains("cannot be used with"), "{}", both.err);
}

/// A table of spectra of known mixtures, in percent if `percent`.
fn spots(folder: &Path, percent: bool) -> String {
    let oils = PigmentLibrary::van_gogh_oils();
    let nm: Vec<String> = oils.grid.wavelengths_nm().map(|nm| nm.to_string()).collect();
    let mut text = format!("sample,{}\n", nm.join(","));
    let known: [(&str, &[(&str, f64)]); 3] = [
        ("sky", &[("Lead White", 0.9), ("Ultramarine", 0.1)]),
        ("cheek", &[("Lead White", 0.7), ("Vermilion", 0.3)]),
        ("corn", &[("Chrome Yellow", 1.0)]),
    ];
    for (name, parts) in known {
        let mixture = oils.mix(oils.recipe(parts.iter().copied()).unwrap()).unwrap();
        let scale = if percent { 100.0 } else { 1.0 };
        let values = mixture.hiding(oils.saunderson).into_iter();
        let values: Vec<String> = values.map(|value| format!("{:.5}", scale * value)).collect();
        text += &format!("{name},{}\n", values.join(","));
    }
    let comb = (0..oils.grid.count()).map(|at| if at % 4 < 2 { "0.05" } else { "0.9" });
    if !percent {
        text += &format!("comb,{}\n", comb.collect::<Vec<_>>().join(","));
    }
    let path = folder.join(if percent { "percent.csv" } else { "spots.csv" });
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

#[test]
fn pigments_of_measured_spots_are_identified() {
    let folder = tempfile::tempdir().unwrap();
    for percent in [false, true] {
        let spots = spots(folder.path(), percent);
        let run = impasto(&["identify", &spots, "--json"]);
        assert_eq!(run.status, 0, "{}", run.err);
        let json = run.json();
        for (at, spot, pigment, share) in [
            (0, "sky", "Ultramarine", 0.1),
            (1, "cheek", "Vermilion", 0.3),
            (2, "corn", "Chrome Yellow", 1.0),
        ] {
            let found = &json["spectra"][at];
            assert_eq!([&found["spectrum"], &found["result"]], [spot, "mapped"], "{found}");
            let pigments = found["pigments"].as_array().unwrap();
            let own =
                pigments.iter().find(|one| one["pigment"].as_str().unwrap().contains(pigment));
            let own = own.unwrap_or_else(|| panic!("{pigment}: {pigments:?}"));
            let near = (own["share"].as_f64().unwrap() - share).abs() < 0.05;
            assert!(near && own["presence"].as_f64().unwrap() > 0.5, "{own}");
            assert!(found["sets"][0]["probability"].as_f64().unwrap() > 0.1, "{found}");
            assert!(found["chi2"].as_f64().unwrap() < 1.0, "{found}");
        }
        assert!(run.err.contains("2 of 20 pigments take no part"), "{}", run.err);
        assert!(run.err.contains("Zinc White (linseed), Chrome Yellow (poppyseed)"), "{}", run.err);
        assert!(run.err.contains("--palette"), "{}", run.err);
    }
    let spots = folder.path().join("spots.csv").display().to_string();
    let text = impasto(&["identify", &format!("{spots}#cheek")]);
    assert!(text.out.contains("cheek: residual") && text.out.contains("Vermilion"), "{}", text.out);
    assert!(!text.out.contains("sky"), "one spectrum by name: {}", text.out);
    let whole = impasto(&["identify", &spots, "--csv"]);
    let head = "spectrum,result,set,probability,pigment,share,share_sd,presence,chi2,rms\n";
    assert!(whole.out.starts_with(head), "{}", whole.out);
    let comb = whole.out.lines().find(|line| line.starts_with("comb,")).unwrap();
    assert!(comb.starts_with("comb,out of gamut,,,,,,,"), "{comb}");
}

#[test]
fn spectra_of_an_envi_library_are_identified_and_no_scan() {
    let folder = tempfile::tempdir().unwrap();
    let oils = PigmentLibrary::van_gogh_oils();
    let recipe = oils.recipe([("Lead White", 0.7), ("Vermilion", 0.3)]).unwrap();
    let curve = oils.mix(recipe).unwrap().hiding(oils.saunderson);
    let nm: Vec<String> = oils.grid.wavelengths_nm().map(|nm| nm.to_string()).collect();
    let header = format!(
        "ENVI\nsamples = {}\nlines = 1\nbands = 1\ndata type = 12\nfile type = ENVI Spectral Library\n\
         wavelength units = Nanometers\nreflectance scale factor = 10000\nspectra names = {{cheek}}\n\
         wavelength = {{{}}}\n",
        nm.len(),
        nm.join(", ")
    );
    let data = curve.iter().flat_map(|value| ((value * 10_000.0).round() as u16).to_le_bytes());
    let [head, own] = ["skin.hdr", "skin.sli"].map(|name| folder.path().join(name));
    std::fs::write(&head, header).unwrap();
    std::fs::write(&own, data.collect::<Vec<u8>>()).unwrap();
    for path in [head, own].map(|path| path.display().to_string()) {
        let run = impasto(&["identify", &path]);
        assert_eq!(run.status, 0, "{}", run.err);
        assert!(
            run.out.contains("cheek: residual 0.00") && run.out.contains("Vermilion"),
            "{}",
            run.out
        );
        let refused = impasto(&["map", &path]);
        assert!(refused.status == 1 && refused.err.contains("impasto identify"), "{}", refused.err);
        assert!(refused.err.contains("which is not a scan"), "{}", refused.err);
    }
}

#[test]
fn what_identify_and_map_cannot_read_is_refused_with_the_other_verb() {
    let folder = tempfile::tempdir().unwrap();
    let spots = spots(folder.path(), false);
    let library = repository("measurements/van-gogh-oils.pigments.json");
    let missing = folder.path().join("lost.csv").display().to_string();
    let scan = written_scan(folder.path(), 6, 8000.0).display().to_string();
    for (words, status, message) in [
        (vec!["map", &spots], 1, "holds spectra of points, not a scan"),
        (vec!["map", &spots], 1, "impasto identify"),
        (vec!["identify", &missing], 2, "cannot be read"),
        (vec!["identify", &library, &spots], 2, "the spectra go first"),
        (vec!["identify", &spots, "--at-most", "9"], 2, "at_most must be 1 to 4"),
        (vec!["identify", &spots, "--palette", "Gamboge"], 2, "Gamboge"),
        (vec!["map", &scan], 1, "--scale 10000"),
        (vec!["map", &scan, "--scale", "white"], 2, "found `white`"),
        (vec!["map", &scan, "--scale", "8000", "--percent"], 2, "cannot be used with"),
    ] {
        let run = impasto(&words);
        assert_eq!(run.status, status, "{words:?}: {}", run.err);
        assert!(run.err.contains(message), "{words:?}: {}", run.err);
    }
    let run = impasto(&["map", &scan, "--scale", "8000", "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(figure(&run.json(), "Lead White", "survey_part") > 0.3, "{}", run.out);
    let text = std::fs::read_to_string(&scan).unwrap() + "data units = Reflectance\n";
    std::fs::write(&scan, text).unwrap();
    let run = impasto(&["map", &scan, "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.contains("warning: a white is taken to read 10000"), "{}", run.err);
    assert!(run.err.contains("--scale 10000"), "{}", run.err);
}
