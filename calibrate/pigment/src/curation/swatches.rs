//! Swatches of a library: the masstone of each pigment and its tints.

use spectra::color::{Adaptation, ColorValues, Lab, adapt};
use spectra::swatch_file::{SwatchColor, SwatchEntry, SwatchFile, d50_white};

use super::error::CurationError;
use crate::evaluate::Viewing;
use crate::library::{AmountKind, PigmentLibrary};
use crate::recipe::PigmentId;

/// Colour of an opaque film of one pigment, alone or with white.
#[derive(Debug, Clone, PartialEq)]
pub struct Swatch {
    /// Name of the pigment.
    pub pigment: String,
    /// Name of the swatch: the pigment's, followed by its ratio to white: `Viridian 1:4`.
    pub name: String,
    /// Measured reflectance on the library's grid, 0 to 1.
    pub reflectance: Vec<f64>,
    /// Its colour.
    pub color: ColorValues,
}

/// Colour space of a swatch in a palette file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SwatchSpace {
    /// sRGB, clipped to its gamut by the file.
    Srgb,
    /// CIELAB under D50, as in graphic arts; adapted by Bradford's transform.
    LabD50,
}

/// Swatches of a library under one light.
#[derive(Debug, Clone, PartialEq)]
pub struct Swatches {
    /// Swatches in the order of the pigments; a masstone comes before its tints.
    pub swatches: Vec<Swatch>,
    title: String,
    white: spectra::color::Xyz,
    grouped: bool,
}

impl Swatches {
    /// The masstone of each pigment of `library`, followed by its tints with `tints` parts of
    /// the reference white. The white itself and pigments with unknown scattering have none.
    ///
    /// # Errors
    /// [`CurationError`] for tints without a reference white, or with parts outside 0 to 1e6.
    pub fn new(
        library: &PigmentLibrary,
        viewing: &Viewing,
        tints: &[f64],
    ) -> Result<Self, CurationError> {
        let white = library.reference_id();
        if !tints.is_empty() && (white.is_none() || library.amounts == AmountKind::Absolute) {
            return Err(CurationError::NoWhite);
        }
        if let Some(&parts) = tints.iter().find(|parts| !(**parts > 0.0 && **parts <= 1e6)) {
            return Err(CurationError::TintParts { parts });
        }
        let weights = viewing.weights(library.grid).expect("a method for the grid");
        let mut swatches = Vec::new();
        for id in library.ids() {
            let pigment = &library[id];
            let mut add = |name: String, recipe: &[(PigmentId, f64)]| {
                let mixture = library.mix(recipe).expect("pigments of the library");
                let reflectance = mixture.hiding(library.saunderson);
                let color = weights.color(&reflectance);
                swatches.push(Swatch { pigment: pigment.name.clone(), name, reflectance, color });
            };
            add(pigment.name.clone(), &[(id, 1.0)]);
            let Some(white) = white.filter(|&white| white != id && pigment.identified) else {
                continue;
            };
            for parts in tints {
                add(format!("{} 1:{parts}", pigment.name), &[(id, 1.0), (white, *parts)]);
            }
        }
        let title = library.title.clone();
        let grouped = !tints.is_empty();
        Ok(Self { swatches, title, white: weights.white(), grouped })
    }

    /// Names of the swatches outside sRGB.
    #[must_use]
    pub fn outside_srgb(&self) -> Vec<&str> {
        let outside = self.swatches.iter().filter(|swatch| !swatch.color.srgb.in_gamut());
        outside.map(|swatch| swatch.name.as_str()).collect()
    }

    /// The swatches as a palette file, with a group for each pigment that has tints.
    #[must_use]
    pub fn palette(&self, space: SwatchSpace) -> SwatchFile {
        let entry = |swatch: &Swatch| SwatchEntry {
            group: if self.grouped { swatch.pigment.clone() } else { String::new() },
            name: swatch.name.clone(),
            color: match space {
                SwatchSpace::Srgb => SwatchColor::Rgb(swatch.color.srgb),
                SwatchSpace::LabD50 => {
                    let d50 = d50_white();
                    let xyz = adapt(swatch.color.xyz, self.white, d50, Adaptation::Bradford);
                    SwatchColor::Lab(Lab::from_xyz(xyz, d50))
                }
            },
        };
        let swatches = self.swatches.iter().map(entry).collect();
        SwatchFile { name: self.title.clone(), swatches }
    }
}
