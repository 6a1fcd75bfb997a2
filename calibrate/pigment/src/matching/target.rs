//! Targets of a search. You give a colour under one light or several, or a spectrum, with the lights under
//! which we judge recipes and the measure of difference.

use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use spectra::color::{Adaptation, ColorCode, ColorCodeError, Lab, Rgb, Xyz, adapt};
use spectra::{Extrapolation, Grid, InterpolateError, Interpolation, Reflectance, Spectrum};

use crate::evaluate::{Viewing, lab};
use crate::least_squares::{Cost, UNKNOWNS};

/// A colour for which recipes are searched: an sRGB colour, a CIELAB colour or a measured spectrum.
///
/// ```
/// use pigment::ColorTarget;
///
/// let hex: ColorTarget = "#4a7d8c".parse()?;
/// let lab: ColorTarget = "52,-10.5,8".parse()?;
/// assert_eq!(lab.name, "Lab 52,-10.5,8");
/// assert!("teal".parse::<ColorTarget>().is_err());
/// # Ok::<(), spectra::color::ColorCodeError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ColorTarget {
    /// Name of the target in reports.
    pub name: String,
    /// The colour itself.
    pub color: TargetColor,
}

/// The ways in which a [`ColorTarget`] states its colour.
#[derive(Debug, Clone, PartialEq)]
pub enum TargetColor {
    /// CIELAB, which you match under every light. We adapt an sRGB colour (Bradford) from the white of the
    /// display to the white of the light, which leaves its CIELAB unchanged.
    Lab(Lab),
    /// CIELAB under a light of its own. We adapt it (Bradford) to the white of the first light of a search, and
    /// then match the same CIELAB under every light.
    LabUnder {
        /// The colour relative to `white`.
        lab: Lab,
        /// XYZ of the white of its light (Y = 100).
        white: Xyz,
    },
    /// A measured reflectance. Its colour depends on the light.
    Reflectance(Spectrum<Reflectance>),
}

impl ColorTarget {
    /// Target from a measured reflectance.
    #[must_use]
    pub fn measured(name: impl Into<String>, reflectance: Spectrum<Reflectance>) -> Self {
        Self { name: name.into(), color: TargetColor::Reflectance(reflectance) }
    }

    /// Target from an encoded sRGB colour.
    #[must_use]
    pub fn srgb(color: Rgb) -> Self {
        Self { name: color.to_hex(), color: TargetColor::Lab(ColorCode::Srgb(color).lab()) }
    }

    /// Colours that a recipe should match under each of `conditions`.
    ///
    /// # Errors
    /// None in practice: the method is chosen to fit the grid of the spectrum.
    pub fn under(&self, conditions: &[ViewingCondition]) -> Result<Target, InterpolateError> {
        match &self.color {
            TargetColor::Lab(lab) => Ok(Target::from_lab(&self.name, *lab, conditions)),
            TargetColor::LabUnder { lab, white } => {
                let lab = match conditions.first() {
                    Some(first) => {
                        let to = first.viewing.weights(Grid::cie())?.white();
                        let xyz = adapt(lab.to_xyz(*white), *white, to, Adaptation::Bradford);
                        Lab::from_xyz(xyz, to)
                    }
                    None => *lab,
                };
                Ok(Target::from_lab(&self.name, lab, conditions))
            }
            TargetColor::Reflectance(reflectance) => {
                Target::from_reflectance(&self.name, reflectance, conditions)
            }
        }
    }
}

impl FromStr for ColorTarget {
    type Err = ColorCodeError;

    /// Reads `#rrggbb` or `#rgb` of sRGB, or CIELAB as `L,a,b`.
    fn from_str(text: &str) -> Result<Self, ColorCodeError> {
        let code: ColorCode = text.parse()?;
        let name = match code {
            ColorCode::Srgb(rgb) => rgb.to_hex(),
            ColorCode::Lab(_) => format!("Lab {text}"),
        };
        Ok(Self { name, color: TargetColor::Lab(code.lab()) })
    }
}

/// Colours that a recipe should have under several lights.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    /// Name of the target in reports.
    pub name: String,
    /// CIELAB under each viewing condition of the request, in their order.
    pub lab: Vec<Lab>,
    /// Reflectance on the grid of the library, if the target was measured and the library shares its band.
    pub spectrum: Option<SpectralTarget>,
}

impl Target {
    /// Target with one colour under all of `conditions`.
    #[must_use]
    pub fn from_lab(name: &str, lab: Lab, conditions: &[ViewingCondition]) -> Self {
        Self { name: name.to_owned(), lab: vec![lab; conditions.len()], spectrum: None }
    }

    /// Target with the colours of a measured reflectance. We leave out its spectrum, because we would need
    /// the grid of a library ([`SpectralTarget::new`]).
    ///
    /// # Errors
    /// None in practice: the method is chosen to fit the grid of the spectrum.
    pub fn from_reflectance(
        name: &str,
        reflectance: &Spectrum<Reflectance>,
        conditions: &[ViewingCondition],
    ) -> Result<Self, InterpolateError> {
        let lab = conditions.iter().map(|condition| {
            let weights = condition.viewing.weights(reflectance.grid())?;
            Ok(lab(&weights, reflectance.values()))
        });
        Ok(Self { name: name.to_owned(), lab: lab.collect::<Result<_, _>>()?, spectrum: None })
    }
}

