//! The eight wavelengths that paint is computed at under a light, and their conversion to
//! sRGB.

use documents::hint::{Explain, Fault, Hint};
use pigment::evaluate::Viewing;
use pigment::library::PigmentLibrary;
use pigment::quadrature::{EffectiveQuadrature, Quadrature, QuadratureFailure};
use spectra::color::{Adaptation, RgbSpace};
use spectra::{LightError, Observer, ObserverError, light_from_text};

use super::kept;
use crate::optics::NODES;

/// An illuminant with an observer, prepared for painting with one library.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// Illuminant and observer.
    pub viewing: Viewing,
    /// Wavelengths, their weights in XYZ, and K and S of every pigment, fitted to films of the
    /// library ([`EffectiveQuadrature::of`]). Their white is that of the full spectrum.
    pub quadrature: EffectiveQuadrature,
    /// Linear sRGB of reflectance 1 at each wavelength, adapted from the light's white to D65
    /// by Bradford's transform. They sum to (1, 1, 1) up to rounding.
    pub rgb_from_nodes: [[f32; 3]; NODES],
}

impl Light {
    /// Prepares the light of `viewing` for painting with `library`. Takes up to a second, unless this
    /// program prepared it before and used few others since.
    ///
    /// # Errors
    /// [`PaintLightError::Quadrature`] if the light has fewer than eight usable wavelengths.
    pub fn new(library: &PigmentLibrary, viewing: &Viewing) -> Result<Self, PaintLightError> {
        let quadrature = kept::quadrature(library, viewing)?;
        let rgb_from_nodes = rgb_from_nodes(&quadrature.rule, 1.0).map(|rgb| rgb.map(|v| v as f32));
        Ok(Self { viewing: viewing.clone(), quadrature, rgb_from_nodes })
    }

    /// Linear sRGB of reflectance 1 at each wavelength for an eye that adapted to the light by a
    /// `degree` of 0 (the picture has the light's own colour beside D65) to 1
    /// (`rgb_from_nodes`, in which every light's white is white).
    ///
    /// Below 1 the exposure is lowered until white stays within sRGB: the greatest channel of
    /// the perfect diffuser is 1.
    #[must_use]
    pub fn rgb_at_degree(&self, degree: f64) -> [[f32; 3]; NODES] {
        if degree >= 1.0 {
            return self.rgb_from_nodes;
        }
        let rgb = rgb_from_nodes(&self.quadrature.rule, degree);
        let greatest = (0..3)
            .map(|channel: usize| rgb.iter().map(|rgb| rgb[channel]).sum::<f64>())
            .fold(f64::MIN_POSITIVE, f64::max);
        rgb.map(|rgb| rgb.map(|value| (value / greatest) as f32))
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

/// Linear sRGB of reflectance 1 at each wavelength, adapted to D65 by `degree`.
fn rgb_from_nodes(quadrature: &Quadrature, degree: f64) -> [[f64; 3]; NODES] {
    let space = RgbSpace::Srgb;
    let white = quadrature.white;
    let adapted = Adaptation::Bradford.partial_matrix(white, space.white(), degree);
    let from_xyz = space.xyz_from_linear().inverse();
    std::array::from_fn(|i| from_xyz.apply(adapted.apply(quadrature.weights[i])))
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
