//! A reading with its dark subtracted.

use super::error::ReferencingError;
use crate::instrument::MeasuredSpectrum;
use crate::interpolate::Extrapolation;
use crate::irregular::IrregularSpectrum;

/// A sample's or white's reading and its dark, each interpolated linearly: counts hold the lines of the
/// lamp, beside which a spline would swing.
pub(super) struct Reading<'a> {
    /// `sample` or `white`, for errors.
    pub(super) role: &'static str,
    pub(super) spectrum: &'a MeasuredSpectrum,
    pub(super) signal: IrregularSpectrum,
    pub(super) dark: Option<IrregularSpectrum>,
    /// Counts from which on the detector is saturated.
    pub(super) ceiling: Option<f64>,
}

impl Reading<'_> {
    /// Signal minus dark at `nm`, in counts or in the unit of power.
    ///
    /// # Errors
    /// [`ReferencingError`] where the detector is saturated, or outside the band of the
    /// reading or of its dark.
    pub(super) fn at(&self, nm: f64) -> Result<f64, ReferencingError> {
        let value = |spectrum: &IrregularSpectrum, role| {
            let value = spectrum.at_linear(nm, Extrapolation::Refuse);
            value.map_err(|_| ReferencingError::Uncovered { role, nm })
        };
        if let Some(ceiling) = self.ceiling.filter(|&ceiling| self.max_neighbour(nm) >= ceiling) {
            let role = self.role;
            let name = self.spectrum.name.clone();
            return Err(ReferencingError::Saturated { role, name, nm, value: ceiling });
        }
        let signal = value(&self.signal, self.role)?;
        Ok(signal - self.dark.as_ref().map_or(Ok(0.0), |dark| value(dark, "dark"))?)
    }

    /// The larger value of the two pixels around `nm`, or the value of the pixel at `nm`.
    fn max_neighbour(&self, nm: f64) -> f64 {
        let values = self.signal.values();
        let after = self.signal.wavelengths_nm().partition_point(|&at| at < nm);
        let exact = self.signal.wavelengths_nm().get(after) == Some(&nm);
        let before = if exact { after } else { after.saturating_sub(1) };
        values[before].max(values[after.min(values.len() - 1)])
    }
}

/// Standard deviation of the noise in a dark reading, from the median difference between
/// neighbouring pixels, which neither a slope nor a few hot pixels disturb.
pub(super) fn dark_noise(dark: &[f64]) -> f64 {
    let mut steps: Vec<f64> = dark.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    steps.sort_by(f64::total_cmp);
    // The median of |x| of a normal distribution is 0.6745 standard deviations, and the
    // difference of two values has the square root of 2 times the noise of one.
    steps.get(steps.len() / 2).map_or(0.0, |median| median / 0.6745 / 2.0_f64.sqrt())
}
