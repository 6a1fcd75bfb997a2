//! Whether a wavelength grid covers enough of the visible band for colours.

use documents::hint::{Explain, Hint};
use spectra::Grid;

use crate::remark::Remark;

/// Band in nm that a grid must touch to have a colour at all.
const NEEDED_NM: [f64; 2] = [400.0, 700.0];
/// Band in nm that a grid should cover: it holds nearly all of the luminance and chroma.
const WANTED_NM: [f64; 2] = [420.0, 680.0];

/// Part of the visible band that a grid covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BandCoverage {
    /// 420 to 680 nm or more.
    Full,
    /// Only a part; colours take the end values for the rest.
    Partial,
    /// Nothing from 400 to 700 nm.
    Missing,
}

impl BandCoverage {
    /// Coverage of `grid`.
    #[must_use]
    pub fn of(grid: Grid) -> Self {
        let start = grid.start_nm();
        let end = grid.end_nm();
        if end < NEEDED_NM[0] || start > NEEDED_NM[1] {
            Self::Missing
        } else if start > WANTED_NM[0] || end < WANTED_NM[1] {
            Self::Partial
        } else {
            Self::Full
        }
    }
}

/// Checks that spectra on `grid` have colours. Returns a warning where the grid covers only a part of the
/// visible band.
///
/// # Errors
/// [`BandError`] for a grid without any visible wavelength.
pub fn check_visible_band(grid: Grid) -> Result<Option<Remark>, BandError> {
    let start_nm = grid.start_nm();
    let end_nm = grid.end_nm();
    match BandCoverage::of(grid) {
        BandCoverage::Full => Ok(None),
        BandCoverage::Partial => Ok(Some(Remark::warning(format!(
            "spectra from {start_nm} to {end_nm} nm; colours take the end values for the rest of the visible band"
        )))),
        BandCoverage::Missing => Err(BandError { start_nm, end_nm }),
    }
}

/// Spectra without any visible wavelength have no colour.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("spectra from {start_nm} to {end_nm} nm have no colour")]
pub struct BandError {
    /// First wavelength of the spectra in nm.
    pub start_nm: f64,
    /// Last wavelength of the spectra in nm.
    pub end_nm: f64,
}

impl Explain for BandError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new("measure from 400 to 700 nm or more"))
    }
}
