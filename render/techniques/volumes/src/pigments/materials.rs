//! Materials of films: a library, the ground under them, and the light under which we match
//! colours. Also a third paint that takes the cast out of greys of white and black, and a
//! conversion of encoded values to the linear values that paint can reach.

use std::sync::Arc;

use documents::hint::Explain;
use paint::document::{Lighting, Medium, Slots};
use paint::ground::{GroundError, GroundSpec};
use paint::light::{Light, PaintLightError};
use paint::separation::{FilmMaterials, PaintFilm, SeparationError};
use pigment::palette::{Cards, Palette, PaletteError};
use pigment::{PigmentId, PigmentLibrary};
use spectra::color::Rgb;

/// Pigments, ground and light of a painting of volumes.
#[derive(Debug, Clone)]
pub struct FilmMaterial {
    /// Library of the pigments.
    pub library: Arc<PigmentLibrary>,
    /// The ground under all films.
    pub ground: GroundSpec,
    /// Light under which you view the painting and we match colours.
    pub lighting: Lighting,
    /// Binder of the paint.
    pub medium: Medium,
    /// Measured reflectance of the ground on the library's grid, 0..1.
    pub reflectance: Vec<f64>,
    light: Light,
}

impl FilmMaterial {
    /// Materials for paintings over `ground`, which you see under `lighting`. This takes a good
    /// part of a second.
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
        // The painter chooses films, also thin ones, that are even.
        let medium = Medium { films_break: false, ..Medium::of(&library) };
        Ok(Self { library, ground, lighting, medium, reflectance, light })
    }

    /// The light under which we match colours.
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

    /// The parts from which you compute films of these pigments.
    #[must_use]
    pub fn materials<'a>(&'a self, slots: &'a Slots) -> FilmMaterials<'a> {
        FilmMaterials {
            library: &self.library,
            slots,
            ground: &self.reflectance,
            scattering_per_mm: self.medium.scattering_per_mm,
        }
    }

    /// The white and the black of the library. The white is its reference white, or else its
    /// lightest paint. The black is its darkest paint.
    ///
    /// # Errors
    /// [`FilmPaintError`] if the library has no two paints that differ, for example one of
    /// absolute amounts, in which the paper is the white.
    pub fn white_and_black(&self) -> Result<[PigmentId; 2], FilmPaintError> {
        let cards = Cards::standard(self.library.grid);
        let palette = Palette::new(&self.library, &self.light.viewing, cards)?;
        let black = palette.black();
        let white = palette.white().filter(|&white| white != black);
        Ok([white.ok_or(FilmPaintError::NoWhite)?, black])
    }
}

/// Films cannot be painted with these materials.
#[derive(Debug, thiserror::Error, Explain)]
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
    #[hint("choose a library of opaque paints, such as the oils")]
    #[fault(Setting)]
    NoWhite,
}

/// CIELAB lightness of the grey that the paint is chosen for.
const MIDDLE: f64 = 50.0;

/// Height of the grey's film in mm.
const GREY_MM: f64 = 0.3;

/// We try this many parts of the paint for one part of black.
const PARTS: [f64; 5] = [0.05, 0.1, 0.2, 0.4, 0.8];

const HALVINGS: usize = 20;

/// The paint of the library that makes a middle grey of white and black most neutral, e.g. an
/// earth against a blue cast. `None` if no paint improves it.
///
/// # Panics
/// If the library lacks `white` or `black`.
#[must_use]
pub fn toner(material: &FilmMaterial, [white, black]: [PigmentId; 2]) -> Option<PigmentId> {
    let chroma = |third: Option<PigmentId>, parts: f64| {
        let mut slots = Slots::default();
        (slots[0], slots[1], slots[2]) = (Some(white), Some(black), third);
        let film = material.film(&slots);
        let lab = |dark: f64| {
            let third = dark * parts;
            let whole = (1.0 + dark + third) / GREY_MM;
            film.lab(&[1.0, dark, third, 0.0, 0.0, 0.0, 0.0, 0.0].map(|part| part / whole))
        };
        let mut range = [0.0, 1.0];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (range[0] + range[1]);
            range[usize::from(lab(middle).lightness < MIDDLE)] = middle;
        }
        let found = lab(range[0]);
        found.a.hypot(found.b)
    };
    let library = &material.library;
    let others = library.ids().filter(|id| library[*id].identified && ![white, black].contains(id));
    let tried = others.flat_map(|id| PARTS.map(|parts| (chroma(Some(id), parts), id)));
    let best = tried.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 < chroma(None, 0.0)).then_some(best.1)
}

const STEPS: usize = 4096;

/// The linear value that we paint for each encoded value. Black becomes the darkest tone that paint
/// reaches and white the lightest, so that differences in shadows and lights survive.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tones {
    black: f32,
    white: f32,
    linear: Vec<f32>,
}

impl Tones {
    pub(super) fn between(black: f32, white: f32) -> Self {
        Self {
            black,
            white,
            linear: (0..=STEPS + 1)
                .map(|step: usize| linear(step.min(STEPS) as f32 / STEPS as f32))
                .collect(),
        }
    }

    /// The linear value that we paint for an encoded one. NaN counts as 0.
    pub(super) fn target(&self, encoded: f32) -> f32 {
        let place = within_one(encoded) * STEPS as f32;
        let step = place as usize;
        let rest = place.fract();
        let linear = self.linear[step] + rest * (self.linear[step + 1] - self.linear[step]);
        self.black + (self.white - self.black) * linear
    }
}

/// The nearest value from 0 to 1. NaN counts as 0.
#[inline]
pub(super) fn within_one(value: f32) -> f32 {
    if value > 0.0 { value.min(1.0) } else { 0.0 }
}

pub(super) fn linear(encoded: f32) -> f32 {
    Rgb([f64::from(encoded); 3]).linear().0[0] as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tones_are_those_of_srgb_between_black_and_white() {
        let tones = Tones::between(0.03, 0.9);
        assert_eq!(tones.target(0.0), 0.03);
        assert_eq!(tones.target(-2.0), 0.03);
        assert_eq!(tones.target(f32::NAN), 0.03);
        assert!((tones.target(1.0) - 0.9).abs() < 1e-6 && (tones.target(7.0) - 0.9).abs() < 1e-6);
        // 0.5 encoded is 0.2140 linear (IEC 61966-2-1).
        assert!((tones.target(0.5) - (0.03 + 0.87 * 0.214_04)).abs() < 1e-5);
    }
}
