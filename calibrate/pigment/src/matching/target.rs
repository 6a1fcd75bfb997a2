//! Colours for which recipes are searched.

use std::str::FromStr;

use spectra::color::{ColorCode, ColorCodeError, Lab, Rgb};
use spectra::{InterpolateError, Reflectance, Spectrum};

use super::spectral_target::SpectralTarget;
use super::viewing_condition::ViewingCondition;
use crate::evaluate::lab;

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
    /// CIELAB, to be matched under every light. An sRGB colour is adapted (Bradford) from the display's
    /// white to that of the light, which leaves its CIELAB unchanged.
    Lab(Lab),
    /// A measured reflectance, which has a colour of its own under each light.
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

    /// Colours to be matched under each of `conditions`.
    ///
    /// # Errors
    /// None in practice: the method is chosen to fit the grid of the spectrum.
    pub fn under(&self, conditions: &[ViewingCondition]) -> Result<Target, InterpolateError> {
        match &self.color {
            TargetColor::Lab(lab) => Ok(Target::from_lab(&self.name, *lab, conditions)),
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

    /// Target with the colours of a measured reflectance; its spectrum is left out, since that needs the grid
    /// of a library ([`SpectralTarget::new`]).
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
