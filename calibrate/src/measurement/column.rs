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
            column(name)
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

/// `None` for a wavelength that no instrument for paint measures.
fn column(name: &str) -> Option<Column> {
    Some(match name.to_ascii_lowercase().as_str() {
        "sample" => Column::Sample,
        "film" => Column::Film,
        "backing" => Column::Backing,
        "thickness_mm" => Column::Thickness,
        "replicate" => Column::Replicate,
        lower => match wavelength(lower) {
            Some(nm) if (200.0..=2500.0).contains(&nm) => Column::Wavelength(nm),
            Some(_) => return None,
            None => Column::Pigment(name.to_owned()),
        },
    })
}

/// The number in `400`, `400nm`, `R400`, `SPEC_400` or `nm400`.
fn wavelength(lower: &str) -> Option<f64> {
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
            assert_eq!(column(header), Some(Column::Wavelength(400.0)), "{header}");
        }
        assert_eq!(column("381.2"), Some(Column::Wavelength(381.2)));
        assert_eq!(column("Red Ochre"), Some(Column::Pigment("Red Ochre".into())));
        assert_eq!(column("PB29"), Some(Column::Pigment("PB29".into())));
        assert_eq!(column("99999"), None);
    }
}
