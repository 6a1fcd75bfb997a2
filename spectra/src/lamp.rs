//! A measured lamp from a two-column text file.

use crate::grid::Grid;
use crate::illuminant::{Illuminant, IlluminantError};
use crate::samples::Samples;

/// A light from text with one `wavelength, power` pair a line.
///
/// Wavelengths in nm, rising, at any steps; power in any unit. Columns are
/// parted by comma, semicolon, tab or spaces; lines that start with `#` and one
/// header line are passed over. `name` is what the light will be called, and
/// what an error calls the file.
///
/// # Errors
/// [`LampError`], with the line.
pub fn lamp_from_csv(name: &str, text: &str) -> Result<Illuminant, LampError> {
    let mut nm = Vec::new();
    let mut power = Vec::new();
    let mut header_seen = false;
    for (index, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let trimmed = line.trim();
        if trimmed.is_empty() || trimmed.starts_with('#') {
            continue;
        }
        let cells: Vec<&str> = trimmed
            .split([',', ';', '\t', ' '])
            .map(str::trim)
            .filter(|cell| !cell.is_empty())
            .collect();
        let numbers: Vec<f64> = cells.iter().filter_map(|cell| cell.parse().ok()).collect();
        match (numbers.as_slice(), cells.len()) {
            (&[w, p], 2) => {
                if nm.last().is_some_and(|&before| w <= before) || !w.is_finite() {
                    return Err(LampError::Order { file: name.to_owned(), line: index + 1, nm: w });
                }
                if !(p.is_finite() && p >= 0.0) {
                    return Err(LampError::Power {
                        file: name.to_owned(),
                        line: index + 1,
                        nm: w,
                        power: p,
                    });
                }
                nm.push(w);
                power.push(p);
            }
            ([], _) if nm.is_empty() && !header_seen => header_seen = true,
            _ => {
                return Err(LampError::Line {
                    file: name.to_owned(),
                    line: index + 1,
                    text: trimmed.to_owned(),
                });
            }
        }
    }
    if nm.len() < 2 {
        return Err(LampError::TooShort { file: name.to_owned(), count: nm.len() });
    }
    let (start_nm, end_nm) = (nm[0], nm[nm.len() - 1]);
    let band = Grid::cie();
    if end_nm < band.start_nm() || start_nm > band.end_nm() {
        return Err(LampError::Band { file: name.to_owned(), start_nm, end_nm });
    }
    let samples = Samples::new(nm, power).map_err(IlluminantError::from)?;
    Ok(Illuminant::from_samples(name, &samples)?)
}

/// Why a lamp's file cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LampError {
    /// A line is not two numbers.
    #[error("{file}, line {line}: a wavelength and a power are wanted, found `{text}`")]
    Line {
        /// The file.
        file: String,
        /// Counted from 1.
        line: usize,
        /// What stands there.
        text: String,
    },
    /// A wavelength does not rise.
    #[error("{file}, line {line}: wavelengths must rise, found `{nm}` nm")]
    Order {
        /// The file.
        file: String,
        /// Counted from 1.
        line: usize,
        /// The wavelength.
        nm: f64,
    },
    /// A power is negative or no number.
    #[error("{file}, line {line}: power at {nm} nm must be 0 and up, found `{power}`")]
    Power {
        /// The file.
        file: String,
        /// Counted from 1.
        line: usize,
        /// The wavelength.
        nm: f64,
        /// The power.
        power: f64,
    },
    /// Fewer than two wavelengths.
    #[error("{file}: a lamp needs at least 2 wavelengths, found `{count}`")]
    TooShort {
        /// The file.
        file: String,
        /// How many were found.
        count: usize,
    },
    /// No wavelength that an eye sees; in another unit, perhaps.
    #[error(
        "{file}: a lamp needs wavelengths from 360 to 830 nm, found `{start_nm}` to `{end_nm}` nm"
    )]
    Band {
        /// The file.
        file: String,
        /// The first wavelength.
        start_nm: f64,
        /// The last one.
        end_nm: f64,
    },
    /// The light cannot be used.
    #[error(transparent)]
    Light(#[from] IlluminantError),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn header_comments_and_separators_are_read() {
        let text = "# lamp\nnm;power\n400;1\n500\t2\n 600 , 3\n";
        let lamp = lamp_from_csv("lamp", text).unwrap();
        let at = |nm: usize| lamp.power().values()[nm - 360];
        assert_eq!((at(360), at(450), at(600), at(800)), (1.0, 1.5, 3.0, 3.0));
    }

    #[test]
    fn faults_name_the_line() {
        assert!(matches!(
            lamp_from_csv("l", "400,1\n390,2\n"),
            Err(LampError::Order { line: 2, .. })
        ));
        assert!(matches!(
            lamp_from_csv("l", "400,1\n410,-2\n"),
            Err(LampError::Power { line: 2, .. })
        ));
        assert!(matches!(
            lamp_from_csv("l", "400,1\n410,x\n"),
            Err(LampError::Line { line: 2, .. })
        ));
        assert!(matches!(lamp_from_csv("l", "400,1\n"), Err(LampError::TooShort { count: 1, .. })));
    }
}