/// 1 is this many percent of reflectance. We report differences of spectra in percent.
const PERCENT: f64 = 100.0;

/// A measured reflectance on the grid of a library, with a weight for each wavelength.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectralTarget {
    reflectance: Vec<f64>,
    /// Weights with sum 1, 0 where the target was not measured.
    weights: Vec<f64>,
    band_nm: [f64; 2],
}

impl SpectralTarget {
    /// Target on `grid`, the wavelengths of a library. We use `conditions` only for
    /// [`SpectrumWeights::Observer`]. `None` if target and grid share less than two wavelengths, or the
    /// lights have no power at the shared ones.
    ///
    /// # Errors
    /// None in practice: the method is chosen to fit the grid of the spectrum.
    pub fn new(
        measured: &Spectrum<Reflectance>,
        grid: Grid,
        weights: SpectrumWeights,
        conditions: &[ViewingCondition],
    ) -> Result<Option<Self>, InterpolateError> {
        let method = Interpolation::best_for(measured.grid());
        let reflectance = measured.resampled(grid, method, Extrapolation::Hold)?;
        let mut share = match weights {
            SpectrumWeights::Even => vec![1.0; grid.count()],
            SpectrumWeights::Observer => visual_weights(grid, conditions)?,
        };
        let mut shared = Vec::new();
        for (nm, share) in grid.wavelengths_nm().zip(&mut share) {
            if measured.grid().covers(nm) {
                shared.push(nm);
            } else {
                *share = 0.0;
            }
        }
        let sum: f64 = share.iter().sum();
        Ok(match shared[..] {
            [first, .., last] if sum > 0.0 => Some(Self {
                reflectance: reflectance.values().to_vec(),
                weights: share.into_iter().map(|share| share / sum).collect(),
                band_nm: [first, last],
            }),
            _ => None,
        })
    }

    /// First and last wavelength in nm that the measurement and the library share.
    #[must_use]
    pub fn band_nm(&self) -> [f64; 2] {
        self.band_nm
    }

    /// Weighted root mean square of the differences of `found` from the target, in percent of reflectance.
    ///
    /// # Panics
    /// If `found` has another number of wavelengths than the grid of the target.
    #[must_use]
    pub fn rms_percent(&self, found: &[f64]) -> f64 {
        assert_eq!(found.len(), self.weights.len(), "one reflectance for each wavelength");
        let pairs = found.iter().zip(&self.reflectance).zip(&self.weights);
        let squares = pairs.map(|((found, wanted), weight)| weight * (found - wanted).powi(2));
        PERCENT * squares.sum::<f64>().sqrt()
    }

    /// Factor of each difference of reflectance in [`Self::rms_percent`].
    pub(super) fn roots_percent(&self) -> Vec<f64> {
        self.weights.iter().map(|weight| PERCENT * weight.sqrt()).collect()
    }

    /// Half the square of [`Self::rms_percent`] of `found`, with its derivatives. `by_unknown` holds the
    /// derivatives of `found` with respect to each unknown, one unknown after the other.
    pub(super) fn cost(&self, found: &[f64], by_unknown: &[f64]) -> Cost {
        let mut cost =
            Cost { value: 0.0, gradient: [0.0; UNKNOWNS], matrix: [[0.0; UNKNOWNS]; UNKNOWNS] };
        let count = found.len();
        let columns = by_unknown.len() / count;
        for at in (0..count).filter(|&at| self.weights[at] > 0.0) {
            let scale = PERCENT * PERCENT * self.weights[at];
            let off = found[at] - self.reflectance[at];
            cost.value += 0.5 * scale * off * off;
            for i in 0..columns {
                let slope = by_unknown[i * count + at];
                cost.gradient[i] += scale * off * slope;
                for j in 0..columns {
                    cost.matrix[i][j] += scale * slope * by_unknown[j * count + at];
                }
            }
        }
        cost
    }
}

/// Visual weight of each wavelength: the sum of its weights for X, Y and Z over all lights, each times
/// the light's own weight.
fn visual_weights(
    grid: Grid,
    conditions: &[ViewingCondition],
) -> Result<Vec<f64>, InterpolateError> {
    let mut sums = vec![0.0; grid.count()];
    for condition in conditions {
        let weights = condition.viewing.weights(grid)?;
        for (sum, xyz) in sums.iter_mut().zip(weights.weights()) {
            *sum += condition.weight * xyz.iter().sum::<f64>().max(0.0);
        }
    }
    Ok(sums)
}

/// A light and an observer under which a recipe is judged.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ViewingCondition {
    /// Light and observer.
    pub viewing: Viewing,
    /// Weight of the colour difference under this light, above 0 and below 1e9. Only the ratios of
    /// several weights matter.
    pub weight: f64,
}

