//! The conditions under which colours are computed, and tristimulus values from spectra.

use documents::hint::Explain;
use documents::request::{RequestError, refused};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::color::{ColorValues, Xyz};
use crate::grid::Grid;
use crate::illuminant::{Illuminant, Observer, ObserverError};
use crate::interpolate::{Extrapolation, InterpolateError, Interpolation};
use crate::light::{LightError, light_from_text};
use crate::spectrum::{Reflectance, Spectrum};

/// A light and an observer.
///
/// ```
/// use spectra::{Grid, Reflectance, Spectrum, Viewing};
///
/// let viewing = Viewing::named("D65", "1931-2")?;
/// let grid = Grid::from_nm(400.0, 10.0, 31)?;
/// let grey = Spectrum::<Reflectance>::new(grid, vec![0.2; 31])?;
/// let color = viewing.color(&grey)?;
/// assert!((color.xyz.y - 20.0).abs() < 1e-9);
/// assert_eq!(color.hex(), "#7c7c7c");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Viewing {
    /// The light that falls on the sample.
    pub illuminant: Illuminant,
    /// The standard observer that looks at it.
    pub observer: Observer,
}

impl Default for Viewing {
    /// D65 and the CIE 1931 2 degree observer.
    fn default() -> Self {
        Self { illuminant: Illuminant::d65(), observer: Observer::default() }
    }
}

impl Viewing {
    /// A light and an observer by their names: `illuminant` as [`light_from_text`] reads
    /// it, `observer` as [`Observer::named`] does.
    pub fn named(illuminant: &str, observer: &str) -> Result<Self, ViewingError> {
        Ok(Self { illuminant: light_from_text(illuminant)?, observer: Observer::named(observer)? })
    }

    /// The weights that turn reflectances on `grid` into XYZ. We interpolate by Sprague's
    /// polynomial if the grid has the six wavelengths that it needs, otherwise linearly.
    pub fn weights(&self, grid: Grid) -> Result<TristimulusWeights, InterpolateError> {
        let interpolation = Interpolation::best_for(grid);
        TristimulusWeights::new(grid, &self.illuminant, self.observer, interpolation)
    }

    /// The colour of a reflectance. If you have many spectra on one grid, compute
    /// [`Viewing::weights`] once and use [`TristimulusWeights::color`].
    pub fn color(
        &self,
        reflectance: &Spectrum<Reflectance>,
    ) -> Result<ColorValues, InterpolateError> {
        Ok(self.weights(reflectance.grid())?.color(reflectance.values()))
    }
}

/// Names of a light and an observer, as people write them.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ViewingNames {
    /// Light: a CIE illuminant (D65, A, FL11, LED-B3 ..), a black body (5600K), daylight (D5600K),
    /// or a lamp's file: an instrument's (FILE#NAME for one of several spectra), or lines `nm,power`
    ///
    /// The power may have any unit. Negative noise down to -1 % of the peak counts as 0.
    pub illuminant: String,
    /// Observer: 1931-2 (or 2), 1964-10 (or 10), 2015-2, 2015-10
    pub observer: String,
}

impl Default for ViewingNames {
    fn default() -> Self {
        Self { illuminant: "D65".to_owned(), observer: Observer::default().name().to_owned() }
    }
}

impl Serialize for Viewing {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let illuminant = self.illuminant.name().to_owned();
        let observer = self.observer.name().to_owned();
        ViewingNames { illuminant, observer }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Viewing {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let ViewingNames { illuminant, observer } = ViewingNames::deserialize(deserializer)?;
        Self::named(illuminant.trim(), &observer).map_err(|error| refused(RequestError::of(&error)))
    }
}

impl JsonSchema for Viewing {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Viewing".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        ViewingNames::json_schema(generator)
    }
}

/// An unknown light or observer.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum ViewingError {
    /// The text does not name a light, or the file of a lamp is faulty.
    #[error(transparent)]
    Light(#[from] LightError),
    /// The text does not name an observer.
    #[error(transparent)]
    Observer(#[from] ObserverError),
}

/// Weights that turn a reflectance on one grid into XYZ under one light and observer: three per
/// wavelength.
///
/// CIE 15:2018, section 7.1: summation at 1 nm from 360 to 830 nm with k = 100 / sum(E y). We
/// interpolate the reflectance to 1 nm and hold its end values outside its band (ASTM E308-18,
/// section 7.3.2.3). Summation and interpolation are linear, so we combine them into one table, and
/// a colour costs three multiplications per wavelength.
///
/// ```
/// use spectra::{Grid, Illuminant, Interpolation, Observer, TristimulusWeights};
/// let grid = Grid::from_nm(400.0, 10.0, 31).unwrap();
/// let weights =
///     TristimulusWeights::new(grid, &Illuminant::d65(), Observer::default(), Interpolation::Sprague)
///         .unwrap();
/// let white = weights.xyz(&[1.0; 31]);
/// assert!((white.y - 100.0).abs() < 1e-9);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct TristimulusWeights {
    grid: Grid,
    weights: Vec<[f64; 3]>,
    white: Xyz,
}

