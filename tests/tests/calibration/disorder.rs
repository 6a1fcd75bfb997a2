//! Recipes beside the wrong readings: `fit` warns, and says which order explains the colours.

use suite::program::{impasto, repository};

/// The oils, where the readings of each sample have the recipe of the sample at `order` of its place.
fn reordered(order: &dyn Fn(usize, usize) -> Option<usize>) -> Vec<u8> {
    let path = repository("measurements/van-gogh-oils.csv");
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_path(path).unwrap();
    let rows: Vec<Vec<String>> =
        reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect();
    let (head, rows) = rows.split_first().unwrap();
    // sample, film, backing, pigments, wavelengths
    let first_nm = head.iter().position(|name| name == "400").unwrap();
    let paint: Vec<&Vec<String>> = rows.iter().filter(|row| row[1] == "paint").collect();
    let mut samples: Vec<&str> = paint.iter().map(|row| row[0].as_str()).collect();
    samples.dedup();
    let mut out = csv::Writer::from_writer(Vec::new());
    out.write_record(head).unwrap();
    for row in rows {
        let mut row = row.clone();
        if row[1] == "paint" {
            let at = samples.iter().position(|name| *name == row[0]).unwrap();
            let Some(from) = order(at, samples.len()) else { continue };
            let recipe = paint.iter().find(|other| other[0] == samples[from]).unwrap();
            row[3..first_nm].clone_from_slice(&recipe[3..first_nm]);
        }
        out.write_record(&row).unwrap();
    }
    out.into_inner().unwrap()
}

#[test]
fn shuffled_recipes_of_the_oils_are_told_and_shifted_ones_are_found() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("oils.csv").display().to_string();
    type Order<'a> = &'a dyn Fn(usize, usize) -> Option<usize>;
    for (name, order, says) in [
        ("as measured", &(|at, _| Some(at)) as Order<'_>, ""),
        ("shuffled", &|at, count| Some((at * 37 + 11) % count), "none of these explains them"),
        ("one lower", &|at, _| at.checked_sub(1), "if each stands one row higher"),
        ("one higher", &|at, count| Some(at + 1).filter(|at| *at < count), "one row lower"),
        ("in reverse", &|at, count| Some(count - 1 - at), "in reverse order"),
    ] {
        std::fs::write(&path, reordered(order)).unwrap();
        let run =
            impasto(&["fit", &path, "--method", "weighted", "--white", "Zinc White", "--csv"]);
        assert_eq!(run.status, 0, "{name}: {}", run.err);
        let is_told = run.err.contains("warning: the recipes explain only");
        assert_eq!(is_told, !says.is_empty(), "{name}: {}", run.err);
        assert!(run.err.contains(says), "{name}: {}", run.err);
    }
}

#[test]
fn the_warning_is_in_the_library_and_comes_first() {
    let folder = tempfile::tempdir().unwrap();
    let [path, library] =
        ["oils.csv", "oils.json"].map(|name| folder.path().join(name).display().to_string());
    std::fs::write(&path, reordered(&|at, _| at.checked_sub(1))).unwrap();
    let options = ["--method", "weighted", "--white", "Zinc White", "--json", "--output", &library];
    let run = impasto(&[&["fit", &path], &options[..]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    let warning = run.json()["warnings"][0].as_str().unwrap().to_owned();
    assert!(warning.contains("if each stands one row higher"), "{warning}");
    let text = std::fs::read_to_string(&library).unwrap();
    let written: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(written["evidence"]["warnings"][0], *warning);
}
