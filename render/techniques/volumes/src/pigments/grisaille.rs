//! The grey drawing as a film of black and white paint, as painters lay it under colour. Also the
//! colours of the scene as films of a palette's mixtures, and hatching as a film of black paint,
//! which is thicker where there is more ink.

use graphics::field::Field;
use graphics::picture::Picture;
use paint::amount::quanta_from_mm;
use paint::document::Slots;
use paint::layer::SLOTS;
use paint::separation::{PaintFilm, Separation, SeparationSettings, choose_palette};
use pigment::PigmentId;
use rayon::prelude::*;

use super::materials::{FilmMaterial, FilmPaintError, Tones, linear, within_one};

/// We distinguish this many greys. Neighbours differ by a quarter of a step of an 8-bit picture.
const LEVELS: usize = 1024;

/// Points along each side of the table of colours. We use only the greys in it.
const LATTICE: usize = 13;

/// Films of white and black paint for all greys.
#[derive(Debug, Clone, PartialEq)]
pub struct Grisaille {
    slots: Slots,
    film: PaintFilm,
    heights_mm: Vec<[f32; SLOTS]>,
}

impl Grisaille {
    /// Finds the films of `white` and `black` for all greys, over the ground and under the light
    /// of `material`. If you pass a `toner`, it removes their cast. `films` has the range of their
    /// heights. This takes a good part of a second.
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

    /// The white in the first slot, the black in the second, and in the third the toner if you use
    /// one.
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

    pub(super) fn quanta(&self, cell_mm: f64) -> Vec<[u32; SLOTS]> {
        self.heights_mm
            .iter()
            .map(|heights| heights.map(|mm: f32| quanta_from_mm(f64::from(mm), cell_mm)))
            .collect()
    }
}

/// Index of the level nearest to an encoded grey. NaN counts as 0.
#[inline]
pub(super) fn level(grey: f32) -> usize {
    (within_one(grey) * (LEVELS - 1) as f32 + 0.5) as usize
}

/// Films for all colours of a scene.
#[derive(Debug, Clone)]
pub struct OwnColors {
    slots: Slots,
    separation: Separation,
    tones: Tones,
}

impl OwnColors {
    /// Finds the mixtures of the pigments `slots` for all colours, over the ground and under the
    /// light of `material`. This takes seconds.
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

    /// Up to eight pigments that come nearest to the encoded colours of a picture. We count the
    /// pixels with a fourth value above 0. This takes seconds.
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
        let colors: Vec<_> = covered
            .map(|[r, g, b, _]: &[f32; 4]| [*r, *g, *b].map(|value| tones.target(value)))
            .collect();
        let colors = Picture::from_values(colors.len(), 1, colors);
        let none = Slots::default();
        Ok(choose_palette(
            &colors,
            material.materials(&none),
            |materials: paint::separation::FilmMaterials<'_>| {
                PaintFilm::at_nodes(materials, &material.light().quadrature)
            },
            films,
        )?
        .slots)
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

const STEPS: usize = 256;

const MOST_MM: f64 = 0.05;

const HALVINGS: usize = 40;

/// Films of black paint for all amounts of ink.
#[derive(Debug, Clone, PartialEq)]
pub struct Pencil {
    heights_mm: Vec<f64>,
}

impl Pencil {
    /// Finds the films that darken the bare ground like a pencil of the encoded `grey`. Full ink
    /// gives this grey, half of it a tone half-way. The black is the black of `grisaille`. A film
    /// is at most 0.05 mm high, which almost hides the ground.
    #[must_use]
    pub fn new(grisaille: &Grisaille, grey: f32) -> Self {
        let luminance = |mm: f64| {
            let mut heights = [0.0; SLOTS];
            heights[1] = mm as f32;
            let [r, g, b] = grisaille.film().rgb(&heights);
            // These are the weights of luminance of sRGB (IEC 61966-2-1).
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let bare = luminance(0.0);
        Self {
            heights_mm: (0..STEPS)
                .map(|step: usize| {
                    let left = 1.0 - step as f32 / (STEPS - 1) as f32 * (1.0 - grey);
                    let wanted = bare * linear(left);
                    let mut range = [0.0, MOST_MM];
                    for _ in 0..HALVINGS {
                        let middle = 0.5 * (range[0] + range[1]);
                        range[usize::from(luminance(middle) < wanted)] = middle;
                    }
                    if step == 0 { 0.0 } else { range[1] }
                })
                .collect(),
        }
    }

    /// Height in mm of the film for an amount of ink, 0..1.
    #[must_use]
    pub fn height_mm(&self, ink: f32) -> f64 {
        self.heights_mm[step(ink)]
    }

    pub(super) fn quanta(&self, cell_mm: f64) -> Vec<u32> {
        self.heights_mm.iter().map(|&mm| quanta_from_mm(mm, cell_mm)).collect()
    }
}

/// Index of the step nearest to an amount of ink. NaN counts as 0.
#[inline]
pub(super) fn step(ink: f32) -> usize {
    (within_one(ink) * (STEPS - 1) as f32 + 0.5) as usize
}
