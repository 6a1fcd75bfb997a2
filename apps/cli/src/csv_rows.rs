//! Rows of JSON as a table of CSV.

use serde_json::Value;

use crate::console::Console;
use crate::failure::{Failure, Result};

/// Names of the columns of lists that are colours.
const COLORS: [(&str, &[&str]); 5] = [
    ("xyz", &["X", "Y", "Z"]),
    ("xy", &["x", "y"]),
    ("lab", &["L", "a", "b"]),
    ("srgb", &["R", "G", "B"]),
    ("weights", &["X", "Y", "Z"]),
];

impl Console<'_> {
    /// Prints objects as CSV, one row each, with the columns of all of them in the order in which they
    /// come. Objects within become columns of their own, `outer_inner`; colours become a column for each value.
    pub(crate) fn csv_rows(&mut self, rows: &[Value]) -> Result<()> {
        let rows: Vec<Vec<(String, String)>> = rows.iter().map(cells).collect();
        let mut headings: Vec<&str> = Vec::new();
        for (name, _) in rows.iter().flatten() {
            if !headings.contains(&name.as_str()) {
                headings.push(name);
            }
        }
        let lines = rows.iter().map(|row| {
            let cell = |heading: &&str| row.iter().find(|(name, _)| name == heading);
            headings.iter().map(|heading| cell(heading).map_or("", |(_, cell)| cell)).collect()
        });
        let table = table(&headings, lines);
        let table = table.map_err(|error| Failure::usage(error.to_string(), "use --json"))?;
        self.text(&String::from_utf8_lossy(&table))
    }
}

fn table<'a>(
    headings: &[&str],
    rows: impl Iterator<Item = Vec<&'a str>>,
) -> std::result::Result<Vec<u8>, csv::Error> {
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(headings)?;
    for row in rows {
        table.write_record(row)?;
    }
    Ok(table.into_inner().unwrap_or_default())
}

/// Names and texts of the cells of one object.
fn cells(row: &Value) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for (name, value) in row.as_object().into_iter().flatten() {
        let color = COLORS.iter().find(|(color, _)| color == name);
        match (value, color) {
            (Value::Object(_), _) => {
                let inner = cells(value).into_iter();
                found.extend(inner.map(|(inner, cell)| (format!("{name}_{inner}"), cell)));
            }
            (Value::Array(parts), Some((_, names))) if parts.len() == names.len() => {
                let names = names.iter().map(|&name| name.to_owned());
                found.extend(names.zip(parts.iter().map(cell)));
            }
            _ => found.push((name.clone(), cell(value))),
        }
    }
    found
}

/// The text of a value: the parts of a list are separated by semicolons.
fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        Value::Array(parts) => parts.iter().map(cell).collect::<Vec<_>>().join("; "),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::console::{Screen, Voice};

    #[test]
    fn rows_of_different_keys_make_one_table() {
        let mut out = Vec::new();
        let mut err = Vec::new();
        let mut console = Console {
            out: &mut out,
            err: &mut err,
            screen: Screen::default(),
            command: String::new(),
            voice: Voice::Usual,
            streamed: false,
        };
        let rows = [
            json!({"name": "Red, dark", "lab": [40, 50.5, 30], "notes": ["old", "dry"]}),
            json!({"name": "Blue", "lab": [30, 1, -40], "grams": {"Zinc White": 9}, "cost": null}),
        ];
        console.csv_rows(&rows).unwrap();
        let wanted = "name,L,a,b,notes,grams_Zinc White,cost\n\
            \"Red, dark\",40,50.5,30,old; dry,,\nBlue,30,1,-40,,9,\n";
        assert_eq!(String::from_utf8(out).unwrap(), wanted);
    }
}
