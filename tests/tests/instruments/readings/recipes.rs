//! Recipes in a file of their own: the fit gives the same library as one CSV of both.

use std::fmt::Write as _;

use suite::program::{Run, impasto, repository};

/// The shipped oils as two files: a CGATS file of all readings and a CSV of their recipes.
fn oils_apart() -> (String, String) {
    let text = std::fs::read_to_string(repository("measurements/van-gogh-oils.csv")).unwrap();
    let mut reader = csv_rows(&text);
    let header = reader.remove(0);
    let first_nm = header.iter().position(|name| name == "400").unwrap();
    let (labels, wavelengths) = header.split_at(first_nm);
    let mut cgats = String::from("CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_ID");
    for nm in wavelengths {
        write!(cgats, " SPECTRAL_NM{nm}").unwrap();
    }
    write!(cgats, "\nEND_DATA_FORMAT\nNUMBER_OF_SETS {}\nBEGIN_DATA\n", reader.len()).unwrap();
    let quoted = |cells: &[String]| {
        cells.iter().map(|cell| format!("\"{cell}\"")).collect::<Vec<_>>().join(",")
    };
    let mut recipes = format!("reading,{}\n", quoted(labels));
    for (row, number) in reader.iter().zip(1..) {
        let (labels, values) = row.split_at(first_nm);
        let name = format!("reading {number}");
        writeln!(cgats, "\"{name}\" {}", values.join(" ")).unwrap();
        writeln!(recipes, "{name},{}", quoted(labels)).unwrap();
    }
    cgats.push_str("END_DATA\n");
    (cgats, recipes)
}

/// Cells of a CSV whose quoted cells contain no quotes.
fn csv_rows(text: &str) -> Vec<Vec<String>> {
    let row = |line: &str| {
        let mut cells = vec![String::new()];
        let mut quoted = false;
        for c in line.chars() {
            match c {
                '"' => quoted = !quoted,
                ',' if !quoted => cells.push(String::new()),
                c => cells.last_mut().unwrap().push(c),
            }
        }
        cells
    };
    text.lines().map(row).collect()
}

#[test]
fn recipes_apart_give_the_library_of_the_csv() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (cgats, recipes) = oils_apart();
    std::fs::write(path("oils.txt"), cgats).unwrap();
    std::fs::write(path("recipes.csv"), recipes).unwrap();
    let one = path("one.json");
    let two = path("two.json");
    let csv = repository("measurements/van-gogh-oils.csv");
    let direct = impasto(&["fit", &csv, "--method", "weighted", "-o", &one]);
    assert_eq!(direct.status, 0, "{}", direct.err);
    let files = [&path("oils.txt"), "--recipes", &path("recipes.csv")];
    let run = impasto(&[&["fit"], &files[..], &["--method", "weighted", "-o", &two]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    let read = |path: &str| -> serde_json::Value {
        serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
    };
    let one = read(&one);
    let two = read(&two);
    assert!(one["pigments"].as_array().unwrap().len() > 10, "{}", one["pigments"]);
    for key in ["grid", "reference", "saunderson", "pigments"] {
        assert_eq!(one[key], two[key], "{key}");
    }
    let inputs = two["inputs"].as_array().unwrap();
    assert_eq!(inputs.len(), 2, "{inputs:?}");
    assert!(inputs.iter().all(|input| input["sha256"].as_str().unwrap().len() == 64), "{inputs:?}");
}

/// Readings of a white, a red, their mixture and a spare sample, without recipes.
const READINGS: &str = "\
sample,400,500,600
w,90,91,92
r,10,11,60
m,40,42,80
spare,50,50,50
";

const RECIPES: &str = "\
sample,White,Red
w,100,
r,,100
m,90,10
unread,50,50
";

fn fit(readings: &str, recipes: &str) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    std::fs::write(path("readings.csv"), readings).unwrap();
    std::fs::write(path("recipes.csv"), recipes).unwrap();
    impasto(&["fit", &path("readings.csv"), "--recipes", &path("recipes.csv"), "--json"])
}

