//! Meaning of the columns of a measurement file, by their headers.

use spectra::csv_table::{CellPlace, CsvTableError, wavelength_of_header};

use super::coordinates::is_coordinate;
use super::error::MeasurementError;
use super::name_column::{name_column, name_rank};

/// Meaning of one column.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Column {
    Sample,
    Film,
    Backing,
    Thickness,
    Replicate,
    /// In a file of recipes: the name of the reading in the measurement file.
    Reading,
    /// Notes of an instrument or its user; not a pigment.
    Ignored,
    Pigment(String),
    Wavelength(f64),
}

/// Kind of table that a file should hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TableKind {
    /// Readings, with wavelengths.
    Readings,
    /// Recipes, without wavelengths.
    Recipes,
}

/// Reads a header row whose cells stand at `place`: one meaning per column. `pigments` are the headings
/// that name pigments; without them, every other heading does. Checks that there is a column of names,
/// that no name occurs twice and that wavelengths rise or fall throughout.
pub(super) fn columns(
    place: &dyn Fn(usize) -> CellPlace,
    headers: &[String],
    kind: TableKind,
    pigments: Option<&[String]>,
) -> Result<Vec<Column>, MeasurementError> {
    let file = || headers.first().map_or_else(String::new, |_| place(0).file);
    // A header such as R254 may be a pigment (Pigment Red 254) or a wavelength.
    let plain = |header: &String| {
        let lower = header.trim().to_ascii_lowercase();
        !is_letter_and_number(&lower) && wavelength_of_header(&lower).is_some()
    };
    let letters = kind == TableKind::Readings && !headers.iter().any(plain);
    let names: Vec<&str> = headers.iter().map(|header| header.trim()).collect();
    let sample = name_column(&names, is_wavelength_heading);
    let has_included = names.iter().any(|name| has_word(name, "sci"));
    let mut columns = Vec::with_capacity(headers.len());
    for (index, &name) in names.iter().enumerate() {
        if Some(index) == sample {
            columns.push(Column::Sample);
            continue;
        }
        // Row numbers that programs for statistics write first have no heading.
        if names[..=index].iter().all(|name| name.is_empty()) {
            columns.push(Column::Ignored);
            continue;
        }
        if name.is_empty() {
            let CellPlace { file, row, .. } = place(index);
            let number = index + 1;
            return Err(MeasurementError::UnnamedColumn { file, row, number });
        }
        if let Some(before) = headers[..index].iter().position(|h| h.trim() == name) {
            return Err(MeasurementError::RepeatedColumn {
                place: place(index),
                first: before + 1,
                second: index + 1,
            });
        }
        if name.contains(char::is_control) {
            return Err(MeasurementError::Sheet(CsvTableError::Cell {
                place: place(index),
                wanted: "a name without control characters",
                text: name.escape_default().to_string(),
            }));
        }
        let column = match name.to_ascii_lowercase().as_str() {
            "reading" if kind == TableKind::Recipes => Some(Column::Reading),
            // Readings without the specular component beside those with it are other readings.
            _ if has_included && excludes_specular(name) => Some(Column::Ignored),
            _ => column(name, letters),
        };
        let is_named = |names: &[String]| names.iter().any(|pigment| pigment == name);
        columns.push(
            match (
                column.ok_or_else(|| MeasurementError::WavelengthRange { place: place(index) })?,
                pigments,
            ) {
                (Column::Pigment(_) | Column::Ignored, Some(names)) if is_named(names) => {
                    Column::Pigment(name.to_owned())
                }
                (Column::Pigment(_), Some(_)) => Column::Ignored,
                (Column::Pigment(_), None) if is_coordinate(headers, index) => Column::Ignored,
                (column, _) => column,
            },
        );
    }
    if !columns.contains(&Column::Sample) {
        return Err(MeasurementError::Sheet(CsvTableError::MissingColumn {
            file: file(),
            column: "sample",
        }));
    }
    let wavelengths = columns.iter().enumerate().filter_map(|(index, column)| match column {
        Column::Wavelength(nm) => Some((index, *nm)),
        _ => None,
    });
    let wavelengths: Vec<(usize, f64)> = wavelengths.collect();
    if wavelengths.is_empty() && kind == TableKind::Readings {
        return Err(MeasurementError::Sheet(CsvTableError::MissingColumn {
            file: file(),
            column: "400 (a wavelength in nm)",
        }));
    }
    let falls = wavelengths.len() > 1 && wavelengths[1].1 < wavelengths[0].1;
    for pair in wavelengths.windows(2) {
        let (_, before) = pair[0];
        let (index, nm) = pair[1];
        if nm == before {
            return Err(MeasurementError::RepeatedWavelength { place: place(index), nm });
        }
        if (nm < before) != falls {
            return Err(MeasurementError::UnorderedWavelength { place: place(index), before, nm });
        }
    }
    Ok(columns)
}

