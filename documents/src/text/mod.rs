//! Texts of TOML and JSON that people write: values with their lines, and errors that name file,
//! line, key and a remedy.
//!
//! ```
//! use documents::hint::Explain;
//! use documents::text::{KeyPath, Source, TextError, ValueFault};
//!
//! #[derive(serde::Deserialize)]
//! #[serde(deny_unknown_fields)]
//! struct Sheet {
//!     width_mm: f64,
//! }
//!
//! fn sheet(name: &str, text: &str) -> Result<Sheet, TextError> {
//!     let source = Source::toml(name, text)?;
//!     let sheet: Sheet = source.typed()?;
//!     if !(1.0..=100.0).contains(&sheet.width_mm) {
//!         let key = KeyPath::of("width_mm");
//!         let fault = ValueFault::new(&key, "1 to 100", sheet.width_mm, "10 is usual");
//!         return Err(source.located(fault));
//!     }
//!     Ok(sheet)
//! }
//!
//! let error = sheet("a.toml", "\nwidth_mm = 0").map(|sheet| sheet.width_mm).unwrap_err();
//! assert_eq!(error.to_string(), "a.toml, line 2: width_mm takes 1 to 100, found `0`");
//! let error = sheet("a.toml", "width = 5").map(|sheet| sheet.width_mm).unwrap_err();
//! assert_eq!(error.to_string(), "a.toml, line 1: width: unknown key `width`");
//! assert_eq!(error.hint().map(|hint| hint.to_string()).as_deref(), Some("it takes the keys width_mm"));
//! ```

mod key_path;

use std::fmt;
use std::ops::Range;
use std::path::Path;

use serde::de::{DeserializeOwned, IgnoredAny};
use toml::de::DeTable;

use crate::ParserReason;
use crate::file::{FileError, is_standard_input, read};
use crate::hint::Explain;
use key_path::Node;

pub use key_path::{KeyPath, KeyStep};

/// We read at most this many bytes of text.
const MOST_BYTES: usize = 16 << 20;

/// The hint for a wrong type, if there is no better one.
pub(crate) const USUAL_HINT: &str = "write a value of the kind that the key takes";

/// A text of TOML or JSON with its name for errors.
#[derive(Debug)]
pub struct Source<'t> {
    file: &'t str,
    text: &'t str,
    language: Language,
    values: Node,
    hint: Option<&'t str>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Language {
    Toml,
    Json,
}

impl<'t> Source<'t> {
    /// Parses `text` in TOML, which errors call `file`.
    pub fn toml(file: &'t str, text: &'t str) -> Result<Self, TextError> {
        Self::hinted_toml(file, text, None)
    }

    /// Parses `text` in TOML. Pass a `hint` for errors where the parser knows none, e.g. the list
    /// of keys.
    pub fn toml_with_hint(file: &'t str, text: &'t str, hint: &'t str) -> Result<Self, TextError> {
        Self::hinted_toml(file, text, Some(hint))
    }

    fn hinted_toml(file: &'t str, text: &'t str, hint: Option<&'t str>) -> Result<Self, TextError> {
        check_length(file, text)?;
        match DeTable::parse(text) {
            Ok(table) => {
                let values = Node::of_toml(&table);
                Ok(Self { file, text, language: Language::Toml, values, hint })
            }
            Err(error) => Err(TextError::Syntax {
                file: file.to_owned(),
                place: Place::line(text, error.span().map_or(0, |span| span.start)),
                key: None,
                reason: error.message().split_whitespace().collect::<Vec<_>>().join(" ").into(),
                hint: hint
                    .unwrap_or(
                        "a line of TOML is `key = value`, `[table]` or `[[list]]`; text stands in \
                         quotes",
                    )
                    .into(),
            }),
        }
    }

    /// Parses `text` in JSON, which errors call `file`.
    pub fn json(file: &'t str, text: &'t str) -> Result<Self, TextError> {
        check_length(file, text)?;
        if let Err(error) = serde_json::from_str::<IgnoredAny>(text) {
            return Err(TextError::Syntax {
                file: file.to_owned(),
                place: Place { line: error.line().max(1), column: Some(error.column().max(1)) },
                key: None,
                reason: without_place(&error.to_string()).into(),
                hint: "JSON is `{\"key\": value, ..}`; text stands in double quotes".into(),
            });
        }
        let values = Node::of_json(text);
        Ok(Self { file, text, language: Language::Json, values, hint: None })
    }

