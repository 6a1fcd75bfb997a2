//! The eight wavelengths that paint is computed at under a light, and their conversion to
//! sRGB.

use pigment::evaluate::Viewing;
use pigment::library::PigmentLibrary;
use pigment::quadrature::{Quadrature, QuadratureFailure};
use spectra::color::{Adaptation, RgbSpace};
use spectra::hint::{Explain, Fault, Hint};
use spectra::{LightError, Observer, ObserverError, light_from_text};

use crate::optics::NODES;

/// An illuminant with an observer, prepared for painting with one library.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// Illuminant and observer.
    pub viewing: Viewing,
    /// Wavelengths and their weights in XYZ, fitted to the library's mixtures
    /// ([`Quadrature::library`]). Their white is that of the full spectrum.
    pub quadrature: Quadrature,
    /// Linear sRGB of reflectance 1 at each wavelength, adapted from the light's white to D65
    /// by Bradford's transform. They sum to (1, 1, 1) up to rounding.
    pub rgb_from_nodes: [[f32; 3]; NODES],
}

impl Light {
    /// Prepares the light of `viewing` for painting with `library`. Takes a good part of a
    /// second.
    ///
    /// # Errors
    /// [`PaintLightError::Quadrature`] if the light has fewer than eight usable wavelengths.
    pub fn new(library: &PigmentLibrary, viewing: &Viewing) -> Result<Self, PaintLightError> {
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

    /// Prepares a light by names: `illuminant` as [`light_from_text`] reads it, `observer` as
    /// [`Observer::named`] does.
    ///
    /// # Errors
    /// [`PaintLightError`] for an unknown name, or a light with fewer than eight usable
    /// wavelengths.
    pub fn named(
        library: &PigmentLibrary,
        illuminant: &str,
        observer: &str,
    ) -> Result<Self, PaintLightError> {
        let illuminant = light_from_text(illuminant)?;
        Self::new(library, &Viewing { illuminant, observer: Observer::named(observer)? })
    }
}

/// A light cannot be used for painting.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PaintLightError {
    /// The name of the illuminant is unknown, or its file is invalid.
    #[error(transparent)]
    Light(#[from] LightError),
    /// The name of the observer is unknown.
    #[error(transparent)]
    Observer(#[from] ObserverError),
    /// The light has too few usable wavelengths, for example that of a laser.
    #[error(transparent)]
    Quadrature(#[from] QuadratureFailure),
}

impl Explain for PaintLightError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Light(error) => error.hint(),
            Self::Observer(error) => error.hint(),
            Self::Quadrature(_) => Some(Hint::new(format!(
                "painting needs a light that the observer sees at {NODES} wavelengths or more"
            ))),
        }
    }

    fn fault(&self) -> Fault {
        Fault::Setting
    }
}
