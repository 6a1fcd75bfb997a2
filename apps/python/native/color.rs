//! Colours of many spectra at once.

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;
use spectra::color::{ColorValues, Lab, Xyz, delta_e_cie76, delta_e_ciede2000};

use crate::arrays::{GridNumbers, grid, rows};
use crate::failure::{Exception, Raised};
use crate::light::{Light, viewing};
use crate::running::beside;

/// A thread takes this many spectra as one task.
const SPECTRA_A_TASK: usize = 4096;

/// XYZ of each row of reflectances, and XYZ of the white.
#[pyfunction]
#[pyo3(signature = (reflectance, grid_numbers, light, observer))]
pub(crate) fn xyz<'py>(
    py: Python<'py>,
    reflectance: PyReadonlyArray2<'py, f64>,
    grid_numbers: GridNumbers,
    light: &Light,
    observer: &str,
) -> PyResult<(Bound<'py, PyArray2<f64>>, [f64; 3])> {
    let grid = grid(py, grid_numbers)?;
    let weights = viewing(py, light, observer)?.weights(grid).raised(py, Exception::Other)?;
    let (values, [count, bands]) = rows(py, &reflectance)?;
    let mut xyz = vec![0.0; 3 * count];
    beside(py, || {
        let pieces = xyz.par_chunks_mut(3 * SPECTRA_A_TASK);
        pieces.zip(values.par_chunks(bands * SPECTRA_A_TASK)).for_each(|(xyz, values)| {
            weights.xyz_of_rows(values, xyz.as_chunks_mut().0);
        });
    });
    let white = weights.white().to_array();
    Ok((PyArray1::from_vec(py, xyz).reshape([count, 3])?, white))
}

/// CIELAB and encoded sRGB of each row of XYZ, for this white.
#[pyfunction]
pub(crate) fn rgb<'py>(
    py: Python<'py>,
    xyz: PyReadonlyArray2<'py, f64>,
    white: [f64; 3],
) -> PyResult<(Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>)> {
    let (values, [count, _]) = rows(py, &xyz)?;
    let white = Xyz::from(white);
    let mut lab = vec![0.0; 3 * count];
    let mut srgb = vec![0.0; 3 * count];
    beside(py, || {
        let pairs = lab.as_chunks_mut::<3>().0.par_iter_mut().zip(srgb.as_chunks_mut::<3>().0);
        pairs.zip(values.as_chunks::<3>().0).for_each(|((lab, srgb), xyz)| {
            let color = ColorValues::from_xyz(Xyz::from(*xyz), white);
            (*lab, *srgb) = (color.lab.to_array(), color.srgb.0);
        });
    });
    let [lab, srgb] = [lab, srgb].map(|values| PyArray1::from_vec(py, values).reshape([count, 3]));
    Ok((lab?, srgb?))
}

/// Colour difference of each row of two tables of CIELAB: CIEDE2000, or CIE 1976.
#[pyfunction]
pub(crate) fn delta_e<'py>(
    py: Python<'py>,
    first: PyReadonlyArray2<'py, f64>,
    second: PyReadonlyArray2<'py, f64>,
    cie1976: bool,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (first, _) = rows(py, &first)?;
    let (second, _) = rows(py, &second)?;
    let differences = beside(py, || {
        let pairs = first.as_chunks::<3>().0.par_iter().zip(second.as_chunks::<3>().0);
        let difference = if cie1976 { delta_e_cie76 } else { delta_e_ciede2000 };
        let each = pairs.map(|(a, b)| difference(Lab::from(*a), Lab::from(*b)));
        each.collect::<Vec<f64>>()
    });
    Ok(PyArray1::from_vec(py, differences))
}
