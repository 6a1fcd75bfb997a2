//! Colour rendering of a light by both standards.

use super::fidelity::ColorFidelity;
use super::rendering_index::RenderingIndex;
use crate::color_temperature::ColorTemperature;
use crate::illuminant::{Illuminant, IlluminantError};
use documents::hint::{Explain, Hint};

/// Greatest colour temperature in K of daylight, with which bluer lights would be compared.
const BLUEST: f64 = 25_000.0;

/// Colour temperature and colour rendering of a light.
///
/// ```
/// use spectra::{ColorRendering, light_from_text};
///
/// let tube = ColorRendering::of(&light_from_text("FL11")?)?;
/// assert_eq!(tube.temperature.kelvin.round(), 4001.0);
/// assert_eq!(tube.index.general.round(), 83.0);
/// assert_eq!(tube.fidelity.fidelity.round(), 80.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ColorRendering {
    /// Correlated colour temperature and distance from the black body.
    pub temperature: ColorTemperature,
    /// Colour rendering indices of CIE 13.3.
    pub index: RenderingIndex,
    /// Fidelity and gamut of TM-30.
    pub fidelity: ColorFidelity,
}

impl ColorRendering {
    /// Colour rendering of `light`. Where a lamp was not measured its end values are held.
    ///
    /// # Errors
    /// [`ColorRenderingError`] for a light so far from every black body that it has no colour temperature, or
    /// bluer than daylight of 25000 K: both standards compare a lamp with a white of its temperature.
    pub fn of(light: &Illuminant) -> Result<Self, ColorRenderingError> {
        let name = || light.name().to_owned();
        let temperature = ColorTemperature::of(light)
            .ok_or_else(|| ColorRenderingError::NotWhite { name: name() })?;
        let kelvin = temperature.kelvin;
        if kelvin > BLUEST {
            return Err(ColorRenderingError::TooBlue { name: name(), kelvin });
        }
        Ok(Self {
            temperature,
            index: RenderingIndex::of(light, kelvin)?,
            fidelity: ColorFidelity::of(light, kelvin)?,
        })
    }
}

/// A light that has no colour rendering.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ColorRenderingError {
    /// The light is coloured.
    #[error(
        "{name} is no white light: it is farther than 0.05 from every black body in CIE 1960 (u, v)"
    )]
    NotWhite {
        /// Name of the light.
        name: String,
    },
    /// No daylight is so blue.
    #[error("{name} has a colour temperature of {kelvin:.0} K, and the reference ends at 25000 K")]
    TooBlue {
        /// Name of the light.
        name: String,
        /// Correlated colour temperature in K.
        kelvin: f64,
    },
    /// The light or its reference has no power where it is needed.
    #[error(transparent)]
    Light(#[from] IlluminantError),
}

impl Explain for ColorRenderingError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::NotWhite { .. } | Self::TooBlue { .. } => {
                Some(Hint::new("colour rendering compares a lamp with a white of its temperature"))
            }
            Self::Light(error) => error.hint(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::black_body::black_body;
    use crate::daylight::daylight;

    #[test]
    fn a_reference_renders_perfectly() {
        for light in [black_body(2700.0), black_body(3900.0), daylight(5600.0), daylight(9000.0)] {
            let found = ColorRendering::of(&light.unwrap()).unwrap();
            for value in [found.index.general, found.fidelity.fidelity, found.fidelity.gamut] {
                assert!((value - 100.0).abs() < 0.05, "{found:?}");
            }
            assert!(found.index.is_meant() && found.index.distance_from_reference < 1e-4);
        }
    }

    #[test]
    fn published_general_indices_are_found() {
        // CIE 15:2004, table T.6.2, and CIE 15:2018, table T.12 for the LED lamps.
        for (name, wanted) in [
            ("FL1", 76.0),
            ("FL2", 64.0),
            ("FL4", 51.0),
            ("FL7", 90.0),
            ("FL8", 95.0),
            ("FL11", 83.0),
            ("FL12", 83.0),
        ] {
            let found = ColorRendering::of(&Illuminant::named(name).unwrap()).unwrap();
            assert!((found.index.general - wanted).abs() < 0.6, "{name}: {}", found.index.general);
        }
    }

    #[test]
    fn coloured_and_very_blue_lights_are_refused() {
        let green =
            Illuminant::from_function(
                "green",
                |nm| if (nm - 530.0).abs() < 20.0 { 1.0 } else { 0.0 },
            );
        let refused = ColorRendering::of(&green.unwrap()).unwrap_err();
        assert!(
            matches!(refused, ColorRenderingError::NotWhite { .. }) && refused.hint().is_some()
        );
        let blue = ColorRendering::of(&black_body(40_000.0).unwrap()).unwrap_err();
        assert!(blue.to_string().contains("40000 K"), "{blue}");
    }

    #[test]
    fn a_light_far_from_its_reference_is_marked() {
        // A black body with some green added.
        let body = black_body(4500.0).unwrap();
        let power = body.power().values();
        let far = Illuminant::from_function("far", |nm| {
            power[(nm - 360.0) as usize] + 25.0 * (-((nm - 545.0) / 20.0).powi(2)).exp()
        });
        let found = ColorRendering::of(&far.unwrap()).unwrap();
        assert!(found.temperature.duv > 6e-3 && !found.index.is_meant(), "{found:?}");
    }
}
