//! Spectra with a physical quantity as their type, on a regular grid or at irregular wavelengths.

use std::marker::PhantomData;

use documents::counted;
use documents::hint::Explain;

use crate::grid::{Grid, Wavelength, WavelengthError};
use crate::interpolate::{Extrapolation, InterpolateError, Interpolation, Spline, roughness};

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
    /// Reflectance factor as a fraction. Values above 1 are valid, e.g. for fluorescence or
    /// relative to a darker white. We refuse values above 2, because they are probably percent.
    Reflectance, "reflectance", 0.0, 2.0, "0 to 2"
);
quantity!(
    /// Relative spectral power of a light, in any unit, not negative.
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
/// Outside the grid a spectrum has no value. If you evaluate it there, you get an error unless you
/// ask for [`Extrapolation::Hold`].
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
    /// [`InterpolateError`] outside the band (unless you hold the end value), or if the grid has
    /// too few wavelengths for the method.
    pub fn at(
        &self,
        nm: f64,
        method: Interpolation,
        ends: Extrapolation,
    ) -> Result<f64, InterpolateError> {
        Ok(method.row(self.grid, nm, ends)?.apply(&self.values))
    }

    /// Resamples the spectrum to another grid. This clips interpolated values to the valid range,
    /// for example a reflectance below 0 where the polynomial overshoots.
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
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
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

/// Fewest values for a spline, as Sprague's polynomial needs on a regular grid.
const LEAST_OF_SPLINE: usize = 6;

/// Values at strictly rising wavelengths with no regular step, as spectrometers with an array
/// detector give them.
#[derive(Debug, Clone, PartialEq)]
pub struct IrregularSpectrum {
    nm: Vec<f64>,
    values: Vec<f64>,
}

impl IrregularSpectrum {
    /// A spectrum of `values` at the wavelengths `nm`.
    ///
    /// # Errors
    /// [`IrregularSpectrumError`] if their numbers differ, there are none, or `nm` contains a
    /// number that is not a wavelength or does not rise strictly.
    pub fn new(nm: Vec<f64>, values: Vec<f64>) -> Result<Self, IrregularSpectrumError> {
        if nm.len() != values.len() || nm.is_empty() {
            return Err(IrregularSpectrumError::Count {
                wavelengths: nm.len(),
                values: values.len(),
            });
        }
        for &nm in &nm {
            Wavelength::from_nm(nm)?;
        }
        if let Some(pair) = nm.windows(2).find(|pair| pair[0] >= pair[1]) {
            return Err(IrregularSpectrumError::Order { before: pair[0], after: pair[1] });
        }
        Ok(Self { nm, values })
    }

    /// The wavelengths in nm, rising.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.nm
    }

    /// The values, in order of rising wavelength.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The value at `nm`, interpolated linearly.
    ///
    /// # Errors
    /// [`IrregularSpectrumError::Outside`] outside the band, unless the end values are held.
    pub fn at_linear(&self, nm: f64, ends: Extrapolation) -> Result<f64, IrregularSpectrumError> {
        let last = self.nm.len() - 1;
        if !(self.nm[0]..=self.nm[last]).contains(&nm) {
            return match ends {
                Extrapolation::Hold if !nm.is_nan() => {
                    Ok(self.values[if nm < self.nm[0] { 0 } else { last }])
                }
                _ => Err(IrregularSpectrumError::Outside {
                    nm,
                    start_nm: self.nm[0],
                    end_nm: self.nm[last],
                }),
            };
        }
        let after = self.nm.partition_point(|&w| w < nm);
        if self.nm[after] == nm {
            return Ok(self.values[after]);
        }
        let before = after - 1;
        let fraction = (nm - self.nm[before]) / (self.nm[after] - self.nm[before]);
        Ok(self.values[before] * (1.0 - fraction) + self.values[after] * fraction)
    }

    /// The spectrum on `grid`, interpolated by a natural cubic spline, or linearly if there are
    /// fewer than six values. Outside the band the end values count. You get values at wavelengths
    /// of `grid` back unchanged. If no value is negative, none becomes so.
    ///
    /// Use this for reflectances, which are smooth. For a lamp with lines use
    /// [`IrregularSpectrum::at_linear`], because a spline would swing next to each line.
    #[must_use]
    pub fn on_grid(&self, grid: Grid) -> Vec<f64> {
        if Grid::through(&self.nm) == Some(grid) {
            return self.values.clone();
        }
        let curve = self.smooth_curve();
        let last = self.nm.len() - 1;

        grid.wavelengths_nm()
            .map(|nm| {
                curve.at(nm).unwrap_or_else(|| self.values[if nm < self.nm[0] { 0 } else { last }])
            })
            .collect()
    }

    /// The usual distance of neighbouring wavelengths in nm, their median. 0 for a single value.
    #[must_use]
    pub fn step_nm(&self) -> f64 {
        let mut steps: Vec<f64> = self.nm.windows(2).map(|pair| pair[1] - pair[0]).collect();
        steps.sort_by(f64::total_cmp);
        steps.get(steps.len() / 2).copied().unwrap_or(0.0)
    }

    /// Whether a polynomial through the values comes closer to what lies between them than straight lines
    /// do: true for incandescent lamps and LEDs, false for lamps with lines and for noise.
    ///
    /// We compare the sums of squares of fourth and of second differences. The root of their ratio must be at most 2 for
    /// steps of up to 5 nm, rising to 2.7 at 10 nm and beyond. The CIE's LEDs (CIE 15:2018) have up to 1.5
    /// at 5 nm and 2.7 at 10 nm, its fluorescent lamps 2.7 to 3.4 at 5 nm. Fewer than eight values are
    /// never smooth.
    #[must_use]
    pub fn is_smooth(&self) -> bool {
        let most = (1.3 + 0.14 * self.step_nm()).clamp(2.0, 2.7);
        let regular = Grid::through(&self.nm).is_some();
        let values = match Grid::suited_to(&self.nm) {
            Some(grid) if !regular => grid
                .wavelengths_nm()
                .filter_map(|nm| self.at_linear(nm, Extrapolation::Hold).ok())
                .collect(),
            _ => self.values.clone(),
        };
        roughness(&values).is_some_and(|found| found <= most)
    }

    /// The curve through the values of a smooth quantity.
    pub(crate) fn smooth_curve(&self) -> SmoothCurve<'_> {
        let enough = self.nm.len() >= LEAST_OF_SPLINE;
        let spline = enough.then(|| Spline::through(&self.nm, &self.values));
        let is_negative = self.values.iter().any(|&value| value < 0.0);
        let least = if is_negative { f64::NEG_INFINITY } else { 0.0 };
        SmoothCurve { spectrum: self, spline, least }
    }
}

