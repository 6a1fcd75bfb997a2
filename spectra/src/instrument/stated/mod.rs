//! Facts that you know about a file and that it does not say, or says wrongly: the quantity of its values and their
//! wavelengths. Also what a file states of the geometry of its instrument.

pub(super) mod bare_values;
mod geometry;

pub use geometry::StatedGeometry;

use super::measured::{MeasuredSpectrum, Role, Unit};
use super::quantity::MeasuredQuantity;

/// Turns a value into a reflectance as a fraction.
type Conversion = fn(f64) -> f64;

/// The quantity of the values of a file, as you state it against its headings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StatedValues {
    /// Reflectance, in percent or as fractions.
    Reflectance,
    /// Reflectance in percent.
    Percent,
    /// Reflectance as a fraction.
    Fraction,
    /// Absorbance A of a reflectance R, which is 10^-A.
    Absorbance,
    /// Kubelka-Munk's K/S of a film that hides.
    KubelkaMunk,
    /// Counts of a detector.
    Counts,
    /// Power of a light.
    Power,
    /// Number of photons of a light.
    Photons,
}

impl StatedValues {
    /// All, for lists of choices.
    pub const ALL: [Self; 8] = [
        Self::Reflectance,
        Self::Percent,
        Self::Fraction,
        Self::Absorbance,
        Self::KubelkaMunk,
        Self::Counts,
        Self::Power,
        Self::Photons,
    ];

    /// The name, as a setting takes it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Reflectance => "reflectance",
            Self::Percent => "percent",
            Self::Fraction => "fraction",
            Self::Absorbance => "absorbance",
            Self::KubelkaMunk => "k/s",
            Self::Counts => "counts",
            Self::Power => "power",
            Self::Photons => "photons",
        }
    }

    /// The quantity of this name, ignoring case.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|values| values.name().eq_ignore_ascii_case(name))
    }

    /// Reflectance as a fraction from a value, and the words that say so. `None` if the values need no
    /// conversion, or cannot be converted.
    ///
    /// K/S is turned round by R = 1 + K/S - sqrt((K/S)^2 + 2 K/S) (Kubelka and Munk 1931). We take a K/S
    /// below 0 for noise of 0.
    #[must_use]
    pub fn conversion(self) -> Option<(Conversion, &'static str)> {
        match self {
            Self::Absorbance => Some((
                |absorbance| 10.0_f64.powf(-absorbance),
                "absorbance A is turned into the reflectance 10^-A",
            )),
            Self::KubelkaMunk => Some((
                |ratio| {
                    let ratio = ratio.max(0.0);
                    // The same as 1 + K/S - root, without cancellation.
                    1.0 / (1.0 + ratio + (ratio * ratio + 2.0 * ratio).sqrt())
                },
                "K/S is turned into the reflectance of a film that hides",
            )),
            _ => None,
        }
    }

    /// Takes the main spectra for what you state.
    pub(super) fn apply(self, spectrum: &mut MeasuredSpectrum) {
        if spectrum.role != Role::Main {
            return;
        }
        spectrum.quantity = match self {
            Self::Counts => MeasuredQuantity::Counts,
            Self::Power => MeasuredQuantity::Power,
            Self::Photons => MeasuredQuantity::Photons,
            _ => MeasuredQuantity::Reflectance,
        };
        spectrum.unit = match self {
            Self::Percent => Unit::Percent,
            Self::Fraction | Self::Absorbance | Self::KubelkaMunk => Unit::Fraction,
            Self::Reflectance => spectrum.unit,
            Self::Counts | Self::Power | Self::Photons => Unit::Unstated,
        };
        if let Some((reflectance, words)) = self.conversion() {
            spectrum.values.iter_mut().for_each(|value| *value = reflectance(*value));
            spectrum.remarks.push(words.to_owned());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_in_any_case() {
        for values in StatedValues::ALL {
            assert_eq!(StatedValues::named(&values.name().to_uppercase()), Some(values));
        }
        assert_eq!(StatedValues::named("moonlight"), None);
    }

    #[test]
    fn absorbance_and_ratios_become_reflectance() {
        let of = |values: StatedValues, value| (values.conversion().unwrap().0)(value);
        for reflectance in [0.01, 0.2, 0.9, 1.0_f64] {
            let absorbance = of(StatedValues::Absorbance, -reflectance.log10());
            let ratio = (1.0 - reflectance).powi(2) / (2.0 * reflectance);
            let found = [absorbance, of(StatedValues::KubelkaMunk, ratio)];
            assert!(found.iter().all(|found| (found - reflectance).abs() < 1e-12), "{found:?}");
        }
        assert_eq!(of(StatedValues::KubelkaMunk, -0.001), 1.0);
        assert!(StatedValues::Percent.conversion().is_none());
    }
}
