//! What a column of a measurement file holds, by its header.

use super::error::{MeasurementError, Place};

/// The meaning of one column.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Column {
    Sample,
    Film,
    Backing,
    Thickness,
    Replicate,
    Pigment(String),
    Wavelength(f64),
}

/// Every column of a header row, checked: a sample column, no name twice,
/// wavelengths rising.
pub(super) fn columns(file: &str, headers: &[&str]) -> Result<Vec<Column>, MeasurementError> {
    let place = |index: usize| Place::new(file, 1, headers[index]);
    // Pigment Red 254 is R254 to some.
    let plain = |header: &&str| {
        let lower = header.trim().to_ascii_lowercase();
        !lower.starts_with('r') && wavelength(&lower).is_some()
    };
    let letters = !headers.iter().any(plain);
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
            return Err(MeasurementError::Cell {
                place: place(index),
                wanted: "a name without control characters",
                text: name.escape_default().to_string(),
            });
        }
        columns.push(
            column(name, letters)
                .ok_or_else(|| MeasurementError::WavelengthRange { place: place(index) })?,
        );
    }
    if !columns.contains(&Column::Sample) {
        return Err(MeasurementError::MissingColumn { file: file.to_owned(), column: "sample" });
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
    if before.is_none() {
        return Err(MeasurementError::MissingColumn {
            file: file.to_owned(),
            column: "400 (a wavelength in nm)",
        });
    }
    Ok(columns)
}

/// `None` for a number that no instrument for paint measures at. `letters` tells
/// whether `R400` is a wavelength here: beside plain numbers it is a pigment.
fn column(name: &str, letters: bool) -> Option<Column> {
    let lower = name.to_ascii_lowercase();
    let pigment = || Some(Column::Pigment(name.to_owned()));
    let in_range = |nm: &f64| (200.0..=2500.0).contains(nm);
    match lower.as_str() {
        "sample" => Some(Column::Sample),
        "film" => Some(Column::Film),
        "backing" => Some(Column::Backing),
        "thickness_mm" => Some(Column::Thickness),
        "replicate" => Some(Column::Replicate),
        _ => match wavelength(&lower) {
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

/// The number in `400`, `400nm`, `R400`, `SPEC_400` or `nm400`.
pub(crate) fn wavelength(lower: &str) -> Option<f64> {
    let bare =
        ["spec_", "nm", "r"].iter().find_map(|prefix| lower.strip_prefix(prefix)).unwrap_or(lower);
    let bare = bare.strip_suffix("nm").unwrap_or(bare).trim();
    if !bare.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    bare.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wavelengths_are_read_in_every_spelling() {
        for header in ["400", "400nm", "400 nm", "R400", "SPEC_400", "nm400", "400.0"] {
            assert_eq!(column(header, true), Some(Column::Wavelength(400.0)), "{header}");
        }
        assert_eq!(column("381.2", true), Some(Column::Wavelength(381.2)));
        assert_eq!(column("Red Ochre", true), Some(Column::Pigment("Red Ochre".into())));
        assert_eq!(column("PB29", true), Some(Column::Pigment("PB29".into())));
        assert_eq!(column("99999", true), None);
    }

    #[test]
    fn a_letter_and_a_number_beside_plain_numbers_is_a_pigment() {
        let beside = columns("f", &["sample", "R254", "R101", "400"]).unwrap();
        assert_eq!(beside[1], Column::Pigment("R254".into()));
        let alone = columns("f", &["sample", "R101", "R400", "R500"]).unwrap();
        assert_eq!(alone[1], Column::Pigment("R101".into()));
        assert_eq!(alone[2], Column::Wavelength(400.0));
    }
}
