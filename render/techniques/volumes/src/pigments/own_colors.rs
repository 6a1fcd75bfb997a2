//! The colours of the scene as films of a palette's mixtures.

use graphics::field::Field;
use graphics::picture::Picture;
use paint::document::Slots;
use paint::layer::SLOTS;
use paint::separation::{PaintFilm, Separation, SeparationSettings, choose_palette};

use super::materials::{FilmMaterial, FilmPaintError};
use super::tones::Tones;

/// Films for all colours of a scene.
#[derive(Debug, Clone)]
pub struct OwnColors {
    slots: Slots,
    separation: Separation,
    tones: Tones,
}

impl OwnColors {
    /// Finds the mixtures of the pigments `slots` for all colours, over the ground and under the
    /// light of `material`. Takes seconds.
    ///
    /// # Errors
    /// [`FilmPaintError`] for an empty palette or heights out of range.
    ///
    /// # Panics
    /// If a slot refers to a pigment that the library lacks.
    pub fn new(
        material: &FilmMaterial,
        slots: Slots,
        films: &SeparationSettings,
    ) -> Result<Self, FilmPaintError> {
        let separation = Separation::new(material.film(&slots), films)?;
        let tones = Tones::between(separation.black(), 1.0);
        Ok(Self { slots, separation, tones })
    }

    /// Up to eight pigments that come nearest to the encoded colours of a picture, which are counted
    /// where their fourth value is above 0. Takes seconds.
    ///
    /// # Errors
    /// [`FilmPaintError`] if the library has no pigment to use.
    pub fn palette(
        material: &FilmMaterial,
        color: &Field<[f32; 4]>,
        films: &SeparationSettings,
    ) -> Result<Slots, FilmPaintError> {
        let tones = Tones::between(material.library.saunderson.floor() as f32, 1.0);
        let covered = color.values().iter().filter(|color| color[3] > 0.0);
        let target = |[r, g, b, _]: &[f32; 4]| [*r, *g, *b].map(|value| tones.target(value));
        let colors: Vec<_> = covered.map(target).collect();
        let colors = Picture::from_values(colors.len(), 1, colors);
        let film = |materials: paint::separation::FilmMaterials<'_>| {
            PaintFilm::at_nodes(materials, &material.light().quadrature)
        };
        let none = Slots::default();
        Ok(choose_palette(&colors, material.materials(&none), film, films)?.slots)
    }

    /// Pigments of the mixtures by slot.
    #[must_use]
    pub fn slots(&self) -> &Slots {
        &self.slots
    }

    /// Heights in mm by slot for an encoded colour.
    #[must_use]
    pub fn heights_mm(&self, color: [f32; 3]) -> [f32; SLOTS] {
        self.separation.heights_mm(color.map(|value| self.tones.target(value)))
    }
}
