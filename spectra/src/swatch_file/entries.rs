//! Named colours.

use crate::color::{Adaptation, Lab, Rgb, RgbSpace, Xyz};
use crate::grid::Grid;
use crate::illuminant::Illuminant;
use crate::integrate::TristimulusWeights;
use crate::interpolate::Interpolation;
use crate::observer::Observer;

/// A colour as a palette holds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SwatchColor {
    /// Encoded RGB, 0..1; sRGB unless one knows better.
    Rgb(Rgb),
    /// CIELAB under D50 ([`d50_white`]).
    Lab(Lab),
    /// Shares of ink, 0..1; without a profile no colour.
    Cmyk([f64; 4]),
    /// From 0 for black to 1 for white.
    Grey(f64),
}

impl SwatchColor {
    /// The colour in sRGB, not cut off at the gamut; none for inks.
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

/// The white of a palette's Lab: D50 for the observer of 1931.
#[must_use]
pub fn d50_white() -> Xyz {
    let light = Illuminant::named("D50").expect("D50 is one of the CIE's");
    let weights =
        TristimulusWeights::new(Grid::cie(), &light, Observer::default(), Interpolation::Linear);
    weights.expect("lines join any grid").white()
}

/// One named colour.
#[derive(Debug, Clone, PartialEq)]
pub struct SwatchEntry {
    /// Its name.
    pub name: String,
    /// The group it stands in; empty for none. Only `.ase` has groups.
    pub group: String,
    /// Its colour.
    pub color: SwatchColor,
}

/// Named colours in order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SwatchFile {
    /// The palette's own name; only `.gpl` has one.
    pub name: String,
    /// The colours.
    pub swatches: Vec<SwatchEntry>,
}
