//! The common grid of a table, and values resampled to it.

use spectra::{Grid, IrregularSpectrum};

/// The grid for `wavelengths_nm`, which rise strictly: [`Grid::suited_to`] them.
pub(super) fn grid_of(wavelengths_nm: &[f64]) -> Grid {
    Grid::suited_to(wavelengths_nm).expect("the wavelengths rise strictly")
}

/// `values` at `wavelengths_nm`, interpolated to `grid` by [`IrregularSpectrum::on_grid`].
pub(super) fn on_grid(grid: Grid, wavelengths_nm: &[f64], values: Vec<f64>) -> Vec<f64> {
    let irregular = IrregularSpectrum::new(wavelengths_nm.to_vec(), values);
    irregular.expect("the wavelengths rise strictly").on_grid(grid)
}
