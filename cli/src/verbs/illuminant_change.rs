//! The name of a metamerism index: which one it is, between which lights, in which unit.

use serde_json::{Value, json};

/// The change of lights that a special metamerism index is for.
#[derive(Debug, Clone, Copy)]
pub(super) struct IlluminantChange<'a> {
    /// Light under which the pair should match.
    pub(super) reference: &'a str,
    /// Light to which the pair is brought.
    pub(super) test: &'a str,
}

impl IlluminantChange<'_> {
    /// Both lights, for the heading of a column.
    pub(super) fn heading(self) -> String {
        format!("{} to {}", self.reference, self.test)
    }

    /// The index with its name and unit; null where it is not defined.
    pub(super) fn json(self, index: Option<f64>) -> Value {
        json!({
            "kind": "special metamerism index, change of illuminant",
            "change": self.heading(),
            "from": self.reference,
            "to": self.test,
            "unit": "CIEDE2000",
            "index": index,
        })
    }
}

/// Meaning of a column of metamerism indices, as a line beside its table.
pub(super) const LEGEND: &str =
    "metamerism: special metamerism index, change of illuminant, in CIEDE2000 (CIE 15:2018, 9.2)";
