//! The option `--grid`: regular wavelengths as `FIRST,LAST,STEP`.

use spectra::{Grid, GridError};

use crate::failure::{Failure, Result};

/// Parses a grid `FIRST,LAST,STEP` in nm.
pub(crate) fn grid(text: &str) -> Result<Grid> {
    let invalid = || {
        Failure::usage(
            format!(
                "--grid takes FIRST,LAST,STEP in nm, LAST a whole number of steps from FIRST, found `{text}`"
            ),
            "try --grid 400,700,10",
        )
    };
    let [first, last, step] = numbers(text).ok_or_else(invalid)?;
    Grid::from_range(first, last, step).map_err(|error| match error {
        GridError::Range { .. } => invalid(),
        error => Failure::usage(format!("--grid {text}: {error}"), "try --grid 400,700,10"),
    })
}

/// Parses exactly N numbers separated by commas.
pub(crate) fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    numbers?.try_into().ok()
}
