//! Keys and values of an ENVI header, with their lines.

use std::path::{Path, PathBuf};

use crate::cube::error::CubeError;

/// A key of the header.
#[derive(Debug)]
struct Field {
    /// Lower case, words separated by one space.
    key: String,
    /// Value without its braces.
    value: String,
    line: usize,
}

/// Keys and values of a header. Keys are found whatever their case.
#[derive(Debug)]
pub(crate) struct Fields {
    path: PathBuf,
    fields: Vec<Field>,
}

/// Whether a file that begins with these bytes is an ENVI header.
pub(crate) fn is_header(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    bytes.starts_with(b"ENVI") && bytes.get(4).is_none_or(u8::is_ascii_whitespace)
}

/// Whether the text is the header of an Esri grid, which also ends in `.hdr`.
fn is_esri(text: &str) -> bool {
    let has = |word: &str| {
        text.lines().any(|line| {
            line.split_whitespace().next().is_some_and(|first| first.eq_ignore_ascii_case(word))
        })
    };
    has("ncols") && has("nrows")
}

impl Fields {
    /// Splits the header in `bytes` into fields.
    pub(crate) fn parse(bytes: &[u8], path: &Path) -> Result<Self, CubeError> {
        let text = String::from_utf8_lossy(bytes);
        if !is_header(bytes) {
            return Err(match is_esri(&text) {
                true => CubeError::format(
                    path,
                    "the header of an Esri grid (ncols, nrows), not of ENVI",
                    "export the scan as ENVI: an Esri grid has no wavelengths",
                ),
                false => CubeError::format(
                    path,
                    "no ENVI header: the first line is not `ENVI`",
                    "name the .hdr file that belongs to the data",
                ),
            });
        }
        let mut fields = Vec::new();
        let mut lines = text.lines().zip(1..).skip(1);
        while let Some((text, line)) = lines.next() {
            let text = text.trim();
            // Lines without an equals sign, such as comments of other programs, hold no key.
            let Some((key, value)) = text.split_once('=').filter(|_| !text.starts_with(';')) else {
                continue;
            };
            let key = key.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
            let mut value = value.trim().to_owned();
            if let Some(inside) = value.strip_prefix('{') {
                let mut list = inside.to_owned();
                while !list.contains('}') {
                    let Some((more, _)) = lines.next() else {
                        return Err(CubeError::Key {
                            path: path.to_owned(),
                            line,
                            key,
                            problem: "opens a brace that is never closed".to_owned(),
                            way_out: "close the list with }".to_owned(),
                        });
                    };
                    if !more.trim_start().starts_with(';') {
                        list.push('\n');
                        list.push_str(more.trim());
                    }
                }
                value = list.split('}').next().unwrap_or_default().trim().to_owned();
            }
            fields.push(Field { key, value, line });
        }
        Ok(Self { path: path.to_owned(), fields })
    }

    /// The value of a key and its line; an error if it is given twice with different values.
    fn find(&self, key: &str) -> Result<Option<&Field>, CubeError> {
        let mut found = self.fields.iter().filter(|field| field.key == key);
        let Some(first) = found.next() else { return Ok(None) };
        match found.find(|other| other.value != first.value) {
            None => Ok(Some(first)),
            Some(other) => Err(self
                .fault(
                    key,
                    format!("has another value than in line {}", first.line),
                    "remove one of the two lines",
                )
                .at(other.line)),
        }
    }

    /// An error about the key `key`, at its line.
    pub(crate) fn fault(
        &self,
        key: &str,
        problem: impl Into<String>,
        way_out: impl Into<String>,
    ) -> CubeError {
        let line = self.fields.iter().find(|field| field.key == key).map_or(0, |field| field.line);
        CubeError::Key {
            path: self.path.clone(),
            line,
            key: key.to_owned(),
            problem: problem.into(),
            way_out: way_out.into(),
        }
    }

    /// Text of a key, `None` if it is not there or empty.
    pub(crate) fn text(&self, key: &str) -> Result<Option<&str>, CubeError> {
        let found = self.find(key)?;
        Ok(found.map(|field| field.value.as_str()).filter(|value| !value.is_empty()))
    }

    /// Whole number of a key.
    pub(crate) fn whole(&self, key: &str) -> Result<Option<u64>, CubeError> {
        let Some(text) = self.text(key)? else { return Ok(None) };
        let number = text.parse().map_err(|_| {
            self.fault(
                key,
                format!("must be a whole number, found `{}`", shortened(text)),
                format!("correct `{key}` in the header"),
            )
        })?;
        Ok(Some(number))
    }

    /// Whole number of a key that every header has.
    pub(crate) fn required(&self, key: &str) -> Result<u64, CubeError> {
        self.whole(key)?.ok_or_else(|| {
            self.fault(key, "is missing", format!("add the line `{key} = ..` to the header"))
        })
    }

    /// Finite number of a key.
    pub(crate) fn number(&self, key: &str) -> Result<Option<f64>, CubeError> {
        let Some(text) = self.text(key)? else { return Ok(None) };
        match text.parse::<f64>() {
            Ok(number) => Ok(Some(number)),
            Err(_) => Err(self.fault(
                key,
                format!("must be a number, found `{}`", shortened(text)),
                format!("correct `{key}` in the header"),
            )),
        }
    }

    /// Numbers of a list of `bands` numbers.
    pub(crate) fn list(&self, key: &str, bands: usize) -> Result<Option<Vec<f64>>, CubeError> {
        let Some(text) = self.text(key)? else { return Ok(None) };
        let words = text.split([',', ' ', '\t', '\n']).map(str::trim);
        let mut numbers = Vec::new();
        for word in words.filter(|word| !word.is_empty()) {
            let number = word.parse::<f64>().map_err(|_| {
                let found = shortened(word);
                let problem = format!("has `{found}` as number {}", numbers.len() + 1);
                self.fault(key, problem, "write numbers with commas between them")
            })?;
            numbers.push(number);
        }
        if numbers.len() != bands {
            let problem = format!("has {} numbers, but `bands` is {bands}", numbers.len());
            return Err(self.fault(key, problem, "give one number a band"));
        }
        Ok(Some(numbers))
    }
}

impl CubeError {
    /// The error at another line.
    fn at(self, at: usize) -> Self {
        match self {
            Self::Key { path, key, problem, way_out, .. } => {
                Self::Key { path, line: at, key, problem, way_out }
            }
            other => other,
        }
    }
}

/// A value of a file as messages show it.
pub(crate) fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}..", &text[..end]),
        None => text.to_owned(),
    }
}