    /// The value at a key of the whole text, as the text writes it.
    #[must_use]
    pub fn value_of(&self, key: &str) -> Option<&'t str> {
        self.text.get(self.values.value_span(key)?)
    }

    /// The whole text as `T`.
    ///
    /// # Errors
    /// [`TextError`] with the place of an unknown key or a wrong type.
    pub fn typed<T: DeserializeOwned>(&self) -> Result<T, TextError> {
        match self.language {
            Language::Toml => toml::from_str(self.text).map_err(|error| {
                let bytes = error.span().unwrap_or(0..self.text.len());
                self.explained(bytes, error.message())
            }),
            Language::Json => self.typed_json(),
        }
    }

    /// The whole JSON text as a `T`. A program that calls this alone holds no code that reads `T` from TOML.
    pub(crate) fn typed_json<T: DeserializeOwned>(&self) -> Result<T, TextError> {
        serde_json::from_str(self.text).map_err(|error| {
            let end = offset_at(self.text, error.line(), error.column());
            let start = end.saturating_sub(1);
            self.explained(start..start + 1, &without_place(&error.to_string()))
        })
    }

    /// Checks the keys `format` and `version` of the whole text, and returns the version.
    ///
    /// # Errors
    /// [`TextError`] if the text has another format, or a version that is newer than `newest`.
    pub fn version_of(&self, format: &str, newest: u64) -> Result<u64, TextError> {
        let found = self.value_of("format").unwrap_or("nothing");
        let wanted = format!("\"{format}\"");
        let plain = found.trim_matches(['"', '\'']);
        if found == plain || plain != format {
            let key = KeyPath::of("format");
            let hint = match self.language {
                Language::Toml => {
                    format!("it begins with format = {wanted} and version = {newest}")
                }
                Language::Json => format!("it has \"format\": {wanted}, \"version\": {newest}"),
            };
            return Err(self.located(ValueFault::new(&key, wanted, found, hint)));
        }
        let found = self.value_of("version").unwrap_or("nothing");
        let version = found.parse().ok().filter(|version| (1..=newest).contains(version));
        version.ok_or_else(|| {
            let wanted = format!("1 to {newest}");
            let hint = "a newer impasto may read it";
            self.located(ValueFault::new(&KeyPath::of("version"), wanted, found, hint))
        })
    }

    /// The line of a value, or of the table that lacks it.
    #[must_use]
    pub fn line(&self, key: &KeyPath) -> usize {
        line_of(self.text, self.values.offset_of(key))
    }

    /// Turns a fault into an error with its place.
    #[must_use]
    pub fn located(&self, fault: Box<ValueFault>) -> TextError {
        let place = self.place(self.values.offset_of(&fault.key));
        TextError::Value { file: self.file.to_owned(), place, fault }
    }

    fn explained(&self, bytes: Range<usize>, message: &str) -> TextError {
        let ParserReason { reason, hint } = ParserReason::of(message);
        TextError::Syntax {
            file: self.file.to_owned(),
            place: self.place(bytes.start),
            key: self.values.path_at(&bytes),
            reason: reason.into(),
            hint: hint.unwrap_or_else(|| self.hint.unwrap_or(USUAL_HINT).to_owned()).into(),
        }
    }

    fn place(&self, offset: usize) -> Place {
        let mut place = Place::line(self.text, offset);
        if self.language == Language::Json {
            let line = self.text.get(..offset).and_then(|before| before.lines().last());
            place.column = Some(1 + line.map_or(0, |line| line.chars().count()));
        }
        place
    }
}

/// Where a text has a fault. For JSON you also get a column, because it often stands on one line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Line, counted from 1.
    pub line: usize,
    /// Letter in the line, counted from 1. Only JSON has this.
    pub column: Option<usize>,
}

impl Place {
    fn line(text: &str, offset: usize) -> Self {
        Self { line: line_of(text, offset), column: None }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}", self.line)?;
        self.column.map_or(Ok(()), |column| write!(f, ", column {column}"))
    }
}

/// Result of a check.
pub type Checked = Result<(), Box<ValueFault>>;

/// A value that is out of its range, or does not fit the values beside it.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Explain)]
#[error("{key} takes {wanted}, found `{found}`")]
#[hint(verbatim, "{hint}")]
pub struct ValueFault {
    /// Path of the value.
    pub key: KeyPath,
    /// Values that you may write.
    pub wanted: String,
    /// The value as text.
    pub found: String,
    /// Sentence on how you repair this.
    pub hint: String,
}

impl ValueFault {
    /// A fault of the value at `key`.
    #[must_use]
    pub fn new(
        key: &KeyPath,
        wanted: impl Into<String>,
        found: impl fmt::Display,
        hint: impl Into<String>,
    ) -> Box<Self> {
        let wanted = wanted.into();
        Box::new(Self { key: key.clone(), wanted, found: found.to_string(), hint: hint.into() })
    }
}

