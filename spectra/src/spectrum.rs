//! Spectra that know what they are spectra of.

use std::marker::PhantomData;

use crate::grid::Grid;
use crate::hint::Explain;
use crate::interpolate::{Extrapolation, InterpolateError, Interpolation};

/// A physical quantity over wavelength.
pub trait Quantity: Copy + std::fmt::Debug + PartialEq {
    /// What an error calls it.
    const NAME: &'static str;
    /// The least possible value.
    const MIN: f64;
    /// The greatest possible value.
    const MAX: f64;
    /// The range from least to greatest, in words.
    const RANGE: &'static str;

    /// Whether `value` is possible for this quantity.
    fn possible(value: f64) -> bool {
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
    /// Reflectance factor, as a fraction. Above 1 is possible (fluorescence, or
    /// a reading relative to a duller white); above 2 is a mistaken unit.
    Reflectance, "reflectance", 0.0, 2.0, "0 to 2"
);
quantity!(
    /// Relative spectral power of a light; any unit, not negative.
    Power, "power", 0.0, f64::INFINITY, "0 and up"
);
quantity!(
    /// Kubelka-Munk absorption K, per unit of thickness (or of amount).
    Absorption, "absorption", 0.0, f64::INFINITY, "0 and up"
);
quantity!(
    /// Kubelka-Munk scattering S, per unit of thickness (or of amount).
    Scattering, "scattering", 0.0, f64::INFINITY, "0 and up"
);
quantity!(
    /// Response of an observer or a sensor; any sign.
    Response, "response", f64::NEG_INFINITY, f64::INFINITY, "any finite number"
);

/// Values of the quantity `Q` on a regular grid, each checked to be possible.
///
/// Outside the grid a spectrum has no value: asking for one is an error unless
/// the caller says [`Extrapolation::Hold`].
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum<Q> {
    grid: Grid,
    values: Vec<f64>,
    quantity: PhantomData<Q>,
}

impl<Q: Quantity> Spectrum<Q> {
    /// `values` on `grid`, one for each wavelength.
    ///
    /// # Errors
    /// [`SpectrumError`] if the count differs or a value is impossible.
    pub fn new(grid: Grid, values: Vec<f64>) -> Result<Self, SpectrumError> {
        if values.len() != grid.count() {
            return Err(SpectrumError::Count { wanted: grid.count(), found: values.len() });
        }
        if let Some(index) = values.iter().position(|&v| !Q::possible(v)) {
            return Err(SpectrumError::Value {
                quantity: Q::NAME,
                range: Q::RANGE,
                nm: grid.nm(index),
                value: values[index],
            });
        }
        Ok(Self { grid, values, quantity: PhantomData })
    }

    /// The grid.
    #[must_use]
    pub fn grid(&self) -> Grid {
        self.grid
    }

    /// The values, in order of rising wavelength.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The values, given away.
    #[must_use]
    pub fn into_values(self) -> Vec<f64> {
        self.values
    }

    /// The value at `nm` nanometres.
    ///
    /// # Errors
    /// [`InterpolateError`] outside the band (unless held) or where the method
    /// lacks points.
    pub fn at(
        &self,
        nm: f64,
        method: Interpolation,
        ends: Extrapolation,
    ) -> Result<f64, InterpolateError> {
        Ok(method.row(self.grid, nm, ends)?.apply(&self.values))
    }

    /// The same spectrum on another grid. A polynomial that swings past what is
    /// possible (a reflectance below 0) is cut off there.
    ///
    /// # Errors
    /// [`InterpolateError`] as in [`Spectrum::at`].
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

/// Values that make no spectrum.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SpectrumError {
    /// The number of values is not the number of wavelengths.
    #[error("a grid of {wanted} wavelengths needs {wanted} values, found `{found}`")]
    Count {
        /// Wavelengths on the grid.
        wanted: usize,
        /// Values that were given.
        found: usize,
    },
    /// A value is impossible for the quantity.
    #[error("{quantity} at {nm} nm must be {range}, found `{value}`")]
    Value {
        /// Which quantity.
        quantity: &'static str,
        /// What it may be.
        range: &'static str,
        /// Where.
        nm: f64,
        /// What was found.
        value: f64,
    },
}

impl Explain for SpectrumError {}
