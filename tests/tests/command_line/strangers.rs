//! Texts from files of strangers: names too long or with control characters are refused with their place,
//! nothing that a terminal obeys is printed, long texts are cut, and no cell is a formula.

use std::path::Path;

use documents::is_hidden;
use suite::program::{Run, impasto, repository};

/// The columns of a small table of readings, with `name` for a sample and `pigment` for a column.
fn readings(name: &str, pigment: &str) -> String {
    format!(
        "sample,film,backing,White,{pigment},400,550,700\n\
         a,paint,card,100,,90,91,92\n{name},paint,card,,100,10,11,60\n\
         c,paint,card,50,50,20,22,70\nd,paint,card,90,10,40,42,80\n"
    )
}

/// The library that ships, with `name` for one pigment, as it stands in a JSON file.
fn library(name: &str) -> String {
    let oils = std::fs::read_to_string(repository("measurements/van-gogh-oils.pigments.json"));
    let json = serde_json::Value::from(name).to_string();
    oils.unwrap().replacen("\"Viridian\"", &json, 1)
}

fn written(folder: &Path, name: &str, content: impl AsRef<[u8]>) -> String {
    let path = folder.join(name);
    std::fs::write(&path, content).unwrap();
    path.display().to_string()
}

/// Asserts that the program refused the data, in a few lines that a terminal can show.
fn refused(run: &Run, words: &[&str]) {
    assert_eq!(run.status, 1, "{}{}", run.out, run.err);
    for word in words {
        assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
    }
    harmless(&run.err);
}

fn harmless(text: &str) {
    assert!(!text.replace('\n', "").contains(is_hidden), "{text:?}");
    assert!(text.len() < 12_000, "{} bytes", text.len());
}

#[test]
fn names_of_more_than_200_letters_are_refused_with_their_place() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let long = "n".repeat(65_536);
    let sample = written(folder, "sample.csv", readings(&long, "Red"));
    let pigment = written(folder, "pigment.csv", readings("b", &long));
    let json = written(folder, "long.json", library(&long));
    let book = written(folder, "book.csv", format!("name,L,a,b\nSky,60,-5,-30\n{long},80,3,25\n"));
    let gpl = written(folder, "book.gpl", format!("GIMP Palette\n1 2 3\tSky\n4 5 6\t{long}\n"));
    let spectra = format!("nm\tSky\t{long}\n400\t0.1\t0.2\n500\t0.2\t0.3\n600\t0.3\t0.5\n");
    let spectra = written(folder, "spectra.txt", spectra);
    let oils = repository("measurements/van-gogh-oils.pigments.json");
    let output = folder.join("out.json").display().to_string();
    let most = "at most 200 letters";
    let runs: &[(&[&str], &[&str])] = &[
        (&["fit", &sample, "-o", &output], &["sample.csv, row 3, column `sample`", most]),
        (&["fit", &pigment, "-o", &output], &["pigment.csv, row 1, column `nnn", most]),
        (&["validate", &sample], &["row 3", most]),
        (&["color", &sample], &[most]),
        (&["color", &spectra], &["spectra.txt, line 2", most]),
        (&["library", "list", &json], &["long.json: pigment number ", most]),
        (&["library", "check", &json], &[most]),
        (&["mix", &json, "Zinc White=1"], &[most]),
        (&["match", &oils, &book], &["book.csv, row 3, column `name`", most]),
        (&["match", &oils, &gpl], &["book.gpl, line 3", most]),
        (&["library", "diff", &oils, &json], &[most]),
    ];
    for (arguments, words) in runs {
        let run = impasto(arguments);
        refused(&run, words);
        assert!(!Path::new(&output).exists(), "{arguments:?}");
    }
    let longest = "n".repeat(200);
    let json = written(folder, "long.json", library(&longest));
    let run = impasto(&["library", "list", &json]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.out.contains(&longest));
}

#[test]
fn a_library_with_control_characters_in_a_name_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["\u{1b}[2J\u{1b}[31mEVIL", "a\u{202e}b", "a\u{9b}31m", "a\nerror: b", " "] {
        let path = written(folder.path(), "library.json", library(name));
        for verb in [&["library", "list"][..], &["library", "check"], &["mix"]] {
            let run = impasto(
                &[verb, &[path.as_str(), "Zinc White=1"][..2 - verb.len().min(1)]].concat(),
            );
            assert_ne!(run.status, 0, "{verb:?} of {name:?}");
            harmless(&run.err);
        }
        let run = impasto(&["library", "list", &path]);
        refused(&run, &["library.json: pigment number ", "a name "]);
    }
    let titled = library("Viridian").replacen("Van Gogh's oils", "\\u001b]0;owned\\u0007", 1);
    let path = written(folder.path(), "title.json", titled);
    refused(&impasto(&["library", "list", &path]), &["title.json: the title needs"]);
}

