//! Reads the JSON objects of brush files key by key, so that every error names its key.

use documents::hint::{Explain, Hint};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

/// An object of a file. You take out its keys one by one.
#[derive(Debug)]
pub(super) struct Object<'a> {
    file: &'a str,
    /// Path of the object in the file. The whole file has an empty path.
    path: String,
    keys: Map<String, Value>,
}

impl<'a> Object<'a> {
    /// Parses the object in a text. Errors call the file `file`.
    pub(super) fn of_text(text: &str, file: &'a str) -> Result<Self, BrushFileError> {
        let value: Value = serde_json::from_str(text).map_err(|error| BrushFileError {
            file: file.to_owned(),
            key: String::new(),
            what: format!("is not JSON: {error}"),
            hint: Some(Hint::new("choose a file of brushes: .json of this program, or .myb")),
        })?;
        Self::of_value(value, file, String::new())
    }

    /// Makes an object of a value in the file. `path` is its place.
    pub(super) fn of_value(
        value: Value,
        file: &'a str,
        path: String,
    ) -> Result<Self, BrushFileError> {
        match value {
            Value::Object(keys) => Ok(Self { file, path, keys }),
            _ => Err(Self { file, path, keys: Map::new() }.fault("must be an object")),
        }
    }

    /// Removes a key and reads its value. Returns `None` if the key is missing.
    pub(super) fn take<T: DeserializeOwned>(
        &mut self,
        key: &str,
    ) -> Result<Option<T>, BrushFileError> {
        let Some(value) = self.keys.remove(key) else { return Ok(None) };
        let read = serde_json::from_value(value);
        read.map(Some).map_err(|error| self.fault_at(key, error.to_string()))
    }

    /// Removes a key that must be there and reads its value.
    pub(super) fn need<T: DeserializeOwned>(&mut self, key: &str) -> Result<T, BrushFileError> {
        self.take(key)?.ok_or_else(|| self.fault_at(key, "is missing"))
    }

    /// Removes a key and returns its object. Returns `None` if the key is missing.
    pub(super) fn take_object(&mut self, key: &str) -> Result<Option<Self>, BrushFileError> {
        let Some(value) = self.keys.remove(key) else { return Ok(None) };
        Self::of_value(value, self.file, self.path_of(key)).map(Some)
    }

    /// Removes a key that must hold a list of objects, and returns them.
    pub(super) fn need_objects(&mut self, key: &str) -> Result<Vec<Self>, BrushFileError> {
        let values: Vec<Value> = self.need(key)?;
        let path = self.path_of(key);
        values
            .into_iter()
            .enumerate()
            .map(|(at, value)| Self::of_value(value, self.file, format!("{path}[{at}]")))
            .collect()
    }

    /// Removes and returns all keys that are left, in the order of their names.
    pub(super) fn rest(self) -> Vec<(String, Value)> {
        self.keys.into_iter().collect()
    }

    /// Names of the keys that are left, in order.
    pub(super) fn names(&self) -> Vec<String> {
        self.keys.keys().cloned().collect()
    }

    /// Call this last: it refuses keys that nothing took.
    pub(super) fn end(self) -> Result<(), BrushFileError> {
        match self.keys.keys().next() {
            None => Ok(()),
            Some(key) => Err(self.fault_at(key, "is unknown")),
        }
    }

    /// An error about this object.
    pub(super) fn fault(&self, what: impl Into<String>) -> BrushFileError {
        let file = self.file.to_owned();
        let key = self.path.clone();
        let hint = Some(Hint::new("correct the file, or export it again"));
        BrushFileError { file, key, what: what.into(), hint }
    }

    /// An error about a key of this object.
    pub(super) fn fault_at(&self, key: &str, what: impl Into<String>) -> BrushFileError {
        BrushFileError { key: self.path_of(key), ..self.fault(what) }
    }

    fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }
}

/// A file of brushes that cannot be used, with the key that is wrong.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Explain)]
#[hint(with = hint.clone())]
#[error("{file}: {}{what}", place(key))]
pub struct BrushFileError {
    /// Name of the file.
    pub file: String,
    /// Path of the key in the file, e.g. `presets[2].options.range`. It is empty for the whole
    /// file.
    pub key: String,
    /// The fault.
    pub what: String,
    /// Advice on what to do.
    pub hint: Option<Hint>,
}

fn place(key: &str) -> String {
    if key.is_empty() { String::new() } else { format!("key `{key}`: ") }
}