/// Reasons why a text cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum TextError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is longer than any that we read.
    #[error("{file}: it has {bytes} bytes, more than `{most}`")]
    #[hint("divide it, or record less often")]
    TooLong {
        /// Name of the file.
        file: String,
        /// Length of the file in bytes.
        bytes: usize,
        /// Longest length in bytes.
        most: usize,
    },
    /// The file holds bytes that are not UTF-8.
    #[error("{file}, line {line}: this is not UTF-8 text, found byte `0x{byte:02x}`")]
    #[hint("save the file as UTF-8")]
    Encoding {
        /// Name of the file.
        file: String,
        /// Line, counted from 1.
        line: usize,
        /// First byte that does not belong to a letter.
        byte: u8,
    },
    /// The text is not TOML or JSON, or has an unknown key or a value of a wrong type.
    #[error("{file}, {place}: {}{reason}", key.as_ref().map_or(String::new(), |key| format!("{key}: ")))]
    #[hint(verbatim, "{hint}")]
    Syntax {
        /// Name of the file.
        file: String,
        /// Place of the fault.
        place: Place,
        /// Path of the value. `None` if we cannot parse the text at all.
        key: Option<KeyPath>,
        /// Reason, with the value.
        reason: Box<str>,
        /// Sentence on how you repair this.
        hint: Box<str>,
    },
    /// A value is wrong.
    #[error("{file}, {place}: {fault}")]
    #[hint(inner = fault)]
    Value {
        /// Name of the file.
        file: String,
        /// Place of the value, or the table that lacks it.
        place: Place,
        /// The value, and how you repair this.
        fault: Box<ValueFault>,
    },
    /// A value that you made by code is wrong.
    #[error(transparent)]
    Invalid(#[from] Box<ValueFault>),
}

/// Reads a file of UTF-8 text.
pub fn read_text(path: &Path) -> Result<String, TextError> {
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

/// Whether a file is TOML: by its ending, standard input by what it holds.
#[must_use]
pub fn is_toml(path: &Path) -> bool {
    match is_standard_input(path) {
        true => holds_toml(&read(path).unwrap_or_default()),
        false => path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")),
    }
}

/// Whether the first line that is no comment is one of TOML: a table, or a key with its value.
fn holds_toml(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let mut lines = text.lines().map(str::trim);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with('#'));
    first
        .is_some_and(|line| line.starts_with('[') || (line.contains('=') && !line.starts_with('{')))
}

/// The line, counted from 1, in which a byte of `text` lies.
#[must_use]
pub fn line_of(text: &str, offset: usize) -> usize {
    let before = &text.as_bytes()[..offset.min(text.len())];
    1 + before.iter().filter(|byte| **byte == b'\n').count()
}

/// The byte at a line and a column of bytes, both counted from 1.
fn offset_at(text: &str, line: usize, column: usize) -> usize {
    let before: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    (before + column).min(text.len())
}

/// Cuts the place from the end of a message of the JSON parser.
fn without_place(message: &str) -> String {
    message.rsplit_once(" at line ").map_or(message, |(reason, _)| reason).to_owned()
}