#[test]
fn nothing_that_a_terminal_obeys_is_printed() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let evil = "\u{1b}[31m\u{202e}\u{9b}2J";
    let cell = written(folder, "cell.csv", readings("b", "Red").replace("22", evil));
    let missing = folder.join(format!("{evil}.csv")).display().to_string();
    let toml = written(folder, "style.toml", "\"\\u001b[31m\\u202e\" = 1\n");
    let photo = repository("docs/images/photograph.png");
    let oils = repository("measurements/van-gogh-oils.pigments.json");
    let named = format!("nm\tSky{evil}\n400\t0.1\n500\t0.2\n600\t0.3\n700\t0.4\n");
    let named = written(folder, "named.txt", named);
    let output = folder.join("a.png").display().to_string();
    for arguments in [
        vec!["fit", &cell],
        vec!["fit", &missing],
        vec!["color", &missing],
        vec!["color", &named],
        vec!["color", &named, "--json"],
        vec!["color", &named, "--csv"],
        vec!["mix", &oils, &missing],
        vec!["mix", &missing, "White=1"],
        vec![&*missing],
        vec!["watercolor", &photo, "--settings", &toml, "-o", &output],
        vec!["watercolor", &missing, "-o", &output],
        vec!["paint", &missing, "-o", &output],
        vec!["stencil", &missing, "-o", &output],
        vec!["map", &missing, &oils],
    ] {
        let run = impasto(&arguments);
        harmless(&run.err);
        harmless(&run.out);
        assert!(!run.err.is_empty() || !run.out.is_empty(), "{arguments:?}");
    }
}

#[test]
fn a_long_cell_is_not_echoed_whole() {
    let folder = tempfile::tempdir().unwrap();
    let long = "9x ".repeat(500_000);
    let cell = written(folder.path(), "cell.csv", readings("b", "Red").replace("22", &long));
    refused(&impasto(&["fit", &cell]), &["row 4", "column `550`", "9x 9x", ".."]);
    let text = format!("{{\"format\": \"{long}\"}}");
    let json = written(folder.path(), "long.json", text);
    refused(&impasto(&["library", "list", &json]), &["`format` must be", "letters more]"]);
}

fn names(path: &str) -> Vec<String> {
    let library = calibrate::library::PigmentLibrary::open(path).unwrap();
    library.pigments.into_iter().map(|pigment| pigment.name).collect()
}

#[test]
fn cells_of_csv_are_no_formulas_and_are_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for name in ["=HYPERLINK(\"http://x\")", "@SUM(1+1)", "+1+cmd", "-1+1", "'=1", "-5"] {
        let json = written(folder, "library.json", library(name));
        let table = folder.join("table.csv").display().to_string();
        let run = impasto(&["library", "export", &json, "-o", &table]);
        assert_eq!(run.status, 0, "{}", run.err);
        let text = std::fs::read_to_string(&table).unwrap();
        let listed = impasto(&["library", "list", &json, "--csv"]);
        assert_eq!(listed.status, 0, "{}", listed.err);
        for text in [&text, &listed.out] {
            let mut rows =
                csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
            for cell in rows
                .records()
                .flat_map(|row| row.unwrap().iter().map(str::to_owned).collect::<Vec<_>>())
            {
                let is_formula = cell.starts_with(['=', '+', '-', '@']);
                assert!(!is_formula || cell.parse::<f64>().is_ok(), "{cell}");
            }
        }
        let back = folder.join("back.json").display().to_string();
        let run = impasto(&["library", "convert", &table, "-o", &back]);
        assert_eq!(run.status, 0, "{}", run.err);
        assert_eq!(names(&back), names(&json));
        let readings = readings(&documents::spreadsheet_cell(name).replace('"', ""), "Red");
        let path = written(folder, "readings.csv", &readings);
        let run = impasto(&["color", &path, "--json"]);
        assert_eq!(run.status, 0, "{}", run.err);
        let found = run.json().to_string();
        let plain = serde_json::Value::from(name.replace('"', "")).to_string();
        assert!(found.contains(&plain), "{found}");
    }
}
