//! Workbooks (`.xlsx`): the sheet with the most numbers, as text with tabs between the cells.
//!
//! A cell keeps its row and column, so that messages name the places that you see in the sheet. For
//! a formula we take the value that the spreadsheet program stored.

use std::io::Cursor;

use calamine::{DataRef, DataType, Reader, Xlsx};

use super::measured::InstrumentError;
use documents::file::split_file_and_sheet;
use documents::name_list;

const FORMAT: &str = "Excel workbook";

/// We read at most this many columns. No instrument has so many wavelengths.
const MOST_COLUMNS: u32 = 8192;
/// An error lists at most this many names of sheets.
const NAMES: usize = 12;
const MOST_BYTES: usize = 512 << 20;

#[derive(Debug, PartialEq)]
pub(super) struct Sheet {
    pub(super) name: String,
    /// One line a row, with tabs between the cells. Line number and row number agree.
    pub(super) text: String,
    /// Names of the other sheets that are not empty.
    pub(super) others: Vec<String>,
}

enum Content {
    Number(f64),
    Text(String),
}

struct Cell {
    row: u32,
    column: u32,
    content: Content,
}

/// The sheet that `file` names as `FILE.xlsx#SHEET`. If it names none, you get the first of the
/// sheets with the most numbers.
pub(super) fn sheet(file: &str, bytes: &[u8]) -> Result<Sheet, InstrumentError> {
    let (file, wanted) = split_file_and_sheet(file);
    let faulty = |fault: String| InstrumentError::faulty(file, FORMAT, fault);
    let mut workbook: Xlsx<_> =
        Xlsx::new(Cursor::new(bytes)).map_err(|reason| faulty(reason.to_string()))?;
    let mut sheets = Vec::new();
    for name in workbook.sheet_names() {
        // A sheet of charts has no cells.
        let Ok(mut reader) = workbook.worksheet_cells_reader(&name) else { continue };
        let mut cells = Vec::new();
        loop {
            let cell = reader.next_cell();
            let cell = cell.map_err(|reason| faulty(format!("sheet `{name}`: {reason}")))?;
            let Some(cell) = cell else { break };
            let (row, column) = cell.get_position();
            if column >= MOST_COLUMNS {
                let fault = format!("sheet `{name}`: more than {MOST_COLUMNS} columns");
                return Err(faulty(fault));
            }
            if let Some(content) = content(cell.get_value()) {
                cells.push(Cell { row, column, content });
            }
        }
        if !cells.is_empty() {
            sheets.push((name, cells));
        }
    }
    let most = sheets.iter().map(count_numbers).max().unwrap_or(0);
    let Some(chosen) = sheets.iter().position(|sheet| match wanted {
        Some(wanted) => sheet.0 == wanted,
        None => count_numbers(sheet) == most,
    }) else {
        let names: Vec<String> = sheets.into_iter().map(|(name, _)| name).collect();
        return Err(match wanted.filter(|_| !names.is_empty()) {
            Some(sheet) => InstrumentError::NoSheet {
                file: file.to_owned(),
                sheet: sheet.to_owned(),
                sheets: name_list(&names, NAMES, ", "),
            },
            None => InstrumentError::Empty { file: file.to_owned(), format: FORMAT },
        });
    };
    let (name, cells) = sheets.remove(chosen);
    let text = text(cells);
    let text = text.ok_or_else(|| faulty(format!("sheet `{name}` is too large")))?;
    Ok(Sheet { name, text, others: sheets.into_iter().map(|(name, _)| name).collect() })
}

fn count_numbers((_, cells): &(String, Vec<Cell>)) -> usize {
    cells.iter().filter(|cell| matches!(cell.content, Content::Number(_))).count()
}

