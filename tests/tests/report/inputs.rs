//! Inputs of `impasto report`: library, readings and pair, refused inputs, and files that stay.

use suite::program::{impasto, repository};
use suite::watercolors::Watercolors;

use crate::made::{Work, files};

#[test]
fn without_readings_only_the_library_is_drawn() {
    let work = Work::new();
    let run = work.report("out", &["--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    let json = run.json();
    let names: Vec<&str> =
        json["figures"].as_array().unwrap().iter().map(|f| f["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"absorption") && names.contains(&"light"), "{names:?}");
    assert!(!names.contains(&"samples") && !names.contains(&"errors"), "{names:?}");
    assert!(json["samples"].is_null() && json["left_out"].is_null(), "{json}");
    for figure in json["figures"].as_array().unwrap() {
        for ending in ["svg", "png", "csv"] {
            let path = figure[ending].as_str().unwrap();
            assert!(std::path::Path::new(path).is_file(), "{path}");
        }
    }
}

#[test]
fn samples_of_pigments_that_the_library_lacks_are_left_out_and_named() {
    let work = Work::new();
    let oils = repository("measurements/van-gogh-oils.csv");
    let run = work.report("out", &[&oils, "--no-validation", "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.contains("the library has no ") && run.err.contains("Viridian"), "{}", run.err);
    let absent = run.json()["absent"].clone();
    let viridian = absent.as_array().unwrap().iter().find(|a| a["sample"] == "09A").unwrap();
    assert_eq!(viridian["pigments"][0], "Viridian");
    let page = std::fs::read_to_string(work.path("out/report.html")).unwrap();
    assert!(page.contains("the library has no "), "the page says so too");
    let samples = std::fs::read_to_string(work.path("out/figures/samples.csv")).unwrap();
    assert!(samples.contains("\n07A,") && !samples.contains("\n09A,"), "only 07 and 13 are shown");
}

#[test]
fn only_the_named_columns_are_pigments() {
    let work = Work::new();
    let readings = crate::made::readings();
    let waxed = readings.lines().enumerate().map(|(row, line)| {
        let (before, after) = line.split_once(',').unwrap();
        let wax = match row {
            0 => "Wax",
            _ if line.starts_with("12") => "3",
            _ => "",
        };
        format!("{before},{wax},{after}\n")
    });
    std::fs::write(work.path("waxed.csv"), waxed.collect::<String>()).unwrap();
    let csv = work.text("waxed.csv");
    let with = |names: &[&str]| {
        let options = names.iter().flat_map(|name| ["--pigments", *name]);
        let all = [csv.as_str(), "--no-validation", "--json"].into_iter().chain(options);
        work.report("out", &all.collect::<Vec<&str>>())
    };
    let headings = csv::Reader::from_reader(readings.as_bytes()).headers().unwrap().clone();
    let others = ["sample", "film", "backing"];
    let pigments =
        headings.iter().filter(|name| !others.contains(name) && name.parse::<f64>().is_err());
    let all = with(&[]);
    let named = with(&pigments.collect::<Vec<&str>>());
    assert_eq!((all.status, named.status), (0, 0), "{}{}", all.err, named.err);
    let [all, named_samples] = [&all, &named].map(|run| run.json()["samples"].as_u64().unwrap());
    assert!(all < named_samples, "the library has no wax");
    assert!(named.err.contains("are ignored: Wax"), "{}", named.err);
    let run = with(&["Bone Blacks"]);
    assert!(run.status == 1 && run.err.contains("`Bone Blacks`"), "{}", run.err);
}

#[test]
fn readings_of_other_pigments_are_refused_before_anything_is_written() {
    let work = Work::new();
    // Names are compared without case. Both sets have a Prussian blue, so we rename it.
    let csv = Watercolors::exact().csv().replace("prussian blue", "indigo");
    std::fs::write(work.path("other.csv"), csv).unwrap();
    let run = work.report("out", &[&work.text("other.csv")]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(
        run.err.contains("`cadmium red, ") && run.err.contains("hint: pigments"),
        "{}",
        run.err
    );
    assert!(!work.path("out").exists(), "nothing was written");
}

#[test]
fn readings_of_a_narrower_band_are_refused_and_of_a_wider_one_resampled() {
    let work = Work::new();
    let csv = work.text("narrow.csv");
    let json = work.text("library.json");
    // Cuts off the last 16 of 31 wavelengths.
    let readings = crate::made::readings();
    let narrow: Vec<&str> =
        readings.lines().map(|line| line.rsplitn(17, ',').last().unwrap()).collect();
    std::fs::write(&csv, narrow.join("\n")).unwrap();
    let run = work.report("out", &[&csv]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("400 to 550 nm") || run.err.contains("400 to 540 nm"), "{}", run.err);

    let narrow = impasto(&["fit", &csv, "--output", &json]);
    assert_eq!(narrow.status, 0, "{}", narrow.err);
    let run = work.report("out", &[&work.text("readings.csv"), "--no-validation"]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.contains("brought to the library's wavelengths"), "{}", run.err);
}

#[test]
fn an_input_is_never_written_over_and_foreign_files_stay() {
    let work = Work::new();
    std::fs::create_dir_all(work.path("out/figures")).unwrap();
    std::fs::write(work.path("out/figures/mine.txt"), "mine").unwrap();
    std::fs::write(work.path("out/report.html"), "old").unwrap();
    std::fs::copy(work.path("readings.csv"), work.path("out/figures/errors.csv")).unwrap();
    let before = files(&work.path("out"));
    let run = work.report("out", &[&work.text("out/figures/errors.csv"), "--no-validation"]);
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("is an input"), "{}", run.err);
    assert!(files(&work.path("out")) == before, "nothing was written");

    let run = work.report("out", &[&work.text("readings.csv"), "--no-validation"]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert_eq!(std::fs::read(work.path("out/figures/mine.txt")).unwrap(), b"mine");
    assert_ne!(std::fs::read(work.path("out/report.html")).unwrap(), b"old");
}

#[test]
fn a_pair_is_found_in_the_library_or_refused() {
    let work = Work::new();
    let run = work.report("out", &["--pair", "Bone Black", "Viridian"]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("`Viridian`") && run.err.contains("hint: pigments"), "{}", run.err);
    assert!(!work.path("out").exists(), "nothing was written");
    let run = work.report("out", &["--pair", "Bone Black", "bone"]);
    assert!(run.status == 2 && run.err.contains("`Bone Black` twice"), "{}", run.err);
}

#[test]
fn absolute_amounts_are_held_against_their_films() {
    let work = Work::new();
    let csv = work.text("washes.csv");
    let json = work.text("library.json");
    let made = Watercolors::exact();
    // All ladders and the first mixtures.
    let some: Vec<&str> = made.csv().lines().take(180).collect();
    std::fs::write(&csv, some.join("\n")).unwrap();
    let how = ["--amounts", "absolute", "--unevenness", "0"];
    let fit = impasto(&[&["fit", &csv, "--output", &json], &how[..]].concat());
    assert_eq!(fit.status, 0, "{}", fit.err);
    let run = work.report("out", &[&csv, "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    let json = run.json();
    assert_eq!(json["samples"], 178);
    assert!(json["delta_e"]["mean"].as_f64().unwrap() < 0.1, "{json}");
    assert!(json["left_out"]["mean"].as_f64().unwrap() < 0.2, "{json}");
    let parts = std::fs::read_to_string(work.path("out/figures/samples-3.svg")).unwrap();
    assert!(parts.contains("part 3 of 3"), "a printed page holds 84");
    let header = std::fs::read_to_string(work.path("out/figures/absorption.csv")).unwrap();
    assert!(header.contains("absorption K [per unit of amount]"), "the unit is that of amounts");
}
