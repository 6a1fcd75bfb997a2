//! The conditions under which colours are computed.

use crate::color::ColorValues;
use crate::grid::Grid;
use crate::illuminant::Illuminant;
use crate::integrate::TristimulusWeights;
use crate::interpolate::{InterpolateError, Interpolation};
use crate::light::{LightError, light_from_text};
use crate::observer::{Observer, ObserverError};
use crate::spectrum::{Reflectance, Spectrum};
use documents::hint::{Explain, Fault, Hint};

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
    ///
    /// # Errors
    /// [`ViewingError`] if either is unknown.
    pub fn named(illuminant: &str, observer: &str) -> Result<Self, ViewingError> {
        Ok(Self { illuminant: light_from_text(illuminant)?, observer: Observer::named(observer)? })
    }

    /// The weights that turn reflectances on `grid` into XYZ, by Sprague interpolation
    /// where the grid has the six wavelengths it needs, otherwise linear.
    ///
    /// # Errors
    /// Never in practice: the method is chosen to suit the grid.
    pub fn weights(&self, grid: Grid) -> Result<TristimulusWeights, InterpolateError> {
        let interpolation = Interpolation::best_for(grid);
        TristimulusWeights::new(grid, &self.illuminant, self.observer, interpolation)
    }

    /// The colour of a reflectance. For many spectra on one grid compute
    /// [`Viewing::weights`] once and use [`TristimulusWeights::color`].
    ///
    /// # Errors
    /// Never in practice, see [`Viewing::weights`].
    pub fn color(
        &self,
        reflectance: &Spectrum<Reflectance>,
    ) -> Result<ColorValues, InterpolateError> {
        Ok(self.weights(reflectance.grid())?.color(reflectance.values()))
    }
}

/// An unknown light or observer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ViewingError {
    /// The text does not name a light, or the file of a lamp is faulty.
    #[error(transparent)]
    Light(#[from] LightError),
    /// The text does not name an observer.
    #[error(transparent)]
    Observer(#[from] ObserverError),
}

impl Explain for ViewingError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Light(error) => error.hint(),
            Self::Observer(error) => error.hint(),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Light(error) => error.fault(),
            Self::Observer(error) => error.fault(),
        }
    }
}
