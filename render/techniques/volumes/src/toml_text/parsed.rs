//! Texts of TOML to values, with errors that name file, line and key.

use std::path::Path;

use documents::ParserReason;
use documents::file::read;
use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::DeTable;

use super::error::TextError;
use super::fault::Fault;
use super::key_path::KeyPath;
use super::places::{line_of, offset_of, path_at};

/// Longest text that is read, in bytes.
const MOST_BYTES: usize = 16 << 20;

/// A text of TOML with its name for errors.
pub(crate) struct Source<'t> {
    file: &'t str,
    text: &'t str,
    table: Spanned<DeTable<'t>>,
}

impl<'t> Source<'t> {
    /// Parses `text`, which errors call `file`.
    pub(crate) fn parse(file: &'t str, text: &'t str) -> Result<Self, TextError> {
        if text.len() > MOST_BYTES {
            let file = file.to_owned();
            let bytes = text.len();
            return Err(TextError::TooLong { file, bytes, most: MOST_BYTES });
        }
        match DeTable::parse(text) {
            Ok(table) => Ok(Self { file, text, table }),
            Err(error) => Err(TextError::Syntax {
                file: file.to_owned(),
                line: line_of(text, error.span().map_or(0, |span| span.start)),
                key: None,
                reason: first_lines(error.message()),
                hint: "a line of TOML is `key = value`, `[table]` or `[[list]]`; text stands in \
                       quotes"
                    .to_owned(),
            }),
        }
    }

    /// The value at a key of the whole text, in its own words.
    pub(crate) fn value_of(&self, key: &str) -> Option<String> {
        let span = self.table.get_ref().get(key)?.span();
        self.text.get(span).map(str::to_owned)
    }

    /// The whole text as `T`.
    pub(crate) fn typed<T: DeserializeOwned>(&self) -> Result<T, TextError> {
        toml::from_str(self.text).map_err(|error| self.explained(&error))
    }

    /// The line of a value, or of the table that it is missing in.
    pub(crate) fn line(&self, key: &KeyPath) -> usize {
        line_of(self.text, offset_of(&self.table, key))
    }

    /// The error of a fault, with its line.
    pub(crate) fn located(&self, fault: Box<Fault>) -> TextError {
        TextError::Value { file: self.file.to_owned(), line: self.line(&fault.key), fault }
    }

    fn explained(&self, error: &toml::de::Error) -> TextError {
        let bytes = error.span().unwrap_or(0..self.text.len());
        let ParserReason { reason, hint } = ParserReason::of(error.message());
        TextError::Syntax {
            file: self.file.to_owned(),
            line: line_of(self.text, bytes.start),
            key: path_at(&self.table, &bytes),
            reason,
            hint: hint.unwrap_or_else(|| "write a value of the kind that the key takes".to_owned()),
        }
    }
}

/// Reads a file of UTF-8 text.
pub(crate) fn read_text(path: &Path) -> Result<String, TextError> {
    String::from_utf8(read(path)?).map_err(|error| {
        let good = error.utf8_error().valid_up_to();
        let bytes = error.as_bytes();
        TextError::Encoding {
            file: path.display().to_string(),
            line: 1 + bytes[..good].iter().filter(|byte| **byte == b'\n').count(),
            byte: bytes.get(good).copied().unwrap_or(0),
        }
    })
}

/// A message of the parser on one line.
fn first_lines(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}
