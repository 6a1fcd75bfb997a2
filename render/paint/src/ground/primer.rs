//! Reflectance of a ground: its priming.

use pigment::evaluate::Viewing;
use pigment::library::PigmentLibrary;
use pigment::smooth_reflectance::smoothest_reflectance;
use serde::{Deserialize, Serialize};
use spectra::color::{Adaptation, Rgb, RgbSpace};
use spectra::{Extrapolation, Grid, Interpolation, Reflectance, Spectrum};

use super::error::{GroundError, check_range};
use super::toned::TonedPrimer;

/// Measured reflectance of a ground: `0.87`, `{"rgb": "#f4f1e8"}`,
/// `{"spectrum": {"grid": {..}, "values": [..]}}`, or a film of paint over the library's white,
/// `{"film": {"recipe": {"Bone Black": 1}, "height_mm": 0.003}}`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(
    untagged,
    expecting = "reflectance is a number 0 to 1, {rgb: #rrggbb}, {spectrum: {grid, values}} or \
                 {film: {recipe, height_mm}}"
)]
pub enum Primer {
    /// One reflectance for all wavelengths, 0 to 1.
    Grey(f64),
    /// The smoothest reflectance that has a given colour.
    Color(ColorPrimer),
    /// A measured spectrum.
    Measured(MeasuredPrimer),
    /// The white of the library under a thin dry film of paint.
    Toned(TonedPrimer),
}

/// Colour of a ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ColorPrimer {
    /// sRGB colour under D65, written `#rrggbb`. A colour that no paint with the library's
    /// surface can have is replaced by a near one.
    pub rgb: String,
}

/// Measured reflectance of a ground, as a file stores it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeasuredPrimer {
    /// Reflectance by wavelength.
    pub spectrum: PrimerSpectrum,
}

/// Reflectance on a wavelength grid of its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrimerSpectrum {
    /// Wavelengths of the values.
    pub grid: Grid,
    /// Measured reflectance for each wavelength, 0 to 1.
    pub values: Vec<f64>,
}

/// Reflectance of a white priming for libraries without a reference white (an assumption).
const WHITE: f64 = 0.87;

impl Primer {
    /// Measured reflectance of an opaque film of the library's reference white, on its
    /// grid; 0.87 throughout if it has none.
    #[must_use]
    pub fn library_white(library: &PigmentLibrary) -> Vec<f64> {
        let reference = library.reference.as_deref().and_then(|name| library.find(name).ok());
        let film = reference.and_then(|index| library.mix([(index, 1.0)]).ok());
        film.map_or_else(
            || vec![WHITE; library.grid.count()],
            |film| film.hiding(library.saunderson),
        )
    }

    /// Measured reflectance on the grid of `library`. A spectrum that covers less is
    /// extended by its end values.
    ///
    /// # Errors
    /// [`GroundError`] for a value out of range, or an invalid colour or spectrum.
    pub fn reflectance(&self, library: &PigmentLibrary) -> Result<Vec<f64>, GroundError> {
        let grid = library.grid;
        match self {
            Self::Grey(value) => {
                Ok(vec![check_range("reflectance", "", *value, [0.0, 1.0])?; grid.count()])
            }
            Self::Color(ColorPrimer { rgb }) => {
                let color =
                    Rgb::from_hex(rgb).ok_or_else(|| GroundError::Color { text: rgb.clone() })?;
                let weights = Viewing::default().weights(grid)?;
                let white = weights.white();
                let surface = library.saunderson;
                let xyz = RgbSpace::Srgb.xyz_from_encoded(color, white, Adaptation::Bradford);
                let found = smoothest_reflectance(&weights, surface, xyz).internal;
                Ok(found.into_iter().map(|r| surface.measured_from_internal(r)).collect())
            }
            Self::Toned(toned) => toned.over(&Self::library_white(library), library),
            Self::Measured(MeasuredPrimer { spectrum }) => {
                let PrimerSpectrum { grid: own, values } = spectrum;
                let start_nm = own.start_nm();
                let end_nm = own.end_nm();
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
