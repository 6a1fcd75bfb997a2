//! Rank and condition of a fit's equations.

use nalgebra::{DMatrix, SymmetricEigen};

use super::curves::Curves;
use super::forward::Data;
use super::problem::Problem;

/// How well the mixtures determine K and S at the wavelength where they do so
/// worst.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Condition {
    /// Unknowns a wavelength.
    pub unknowns: usize,
    /// The least rank over wavelength.
    pub rank: usize,
    /// The largest condition number among the wavelengths of that rank.
    pub number: f64,
    /// Where that is, in nm.
    pub nm: f64,
}

/// Rank and condition of the derivatives of measured reflectance over log K and
/// log S, columns scaled to length 1. A singular value below 3e-7 of the
/// largest counts as 0: that is where rounding of the normal matrix ends.
#[must_use]
pub fn condition(problem: &Problem, absorption: &[Vec<f64>], scattering: &[Vec<f64>]) -> Condition {
    let curves = Curves { absorption: absorption.to_vec(), scattering: scattering.to_vec() };
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
        let rank = eigenvalues.iter().filter(|&&v| v > 1e-13 * largest).count();
        let number = (largest / eigenvalues.min().max(1e-16 * largest)).sqrt();
        if rank < worst.rank || (rank == worst.rank && number > worst.number) {
            (worst.rank, worst.number, worst.nm) = (rank, number, problem.grid.nm(at));
        }
    }
    worst
}
