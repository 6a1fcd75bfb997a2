//! A colour under one light, in the forms that people use.

use spectra::color::{Adaptation, Lab, Rgb, RgbSpace, Xyz};

/// A colour under one light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Appearance {
    /// Tristimulus values, Y = 100 for the white.
    pub xyz: Xyz,
    /// CIELAB relative to the light's own white.
    pub lab: Lab,
    /// Encoded sRGB, adapted from the light to the display (Bradford); outside 0..1 where sRGB cannot
    /// show the colour.
    pub srgb: Rgb,
}

impl Appearance {
    /// Computes the appearance of `xyz` under a light whose white is `white`.
    #[must_use]
    pub fn of(xyz: Xyz, white: Xyz) -> Self {
        Self {
            xyz,
            lab: Lab::from_xyz(xyz, white),
            srgb: RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford),
        }
    }
}
