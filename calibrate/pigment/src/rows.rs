//! Rows of JSON as CSV, in the same form from every program.

use documents::spreadsheet_cell;
use serde_json::Value;

/// Keys of JSON that hold a colour as a list, each with names for its columns.
const COLORS: [(&str, &[&str]); 5] = [
    ("xyz", &["X", "Y", "Z"]),
    ("xy", &["x", "y"]),
    ("lab", &["L", "a", "b"]),
    ("srgb", &["R", "G", "B"]),
    ("weights", &["X", "Y", "Z"]),
];

/// Writes objects as CSV, one row each. Every key of any object becomes a column, in the order in which keys
/// first occur. Keys of an inner object become columns such as `outer_inner`. Colours become a column for
/// each value, the parts of other lists are separated by semicolons, and null is an empty cell. Texts that a
/// spreadsheet would take for formulas begin with `'`, see [`spreadsheet_cell`].
///
/// ```
/// use pigment::rows::csv_of;
/// use serde_json::json;
///
/// let rows = [json!({"sample": "red", "k_d": 0.5}), json!({"sample": "blue", "k_d": null})];
/// assert_eq!(csv_of(&rows), "sample,k_d\nred,0.5\nblue,\n");
/// ```
#[must_use]
pub fn csv_of(rows: &[Value]) -> String {
    let rows: Vec<Vec<(String, String)>> = rows.iter().map(cells).collect();
    let mut headings: Vec<&str> = Vec::new();
    for (name, _) in rows.iter().flatten() {
        if !headings.contains(&name.as_str()) {
            headings.push(name);
        }
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    let shown: Vec<_> = headings.iter().map(|heading| spreadsheet_cell(heading)).collect();
    let mut records = vec![shown.iter().map(|name| &**name).collect::<Vec<&str>>()];
    for row in &rows {
        let cells = headings.iter().map(|heading| {
            let cell = row.iter().find(|(name, _)| name == heading);
            cell.map_or("", |(_, cell)| cell)
        });
        records.push(cells.collect());
    }
    for record in records {
        writer.write_record(record).expect("rows have one length, and memory can be written");
    }
    let table = writer.into_inner().expect("memory can be written");
    String::from_utf8(table).expect("cells are text")
}

/// One row with the columns of `start`, then the columns of `row`. Both must be objects.
#[must_use]
pub fn joined(mut start: Value, row: Value) -> Value {
    if let (Value::Object(start), Value::Object(row)) = (&mut start, row) {
        start.extend(row);
    }
    start
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

fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => spreadsheet_cell(text).into_owned(),
        Value::Array(parts) => parts.iter().map(cell).collect::<Vec<_>>().join("; "),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn rows_of_different_keys_make_one_table() {
        let rows = [
            json!({"name": "Red, dark", "lab": [40, 50.5, 30], "notes": ["old", "dry"]}),
            json!({"name": "Blue", "lab": [30, 1, -40], "grams": {"Zinc White": 9}, "cost": null}),
        ];
        let wanted = "name,L,a,b,notes,grams_Zinc White,cost\n\
            \"Red, dark\",40,50.5,30,old; dry,,\nBlue,30,1,-40,,9,\n";
        assert_eq!(csv_of(&rows), wanted);
    }
}
