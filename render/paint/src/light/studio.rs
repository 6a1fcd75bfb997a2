//! Eight wavelengths for a light, and the way from them to a screen.

use pigment::evaluate::Viewing;
use pigment::library::PigmentLibrary;
use pigment::quadrature::{Quadrature, QuadratureFailure};
use spectra::color::{Adaptation, RgbSpace};
use spectra::hint::Explain;
use spectra::{LightError, Observer, ObserverError, light_from_text};

use crate::optics::NODES;

/// A light with its observer, ready for painting with one library.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// Light and observer.
    pub viewing: Viewing,
    /// The wavelengths and their weights in XYZ, fitted to what the library can
    /// mix ([`Quadrature::library`]); their white is that of the full spectrum.
    pub quadrature: Quadrature,
    /// Linear sRGB of a unit reflectance at each wavelength, adapted from the
    /// light's white to D65 (Bradford, as everywhere in this program). A perfect
    /// diffuse is (1, 1, 1) to rounding.
    pub rgb_from_nodes: [[f32; 3]; NODES],
}

impl Light {
    /// The light of `viewing` for paint of `library`. Takes a good part of a
    /// second.
    ///
    /// # Errors
    /// [`LightFailure::Quadrature`] if the light has not eight wavelengths.
    pub fn new(library: &PigmentLibrary, viewing: &Viewing) -> Result<Self, LightFailure> {
        let quadrature = Quadrature::library(viewing, library, NODES)?;
        let white = quadrature.white;
        let rgb = |i: usize| {
            let weights = quadrature.weights[i].into();
            let linear = RgbSpace::Srgb.linear_from_xyz(weights, white, Adaptation::Bradford);
            linear.0.map(|channel| channel as f32)
        };
        let rgb_from_nodes = std::array::from_fn(rgb);
        Ok(Self { viewing: viewing.clone(), quadrature, rgb_from_nodes })
    }

    /// The same from names: `illuminant` as [`light_from_text`] takes it,
    /// `observer` as [`Observer::named`].
    ///
    /// # Errors
    /// [`LightFailure`] if a name is not known, or as [`Light::new`].
    pub fn named(
        library: &PigmentLibrary,
        illuminant: &str,
        observer: &str,
    ) -> Result<Self, LightFailure> {
        let illuminant = light_from_text(illuminant)?;
        Self::new(library, &Viewing { illuminant, observer: Observer::named(observer)? })
    }
}

/// Why there is no such light.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LightFailure {
    /// The name of the light.
    #[error(transparent)]
    Light(#[from] LightError),
    /// The name of the observer.
    #[error(transparent)]
    Observer(#[from] ObserverError),
    /// Too few wavelengths, as of a laser.
    #[error(transparent)]
    Quadrature(#[from] QuadratureFailure),
}

impl LightFailure {
    /// What to try.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Light(error) => error.hint().map(|hint| hint.to_string()),
            Self::Observer(_) => None,
            Self::Quadrature(_) => Some(format!(
                "painting needs a light that the observer sees at {NODES} wavelengths or more"
            )),
        }
    }
}
