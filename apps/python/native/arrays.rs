//! Arrays and grids between Python and Rust.

use documents::hint::Fault;
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use spectra::{Grid, Reflectance, Spectrum};

use crate::failure::{Exception, Raised};

/// A grid of wavelengths as first wavelength, step and count, in nm.
pub(crate) type GridNumbers = (f64, f64, usize);

/// The grid that these numbers describe.
pub(crate) fn grid(py: Python<'_>, (start, step, count): GridNumbers) -> PyResult<Grid> {
    Grid::from_nm(start, step, count).raised(py, Exception::Other)
}

/// Values of a matrix row by row, and its shape.
pub(crate) fn rows<'a>(
    py: Python<'_>,
    matrix: &'a PyReadonlyArray2<'_, f64>,
) -> PyResult<(&'a [f64], [usize; 2])> {
    let shape = matrix.shape();
    let slice = matrix.as_slice().map_err(|_| {
        let message = "an array must lie in memory row after row";
        Exception::Other.with(py, Fault::Setting, message, Some("use numpy.ascontiguousarray"))
    })?;
    Ok((slice, [shape[0], shape[1]]))
}

/// A reflectance on the grid of these numbers.
pub(crate) fn reflectance(
    py: Python<'_>,
    numbers: GridNumbers,
    values: &PyReadonlyArray1<'_, f64>,
) -> PyResult<Spectrum<Reflectance>> {
    let grid = grid(py, numbers)?;
    let values = values.as_array().to_vec();
    Spectrum::new(grid, values).raised(py, Exception::Reading)
}
