//! Workbooks (`.xlsx`): the sheet with the most numbers, as text with tabs between the cells.
//!
//! A cell keeps its row and column, so that messages name the places that you see in the sheet. For
//! a formula we take the value that the spreadsheet program stored.
//!
//! A small workbook can hold much: what it unpacks to, its cells and the text of its sheet take at most 64 MB
//! each.

use std::io::Cursor;

use calamine::{DataRef, DataType, Reader, Xlsx};

use super::decode::{Archive, MOST_BYTES, MOST_MB};
use super::measured::InstrumentError;
use documents::file::split_file_and_sheet;
use documents::{excerpt, foreign_message, name_list};

const FORMAT: &str = "Excel workbook";

/// We read at most this many columns. No instrument has so many wavelengths.
const MOST_COLUMNS: u32 = 8192;
/// Rows of a sheet, as spreadsheet programs have them.
const MOST_ROWS: u32 = 1 << 20;
/// An error lists at most this many names of sheets.
const NAMES: usize = 12;

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
    let archive = Archive::open(file, bytes);
    let mut archive = archive.map_err(|_| faulty("its directory is missing".to_owned()))?;
    if !archive.fits(MOST_BYTES) {
        return Err(InstrumentError::too_large(file, "the workbook, unpacked,", MOST_MB));
    }
    for name in archive.all(|name| name.to_ascii_lowercase().ends_with("sharedstrings.xml")) {
        let strings = count_strings(&archive.read(&name)?);
        if strings.saturating_mul(size_of::<String>()) > MOST_BYTES {
            return Err(InstrumentError::too_large(file, "the list of its texts", MOST_MB));
        }
    }
    for name in archive.all(|name| name.to_ascii_lowercase().ends_with(".xml")) {
        // The reader of workbooks names a part that it needs and cannot unpack.
        let Ok(xml) = archive.read(&name) else { continue };
        if let Some(place) = place_outside(&xml) {
            let place = excerpt(&String::from_utf8_lossy(place));
            return Err(faulty(format!(
                "`{}` names the cell `{place}`, which no sheet has",
                excerpt(&name)
            )));
        }
    }
    let mut workbook: Xlsx<_> =
        Xlsx::new(Cursor::new(bytes)).map_err(|reason| faulty(foreign_message(&reason)))?;
    let mut sheets = Vec::new();
    let mut left = MOST_BYTES;
    for name in workbook.sheet_names() {
        // A sheet of charts has no cells.
        let Ok(mut reader) = workbook.worksheet_cells_reader(&name) else { continue };
        let mut cells = Vec::new();
        loop {
            let cell = reader.next_cell();
            let cell = cell.map_err(|reason| {
                faulty(format!("sheet `{name}`: {}", foreign_message(&reason)))
            })?;
            let Some(cell) = cell else { break };
            let (row, column) = cell.get_position();
            if column >= MOST_COLUMNS {
                let fault = format!("sheet `{name}`: more than {MOST_COLUMNS} columns");
                return Err(faulty(fault));
            }
            if row >= MOST_ROWS {
                return Err(faulty(format!("sheet `{name}`: more than {MOST_ROWS} rows")));
            }
            if let Some(content) = content(cell.get_value()) {
                let text_bytes = if let Content::Text(text) = &content { text.len() } else { 0 };
                let Some(rest) = left.checked_sub(size_of::<Cell>() + text_bytes) else {
                    let what = format!("the cells up to row {} of sheet `{name}`", row + 1);
                    return Err(InstrumentError::too_large(file, what, MOST_MB));
                };
                left = rest;
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
    let Some(text) = text(cells) else {
        let what = format!("the text of sheet `{name}`");
        return Err(InstrumentError::too_large(file, what, MOST_MB));
    };
    Ok(Sheet { name, text, others: sheets.into_iter().map(|(name, _)| name).collect() })
}

/// The first place of a cell, such as `B12`, with more letters or digits than a sheet has columns or rows. Row
/// and column would overflow in the crate that reads workbooks.
fn place_outside(xml: &[u8]) -> Option<&[u8]> {
    let elements = xml.split(|byte| *byte == b'<').filter(|element| {
        let name = element.split(|byte| b"/> \t\r\n".contains(byte)).next().unwrap_or_default();
        let name = name.rsplit(|byte| *byte == b':').next().unwrap_or_default();
        [&b"c"[..], b"row", b"f", b"dimension", b"mergeCell"].contains(&name)
    });
    let mut attributes = elements.flat_map(|element| {
        let mut pieces = element.split(|byte| b"\"'".contains(byte));
        std::iter::from_fn(move || Some((pieces.next()?, pieces.next()?)))
    });
    let found = attributes.find(|(name, value)| {
        let name = name.trim_ascii_end().strip_suffix(b"=").unwrap_or_default().trim_ascii_end();
        let last = name.rsplit(|byte| byte.is_ascii_whitespace() || *byte == b':').next();
        let is_place = last.is_some_and(|last| last == b"r" || last == b"ref");
        is_place
            && value.split(|byte| *byte == b':').any(|place| {
                let letters = place.iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
                let digits = place[letters..].iter().take_while(|byte| byte.is_ascii_digit());
                letters > 3 || digits.count() > 7
            })
    });
    found.map(|(_, value)| value)
}

/// Number of texts that cells share: those that the list holds, or as many as it announces, for which the reader
/// takes memory at once. We look at bytes, so that we see elements that a damaged encoding hides.
fn count_strings(list: &[u8]) -> usize {
    let mut count = 0;
    let mut announced = 0;
    for element in list.split(|byte| *byte == b'<') {
        let name = element.split(|byte| b"/> \t\r\n".contains(byte)).next().unwrap_or_default();
        match name.rsplit(|byte| *byte == b':').next() {
            Some(b"si") => count += 1,
            Some(b"sst") => announced = announced.max(announced_count(element)),
            _ => {}
        }
    }
    count.max(announced)
}

/// The number in the attribute `uniqueCount`, 0 without it.
fn announced_count(element: &[u8]) -> usize {
    let name = b"uniqueCount";
    let Some(at) = element.windows(name.len()).position(|window| window == name) else { return 0 };
    let digits = element[at + name.len()..].iter().skip_while(|byte| !byte.is_ascii_digit());
    digits.take_while(|byte| byte.is_ascii_digit()).fold(0, |number: usize, digit| {
        number.saturating_mul(10).saturating_add(usize::from(digit - b'0'))
    })
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
    let rows = cells.chunk_by(|a, b| a.row == b.row).count();
    if rows.saturating_mul(width as usize) > MOST_BYTES {
        return None;
    }
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
    use documents::hint::Explain;

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

    /// The workbook `sheets` with another list of texts.
    fn with_strings(sheets: &[(&str, &str)], strings: &[u8]) -> Vec<u8> {
        let bytes = workbook(sheets);
        let mut archived = Archive::open("f", &bytes).unwrap();
        let mut names = vec!["_rels/.rels".to_owned(), "xl/workbook.xml".to_owned()];
        names.push("xl/_rels/workbook.xml.rels".to_owned());
        names.extend((1..=sheets.len()).map(|id| format!("xl/worksheets/sheet{id}.xml")));
        let mut files: Vec<(String, Vec<u8>)> = names
            .into_iter()
            .map(|name| {
                let content = archived.read(&name).unwrap();
                (name, content)
            })
            .collect();
        files.push(("xl/sharedStrings.xml".to_owned(), strings.to_vec()));
        let files: Vec<(&str, &[u8])> =
            files.iter().map(|(name, text)| (name.as_str(), &text[..])).collect();
        archive(&files)
    }

    #[test]
    fn workbooks_take_64_mb_at_most() {
        fn is_refused(bytes: &[u8], wanted: &str) {
            assert!(bytes.len() < 1 << 20, "a small file: {} bytes", bytes.len());
            let error = sheet("some.xlsx", bytes).unwrap_err();
            assert_eq!(error.to_string(), format!("some.xlsx: {wanted} takes more than 64 MB"));
            assert!(error.hint().unwrap().to_string().contains("save the sheet"), "{error}");
        }
        // Many cells that share one long text.
        let shared = format!("<sst><si><t>{}</t></si></sst>", "a".repeat(1 << 20));
        let cells =
            (1..=100).map(|row: u32| format!("<row r=\"{row}\"><c t=\"s\"><v>0</v></c></row>"));
        let bytes = with_strings(&[("A", &cells.collect::<String>())], shared.as_bytes());
        is_refused(&bytes, "the cells up to row 64 of sheet `A`");
        // Lists of texts that are long, or announce to be.
        let list = format!("<sst>{}</sst>", "<si/>".repeat(3_000_000));
        is_refused(&with_strings(&[("A", ROWS)], list.as_bytes()), "the list of its texts");
        let list = "<sst uniqueCount=\"9999999999999999\"><si><t>Red</t></si></sst>";
        is_refused(&with_strings(&[("A", ROWS)], list.as_bytes()), "the list of its texts");
        // One text of 64 MB.
        let long = [b"<sst><si><t>".to_vec(), vec![b'a'; 64 << 20], b"</t></si></sst>".to_vec()];
        is_refused(&with_strings(&[("A", ROWS)], &long.concat()), "the workbook, unpacked,");
        // Few cells that span many rows and columns.
        let spread = (1..=20_000).map(|row: u32| format!("<row r=\"{row}\"><c><v>1</v></c></row>"));
        let spread =
            spread.collect::<String>() + "<row r=\"20001\"><c r=\"EZZ20001\"><v>1</v></c></row>";
        is_refused(&workbook(&[("A", &spread)]), "the text of sheet `A`");
        let last = "<row r=\"1048577\"><c r=\"A1048577\"><v>1</v></c></row>";
        let error = sheet("some.xlsx", &workbook(&[("A", last)])).unwrap_err().to_string();
        assert!(error.contains("sheet `A`"), "{error}");
    }

    #[test]
    fn workbooks_that_are_empty_or_cut_are_refused_by_name() {
        let empty = sheet("some.xlsx", &workbook(&[("A", "")])).unwrap_err().to_string();
        assert!(empty.starts_with("some.xlsx: no spectrum in this Excel workbook"), "{empty}");
        let wide = ROWS.replace("D4", "XFD4");
        let wide = sheet("some.xlsx", &workbook(&[("A", &wide)])).unwrap_err().to_string();
        assert!(wide.contains("sheet `A`: more than 8192 columns"), "{wide}");
        for (found, place) in [
            ("r=\"B184467440737095516163\"", "B184467440737095516163"),
            ("r='FFFFFFFB3'", "FFFFFFFB3"),
            ("s=\"1\" r=\"A1:B99999999\"", "A1:B99999999"),
            ("t=\"inlineStr\"\nr = \"formats.org\"", "formats.org"),
        ] {
            let far = format!("<row r=\"1\"><c {found}><v>1</v></c></row>");
            let far = sheet("some.xlsx", &workbook(&[("A", &far)])).unwrap_err().to_string();
            assert!(far.contains(&format!("names the cell `{place}`")), "{far}");
        }
        let bytes = workbook(&[("A", ROWS)]);
        for length in 0..bytes.len() {
            let error = sheet("some.xlsx", &bytes[..length]).unwrap_err().to_string();
            assert!(error.starts_with("some.xlsx: faulty Excel workbook"), "{error}");
        }
    }
}
