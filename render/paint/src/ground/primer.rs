//! The reflectance of a ground.

use pigment::evaluate::Viewing;
use pigment::library::PigmentLibrary;
use pigment::smooth_reflectance::smoothest_reflectance;
use serde::{Deserialize, Serialize};
use spectra::color::{Adaptation, Rgb, RgbSpace};
use spectra::{Extrapolation, Grid, Interpolation, Reflectance, Spectrum};

use super::{GroundError, within};

/// What a ground reflects, as measured: `0.87`, `{"rgb": "#f4f1e8"}`, or
/// `{"spectrum": {"grid": {..}, "values": [..]}}`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(
    untagged,
    expecting = "reflectance is a number 0 to 1, {rgb: #rrggbb} or {spectrum: {grid, values}}"
)]
pub enum Primer {
    /// The same at every wavelength, 0..=1.
    Grey(f64),
    /// The smoothest reflectance of a colour.
    Color(ColorPrimer),
    /// As measured.
    Measured(MeasuredPrimer),
}

/// A colour of a ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ColorPrimer {
    /// `#rrggbb`, sRGB seen under D65. A colour that no film of the library's
    /// surface can have is replaced by one near it.
    pub rgb: String,
}

/// A measured ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeasuredPrimer {
    /// Its spectrum.
    pub spectrum: PrimerSpectrum,
}

/// Reflectance on a grid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrimerSpectrum {
    /// The wavelengths.
    pub grid: Grid,
    /// Reflectance as measured, 0..=1, one for each.
    pub values: Vec<f64>,
}

/// Made up: a white priming, where a library has no white of its own.
const WHITE: f64 = 0.87;

impl Primer {
    /// The white of a library: a film of its reference pigment that hides, on
    /// its grid; 0.87 where it has none.
    #[must_use]
    pub fn of_library(library: &PigmentLibrary) -> Vec<f64> {
        let reference = library.reference.as_deref().and_then(|name| library.find(name).ok());
        let film = reference.and_then(|index| library.mix(&[(index, 1.0)]).ok());
        film.map_or_else(
            || vec![WHITE; library.grid.count()],
            |film| film.hiding(library.saunderson),
        )
    }

    /// The reflectance on the grid of `library`; the ends of a spectrum held.
    ///
    /// # Errors
    /// [`GroundError`] for a value, colour or spectrum that cannot be.
    pub fn reflectance(&self, library: &PigmentLibrary) -> Result<Vec<f64>, GroundError> {
        let grid = library.grid;
        match self {
            Self::Grey(value) => {
                Ok(vec![within("reflectance", "", *value, [0.0, 1.0])?; grid.count()])
            }
            Self::Color(ColorPrimer { rgb }) => {
                let color =
                    Rgb::from_hex(rgb).ok_or_else(|| GroundError::Color { text: rgb.clone() })?;
                let weights = Viewing::default().weights(grid)?;
                let (white, surface) = (weights.white(), library.saunderson);
                let xyz = RgbSpace::Srgb.xyz_from_encoded(color, white, Adaptation::Bradford);
                let found = smoothest_reflectance(&weights, surface, xyz).internal;
                Ok(found.into_iter().map(|r| surface.measured_from_internal(r)).collect())
            }
            Self::Measured(MeasuredPrimer { spectrum }) => {
                let PrimerSpectrum { grid: own, values } = spectrum;
                let (start_nm, end_nm) = (own.start_nm(), own.end_nm());
                if start_nm > grid.end_nm() || end_nm < grid.start_nm() {
                    let library = grid.to_string();
                    return Err(GroundError::Band { start_nm, end_nm, library });
                }
                let spectrum = Spectrum::<Reflectance>::new(*own, values.clone())?;
                let method = Interpolation::best_for(*own);
                Ok(spectrum.resampled(grid, method, Extrapolation::Hold)?.into_values())
            }
        }
    }
}
