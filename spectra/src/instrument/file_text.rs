//! The text of a file, or that of a workbook's sheet.

use super::content_kind::ContentKind;
use super::error::InstrumentError;
use super::text::decode_text;
use super::workbook;

/// Text that a file holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileText {
    /// Path of the file, followed by the name of the sheet if it is a workbook.
    pub file: String,
    /// The text. Of a sheet, the cells of each row with tabs between them, in the lines of their rows.
    pub text: String,
    /// Name of the encoding.
    pub encoding: &'static str,
    /// Whether the text is a sheet of a workbook.
    pub is_sheet: bool,
    /// Message about sheets that are not read.
    pub remark: Option<String>,
}

impl FileText {
    /// The text in `bytes`, the content of `file`; `None` if it is binary and of a format that
    /// [`read`](super::read) knows.
    ///
    /// # Errors
    /// [`InstrumentError::NotRead`] for other binary files, [`InstrumentError::Faulty`] for a damaged workbook.
    pub fn of(file: &str, bytes: &[u8]) -> Result<Option<Self>, InstrumentError> {
        match ContentKind::of(file, bytes)? {
            ContentKind::Text => {
                let (text, encoding) = decode_text(bytes);
                let file = file.to_owned();
                let is_sheet = false;
                let remark = None;
                Ok(Some(Self { file, text, encoding, is_sheet, remark }))
            }
            ContentKind::Workbook => {
                let sheet = workbook::sheet(file, bytes)?;
                let others = sheet.others.join("`, `");
                let (path, wanted) = workbook::split_file_and_sheet(file);
                Ok(Some(Self {
                    file: format!("{path}, sheet `{}`", sheet.name),
                    text: sheet.text.clone(),
                    encoding: "UTF-8",
                    is_sheet: true,
                    remark: (wanted.is_none() && !sheet.others.is_empty()).then(|| {
                        format!(
                            "sheet `{}` is read, not `{others}`; FILE.xlsx#SHEET names another",
                            sheet.name
                        )
                    }),
                }))
            }
            _ => Ok(None),
        }
    }
}