/// Content of a cell, or `None` if it is empty.
fn content(cell: &DataRef<'_>) -> Option<Content> {
    match cell {
        DataRef::Empty => None,
        DataRef::Int(_) | DataRef::Float(_) | DataRef::DateTime(_) => {
            cell.as_f64().map(Content::Number)
        }
        DataRef::String(found) => text_content(found),
        DataRef::SharedString(found) => text_content(found),
        DataRef::Bool(found) => text_content(if *found { "TRUE" } else { "FALSE" }),
        DataRef::DateTimeIso(found) | DataRef::DurationIso(found) => text_content(found),
        DataRef::Error(found) => text_content(&found.to_string()),
    }
}

fn text_content(text: &str) -> Option<Content> {
    let plain = documents::plain_name(text);
    (!plain.is_empty()).then_some(Content::Text(plain))
}

/// The text of a sheet, or `None` if it is too long. Numbers get a decimal comma if texts have one,
/// e.g. in a column that was pasted as text.
fn text(mut cells: Vec<Cell>) -> Option<String> {
    cells.sort_by_key(|cell| (cell.row, cell.column));
    let has_comma = cells.iter().any(|cell| match &cell.content {
        Content::Text(text) => {
            text.contains(',') && text.bytes().all(|b| b.is_ascii_digit() || b"-,".contains(&b))
        }
        Content::Number(_) => false,
    });
    // Rows of one width, so that empty cells at their ends are not missing.
    let width = cells.iter().map(|cell| cell.column).max().unwrap_or(0);
    let mut text = String::new();
    let mut row = 0;
    let mut column = 0;
    for cell in cells {
        while row < cell.row {
            if column > 0 {
                (column..width).for_each(|_| text.push('\t'));
            }
            text.push('\n');
            (row, column) = (row + 1, 0);
        }
        while column < cell.column {
            text.push('\t');
            column += 1;
        }
        match cell.content {
            Content::Number(number) if has_comma => {
                text.push_str(&number.to_string().replace('.', ","));
            }
            Content::Number(number) => text.push_str(&number.to_string()),
            Content::Text(found) if found.contains('"') => {
                text.push_str(&format!("\"{}\"", found.replace('"', "\"\"")));
            }
            Content::Text(found) => text.push_str(&found),
        }
        if text.len() > MOST_BYTES {
            return None;
        }
    }
    (column..width).for_each(|_| text.push('\t'));
    text.push('\n');
    Some(text)
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::decode::tests::archive;
    use super::*;

    /// A workbook with sheets of this name and XML of rows.
    pub(in super::super) fn workbook(sheets: &[(&str, &str)]) -> Vec<u8> {
        let list: String = sheets
            .iter()
            .zip(1..)
            .map(|((name, _), id)| {
                format!("<sheet name=\"{name}\" sheetId=\"{id}\" r:id=\"rId{id}\"/>")
            })
            .collect();
        let relations: String = sheets.iter().zip(1..)
            .map(|(_, id)| {
                format!(
                    "<Relationship Id=\"rId{id}\" Type=\"http://schemas.openxmlformats.org/officeDocument/2006/relationships/worksheet\" Target=\"worksheets/sheet{id}.xml\"/>"
                )
            })
            .collect();
        let main = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
        let book = format!(
            "<workbook xmlns=\"{main}\" xmlns:r=\"http://schemas.openxmlformats.org/officeDocument/2006/relationships\"><sheets>{list}</sheets></workbook>"
        );
        let relations = format!(
            "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">{relations}</Relationships>"
        );
        let root = "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship Id=\"rId1\" Type=\"http://schemas.openxmlformats.org/officeDocument/2006/relationships/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>";
        let strings = format!("<sst xmlns=\"{main}\"><si><t>Red</t></si></sst>");
        let mut files = vec![
            ("_rels/.rels".to_owned(), root.to_owned()),
            ("xl/workbook.xml".to_owned(), book),
            ("xl/_rels/workbook.xml.rels".to_owned(), relations),
            ("xl/sharedStrings.xml".to_owned(), strings),
        ];
        for ((_, rows), id) in sheets.iter().zip(1..) {
            let sheet =
                format!("<worksheet xmlns=\"{main}\"><sheetData>{rows}</sheetData></worksheet>");
            files.push((format!("xl/worksheets/sheet{id}.xml"), sheet));
        }
        let files: Vec<(&str, &[u8])> =
            files.iter().map(|(name, text)| (name.as_str(), text.as_bytes())).collect();
        archive(&files)
    }

    pub(in super::super) const ROWS: &str = "<row r=\"2\"><c r=\"B2\" t=\"inlineStr\"><is><t>Name</t></is></c>\
        <c r=\"C2\"><v>400</v></c><c r=\"D2\"><v>500</v></c></row>\
        <row r=\"4\"><c r=\"B4\" t=\"s\"><v>0</v></c><c r=\"C4\"><f>1/8</f><v>0.125</v></c>\
        <c r=\"D4\"><v>0.25</v></c></row>";

    #[test]
    fn cells_keep_their_rows_and_columns_and_formulas_their_values() {
        let note = "<row r=\"1\"><c r=\"A1\" t=\"inlineStr\"><is><t>a \"note\"</t></is></c></row>";
        let found = sheet("f", &workbook(&[("Notes", note), ("Readings", ROWS)])).unwrap();
        assert_eq!(found.name, "Readings");
        assert_eq!(found.text, "\n\tName\t400\t500\n\n\tRed\t0.125\t0.25\n");
        assert_eq!(found.others, ["Notes"]);
        let comma =
            ROWS.replace("<c r=\"D4\"><v>0.25</v></c>", "<c r=\"D4\" t=\"str\"><v>0,25</v></c>");
        let found = sheet("f", &workbook(&[("A", &comma)])).unwrap();
        assert!(found.text.ends_with("\tRed\t0,125\t0,25\n"), "{}", found.text);
        let found = sheet("f", &workbook(&[("Notes", note)])).unwrap();
        assert_eq!(found.text, "\"a \"\"note\"\"\"\n");
    }

    #[test]
    fn a_sheet_is_taken_by_its_name() {
        let few = "<row r=\"1\"><c r=\"A1\"><v>7</v></c></row>";
        let bytes = workbook(&[("Readings", ROWS), ("Red # 2", few)]);
        assert_eq!(sheet("a.xlsx", &bytes).unwrap().name, "Readings");
        let found = sheet("a.XLSX#Red # 2", &bytes).unwrap();
        assert_eq!((found.name.as_str(), found.text.as_str()), ("Red # 2", "7\n"));
        assert_eq!(found.others, ["Readings"]);
        let error = sheet("a.xlsx#red", &bytes).unwrap_err().to_string();
        assert_eq!(error, "a.xlsx: no sheet is called `red`; its sheets are Readings, Red # 2");
        assert_eq!(split_file_and_sheet("a#b.csv"), ("a#b.csv", None));
        assert_eq!(split_file_and_sheet("a.xlsx#"), ("a.xlsx#", None));
    }

    #[test]
    fn workbooks_that_are_empty_or_cut_are_refused_by_name() {
        let empty = sheet("some.xlsx", &workbook(&[("A", "")])).unwrap_err().to_string();
        assert!(empty.starts_with("some.xlsx: no spectrum in this Excel workbook"), "{empty}");
        let wide = ROWS.replace("D4", "XFD4");
        let wide = sheet("some.xlsx", &workbook(&[("A", &wide)])).unwrap_err().to_string();
        assert!(wide.contains("sheet `A`: more than 8192 columns"), "{wide}");
        let bytes = workbook(&[("A", ROWS)]);
        for length in 0..bytes.len() {
            let error = sheet("some.xlsx", &bytes[..length]).unwrap_err().to_string();
            assert!(error.starts_with("some.xlsx: faulty Excel workbook"), "{error}");
        }
    }
}