fn check_length(file: &str, text: &str) -> Result<(), TextError> {
    if text.len() <= MOST_BYTES {
        return Ok(());
    }
    Err(TextError::TooLong { file: file.to_owned(), bytes: text.len(), most: MOST_BYTES })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "only errors are looked at")]
    struct Sheet {
        format: Option<String>,
        width: f64,
        #[serde(default)]
        pours: Vec<Pour>,
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "only errors are looked at")]
    struct Pour {
        recipe: String,
    }

    fn message_and_hint(error: TextError) -> (String, String) {
        (error.to_string(), error.hint().unwrap().to_string())
    }

    #[test]
    fn errors_of_toml_name_line_key_and_way_out() {
        for (text, message, hint) in [
            ("width = ", "a, line 1: ", "a line of TOML is"),
            ("\nwidth = 1\nwidt = 2", "a, line 3: widt: unknown key `widt`", "did you mean width?"),
            ("width = \"b\"", "a, line 1: width: invalid type: text \"b\"", "write a value"),
            (
                "width = 1\n[[pours]]\nrecipe = 3",
                "a, line 3: [[pours]] 1, recipe: invalid type",
                "write a value",
            ),
            ("format = \"b\"", "a, line 1: the key `width` is missing", "add a line `width`"),
        ] {
            let read = Source::toml("a", text).and_then(|source| source.typed::<Sheet>());
            let (found, way) = message_and_hint(read.unwrap_err());
            assert!(found.starts_with(message), "{text}: {found}");
            assert!(way.starts_with(hint), "{text}: {way}");
        }
        let own = Source::toml_with_hint("a", "width = 1\nx", "keys are width and pours");
        assert_eq!(message_and_hint(own.unwrap_err()).1, "keys are width and pours");
    }

    #[test]
    fn errors_of_json_name_line_and_column_too() {
        for (text, message) in [
            ("{\"width\": 1,}", "a, line 1, column 13: "),
            ("{\"width\": 1,\n \"widt\": 2}", "a, line 2, column 7: widt: unknown key `widt`"),
            ("{\"width\": \"b\"}", "a, line 1, column 13: width: invalid type: text \"b\""),
            (
                "{\"width\": 1, \"pours\": [{\"recipe\": 12}]}",
                "a, line 1, column 36: [[pours]] 1, recipe: invalid type",
            ),
        ] {
            let read = Source::json("a", text).and_then(|source| source.typed::<Sheet>());
            let (found, _) = message_and_hint(read.unwrap_err());
            assert!(found.starts_with(message), "{text}: {found}");
            assert!(!found.contains("at line"), "{found}");
        }
        let source = Source::json("a", "{\"\u{e9}\": 0, \"width\": 3}").unwrap();
        let fault = ValueFault::new(&KeyPath::of("width"), "1 to 2", 3, "1 is usual");
        let wanted = "a, line 1, column 10: width takes 1 to 2, found `3`";
        assert_eq!(source.located(fault).to_string(), wanted);
    }

    #[test]
    fn another_format_and_a_newer_version_are_refused() {
        let version = |text| {
            let source = Source::toml("a", text).unwrap();
            source.version_of("scene", 2).map_err(|error| message_and_hint(error).0)
        };
        assert_eq!(version("format = \"scene\"\nversion = 1"), Ok(1));
        assert_eq!(version("version = 2\nformat = 'scene'"), Ok(2));
        for (text, wanted) in [
            ("version = 1", "a, line 1: format takes \"scene\", found `nothing`"),
            ("\nformat = \"other\"", "a, line 2: format takes \"scene\", found `\"other\"`"),
            ("format = \"scene\"\nversion = 3", "a, line 2: version takes 1 to 2, found `3`"),
            ("format = \"scene\"\nversion = 0", "a, line 2: version takes 1 to 2, found `0`"),
            (
                "format = \"scene\"\nversion = \"1\"",
                "a, line 2: version takes 1 to 2, found `\"1\"`",
            ),
            ("format = \"scene\"", "a, line 1: version takes 1 to 2, found `nothing`"),
        ] {
            assert_eq!(version(text), Err(wanted.to_owned()), "{text}");
        }
        let json = Source::json("a", "{\"format\": \"scene\", \"version\": 9}").unwrap();
        let (message, hint) = message_and_hint(json.version_of("scene", 2).unwrap_err());
        assert_eq!(message, "a, line 1, column 21: version takes 1 to 2, found `9`");
        assert_eq!(hint, "a newer impasto may read it");
    }

    #[test]
    fn texts_that_nobody_writes_are_refused() {
        let long = "#".repeat(MOST_BYTES + 1);
        let error = Source::toml("a", &long).unwrap_err();
        assert_eq!(error.to_string(), "a: it has 16777217 bytes, more than `16777216`");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("latin.toml");
        std::fs::write(&path, b"a = 1\nb = \"\xe9\"").unwrap();
        let (message, hint) = message_and_hint(read_text(&path).unwrap_err());
        assert!(
            message.ends_with("line 2: this is not UTF-8 text, found byte `0xe9`"),
            "{message}"
        );
        assert_eq!(hint, "save the file as UTF-8");
        let missing = read_text(&folder.path().join("none")).unwrap_err();
        assert!(matches!(missing, TextError::File(_)) && missing.hint().is_some());
    }

    #[test]
    fn toml_is_told_from_models_json_and_pictures() {
        for toml in
            ["format = \"paint-volumes\"\n", "# guides\n\n[[guide]]\n", "[edges]\nstrength = 2"]
        {
            assert!(holds_toml(toml.as_bytes()), "{toml}");
        }
        for other in [
            &b"# a tent\nmtllib tent.mtl\nv 0 0 1\n"[..],
            b"ply\nformat ascii 1.0\ncomment a = b\n",
            b"{\"asset\": {\"generator\": \"a=b\"}}",
            b"\x89PNG\r\n\x1a\n= \xff",
            b"# a comment alone\n",
            b"",
        ] {
            assert!(!holds_toml(other), "{other:?}");
        }
    }
}
