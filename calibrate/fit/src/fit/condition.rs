//! Rank and condition of the equations of a fit.

use nalgebra::{DMatrix, SymmetricEigen};

use super::curves::CurveTable;
use super::forward::Data;
use super::problem::Problem;
use pigment::Curves;

/// How well the mixtures determine K and S, at the wavelength where they do so worst.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Condition {
    /// Number of unknowns per wavelength.
    pub unknowns: usize,
    /// Least rank over all wavelengths.
    pub rank: usize,
    /// Largest condition number among the wavelengths of that rank.
    pub number: f64,
    /// Wavelength of that condition number, in nm.
    pub nm: f64,
}

/// Eigenvalues of the normal matrix below this fraction of the largest are attributed to rounding.
const ROUNDING: f64 = 1e-13;

/// Computes rank and condition of the derivatives of measured reflectance over log K and log S, with
/// columns scaled to length 1. A singular value below 3e-7 of the largest counts as 0, since rounding of
/// the normal matrix ends there.
#[must_use]
pub fn condition(problem: &Problem, curves: &[Curves]) -> Condition {
    let curves = CurveTable::off_zero(curves, [f64::NEG_INFINITY; 2]);
    let data = Data::hiding(problem);
    let linear = data.linear(&curves);
    let unknowns = data.layout.per_wavelength();
    let mut worst =
        Condition { unknowns, rank: unknowns, number: 0.0, nm: problem.grid.start_nm() };
    for at in 0..data.layout.wavelengths {
        let normal = data.normal(&linear, at);
        let lengths: Vec<f64> = (0..unknowns).map(|i| normal[(i, i)].sqrt()).collect();
        let unit = |i: usize| if lengths[i] > 0.0 { lengths[i] } else { 1.0 };
        let scaled =
            DMatrix::from_fn(unknowns, unknowns, |i, j| normal[(i, j)] / (unit(i) * unit(j)));
        let eigenvalues = SymmetricEigen::new(scaled).eigenvalues;
        let largest = eigenvalues.max();
        let rank = eigenvalues.iter().filter(|&&v| v > ROUNDING * largest).count();
        let number = (largest / eigenvalues.min().max(1e-16 * largest)).sqrt();
        if rank < worst.rank || (rank == worst.rank && number > worst.number) {
            (worst.rank, worst.number, worst.nm) = (rank, number, problem.grid.nm(at));
        }
    }
    worst
}
