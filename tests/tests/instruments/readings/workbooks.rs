//! Workbooks of readings and of recipes, and binary files: read like text, refused with sheet and cell.

use std::io::{Cursor, Write};

use suite::near::assert_near;
use suite::program::impasto;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::fixture;

const MAIN: &str = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
const OFFICE: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
const PACKAGE: &str = "http://schemas.openxmlformats.org/package/2006/relationships";

/// A workbook whose only sheet, `Readings`, has the cells of a CSV from its row `first` on.
fn workbook(csv: &str, first: usize) -> Vec<u8> {
    workbook_of(&[("Readings", csv)], first)
}

/// A workbook with sheets of these names, which have the cells of a CSV from their row `first` on.
fn workbook_of(sheets: &[(&str, &str)], first: usize) -> Vec<u8> {
    let cell = |text: &str, row: usize, column: usize| {
        let letter = char::from(b'A' + u8::try_from(column).unwrap());
        match text {
            "" => String::new(),
            text if text.parse::<f64>().is_ok() => {
                format!("<c r=\"{letter}{row}\"><v>{text}</v></c>")
            }
            text => format!("<c r=\"{letter}{row}\" t=\"str\"><v>{text}</v></c>"),
        }
    };
    let rows = |csv: &str| -> String {
        let rows = csv.lines().zip(first..).map(|(line, row)| {
            let cells = line.split(',').enumerate();
            let cells: String = cells.map(|(column, text)| cell(text, row, column)).collect();
            format!("<row r=\"{row}\">{cells}</row>")
        });
        rows.collect()
    };
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
        let xml =
            format!("<worksheet xmlns=\"{MAIN}\"><sheetData>{}</sheetData></worksheet>", rows(csv));
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
    let fit = |file: &str| impasto(&["fit", &path(file), "--json"]);
    let csv = fit("r.csv").json();
    for file in ["r.xlsx", "below.xlsx"] {
        let run = fit(file);
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
    let sheet = |name: &str| format!("{}#{name}", path("both.xlsx"));
    let run = impasto(&["fit", &sheet("Spectra"), "--recipes", &sheet("Recipes"), "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert_eq!(run.json()["delta_e"], csv["delta_e"]);
    assert!(!run.err.contains("is read, not"), "a sheet was named: {}", run.err);
    let run = impasto(&["fit", &sheet("Spectra"), "--recipes", &sheet("recipes"), "--json"]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("no sheet is called `recipes`; its sheets are Spectra, Recipes"));
    let over = ["--recipes", &sheet("Recipes"), "--output", &path("both.xlsx")];
    let run = impasto(&[&["fit", &sheet("Spectra")], &over[..]].concat());
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
    let lab =
        |json: &serde_json::Value| [0, 1, 2].map(|axis| json[0]["lab"][axis].as_f64().unwrap());
    assert_near("madder", &lab(&run.json()), &lab(&sheet), 1e-6);
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
            let told = run.err.contains(words) || run.err.contains("binary file");
            assert!(told, "{arguments:?}: `{words}` is missing: {}", run.err);
            assert!(
                run.err.chars().all(|c: char| !c.is_control() || c == '\n'),
                "{arguments:?}: {:?}",
                run.err
            );
        }
    }
}