/// A spectrum as a natural cubic spline, or as straight lines if it has fewer than six values.
#[derive(Debug)]
pub(crate) struct SmoothCurve<'a> {
    spectrum: &'a IrregularSpectrum,
    spline: Option<Spline<'a>>,
    /// Least value of the curve. This is 0 unless the spectrum itself has negative values.
    least: f64,
}

impl SmoothCurve<'_> {
    /// The value at `nm`. `None` outside the band.
    pub(crate) fn at(&self, nm: f64) -> Option<f64> {
        let linear = self.spectrum.at_linear(nm, Extrapolation::Refuse).ok()?;
        Some(self.spline.as_ref().map_or(linear, |spline| spline.at(nm).max(self.least)))
    }
}

/// Values that do not form a spectrum, or a spectrum that cannot be evaluated.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum IrregularSpectrumError {
    /// The numbers of wavelengths and values differ, or there are none.
    #[error(
        "one value for each wavelength is needed, found `{values}` for {}",
        counted(*wavelengths, "wavelength")
    )]
    Count {
        /// Number of wavelengths.
        wavelengths: usize,
        /// Number of values.
        values: usize,
    },
    /// A number that is not a wavelength.
    #[error(transparent)]
    Wavelength(#[from] WavelengthError),
    /// The wavelengths do not rise strictly.
    #[error("wavelengths must rise strictly, found {before} nm before `{after}` nm")]
    Order {
        /// The wavelength before, in nm.
        before: f64,
        /// The wavelength that is not larger, in nm.
        after: f64,
    },
    /// The wavelength is outside the band of the spectrum.
    #[error("`{nm}` nm lies outside the measured band of {start_nm} to {end_nm} nm")]
    Outside {
        /// The requested wavelength in nm.
        nm: f64,
        /// First wavelength of the spectrum in nm.
        start_nm: f64,
        /// Last wavelength of the spectrum in nm.
        end_nm: f64,
    },
}
