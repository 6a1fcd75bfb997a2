//! The run that makes maps: which the store tells, and by which a run is resumed.

use std::ops::Range;

#[cfg(feature = "files")]
use serde_json::json;
use serde_json::{Map, Value};

/// Everything on which the bytes of maps depend.
#[derive(Debug, Clone, PartialEq)]
pub struct MapsAbout {
    /// Names of the pigments or groups, in the order of the maps; at most 64, all different.
    pub pigments: Vec<String>,
    /// SHA-256 of the library's file, in hexadecimal digits.
    pub library_sha256: String,
    /// SHA-256 of the survey's book, in hexadecimal digits.
    pub book_sha256: String,
    /// SHA-256 or another sign of the scan, by which another scan is told apart.
    pub scan: String,
    /// Rows of the scan that are mapped.
    pub rows: Range<usize>,
    /// Columns of the scan that are mapped.
    pub columns: Range<usize>,
    /// Settings of the run.
    pub settings: Map<String, Value>,
}

impl MapsAbout {
    /// Attributes of the group.
    #[cfg(feature = "files")]
    pub(crate) fn attributes(&self) -> Map<String, Value> {
        let all = json!({
            "title": "pigment maps",
            "impasto_version": env!("CARGO_PKG_VERSION"),
            "library_sha256": self.library_sha256,
            "book_sha256": self.book_sha256,
            "scan": self.scan,
            "pigments": self.pigments,
            "rows": [self.rows.start, self.rows.end],
            "columns": [self.columns.start, self.columns.end],
            "settings": self.settings,
        });
        match all {
            Value::Object(map) => map,
            _ => Map::new(),
        }
    }
}
