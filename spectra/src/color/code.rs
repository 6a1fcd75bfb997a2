//! Colours as text.

use std::str::FromStr;

use super::adaptation::Adaptation;
use super::lab::Lab;
use super::rgb::{Rgb, RgbSpace};
use super::xyz::Xyz;
use documents::hint::{Explain, Hint};

/// A colour as a user types it: `#rrggbb` or `#rgb` in sRGB, or CIELAB as `L,a,b`.
///
/// ```
/// use spectra::color::ColorCode;
///
/// let blue: ColorCode = "#2a5caa".parse()?;
/// assert_eq!(blue.lab().lightness.round(), 40.0);
/// assert!("blue".parse::<ColorCode>().is_err());
/// # Ok::<(), spectra::color::ColorCodeError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ColorCode {
    /// Encoded sRGB, each channel 0 to 1.
    Srgb(Rgb),
    /// CIELAB relative to the white of any light.
    Lab(Lab),
}

impl ColorCode {
    /// CIELAB of the colour, relative to the display's white for sRGB.
    #[must_use]
    pub fn lab(self) -> Lab {
        match self {
            Self::Srgb(_) => {
                let white = RgbSpace::Srgb.white();
                Lab::from_xyz(self.xyz(white), white)
            }
            Self::Lab(lab) => lab,
        }
    }

    /// XYZ of the colour under a light with the given white. sRGB is adapted from the
    /// display's white (Bradford).
    #[must_use]
    pub fn xyz(self, white: Xyz) -> Xyz {
        match self {
            Self::Srgb(rgb) => RgbSpace::Srgb.xyz_from_encoded(rgb, white, Adaptation::Bradford),
            Self::Lab(lab) => lab.to_xyz(white),
        }
    }
}

impl FromStr for ColorCode {
    type Err = ColorCodeError;

    fn from_str(text: &str) -> Result<Self, ColorCodeError> {
        let rgb = Rgb::from_hex(text).map(Self::Srgb);
        rgb.or_else(|| Lab::from_text(text).map(Self::Lab))
            .ok_or_else(|| ColorCodeError { text: text.to_owned() })
    }
}

/// A text that is not a colour.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("a colour is #rrggbb or L,a,b, found `{text}`")]
pub struct ColorCodeError {
    /// The text that was given.
    pub text: String,
}

impl Explain for ColorCodeError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new("try \"#2a5caa\" or 40,5,-45"))
    }
}
