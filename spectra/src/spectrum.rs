//! Spectra with a physical quantity as their type.

use std::marker::PhantomData;

use crate::grid::Grid;
use crate::interpolate::{Extrapolation, InterpolateError, Interpolation};
use documents::counted;
use documents::hint::Explain;

/// A physical quantity over wavelength, with its range of valid values.
pub trait Quantity: Copy + std::fmt::Debug + PartialEq {
    /// Name of the quantity in errors.
    const NAME: &'static str;
    /// Smallest valid value.
    const MIN: f64;
    /// Largest valid value.
    const MAX: f64;
    /// Description of the valid range in errors.
    const RANGE: &'static str;

    /// Whether `value` is finite and in the valid range.
    fn is_valid(value: f64) -> bool {
        value.is_finite() && (Self::MIN..=Self::MAX).contains(&value)
    }
}

macro_rules! quantity {
    ($(#[$doc:meta])* $name:ident, $word:literal, $least:expr, $most:expr, $range:literal) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub struct $name;

        impl Quantity for $name {
            const NAME: &'static str = $word;
            const MIN: f64 = $least;
            const MAX: f64 = $most;
            const RANGE: &'static str = $range;
        }
    };
}

quantity!(
    /// Reflectance factor as a fraction. Values above 1 are valid (fluorescence, or a reading
    /// relative to a darker white); values above 2 are taken for percent and refused.
    Reflectance, "reflectance", 0.0, 2.0, "0 to 2"
);
quantity!(
    /// Relative spectral power of a light, in any unit; not negative.
    Power, "power", 0.0, f64::INFINITY, "0 and up"
);
quantity!(
    /// Kubelka-Munk absorption coefficient K, per unit of thickness or of amount.
    Absorption, "absorption", 0.0, f64::INFINITY, "0 and up"
);
quantity!(
    /// Kubelka-Munk scattering coefficient S, per unit of thickness or of amount.
    Scattering, "scattering", 0.0, f64::INFINITY, "0 and up"
);
quantity!(
    /// Response of an observer or a sensor, of any sign.
    Response, "response", f64::NEG_INFINITY, f64::INFINITY, "any finite number"
);

/// Values of the quantity `Q` on a regular grid, each in the valid range of `Q`.
///
/// Outside the grid a spectrum has no value: evaluating there is an error unless the caller
/// asks for [`Extrapolation::Hold`].
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum<Q> {
    grid: Grid,
    values: Vec<f64>,
    quantity: PhantomData<Q>,
}

impl<Q: Quantity> Spectrum<Q> {
    /// A spectrum of `values` on `grid`, one for each wavelength.
    ///
    /// # Errors
    /// [`SpectrumError`] if their number differs or a value is not valid.
    pub fn new(grid: Grid, values: Vec<f64>) -> Result<Self, SpectrumError> {
        if values.len() != grid.count() {
            return Err(SpectrumError::Count { expected: grid.count(), found: values.len() });
        }
        if let Some(index) = values.iter().position(|&v| !Q::is_valid(v)) {
            return Err(SpectrumError::Value {
                quantity: Q::NAME,
                range: Q::RANGE,
                nm: grid.nm(index),
                value: values[index],
            });
        }
        Ok(Self { grid, values, quantity: PhantomData })
    }

    /// The wavelengths of the spectrum.
    #[must_use]
    pub fn grid(&self) -> Grid {
        self.grid
    }

    /// The values, in order of rising wavelength.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Consumes the spectrum and returns its values in order of rising wavelength.
    #[must_use]
    pub fn into_values(self) -> Vec<f64> {
        self.values
    }

    /// The value at the wavelength `nm`.
    ///
    /// # Errors
    /// [`InterpolateError`] outside the band (unless the end value is held), or if the grid has
    /// too few wavelengths for the method.
    pub fn at(
        &self,
        nm: f64,
        method: Interpolation,
        ends: Extrapolation,
    ) -> Result<f64, InterpolateError> {
        Ok(method.row(self.grid, nm, ends)?.apply(&self.values))
    }

    /// Resamples the spectrum to another grid. Interpolated values outside the valid range
    /// (such as a reflectance below 0, where the polynomial overshoots) are clipped.
    ///
    /// # Errors
    /// [`InterpolateError`] in the cases of [`Spectrum::at`].
    pub fn resampled(
        &self,
        grid: Grid,
        method: Interpolation,
        ends: Extrapolation,
    ) -> Result<Self, InterpolateError> {
        let values = grid
            .wavelengths_nm()
            .map(|nm| Ok(self.at(nm, method, ends)?.clamp(Q::MIN, Q::MAX)))
            .collect::<Result<_, InterpolateError>>()?;
        Ok(Self { grid, values, quantity: PhantomData })
    }
}

/// Values that do not form a spectrum.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SpectrumError {
    /// The number of values differs from the number of wavelengths.
    #[error("a grid of {} needs as many values, found `{found}`", counted(*expected, "wavelength"))]
    Count {
        /// Number of wavelengths on the grid.
        expected: usize,
        /// Number of values that were given.
        found: usize,
    },
    /// A value is outside the range of the quantity.
    #[error("{quantity} at {nm} nm must be {range}, found `{value}`")]
    Value {
        /// Name of the quantity.
        quantity: &'static str,
        /// Description of the valid range.
        range: &'static str,
        /// Wavelength of the value in nm.
        nm: f64,
        /// The value that was given.
        value: f64,
    },
}

impl Explain for SpectrumError {}
