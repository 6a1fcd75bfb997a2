//! The named colours that a swatch file holds.

use crate::color::{Adaptation, Lab, Rgb, RgbSpace, Xyz};
use crate::grid::Grid;
use crate::illuminant::Illuminant;
use crate::integrate::TristimulusWeights;
use crate::interpolate::Interpolation;
use crate::observer::Observer;

/// A colour in one of the models of swatch files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SwatchColor {
    /// Encoded RGB, each channel 0 to 1. Swatch files do not name the RGB space; it is taken as
    /// sRGB.
    Rgb(Rgb),
    /// CIELAB under D50 ([`d50_white`]).
    Lab(Lab),
    /// Amounts of ink, each 0 to 1. Without a colour profile they do not define a colour.
    Cmyk([f64; 4]),
    /// Grey, from 0 for black to 1 for white.
    Grey(f64),
}

impl SwatchColor {
    /// The colour in sRGB, not clipped to the gamut; `None` for inks.
    #[must_use]
    pub fn srgb(self) -> Option<Rgb> {
        match self {
            Self::Rgb(rgb) => Some(rgb),
            Self::Lab(lab) => {
                let white = d50_white();
                let xyz = lab.to_xyz(white);
                Some(RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford))
            }
            Self::Cmyk(_) => None,
            Self::Grey(grey) => Some(Rgb([grey; 3])),
        }
    }
}

/// White point of Lab in swatch files: D50 for the observer of 1931.
#[must_use]
pub fn d50_white() -> Xyz {
    let light = Illuminant::named("D50").expect("D50 is in the table of CIE illuminants");
    let weights =
        TristimulusWeights::new(Grid::cie(), &light, Observer::default(), Interpolation::Linear);
    weights.expect("linear interpolation suits any grid").white()
}

/// One named colour of a swatch file.
#[derive(Debug, Clone, PartialEq)]
pub struct SwatchEntry {
    /// Name of the colour.
    pub name: String,
    /// Name of its group, empty for none. Only `.ase` files have groups.
    pub group: String,
    /// Value of the colour.
    pub color: SwatchColor,
}

/// The content of a swatch file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SwatchFile {
    /// Name of the whole palette; only `.gpl` files have one.
    pub name: String,
    /// The colours in the order of the file.
    pub swatches: Vec<SwatchEntry>,
}
