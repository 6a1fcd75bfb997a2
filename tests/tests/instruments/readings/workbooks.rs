//! Workbooks of readings and of recipes, and binary files: read like text, refused with sheet and
//! cell. If recipes are in a separate file, the fit gives the same library as one CSV of both.

use std::fmt::Write as _;
use std::io::{Cursor, Write};

use suite::golden::assert_near;
use suite::program::{Run, impasto, repository};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::fixture;

const MAIN: &str = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
const OFFICE: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
const PACKAGE: &str = "http://schemas.openxmlformats.org/package/2006/relationships";

/// A workbook with the cells of a CSV from row `first` on in its only sheet, `Readings`.
pub(super) fn workbook(csv: &str, first: usize) -> Vec<u8> {
    workbook_of(&[("Readings", csv)], first)
}

/// A workbook with sheets of these names. Each has the cells of a CSV from row `first` on.
fn workbook_of(sheets: &[(&str, &str)], first: usize) -> Vec<u8> {
    fn cell(text: &str, row: usize, column: usize) -> String {
        let letter = char::from(b'A' + u8::try_from(column).unwrap());
        match text {
            "" => String::new(),
            text if text.parse::<f64>().is_ok() => {
                format!("<c r=\"{letter}{row}\"><v>{text}</v></c>")
            }
            text => format!("<c r=\"{letter}{row}\" t=\"str\"><v>{text}</v></c>"),
        }
    }
    let mut list = String::new();
    let mut relations = String::new();
    for ((name, _), id) in sheets.iter().zip(1..) {
        list += &format!("<sheet name=\"{name}\" sheetId=\"{id}\" r:id=\"rId{id}\"/>");
        relations += &format!(
            "<Relationship Id=\"rId{id}\" Type=\"{OFFICE}/worksheet\" Target=\"worksheets/sheet{id}.xml\"/>"
        );
    }
    let mut files = vec![
        (
            "_rels/.rels".to_owned(),
            format!(
                "<Relationships xmlns=\"{PACKAGE}\"><Relationship Id=\"rId1\" Type=\"{OFFICE}/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>"
            ),
        ),
        (
            "xl/workbook.xml".to_owned(),
            format!(
                "<workbook xmlns=\"{MAIN}\" xmlns:r=\"{OFFICE}\"><sheets>{list}</sheets></workbook>"
            ),
        ),
        (
            "xl/_rels/workbook.xml.rels".to_owned(),
            format!("<Relationships xmlns=\"{PACKAGE}\">{relations}</Relationships>"),
        ),
    ];
    for ((_, csv), id) in sheets.iter().zip(1..) {
        let rows = csv.lines().zip(first..).map(|(line, row)| {
            let cells = line.split(',').enumerate();
            let cells: String = cells.map(|(column, text)| cell(text, row, column)).collect();
            format!("<row r=\"{row}\">{cells}</row>")
        });
        let rows: String = rows.collect();
        let xml = format!("<worksheet xmlns=\"{MAIN}\"><sheetData>{rows}</sheetData></worksheet>");
        files.push((format!("xl/worksheets/sheet{id}.xml"), xml));
    }
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    for (name, text) in files {
        writer.start_file(name, options).unwrap();
        writer.write_all(text.as_bytes()).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

const READINGS: &str = "\
sample,film,White,Red,400,500,600
w,paint,100,,90,91,92
r,paint,,100,10,11,60
m,paint,90,10,40.5,42,80
";

#[test]
fn a_workbook_gives_what_its_csv_gives() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    std::fs::write(path("r.csv"), READINGS).unwrap();
    std::fs::write(path("r.xlsx"), workbook(READINGS, 1)).unwrap();
    std::fs::write(path("below.xlsx"), workbook(&format!("Paints of 2026\n\n{READINGS}"), 3))
        .unwrap();
    let [csv, one, below] =
        ["r.csv", "r.xlsx", "below.xlsx"].map(|file| impasto(&["fit", &path(file), "--json"]));
    let csv = csv.json();
    for (file, run) in [("r.xlsx", one), ("below.xlsx", below)] {
        assert_eq!(run.status, 0, "{}", run.err);
        assert!(run.err.contains(&format!("{file}, sheet `Readings`: 3 readings")), "{}", run.err);
        assert_eq!(run.json()["delta_e"], csv["delta_e"], "{file}");
    }
    let names = READINGS.lines().map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        ([&cells[..1], &cells[4..]].concat().join(","), cells[..4].join(","))
    });
    let (spectra, recipes): (Vec<String>, Vec<String>) = names.unzip();
    std::fs::write(path("spectra.xlsx"), workbook(&spectra.join("\n"), 1)).unwrap();
    std::fs::write(path("recipes.xlsx"), workbook(&recipes.join("\n"), 1)).unwrap();
    let run =
        impasto(&["fit", &path("spectra.xlsx"), "--recipes", &path("recipes.xlsx"), "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert_eq!(run.json()["delta_e"], csv["delta_e"]);

    let both = [("Spectra", spectra.join("\n")), ("Recipes", recipes.join("\n"))];
    let both = both.each_ref().map(|(name, csv)| (*name, csv.as_str()));
    std::fs::write(path("both.xlsx"), workbook_of(&both, 1)).unwrap();
    let [spectra, recipes, wrong] =
        ["Spectra", "Recipes", "recipes"].map(|name| format!("{}#{name}", path("both.xlsx")));
    let run = impasto(&["fit", &spectra, "--recipes", &recipes, "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert_eq!(run.json()["delta_e"], csv["delta_e"]);
    assert!(!run.err.contains("is read, not"), "a sheet was named: {}", run.err);
    let run = impasto(&["fit", &spectra, "--recipes", &wrong, "--json"]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("no sheet is called `recipes`; its sheets are Spectra, Recipes"));
    let over = ["--recipes", &recipes, "--output", &path("both.xlsx")];
    let run = impasto(&[&["fit", &spectra], &over[..]].concat());
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("is an input file"), "{}", run.err);
}

#[test]
fn faults_in_a_workbook_name_sheet_and_cell() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("r.xlsx");
    let file = file.to_str().unwrap();
    for (from, to, words) in [
        ("40.5", "x", ["sheet `Readings`, cell E6", "column `400`", "found `x`"]),
        ("40.5", "", ["sheet `Readings`, cell E6", "column `400`", "fill in"]),
        ("11,60", "1100,60", ["sheet `Readings`, cell F5", "column `500`", "`1100`"]),
        ("90,10,40", "-1,10,40", ["sheet `Readings`, cell C6", "column `White`", "`-1`"]),
        ("400,500", "500,500", ["sheet `Readings`, cell F3", "column `500`", "twice"]),
    ] {
        std::fs::write(file, workbook(&READINGS.replacen(from, to, 1), 3)).unwrap();
        let run = impasto(&["fit", file]);
        assert_eq!(run.status, 1, "{to}: {}", run.err);
        for word in words {
            assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
        }
    }
    let whole = workbook(READINGS, 1);
    std::fs::write(file, &whole[..whole.len() / 2]).unwrap();
    let run = impasto(&["fit", file]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("r.xlsx: faulty") && run.err.contains("cut off"), "{}", run.err);
}

#[test]
fn columns_in_a_workbook_are_colors() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("madder.xlsx");
    let csv = "nm,Madder\n400,0.2\n450,0.105\n500,0.12\n550,0.1525\n600,0.6\n650,0.7\n700,0.75\n";
    std::fs::write(&file, workbook(csv, 2)).unwrap();
    let run = impasto(&["color", file.to_str().unwrap(), "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.contains("Excel workbook"), "{}", run.err);
    let sheet = impasto(&["color", &fixture("sheet.csv"), "--json"]).json();
    let [found, wanted] = [run.json(), sheet]
        .map(|json| [0, 1, 2].map(|axis| json[0]["lab"][axis].as_f64().unwrap()));
    assert_near("madder", &found, &wanted, 1e-6);
}

#[test]
fn binary_files_are_named_and_none_of_their_bytes_is_printed() {
    let folder = tempfile::tempdir().unwrap();
    let noise: Vec<u8> = (0..255).cycle().take(4000).collect();
    let white = "--white";
    for (name, first, words) in [
        ("old.xls", &b"\xd0\xcf\x11\xe0"[..], "old Excel workbook"),
        ("some.0", b"\x0a\x0a\xfe\xfe", "Bruker OPUS"),
        ("some.mesx", b"", "SpectraMagic DX"),
        ("some.dat", b"", "no known format"),
        ("cut.asd", b"as7\0\0\0", "ASD FieldSpec"),
    ] {
        let file = folder.path().join(name);
        std::fs::write(&file, [first, &noise].concat()).unwrap();
        let file = file.to_str().unwrap();
        let csv = fixture("sheet.csv");
        for arguments in [
            &["color", file][..],
            &["fit", file],
            &["fit", file, "--format", "csv"],
            &["fit", &csv, "--recipes", file],
            &["color", &csv, "--illuminant", file],
            &["color", &fixture("spectrasuite.txt"), white, file],
            &["color", file, "--format", "columns"],
        ] {
            let run = impasto(arguments);
            assert!(run.status != 0 && run.out.is_empty(), "{arguments:?}: {}{}", run.out, run.err);
            assert!(run.err.contains(name) && run.err.is_ascii(), "{arguments:?}: {}", run.err);
            assert!(run.err.contains("hint: "), "{arguments:?}: {}", run.err);
            let is_reported = run.err.contains(words) || run.err.contains("binary file");
            assert!(is_reported, "{arguments:?}: `{words}` is missing: {}", run.err);
            assert!(
                run.err.chars().all(|c: char| !c.is_control() || c == '\n'),
                "{arguments:?}: {:?}",
                run.err
            );
        }
    }
}

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
    fn quoted(cells: &[String]) -> String {
        cells.iter().map(|cell| format!("\"{cell}\"")).collect::<Vec<_>>().join(",")
    }
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

/// Cells of a CSV. Quoted cells must not contain quotes.
fn csv_rows(text: &str) -> Vec<Vec<String>> {
    let rows = text.lines().map(|line| {
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
    });
    rows.collect()
}

#[test]
fn recipes_apart_give_the_library_of_the_csv() {
    let folder = tempfile::tempdir().unwrap();
    let names = ["oils.txt", "recipes.csv", "one.json", "two.json"];
    let [readings, mixed, one, two] =
        names.map(|name| folder.path().join(name).to_str().unwrap().to_owned());
    let (cgats, recipes) = oils_apart();
    std::fs::write(&readings, cgats).unwrap();
    std::fs::write(&mixed, recipes).unwrap();
    let csv = repository("measurements/van-gogh-oils.csv");
    let direct = impasto(&["fit", &csv, "--method", "weighted", "-o", &one]);
    assert_eq!(direct.status, 0, "{}", direct.err);
    let files = [&readings, "--recipes", &mixed];
    let run = impasto(&[&["fit"], &files[..], &["--method", "weighted", "-o", &two]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    let [one, two] = [one, two].map(|path| -> serde_json::Value {
        serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
    });
    assert!(one["pigments"].as_array().unwrap().len() > 10, "{}", one["pigments"]);
    for key in ["grid", "reference", "saunderson", "pigments"] {
        assert_eq!(one[key], two[key], "{key}");
    }
    let inputs = two["inputs"].as_array().unwrap();
    assert_eq!(inputs.len(), 2, "{inputs:?}");
    assert!(inputs.iter().all(|input| input["sha256"].as_str().unwrap().len() == 64), "{inputs:?}");
}

/// Readings of a white, a red, their mixture and a spare sample, without recipes.
const PAINT_READINGS: &str = "\
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
    let [readings_file, recipes_file] = ["readings.csv", "recipes.csv"]
        .map(|name| folder.path().join(name).to_str().unwrap().to_owned());
    std::fs::write(&readings_file, readings).unwrap();
    std::fs::write(&recipes_file, recipes).unwrap();
    impasto(&["fit", &readings_file, "--recipes", &recipes_file, "--json"])
}

#[test]
fn what_stands_on_one_side_only_is_said() {
    let run = fit(PAINT_READINGS, RECIPES);
    assert_eq!(run.status, 0, "{}", run.err);
    assert_eq!(run.json()["samples"], 3);
    assert!(run.err.contains("without a recipe are left out: spare"), "{}", run.err);
    assert!(run.err.contains("recipes without a reading: unread"), "{}", run.err);
}

#[test]
fn faulty_recipes_are_refused_with_their_place() {
    fn changed(from: &str, to: &str) -> String {
        assert!(RECIPES.contains(from), "{from}");
        RECIPES.replace(from, to)
    }
    for (recipes, words) in [
        (changed("unread", "m"), &["row 5", "`m`", "row 4", "hint"][..]),
        (changed("White,Red", "White,400"), &["row 1", "`400`", "hint"]),
        (changed("90,10", "90,x"), &["row 4", "`Red`", "`x`"]),
        (changed("90,10", ","), &["row 4", "sample m"]),
        ("sample,A\nq,1\n".to_owned(), &["recipes: q;", "readings: w, r, m, spare", "hint"]),
        ("sample,L*\nw,1\n".to_owned(), &["no column is a pigment"]),
    ] {
        let run = fit(PAINT_READINGS, &recipes);
        assert_eq!(run.status, 1, "{recipes}\n{}", run.err);
        for word in words {
            assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
        }
    }
    let both =
        fit(&PAINT_READINGS.replace("sample", "sample,White").replace(",4", ",1,4"), RECIPES);
    assert_ne!(both.status, 0, "{}", both.err);
}

#[test]
fn columns_of_instruments_are_no_pigments() {
    let run =
        fit(PAINT_READINGS, &RECIPES.replace("Red\n", "Red,L*\n").replace("90,10", "90,10,55"));
    // The other rows lack a cell in the new column.
    assert_eq!(run.status, 1, "{}", run.err);
    let wide = RECIPES.lines().enumerate();
    let wide: String = wide
        .map(|(row, line)| format!("{line},{}\n", if row == 0 { "L*" } else { "55" }))
        .collect();
    let run = fit(PAINT_READINGS, &wide);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.contains("are ignored: L*"), "{}", run.err);
    assert_eq!(run.json()["pigments"], 2, "{}", run.out);
}

/// Two amounts of one paint over paper. The bare paper is in the first row.
const WASHES: &str = "\
sample,film,Blue,400,500,600
paper,none,,0.9,0.9,0.9
thin,paint,0.1,0.8,0.7,0.5
thick,paint,0.2,0.7,0.55,0.3
";

fn fit_washes(readings: &str, options: &[&str]) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("washes.csv");
    std::fs::write(&file, readings).unwrap();
    impasto(&[&["fit", file.to_str().unwrap(), "--json"], options].concat())
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