impl Default for ViewingCondition {
    /// Illuminant D65 and the CIE 1931 observer, with weight 1.
    fn default() -> Self {
        Self { viewing: Viewing::default(), weight: 1.0 }
    }
}

/// Measure of the difference between a recipe and its target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(from = "MetricName", into = "MetricName")]
pub enum Metric {
    /// CIEDE2000, which is valid for differences up to about 5.
    #[default]
    Ciede2000,
    /// CIE 1976, which orders large differences better. For example, by CIEDE2000 a grey may be nearer to a
    /// brilliant magenta than a dull magenta is.
    Cie1976,
    /// Root mean square of the differences of reflectance in percent, over the wavelengths that target and
    /// library share. We use the lights only to report colours. The target must be a measured spectrum.
    Spectrum(SpectrumWeights),
}

/// How much each wavelength counts in a difference of spectra.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SpectrumWeights {
    /// All wavelengths equally.
    #[default]
    Even,
    /// By the sum of its weights for X, Y and Z under the lights.
    Observer,
}

/// A measure as people write it.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum MetricName {
    /// CIEDE2000 under the lights
    Color,
    /// CIE 1976 under the lights
    Cie1976,
    /// Root mean square of the differences of reflectance, each wavelength equally
    Spectrum,
    /// Root mean square too, each wavelength as much as the observer sees of it under the lights
    WeightedSpectrum,
}

impl From<MetricName> for Metric {
    fn from(name: MetricName) -> Self {
        match name {
            MetricName::Color => Self::Ciede2000,
            MetricName::Cie1976 => Self::Cie1976,
            MetricName::Spectrum => Self::Spectrum(SpectrumWeights::Even),
            MetricName::WeightedSpectrum => Self::Spectrum(SpectrumWeights::Observer),
        }
    }
}

impl From<Metric> for MetricName {
    fn from(metric: Metric) -> Self {
        match metric {
            Metric::Ciede2000 => Self::Color,
            Metric::Cie1976 => Self::Cie1976,
            Metric::Spectrum(SpectrumWeights::Even) => Self::Spectrum,
            Metric::Spectrum(SpectrumWeights::Observer) => Self::WeightedSpectrum,
        }
    }
}

impl Metric {
    /// Weights of the wavelengths, for a difference of spectra.
    #[must_use]
    pub fn spectrum_weights(self) -> Option<SpectrumWeights> {
        match self {
            Self::Spectrum(weights) => Some(weights),
            Self::Ciede2000 | Self::Cie1976 => None,
        }
    }

    /// Name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Ciede2000 => "color",
            Self::Cie1976 => "cie1976",
            Self::Spectrum(SpectrumWeights::Even) => "spectrum",
            Self::Spectrum(SpectrumWeights::Observer) => "weighted-spectrum",
        }
    }

    /// Unit of the reported differences.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Ciede2000 => "CIEDE2000",
            Self::Cie1976 => "CIE 1976",
            Self::Spectrum(_) => "% of reflectance",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(start_nm: f64, step_nm: f64, values: Vec<f64>) -> Spectrum<Reflectance> {
        let grid = Grid::from_nm(start_nm, step_nm, values.len()).unwrap();
        Spectrum::new(grid, values).unwrap()
    }

    #[test]
    fn the_shared_band_counts_evenly() {
        let target = measured(450.0, 10.0, vec![0.5; 16]);
        let grid = Grid::from_nm(400.0, 20.0, 16).unwrap();
        let target = SpectralTarget::new(&target, grid, SpectrumWeights::Even, &[]).unwrap();
        let target = target.unwrap();
        assert_eq!(target.band_nm(), [460.0, 600.0]);
        let mut found = vec![0.9; 16];
        found[3..=10].fill(0.5);
        assert!(target.rms_percent(&found) < 1e-12, "outside of the band nothing counts");
        found[5] = 0.6;
        // One of the eight shared wavelengths is off by 10 %.
        assert!((target.rms_percent(&found) - 10.0 / 8.0_f64.sqrt()).abs() < 1e-9);
    }

    #[test]
    fn the_observer_weighs_green_more_than_the_ends() {
        let grid = Grid::from_nm(400.0, 10.0, 31).unwrap();
        let target = measured(400.0, 10.0, vec![0.3; 31]);
        let conditions = [ViewingCondition::default()];
        let [first, middle, last] = [0, 15, 30].map(|at: usize| {
            let seen = SpectrumWeights::Observer;
            let target = SpectralTarget::new(&target, grid, seen, &conditions).unwrap().unwrap();
            let mut found = vec![0.3; 31];
            found[at] = 0.4;
            target.rms_percent(&found)
        });
        assert!(middle > 3.0 * first && middle > 3.0 * last, "{middle} {first}");
    }

    #[test]
    fn bands_that_do_not_meet_are_no_target() {
        let grid = Grid::from_nm(400.0, 10.0, 11).unwrap();
        let infrared = measured(500.0, 10.0, vec![0.3; 31]);
        let target = SpectralTarget::new(&infrared, grid, SpectrumWeights::Even, &[]).unwrap();
        assert_eq!(target, None);
    }
}