/// Whether `heading` is that of a wavelength at which paint is measured.
pub(super) fn is_wavelength_heading(heading: &str) -> bool {
    let nm = wavelength_of_header(&heading.trim().to_ascii_lowercase());
    nm.is_some_and(|nm| MEASURABLE_NM.contains(&nm))
}

/// Whether `heading` is that of readings without the specular component, such as `SCE 400nm`.
pub(super) fn excludes_specular(heading: &str) -> bool {
    has_word(heading, "sce") && is_wavelength_heading(heading)
}

/// Whether a heading in lower case is a single letter before a number, such as `r254`, which may
/// name a pigment.
fn is_letter_and_number(lower: &str) -> bool {
    let number = lower.strip_prefix(['r', 'x']);
    number.is_some_and(|number| number.trim().parse::<f64>().is_ok())
}

/// Whether `word` is a word of a heading, in any case.
fn has_word(heading: &str, word: &str) -> bool {
    let words = heading.split(|c: char| !c.is_ascii_alphabetic());
    words.into_iter().any(|found| found.eq_ignore_ascii_case(word))
}

/// Meaning of the header `name`; `None` for a number outside the wavelengths at which paint is measured.
/// `letters` says whether `R400` is a wavelength: beside plain numbers it is a pigment.
fn column(name: &str, letters: bool) -> Option<Column> {
    let lower = name.to_ascii_lowercase();
    let pigment = || Some(Column::Pigment(name.to_owned()));
    let in_range = |nm: &f64| (MEASURABLE_NM).contains(nm);
    match lower.as_str() {
        "film" => Some(Column::Film),
        "backing" => Some(Column::Backing),
        "thickness_mm" => Some(Column::Thickness),
        "replicate" => Some(Column::Replicate),
        lower if NO_PIGMENTS.contains(&lower) => Some(Column::Ignored),
        // Another column holds the names.
        lower if name_rank(lower).is_some() => Some(Column::Ignored),
        _ => match wavelength_of_header(&lower) {
            Some(nm) if is_letter_and_number(&lower) => {
                if letters && in_range(&nm) {
                    Some(Column::Wavelength(nm))
                } else {
                    pigment()
                }
            }
            Some(nm) => in_range(&nm).then_some(Column::Wavelength(nm)),
            None => pigment(),
        },
    }
}

/// Whether a column headed `name` is read as a pigment, in a file whose wavelengths are plain numbers.
#[must_use]
pub fn names_a_pigment(name: &str) -> bool {
    let plain = !name.is_empty() && name.trim() == name && !name.contains(char::is_control);
    plain && matches!(column(name, false), Some(Column::Pigment(_)))
}

/// Wavelengths in nm at which instruments for paint measure.
pub(super) const MEASURABLE_NM: std::ops::RangeInclusive<f64> = 200.0..=2500.0;

