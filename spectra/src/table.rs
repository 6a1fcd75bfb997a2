//! Reading the tables of the CIE that are part of the crate.

/// The columns of a CSV with their headings. Empty cells are `None`.
pub(crate) fn columns(text: &str) -> Vec<(String, Vec<Option<f64>>)> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let headers = reader.headers().expect("a shipped table has headers").clone();
    let mut columns: Vec<(String, Vec<Option<f64>>)> =
        headers.iter().map(|name| (name.to_owned(), Vec::new())).collect();
    for record in reader.records() {
        let record = record.expect("a shipped table has rows of one length");
        for (column, cell) in columns.iter_mut().zip(&record) {
            column.1.push(
                (!cell.is_empty()).then(|| cell.parse().expect("a shipped cell is a number")),
            );
        }
    }
    columns
}

/// The wavelengths and values of the filled cells in the column `name`; the first column holds
/// the wavelengths.
pub(crate) fn filled(
    columns: &[(String, Vec<Option<f64>>)],
    name: &str,
) -> Option<(Vec<f64>, Vec<f64>)> {
    let nm = &columns.first()?.1;
    let values = &columns.iter().skip(1).find(|(header, _)| header == name)?.1;
    Some(nm.iter().zip(values).filter_map(|(nm, value)| Some(((*nm)?, (*value)?))).unzip())
}