impl TristimulusWeights {
    /// Computes the weights for reflectances on `grid`.
    ///
    /// # Errors
    /// [`InterpolateError::TooFew`] for Sprague interpolation on fewer than six wavelengths.
    pub fn new(
        grid: Grid,
        illuminant: &Illuminant,
        observer: Observer,
        interpolation: Interpolation,
    ) -> Result<Self, InterpolateError> {
        let mut weights = vec![[0.0; 3]; grid.count()];
        let mut white = [0.0; 3];
        for (nm, response) in responses(illuminant, observer) {
            let row = interpolation.row(grid, nm, Extrapolation::Hold)?;
            for (target, share) in weights[row.first..].iter_mut().zip(row.weights()) {
                for (t, r) in target.iter_mut().zip(response) {
                    *t += share * r;
                }
            }
            for (w, r) in white.iter_mut().zip(response) {
                *w += r;
            }
        }
        Ok(Self { grid, weights, white: white.into() })
    }

    /// The grid of the reflectances.
    #[must_use]
    pub fn grid(&self) -> Grid {
        self.grid
    }

    /// XYZ of the perfect diffuser, with Y = 100: the white point.
    #[must_use]
    pub fn white(&self) -> Xyz {
        self.white
    }

    /// The weights of X, Y and Z at each wavelength of the grid.
    #[must_use]
    pub fn weights(&self) -> &[[f64; 3]] {
        &self.weights
    }

    /// XYZ of one reflectance, given by its values on the grid.
    ///
    /// # Panics
    /// If you do not pass one value for each wavelength.
    #[must_use]
    pub fn xyz(&self, reflectance: &[f64]) -> Xyz {
        assert_eq!(reflectance.len(), self.weights.len(), "one reflectance for each wavelength");
        let mut xyz = [0.0; 3];
        for (value, weights) in reflectance.iter().zip(&self.weights) {
            for (sum, weight) in xyz.iter_mut().zip(weights) {
                *sum += value * weight;
            }
        }
        xyz.into()
    }

    /// Computes XYZ of many reflectances, which stand one after the other in `rows`, into `xyz`.
    /// This differs from [`Self::xyz`] by rounding alone.
    ///
    /// # Panics
    /// If `rows` does not hold one value for each wavelength and element of `xyz`.
    pub fn xyz_of_rows(&self, rows: &[f64], xyz: &mut [[f64; 3]]) {
        let bands = self.weights.len();
        assert_eq!(rows.len(), bands * xyz.len(), "one value for each wavelength and spectrum");
        for (xyz, row) in xyz.iter_mut().zip(rows.chunks_exact(bands)) {
            // Four sums at a time keep the processor's vectors full.
            let mut sums = [[0.0; 4]; 3];
            let (values, rest) = row.as_chunks::<4>();
            let (weights, last) = self.weights.as_chunks::<4>();
            for (values, weights) in values.iter().zip(weights) {
                for (channel, sums) in sums.iter_mut().enumerate() {
                    for lane in 0..4 {
                        sums[lane] += values[lane] * weights[lane][channel];
                    }
                }
            }
            for (value, weights) in rest.iter().zip(last) {
                for (sums, weight) in sums.iter_mut().zip(weights) {
                    sums[0] += value * weight;
                }
            }
            *xyz = sums.map(|[a, b, c, d]| (a + b) + (c + d));
        }
    }

    /// The colour of one reflectance in XYZ, CIELAB and sRGB.
    ///
    /// # Panics
    /// If you do not pass one value for each wavelength.
    #[must_use]
    pub fn color(&self, reflectance: &[f64]) -> ColorValues {
        ColorValues::from_xyz(self.xyz(reflectance), self.white)
    }
}

/// The power of a light weighted by the observer at every nanometre from 360 to 830: k E x, k E y
/// and k E z.
pub(crate) fn responses(
    illuminant: &Illuminant,
    observer: Observer,
) -> impl Iterator<Item = (f64, [f64; 3])> {
    let functions = observer.functions();
    let power = illuminant.power().values();
    let luminance: f64 = power.iter().zip(functions[1].values()).map(|(e, y)| e * y).sum();
    let k = 100.0 / luminance;
    Grid::cie().wavelengths_nm().enumerate().map(move |(index, nm)| {
        (nm, std::array::from_fn(|channel| k * power[index] * functions[channel].values()[index]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Viewing;

    #[test]
    fn rows_have_the_xyz_of_each_spectrum() {
        for bands in [2, 7, 31, 36] {
            let grid = Grid::from_nm(400.0, 10.0, bands).unwrap();
            let weights = Viewing::default().weights(grid).unwrap();
            let rows: Vec<f64> = (0..5 * bands).map(|i| (i * 37 % 101) as f64 / 101.0).collect();
            let mut xyz = [[0.0; 3]; 5];
            weights.xyz_of_rows(&rows, &mut xyz);
            for (found, row) in xyz.iter().zip(rows.chunks(bands)) {
                let wanted = weights.xyz(row).to_array();
                let apart = found.iter().zip(wanted).map(|(a, b)| (a - b).abs());
                assert!(apart.fold(0.0, f64::max) < 1e-10, "{bands} bands: {found:?}, {wanted:?}");
            }
        }
    }
}
