//! One colour in three colour spaces.

use super::adaptation::Adaptation;
use super::lab::Lab;
use super::rgb::{Rgb, RgbSpace};
use super::xyz::Xyz;

/// The colour of an object under one light, in XYZ, CIELAB and sRGB.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorValues {
    /// Tristimulus values; Y = 100 for the perfect diffuser.
    pub xyz: Xyz,
    /// CIELAB relative to the white of the light.
    pub lab: Lab,
    /// Encoded sRGB, adapted from the light's white to the display's (Bradford). Outside
    /// 0 to 1 where the display cannot show the colour.
    pub srgb: Rgb,
}

impl ColorValues {
    /// The colour `xyz` under a light whose white point is `white`.
    #[must_use]
    pub fn from_xyz(xyz: Xyz, white: Xyz) -> Self {
        Self {
            xyz,
            lab: Lab::from_xyz(xyz, white),
            srgb: RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford),
        }
    }

    /// The colour as `#rrggbb`, clipped to the sRGB gamut.
    #[must_use]
    pub fn hex(&self) -> String {
        self.srgb.to_hex()
    }
}
