//! Washes painted as glazes, their pigments chosen by the first wash.

use pigment::library::PigmentLibrary;

use super::glazes::{GlazeError, Glazes};
use crate::settings::Settings;
use crate::textures::Textures;
use crate::wash::Wash;
use paint::document::{Document, Lighting, Slots};
use paint::ground::{ColorPrimer, GroundError, Primer};
use paint::light::Light;

/// Paints washes with glazes of a library's pigments.
#[derive(Debug, Clone)]
pub struct GlazePainter {
    library: PigmentLibrary,
    palette: Option<Slots>,
    paper: Vec<f64>,
    light: Light,
    lighting: Lighting,
    /// The recipes, once the pigments are chosen.
    glazes: Option<Glazes>,
}

impl GlazePainter {
    /// Makes a painter for paper with the measured reflectance `paper` on the library's
    /// grid. Colours are matched under `light`. Paintings store `lighting`, which should
    /// name that light.
    #[must_use]
    pub fn new(library: PigmentLibrary, paper: Vec<f64>, light: Light, lighting: Lighting) -> Self {
        Self { library, palette: None, paper, light, lighting, glazes: None }
    }

    /// Paints with these pigments. Without them, up to eight pigments are chosen that come
    /// closest to the colours of the first wash.
    #[must_use]
    pub fn with_palette(self, palette: Slots) -> Self {
        Self { palette: Some(palette), glazes: None, ..self }
    }

    /// The smoothest reflectance, on the library's grid, of the paper colour in `settings`.
    ///
    /// # Errors
    /// [`GroundError`] if no surface has that colour.
    pub fn paper_of_settings(
        settings: &Settings,
        library: &PigmentLibrary,
    ) -> Result<Vec<f64>, GroundError> {
        let rgb = settings.paper.color.clone();
        Primer::Color(ColorPrimer { rgb }).reflectance(library)
    }

    /// Chooses the pigments by this wash unless they are known, and finds the recipes of
    /// their glazes unless they are known. Takes seconds the first time.
    ///
    /// # Errors
    /// [`GlazeError`] if the library has no pigment to use, or the palette is empty.
    pub fn choose(&mut self, wash: &Wash) -> Result<&Glazes, GlazeError> {
        let Self { library, palette, paper, light, glazes, .. } = self;
        let found = match glazes.take() {
            Some(found) => found,
            None => {
                let slots = match palette {
                    Some(slots) => *slots,
                    None => Glazes::palette(wash, library, paper, light)?,
                };
                Glazes::new(library, &slots, paper.clone(), light)?
            }
        };
        Ok(glazes.insert(found))
    }

    /// Paints `wash` with glazes: a painting of one dry layer over the paper. `textures` and
    /// `settings` are those for its size. The first wash chooses the pigments
    /// ([`Self::choose`]).
    ///
    /// # Errors
    /// [`GlazeError`] if the library has no pigment to use, or the palette is empty.
    ///
    /// # Panics
    /// If sizes differ.
    pub fn paint(
        &mut self,
        title: &str,
        wash: &Wash,
        textures: &Textures,
        settings: &Settings,
    ) -> Result<Document, GlazeError> {
        let lighting = self.lighting.clone();
        Ok(self.choose(wash)?.paint(title, wash, textures, settings, lighting))
    }

    /// The light that colours are matched under.
    #[must_use]
    pub fn light(&self) -> &Light {
        &self.light
    }

    /// Names of the pigments in use; none before they are chosen.
    #[must_use]
    pub fn pigments(&self) -> Vec<&str> {
        let slots = self.glazes.as_ref().map(|glazes| *glazes.slots()).unwrap_or_default();
        slots.iter().flatten().map(|&pigment| self.library[pigment].name.as_str()).collect()
    }
}
