//! K and S of all pigments, as values and as unknowns of a fit.

use pigment::Curves;
use spectra::Grid;

/// K and S of all pigments, by pigment and wavelength.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CurveTable {
    pub(crate) absorption: Vec<Vec<f64>>,
    pub(crate) scattering: Vec<Vec<f64>>,
}

impl CurveTable {
    /// Table of `curves`, with K of at least `least[0]` and S of at least `least[1]`, since the logarithm
    /// of 0 has no slope.
    pub(crate) fn off_zero(curves: &[Curves], least: [f64; 2]) -> Self {
        let clamped = |curve: &[f64], least: f64| curve.iter().map(|v| v.max(least)).collect();
        Self {
            absorption: curves.iter().map(|c| clamped(&c.absorption, least[0])).collect(),
            scattering: curves.iter().map(|c| clamped(&c.scattering, least[1])).collect(),
        }
    }

    /// The curves by pigment.
    pub(crate) fn into_curves(self, grid: Grid) -> Vec<Curves> {
        let pairs = self.absorption.into_iter().zip(self.scattering);
        pairs.map(|(absorption, scattering)| Curves { grid, absorption, scattering }).collect()
    }
}

/// Lower limits of K and S, applied to a solution that may contain 0 before logarithms are taken.
pub(crate) const OFF_ZERO: [f64; 2] = [1e-4, 1e-3];

/// Bounds of log K and log S: from 1e-5, below which a pigment does not show, to 1e4.
pub(super) const LOWER: f64 = -11.512_925_464_970_229;
pub(super) const UPPER: f64 = 9.210_340_371_976_184;

/// Places of the unknowns: by wavelength, log K of every pigment, then log S of every pigment except the
/// reference, whose S is 1. Absolute amounts have no reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Layout {
    pub(super) pigments: usize,
    pub(super) reference: Option<usize>,
    pub(super) wavelengths: usize,
}

impl Layout {
    /// Number of unknowns per wavelength.
    pub(super) fn per_wavelength(self) -> usize {
        2 * self.pigments - usize::from(self.reference.is_some())
    }

    /// Number of unknowns in all.
    pub(super) fn len(self) -> usize {
        self.per_wavelength() * self.wavelengths
    }

    /// Place of log S of `pigment` within its wavelength; `None` for the reference.
    pub(super) fn scattering(self, pigment: usize) -> Option<usize> {
        match self.reference {
            Some(reference) if pigment == reference => None,
            Some(reference) if pigment > reference => Some(self.pigments + pigment - 1),
            _ => Some(self.pigments + pigment),
        }
    }

    /// Unknowns of `curves`, clamped to the bounds.
    pub(super) fn unknowns(self, curves: &CurveTable) -> Vec<f64> {
        let log = |value: f64| value.max(f64::MIN_POSITIVE).ln().clamp(LOWER, UPPER);
        let mut unknowns = Vec::with_capacity(self.len());
        for at in 0..self.wavelengths {
            unknowns.extend((0..self.pigments).map(|p| log(curves.absorption[p][at])));
            let others = (0..self.pigments).filter(|&p| Some(p) != self.reference);
            unknowns.extend(others.map(|p| log(curves.scattering[p][at])));
        }
        unknowns
    }

    /// K and S of `unknowns`.
    pub(super) fn curves(self, unknowns: &[f64]) -> CurveTable {
        let per = self.per_wavelength();
        let curve = |place: usize| -> Vec<f64> {
            (0..self.wavelengths).map(|at| unknowns[at * per + place].exp()).collect()
        };
        CurveTable {
            absorption: (0..self.pigments).map(curve).collect(),
            scattering: (0..self.pigments)
                .map(|p| self.scattering(p).map_or_else(|| vec![1.0; self.wavelengths], curve))
                .collect(),
        }
    }
}