/// Headings of instruments' tables and of notes, none of which is the name of a pigment.
const NO_PIGMENTS: [&str; 47] = [
    "no",
    "no.",
    "nr",
    "nr.",
    "#",
    "id",
    "index",
    "row",
    "batch",
    "gloss",
    "temperature",
    "humidity",
    "remark",
    "l*",
    "a*",
    "b*",
    "c*",
    "h*",
    "hue",
    "chroma",
    "lab_l",
    "lab_a",
    "lab_b",
    "xyz_x",
    "xyz_y",
    "xyz_z",
    "rgb_r",
    "rgb_g",
    "rgb_b",
    "cie l*",
    "cie a*",
    "cie b*",
    "date",
    "time",
    "datetime",
    "instrument",
    "serial",
    "serial number",
    "operator",
    "user",
    "comment",
    "comments",
    "illuminant",
    "observer",
    "geometry",
    "aperture",
    "filter",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_of_wavelengths_are_read_in_every_spelling() {
        for header in
            ["400", "400nm", "400 nm", "R400", "SPEC_400", "nm400", "400.0", "400[nm]", "R400 nm"]
        {
            assert_eq!(column(header, true), Some(Column::Wavelength(400.0)), "{header}");
        }
        assert_eq!(column("381.2", true), Some(Column::Wavelength(381.2)));
        assert_eq!(column("Red Ochre", true), Some(Column::Pigment("Red Ochre".into())));
        assert_eq!(column("PB29", true), Some(Column::Pigment("PB29".into())));
        assert_eq!(column("99999", true), None);
    }

    #[test]
    fn wavelengths_fall_or_rise_and_turn_nowhere() {
        let columns = |names: &str| {
            let names: Vec<String> = names.split(',').map(str::to_owned).collect();
            let place = |index: usize| CellPlace::new("f", 3, &names[index]);
            columns(&place, &names, TableKind::Readings, None).map_err(|error| error.to_string())
        };
        assert_eq!(columns("Name,700,600,500").unwrap()[1], Column::Wavelength(700.0));
        assert_eq!(
            columns("Name,700,500,600").unwrap_err(),
            "f, row 3, column `600`: wavelengths must rise or fall throughout, found 600 nm after 500 nm"
        );
        assert!(columns("Name,700,600,600nm").unwrap_err().contains("600 nm occurs twice"));
    }

    #[test]
    fn readings_without_the_specular_component_are_ignored_beside_those_with_it() {
        let columns = |names: [&str; 5]| {
            let names = names.map(str::to_owned);
            columns(
                &|index| CellPlace::new("f", 1, &names[index]),
                &names,
                TableKind::Readings,
                None,
            )
            .unwrap()
        };
        let both = columns(["Data Name", "SCI 400nm", "SCI 410nm", "SCE 400nm", "SCE 410nm"]);
        let nm = Column::Wavelength;
        assert_eq!(both[1..], [nm(400.0), nm(410.0), Column::Ignored, Column::Ignored]);
        let one = columns(["Data Name", "SCE 400nm", "SCE 410nm", "SCE 420nm", "L*(D65)"]);
        assert_eq!(one[1..4], [nm(400.0), nm(410.0), nm(420.0)]);
    }

    #[test]
    fn a_letter_with_a_number_is_a_pigment_beside_plain_wavelengths() {
        let columns = |names: &[&str], kind| {
            let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
            columns(&|index| CellPlace::new("f", 1, &names[index]), &names, kind, None).unwrap()
        };
        let beside = columns(&["sample", "R254", "R101", "400"], TableKind::Readings);
        assert_eq!(beside[1], Column::Pigment("R254".into()));
        let alone = columns(&["sample", "R101", "R400", "R500"], TableKind::Readings);
        assert_eq!(alone[1], Column::Pigment("R101".into()));
        assert_eq!(alone[2], Column::Wavelength(400.0));
        let recipe = columns(&["sample", "R254", "a*"], TableKind::Recipes);
        assert_eq!(recipe[1], Column::Pigment("R254".into()));
        assert_eq!(recipe[2], Column::Ignored);
    }
}
