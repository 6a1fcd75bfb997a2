//! Columns of a table that name no pigment, though their headings could.

use super::column::Column;
use super::csv_row::CsvRow;
use super::table::Film;

/// Fewest rows of paint from which a column is judged by its amounts; chosen by eye.
const LEAST_ROWS: usize = 3;
/// Share by which sums of amounts may differ and still be one whole.
const WHOLE: f64 = 1e-3;

/// Places of the pigment columns that hold no amounts: text in every cell, amounts of bare cards, or
/// values in every row without which the amounts of each row sum to one whole (1 or 100).
pub(super) fn without_amounts(
    columns: &[Column],
    rows: &[CsvRow],
    number: impl Fn(&str) -> Option<f64>,
) -> Vec<usize> {
    let cell = |row: &CsvRow, place: usize| row.cells.get(place).unwrap_or_default().to_owned();
    let film = columns.iter().position(|column| *column == Column::Film);
    let is_bare =
        |row: &CsvRow| film.is_some_and(|place| Film::named(&cell(row, place)) == Some(Film::None));
    let (bare, paint): (Vec<&CsvRow>, Vec<&CsvRow>) = rows.iter().partition(|row| is_bare(row));
    let pigments = columns.iter().enumerate();
    let pigments: Vec<usize> = pigments
        .filter(|(_, column)| matches!(column, Column::Pigment(_)))
        .map(|(place, _)| place)
        .collect();
    let amount = |row: &CsvRow, place: usize| number(&cell(row, place));
    let in_all = |rows: &[&CsvRow], place: usize| {
        !rows.is_empty() && rows.iter().all(|row| amount(row, place).is_some_and(|a| a != 0.0))
    };
    let is_text = |place: usize| {
        let mut cells = rows.iter().map(|row| cell(row, place)).filter(|cell| !cell.is_empty());
        let mut texts = cells.by_ref().peekable();
        texts.peek().is_some() && texts.all(|cell| number(&cell).is_none())
    };
    let mut found: Vec<usize> =
        pigments.iter().copied().filter(|&place| is_text(place) || in_all(&bare, place)).collect();
    let (everywhere, others): (Vec<usize>, Vec<usize>) = pigments
        .into_iter()
        .filter(|place| !found.contains(place))
        .partition(|&place| in_all(&paint, place));
    let total = |row: &&CsvRow| others.iter().filter_map(|&place| amount(row, place)).sum::<f64>();
    let is_whole = |whole: f64| paint.iter().all(|row| (total(row) / whole - 1.0).abs() < WHOLE);
    if paint.len() >= LEAST_ROWS && (is_whole(1.0) || is_whole(100.0)) {
        found.extend(everywhere);
    }
    found.sort_unstable();
    found
}

#[cfg(test)]
mod tests {
    use super::super::scale::ScaleChoice;
    use super::super::table::MeasurementTable;

    /// Pigments and remarks of a table whose rows end in a column headed `heading` with `cells`.
    fn read(heading: &str, cells: [&str; 4]) -> (Vec<String>, String) {
        let [card, white, red, mixture] = cells;
        let text = format!(
            "sample,film,White,Red,{heading},400,500\ncard,none,,,{card},0.9,0.9\n\
             w,paint,1,,{white},0.8,0.8\nr,paint,,1,{red},0.1,0.2\nm,paint,0.5,0.5,{mixture},0.3,0.4\n"
        );
        let table = MeasurementTable::from_csv("t.csv", text.as_bytes(), ScaleChoice::ByFile);
        let table = table.unwrap();
        (table.pigments, table.remarks.join("\n"))
    }

    #[test]
    fn a_column_that_holds_no_amounts_is_told_and_ignored() {
        for (heading, cells) in [
            ("L,a,b", ["90,0,1", "88,-1,2", "40,50,20", "60,20,-10"]),
            ("X,Y", ["80,82", "70,72", "30,20", "50,40"]),
            ("No", ["1", "2", "3", "4"]),
            ("Date", ["1.1.26", "1.1.26", "2.1.26", "2.1.26"]),
            ("Shelf", ["top", "", "top", "left"]),
            ("Lux", ["500", "510", "505", "498"]),
            ("Gloss85", ["", "4", "3", "5"]),
        ] {
            let (pigments, remarks) = read(heading, cells);
            assert_eq!(pigments, ["White", "Red"], "{heading}");
            let told = heading.replace(',', ", ");
            assert!(remarks.contains(&told) && remarks.contains("ignored"), "{heading}: {remarks}");
        }
    }

    #[test]
    fn amounts_remain_pigments() {
        for (heading, cells) in [
            ("a", ["", "1", "", "1"]),
            ("Y", ["", "0", "0.5", ""]),
            ("Linseed oil", ["", "0.4", "0.5", "0.6"]),
        ] {
            let without_whole = read(heading, cells).0;
            let expected: &[&str] = match heading {
                // A medium beside shares that sum to 1 takes no part in them.
                "Linseed oil" => &["White", "Red"],
                heading => &["White", "Red", heading],
            };
            assert_eq!(without_whole, expected, "{heading}");
        }
    }

    #[test]
    fn pigments_that_are_named_are_read_and_no_others() {
        let text = b"sample,L,a,b,Note,400,500\nw,1,,3,,0.8,0.8\nr,,1,-2,x,0.1,0.2\n";
        let names = ["L".to_owned(), "a".to_owned()];
        let read = |names| {
            MeasurementTable::from_csv_with("t.csv", text, ScaleChoice::ByFile, Some(names))
        };
        let table = read(&names).unwrap();
        assert_eq!(table.pigments, names);
        assert!(table.remarks[0].contains("b, Note"), "{:?}", table.remarks);
    }
}
