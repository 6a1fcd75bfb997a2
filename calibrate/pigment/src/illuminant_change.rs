//! The name of a metamerism index: which one it is, between which lights, in which unit.

use serde_json::{Value, json};

/// The change of lights that a special metamerism index is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IlluminantChange<'a> {
    /// Name of the light under which the pair should match.
    pub reference: &'a str,
    /// Name of the light to which the pair is brought.
    pub test: &'a str,
}

impl IlluminantChange<'_> {
    /// Meaning of a column of these indices, as a line beside its table.
    pub const LEGEND: &'static str = "metamerism: special metamerism index, change of illuminant, in CIEDE2000 (CIE 15:2018, 9.2)";

    /// Both lights, for the heading of a column.
    #[must_use]
    pub fn heading(self) -> String {
        format!("{} to {}", self.reference, self.test)
    }

    /// The index with its name, lights and unit as JSON; null where it is not defined.
    #[must_use]
    pub fn to_json(self, index: Option<f64>) -> Value {
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
