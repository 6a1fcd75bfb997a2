//! The grey drawing as a film of black and white paint, as painters lay it under colour.

use paint::amount::quanta_from_mm;
use paint::document::Slots;
use paint::layer::SLOTS;
use paint::separation::{PaintFilm, Separation, SeparationSettings};
use pigment::PigmentId;
use rayon::prelude::*;

use super::materials::{FilmMaterial, FilmPaintError};
use super::tones::{Tones, within_one};

/// Greys that differ; neighbours differ by a quarter of a step of an 8-bit picture.
const LEVELS: usize = 1024;

/// Points along each side of the table of colours, of which only greys are used.
const LATTICE: usize = 13;

/// Films of white and black paint for all greys.
#[derive(Debug, Clone, PartialEq)]
pub struct Grisaille {
    slots: Slots,
    film: PaintFilm,
    /// Heights in mm by level of grey.
    heights_mm: Vec<[f32; SLOTS]>,
}

impl Grisaille {
    /// Finds the films of `white` and `black` for all greys, with `toner` against their cast if there
    /// is one, over the ground and under the light of `material`. `films` has the range of their
    /// heights. Takes a good part of a second.
    ///
    /// # Errors
    /// [`FilmPaintError`] for heights out of range.
    ///
    /// # Panics
    /// If the library lacks a pigment.
    pub fn new(
        material: &FilmMaterial,
        ([white, black], toner): ([PigmentId; 2], Option<PigmentId>),
        films: &SeparationSettings,
    ) -> Result<Self, FilmPaintError> {
        let mut slots = Slots::default();
        (slots[0], slots[1], slots[2]) = (Some(white), Some(black), toner);
        let film = material.film(&slots);
        let settings = SeparationSettings { lattice: LATTICE, ..*films };
        let separation = Separation::new(film.clone(), &settings)?;
        let mut lightest = [0.0; SLOTS];
        lightest[0] = films.most_mm as f32;
        let white = film.rgb(&lightest).into_iter().fold(1.0, f32::min);
        let tones = Tones::between(separation.black(), white);
        let heights_mm = (0..LEVELS)
            .into_par_iter()
            .map(|level: usize| {
                let grey = tones.target(level as f32 / (LEVELS - 1) as f32);
                separation.refined_heights_mm([grey; 3])
            })
            .collect();
        Ok(Self { slots, film, heights_mm })
    }

    /// The white in the first slot, the black in the second, and the toner, if any, in the third.
    #[must_use]
    pub fn slots(&self) -> &Slots {
        &self.slots
    }

    /// The model of the films' colours.
    #[must_use]
    pub fn film(&self) -> &PaintFilm {
        &self.film
    }

    /// Heights in mm by slot for an encoded grey, 0..1.
    #[must_use]
    pub fn heights_mm(&self, grey: f32) -> [f32; SLOTS] {
        self.heights_mm[level(grey)]
    }

    /// Films of all levels in quanta, for cells `cell_mm` wide.
    pub(super) fn quanta(&self, cell_mm: f64) -> Vec<[u32; SLOTS]> {
        self.heights_mm
            .iter()
            .map(|heights| heights.map(|mm: f32| quanta_from_mm(f64::from(mm), cell_mm)))
            .collect()
    }
}

/// Index of the level nearest to an encoded grey; what is no number counts as 0.
#[inline]
pub(super) fn level(grey: f32) -> usize {
    (within_one(grey) * (LEVELS - 1) as f32 + 0.5) as usize
}
