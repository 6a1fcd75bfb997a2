//! The one grid of a table, and values brought to it.

use spectra::{Extrapolation, Grid, IrregularSpectrum};

/// The grid of `wavelengths_nm`, which rise strictly: their own if they are regular, else
/// [`regular_grid`].
pub(super) fn grid_of(wavelengths_nm: &[f64]) -> Grid {
    Grid::through(wavelengths_nm).unwrap_or_else(|| regular_grid(wavelengths_nm))
}

/// `values` at `wavelengths_nm`, brought to `grid` by straight lines.
pub(super) fn on_grid(grid: Grid, wavelengths_nm: &[f64], values: Vec<f64>) -> Vec<f64> {
    if Grid::through(wavelengths_nm) == Some(grid) {
        return values;
    }
    let samples =
        IrregularSpectrum::new(wavelengths_nm.to_vec(), values).expect("wavelengths rise");
    let at = |nm| samples.at_linear(nm, Extrapolation::Hold).expect("ends are held");
    grid.wavelengths_nm().map(at).collect()
}

/// The regular grid for irregular wavelengths: inside their band, at the
/// smallest of 1, 2, 5, 10 and 20 nm that is not finer than their median step (by
/// more than 5 %).
fn regular_grid(wavelengths_nm: &[f64]) -> Grid {
    let mut steps: Vec<f64> = wavelengths_nm.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    let median = steps[steps.len() / 2];
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().find(|s| 1.05 * s >= median).unwrap_or(20.0);
    let last = wavelengths_nm[wavelengths_nm.len() - 1];
    let round = (wavelengths_nm[0] / step).ceil() * step;
    let start = if round <= last { round } else { wavelengths_nm[0] };
    let count = ((last - start) / step).floor().max(0.0) as usize + 1;
    Grid::from_nm(start, step, count).expect("rising wavelengths span a grid")
}