#[test]
fn what_stands_on_one_side_only_is_said() {
    let run = fit(READINGS, RECIPES);
    assert_eq!(run.status, 0, "{}", run.err);
    assert_eq!(run.json()["samples"], 3);
    assert!(run.err.contains("without a recipe are left out: spare"), "{}", run.err);
    assert!(run.err.contains("recipes without a reading: unread"), "{}", run.err);
}

#[test]
fn faulty_recipes_are_refused_with_their_place() {
    let changed = |from: &str, to: &str| {
        assert!(RECIPES.contains(from), "{from}");
        RECIPES.replace(from, to)
    };
    for (recipes, words) in [
        (changed("unread", "m"), &["row 5", "`m`", "row 4", "hint"][..]),
        (changed("White,Red", "White,400"), &["row 1", "`400`", "hint"]),
        (changed("90,10", "90,x"), &["row 4", "`Red`", "`x`"]),
        (changed("90,10", ","), &["row 4", "sample m"]),
        ("sample,A\nq,1\n".to_owned(), &["recipes: q;", "readings: w, r, m, spare", "hint"]),
        ("sample,L*\nw,1\n".to_owned(), &["no column is a pigment"]),
    ] {
        let run = fit(READINGS, &recipes);
        assert_eq!(run.status, 1, "{recipes}\n{}", run.err);
        for word in words {
            assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
        }
    }
    let both = fit(&READINGS.replace("sample", "sample,White").replace(",4", ",1,4"), RECIPES);
    assert_ne!(both.status, 0, "{}", both.err);
}

#[test]
fn columns_of_instruments_are_no_pigments() {
    let run = fit(READINGS, &RECIPES.replace("Red\n", "Red,L*\n").replace("90,10", "90,10,55"));
    // The other rows lack a cell in the new column.
    assert_eq!(run.status, 1, "{}", run.err);
    let wide = RECIPES.lines().enumerate();
    let wide: String = wide
        .map(|(row, line)| format!("{line},{}\n", if row == 0 { "L*" } else { "55" }))
        .collect();
    let run = fit(READINGS, &wide);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.contains("are ignored: L*"), "{}", run.err);
    assert_eq!(run.json()["pigments"], 2, "{}", run.out);
}

/// Two amounts of one paint over paper, which is measured bare and stands in the first row.
const WASHES: &str = "\
sample,film,Blue,400,500,600
paper,none,,0.9,0.9,0.9
thin,paint,0.1,0.8,0.7,0.5
thick,paint,0.2,0.7,0.55,0.3
";

fn fit_washes(readings: &str, options: &[&str]) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    std::fs::write(path("washes.csv"), readings).unwrap();
    impasto(&[&["fit", &path("washes.csv"), "--json"], options].concat())
}

#[test]
fn washes_without_their_bare_paper_are_told_which_columns_they_need() {
    let absolute = ["--amounts", "absolute"];
    let run = fit_washes(WASHES, &absolute);
    assert_eq!(run.status, 0, "{}", run.err);
    let without: String = WASHES
        .lines()
        .map(|line| {
            let (name, rest) = line.split_once(',').unwrap();
            format!("{name},{}\n", rest.split_once(',').unwrap().1)
        })
        .collect();
    let unmarked = fit_washes(&without, &absolute);
    let no_paper = fit_washes(&without.replace("paper,,0.9,0.9,0.9\n", ""), &absolute);
    for (run, words) in [
        (unmarked, ["row 2: sample paper is paint", "column `film`", "`none`", "--recipes"]),
        (no_paper, ["no bare reading", "column `film`", "column `backing`", "--recipes"]),
    ] {
        assert_eq!(run.status, 1, "{}", run.err);
        assert!(!run.err.contains("``"), "{}", run.err);
        for word in words {
            assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
        }
    }
    let relative = fit_washes(&WASHES.replace("Blue", "White"), &[]);
    assert!(relative.out.contains("columns `film` and `backing`"), "{}", relative.out);
}
