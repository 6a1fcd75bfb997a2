//! Materials of films: a library, the ground under them, and the light that colours are matched
//! under.

use std::sync::Arc;

use documents::hint::{Explain, Fault, Hint};
use paint::document::{Lighting, Medium, Slots};
use paint::ground::{GroundError, GroundSpec};
use paint::light::{Light, PaintLightError};
use paint::separation::{FilmMaterials, PaintFilm, SeparationError};
use pigment::palette::{Cards, Palette, PaletteError};
use pigment::{PigmentId, PigmentLibrary};

/// Pigments, ground and light of a painting of volumes.
#[derive(Debug, Clone)]
pub struct FilmMaterial {
    /// Library of the pigments.
    pub library: Arc<PigmentLibrary>,
    /// The ground under all films.
    pub ground: GroundSpec,
    /// Light that the painting is viewed under, and that colours are matched under.
    pub lighting: Lighting,
    /// Binder of the paint.
    pub medium: Medium,
    /// Measured reflectance of the ground on the library's grid, 0..1.
    pub reflectance: Vec<f64>,
    light: Light,
}

impl FilmMaterial {
    /// Materials for paintings over `ground`, seen under `lighting`. Takes a good part of a second.
    ///
    /// # Errors
    /// [`FilmPaintError`] for a light or a ground that cannot be used with the library.
    pub fn new(
        library: Arc<PigmentLibrary>,
        ground: GroundSpec,
        lighting: Lighting,
    ) -> Result<Self, FilmPaintError> {
        let light = Light::named(&library, &lighting.illuminant, &lighting.observer)?;
        let reflectance = ground.reflectance(&library)?;
        let medium = Medium::of(&library);
        Ok(Self { library, ground, lighting, medium, reflectance, light })
    }

    /// The light that colours are matched under.
    #[must_use]
    pub fn light(&self) -> &Light {
        &self.light
    }

    /// Films of these pigments over the ground.
    ///
    /// # Panics
    /// If a slot refers to a pigment that the library lacks.
    #[must_use]
    pub fn film(&self, slots: &Slots) -> PaintFilm {
        PaintFilm::at_nodes(self.materials(slots), &self.light.quadrature)
    }

    /// The parts that films of these pigments are computed from.
    #[must_use]
    pub fn materials<'a>(&'a self, slots: &'a Slots) -> FilmMaterials<'a> {
        FilmMaterials {
            library: &self.library,
            slots,
            ground: &self.reflectance,
            scattering_per_mm: self.medium.scattering_per_mm,
        }
    }

    /// The white and the black of the library: its reference white, or its lightest paint, and its
    /// darkest one.
    ///
    /// # Errors
    /// [`FilmPaintError`] if the library has no two paints that differ, as one of absolute amounts,
    /// in which the paper is the white.
    pub fn white_and_black(&self) -> Result<[PigmentId; 2], FilmPaintError> {
        let cards = Cards::standard(self.library.grid);
        let palette = Palette::new(&self.library, &self.light.viewing, cards)?;
        let black = palette.black();
        let white = palette.white().filter(|&white| white != black);
        Ok([white.ok_or(FilmPaintError::NoWhite)?, black])
    }
}

/// Films cannot be painted with these materials.
#[derive(Debug, thiserror::Error)]
pub enum FilmPaintError {
    /// The light cannot be used with the library.
    #[error(transparent)]
    Light(#[from] PaintLightError),
    /// The ground cannot be made.
    #[error(transparent)]
    Ground(#[from] GroundError),
    /// The pigments give no mixtures.
    #[error(transparent)]
    Separation(#[from] SeparationError),
    /// The library has nothing to mix.
    #[error(transparent)]
    Palette(#[from] PaletteError),
    /// There is no white beside the darkest paint.
    #[error("a drawing in grey needs a white and a black paint, and the library has no white")]
    NoWhite,
}

impl FilmPaintError {
    fn cause(&self) -> Option<&dyn Explain> {
        match self {
            Self::Light(error) => Some(error),
            Self::Ground(error) => Some(error),
            Self::Separation(error) => Some(error),
            Self::Palette(error) => Some(error),
            Self::NoWhite => None,
        }
    }
}

impl Explain for FilmPaintError {
    fn hint(&self) -> Option<Hint> {
        self.cause().map_or_else(
            || Some(Hint::new("choose a library of opaque paints, such as the oils")),
            Explain::hint,
        )
    }

    fn fault(&self) -> Fault {
        self.cause().map_or(Fault::Setting, Explain::fault)
    }
}
