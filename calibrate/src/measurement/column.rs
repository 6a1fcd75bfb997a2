//! Meaning of the columns of a measurement file, by their headers.

use spectra::csv_table::{CellPlace, CsvTableError, wavelength_of_header};

use super::coordinates::is_coordinate;
use super::error::MeasurementError;

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

/// Reads a header row: one meaning per column. `pigments` are the headings that name pigments; without
/// them, every other heading does. Checks that there is a sample column, that no name occurs
/// twice and that wavelengths rise.
pub(super) fn columns(
    file: &str,
    headers: &[String],
    kind: TableKind,
    pigments: Option<&[String]>,
) -> Result<Vec<Column>, MeasurementError> {
    let place = |index: usize| CellPlace::new(file, 1, &headers[index]);
    // A header such as R254 may be a pigment (Pigment Red 254) or a wavelength.
    let plain = |header: &String| {
        let lower = header.trim().to_ascii_lowercase();
        !lower.starts_with('r') && wavelength_of_header(&lower).is_some()
    };
    let letters = kind == TableKind::Readings && !headers.iter().any(plain);
    let mut columns = Vec::with_capacity(headers.len());
    for (index, header) in headers.iter().enumerate() {
        let name = header.trim();
        if name.is_empty() {
            return Err(MeasurementError::UnnamedColumn {
                file: file.to_owned(),
                number: index + 1,
            });
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
            _ => column(name, letters),
        };
        let out_of_range = || MeasurementError::WavelengthRange { place: place(index) };
        let is_named = |names: &[String]| names.iter().any(|pigment| pigment == name);
        columns.push(match (column.ok_or_else(out_of_range)?, pigments) {
            (Column::Pigment(_) | Column::Ignored, Some(names)) if is_named(names) => {
                Column::Pigment(name.to_owned())
            }
            (Column::Pigment(_), Some(_)) => Column::Ignored,
            (Column::Pigment(_), None) if is_coordinate(headers, index) => Column::Ignored,
            (column, _) => column,
        });
    }
    if !columns.contains(&Column::Sample) {
        return Err(MeasurementError::Sheet(CsvTableError::MissingColumn {
            file: file.to_owned(),
            column: "sample",
        }));
    }
    let mut before: Option<f64> = None;
    for (index, column) in columns.iter().enumerate() {
        let Column::Wavelength(nm) = *column else { continue };
        match before {
            Some(previous) if nm == previous => {
                return Err(MeasurementError::RepeatedWavelength { place: place(index), nm });
            }
            Some(previous) if nm < previous => {
                return Err(MeasurementError::FallingWavelength {
                    place: place(index),
                    before: previous,
                    nm,
                });
            }
            _ => before = Some(nm),
        }
    }
    if before.is_none() && kind == TableKind::Readings {
        return Err(MeasurementError::Sheet(CsvTableError::MissingColumn {
            file: file.to_owned(),
            column: "400 (a wavelength in nm)",
        }));
    }
    Ok(columns)
}

/// Meaning of the header `name`; `None` for a number outside the wavelengths at which paint is measured.
/// `letters` says whether `R400` is a wavelength: beside plain numbers it is a pigment.
fn column(name: &str, letters: bool) -> Option<Column> {
    let lower = name.to_ascii_lowercase();
    let pigment = || Some(Column::Pigment(name.to_owned()));
    let in_range = |nm: &f64| (MEASURABLE_NM).contains(nm);
    match lower.as_str() {
        "sample" => Some(Column::Sample),
        "film" => Some(Column::Film),
        "backing" => Some(Column::Backing),
        "thickness_mm" => Some(Column::Thickness),
        "replicate" => Some(Column::Replicate),
        lower if NO_PIGMENTS.contains(&lower) => Some(Column::Ignored),
        _ => match wavelength_of_header(&lower) {
            Some(nm) if lower.starts_with('r') => {
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
const NO_PIGMENTS: [&str; 49] = [
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
    "sample_id",
    "sample_name",
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
        for header in ["400", "400nm", "400 nm", "R400", "SPEC_400", "nm400", "400.0"] {
            assert_eq!(column(header, true), Some(Column::Wavelength(400.0)), "{header}");
        }
        assert_eq!(column("381.2", true), Some(Column::Wavelength(381.2)));
        assert_eq!(column("Red Ochre", true), Some(Column::Pigment("Red Ochre".into())));
        assert_eq!(column("PB29", true), Some(Column::Pigment("PB29".into())));
        assert_eq!(column("99999", true), None);
    }

    #[test]
    fn a_letter_with_a_number_is_a_pigment_beside_plain_wavelengths() {
        let columns = |names: &[&str], kind| {
            let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
            columns("f", &names, kind, None).unwrap()
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
