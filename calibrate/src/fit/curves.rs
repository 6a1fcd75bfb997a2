//! K and S of every pigment, as physical values and as unknowns.

/// K and S by pigment and wavelength.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Curves {
    pub(crate) absorption: Vec<Vec<f64>>,
    pub(crate) scattering: Vec<Vec<f64>>,
}

/// Bounds of log K and log S: from 1e-5, where a pigment no longer shows, to
/// 1e4.
pub(super) const LOWER: f64 = -11.512_925_464_970_229;
pub(super) const UPPER: f64 = 9.210_340_371_976_184;

/// Where each unknown stands: by wavelength log K of every pigment, then log S
/// of every pigment but the reference, whose S is 1. Absolute amounts need no
/// reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Layout {
    pub(super) pigments: usize,
    pub(super) reference: Option<usize>,
    pub(super) wavelengths: usize,
}

impl Layout {
    /// Unknowns a wavelength.
    pub(super) fn per_wavelength(self) -> usize {
        2 * self.pigments - usize::from(self.reference.is_some())
    }

    /// Unknowns in all.
    pub(super) fn len(self) -> usize {
        self.per_wavelength() * self.wavelengths
    }

    /// Where log S of `pigment` stands in its wavelength; `None` for the
    /// reference.
    pub(super) fn scattering(self, pigment: usize) -> Option<usize> {
        match self.reference {
            Some(reference) if pigment == reference => None,
            Some(reference) if pigment > reference => Some(self.pigments + pigment - 1),
            _ => Some(self.pigments + pigment),
        }
    }

    /// The unknowns of `curves`, within the bounds.
    pub(super) fn unknowns(self, curves: &Curves) -> Vec<f64> {
        let log = |value: f64| value.max(f64::MIN_POSITIVE).ln().clamp(LOWER, UPPER);
        let mut unknowns = Vec::with_capacity(self.len());
        for at in 0..self.wavelengths {
            unknowns.extend((0..self.pigments).map(|p| log(curves.absorption[p][at])));
            let others = (0..self.pigments).filter(|&p| Some(p) != self.reference);
            unknowns.extend(others.map(|p| log(curves.scattering[p][at])));
        }
        unknowns
    }

    /// The curves of `unknowns`.
    pub(super) fn curves(self, unknowns: &[f64]) -> Curves {
        let per = self.per_wavelength();
        let curve = |place: usize| -> Vec<f64> {
            (0..self.wavelengths).map(|at| unknowns[at * per + place].exp()).collect()
        };
        Curves {
            absorption: (0..self.pigments).map(curve).collect(),
            scattering: (0..self.pigments)
                .map(|p| self.scattering(p).map_or_else(|| vec![1.0; self.wavelengths], curve))
                .collect(),
        }
    }
}
