//! From colours to heights of pigments: a table over the sRGB cube.
//!
//! The table is a lattice over the square roots of linear red, green and blue,
//! which are nearly even to the eye. Each point holds the film nearest to its
//! colour (see `nearest`); between points heights are interpolated in the
//! tetrahedron that holds the colour, as is usual for colour tables.

use rayon::prelude::*;
use spectra::color::{Lab, RgbSpace, delta_e_ciede2000};

use super::film::PaintFilm;
use super::mixtures::Mixtures;
use super::nearest::{Anchor, Mixed, Nearest};
use crate::layer::SLOTS;
use graphics::field::Field;
use graphics::picture::Picture;

/// How colours become paint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeparationSettings {
    /// Points of the table along each side, 5 to 65; 25 by default. More take
    /// time by the cube, and come nearer between the points.
    pub lattice: usize,
    /// The least height of a film in mm, above 0; 0.03 by default.
    pub least_mm: f64,
    /// The greatest in mm, not below the least; 0.3 by default.
    pub most_mm: f64,
    /// Whether paint is to hide the ground as well as the range allows (the
    /// default). Else the ground may shine through, which over white reaches
    /// lighter and more saturated colours.
    pub hides: bool,
    /// Whether [`Separation::separate`] refines each pixel's film after looking
    /// it up, which takes some microseconds a pixel; `true` by default.
    pub refined: bool,
}

impl Default for SeparationSettings {
    fn default() -> Self {
        Self { lattice: 25, least_mm: 0.03, most_mm: 0.3, hides: true, refined: true }
    }
}

/// What a difference over black and over the ground counts to one from the
/// wanted colour, where paint is to hide.
const HIDING: f64 = 0.07;

/// Sets of pigments tried at each point of the table.
const STARTS: usize = 3;
/// Steps of each descent.
const STEPS: usize = 20;
/// Passes over the table in which each point hears its neighbours.
const SMOOTHINGS: usize = 2;
/// How much a point stays at the mean of its neighbours.
const NEIGHBOURS: f64 = 0.3;
/// How much a pixel stays at its film of the table, and the steps from there.
const FROM_TABLE: f64 = 1.0;
const REFINEMENTS: usize = 8;

/// The nearest reproducible colour is farther than this, in CIEDE2000: the
/// colour is out of gamut.
pub const OUT_OF_GAMUT: f64 = 1.0;

/// A table from linear sRGB to heights of a palette's pigments in mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Separation {
    nearest: Nearest,
    refined: bool,
    lattice: usize,
    /// Heights in mm by slot; blue runs fastest.
    heights: Vec<[f32; SLOTS]>,
}

impl Separation {
    /// The table of `film`'s palette, ground and light.
    ///
    /// # Errors
    /// [`SeparationError`] for an empty palette or settings out of range.
    pub fn new(film: PaintFilm, settings: &SeparationSettings) -> Result<Self, SeparationError> {
        settings.check()?;
        if film.used().is_empty() {
            return Err(SeparationError::NoPigment);
        }
        let nearest = settings.nearest(film);
        let count = settings.lattice;
        let mixtures = Mixtures::of(&nearest);
        let mut films: Vec<Mixed> = (0..count.pow(3))
            .into_par_iter()
            .map(|index| {
                let wanted = nearest.wanted(color(&nearest, count, index));
                let found = mixtures
                    .nearest_to(&wanted, STARTS)
                    .iter()
                    .map(|start| nearest.descended(&wanted, start, None, STEPS))
                    .min_by(|a, b| a.0.total_cmp(&b.0));
                found.expect("a palette has a film").1
            })
            .collect();
        for _ in 0..SMOOTHINGS {
            films = (0..films.len())
                .into_par_iter()
                .map(|index| smoothed(&nearest, count, &films, index))
                .collect();
        }
        let heights: Vec<[f32; SLOTS]> =
            films.iter().map(|mixed| mixed.heights_mm().map(|height| height as f32)).collect();
        Ok(Self { nearest, refined: settings.refined, lattice: count, heights })
    }

    /// The films that the table was made for.
    #[must_use]
    pub fn film(&self) -> &PaintFilm {
        &self.nearest.film
    }

    /// Heights in mm by slot for a linear sRGB colour, by the table; values
    /// outside 0..1 count as the nearest inside.
    #[must_use]
    pub fn heights_mm(&self, rgb: [f32; 3]) -> [f32; SLOTS] {
        let corners = self.corners(inside(rgb));
        let mut sum = [0.0; SLOTS];
        for (index, weight) in corners {
            for (sum, height) in sum.iter_mut().zip(&self.heights[index]) {
                *sum += weight * height;
            }
        }
        sum
    }

    /// The same, then brought nearer by least squares from there.
    #[must_use]
    pub fn refined_heights_mm(&self, rgb: [f32; 3]) -> [f32; SLOTS] {
        let nearest = &self.nearest;
        let rgb = inside(rgb);
        let table = self.heights_mm(rgb).map(f64::from);
        let start = Mixed::of(table, nearest.film.used()[0]);
        let anchor = Anchor { mixed: start, strength: FROM_TABLE };
        let wanted = nearest.wanted(nearest.film.lab_from_rgb(rgb));
        let (_, found) = nearest.descended(&wanted, &start, Some(&anchor), REFINEMENTS);
        found.heights_mm().map(|height| height as f32)
    }

    /// Whether the nearest colour that the palette reproduces is farther than
    /// [`OUT_OF_GAMUT`].
    #[must_use]
    pub fn is_out_of_gamut(&self, rgb: [f32; 3]) -> bool {
        let film = &self.nearest.film;
        let found = film.lab(&self.refined_heights_mm(rgb).map(f64::from));
        delta_e_ciede2000(film.lab_from_rgb(rgb), found) > OUT_OF_GAMUT
    }

    /// Heights in mm by slot for every pixel.
    #[must_use]
    pub fn separate(&self, picture: &Picture) -> Field<[f32; SLOTS]> {
        let colors = picture.values().par_iter().with_min_len(1024);
        let heights = if self.refined {
            colors.map(|&rgb| self.refined_heights_mm(rgb)).collect()
        } else {
            colors.map(|&rgb| self.heights_mm(rgb)).collect()
        };
        Field::from_values(picture.width(), picture.height(), heights)
    }

    /// The luminance, 0..1, of the darkest grey that the palette reproduces.
    #[must_use]
    pub fn black(&self) -> f32 {
        let rgb = self.film().rgb(&self.refined_heights_mm([0.0; 3]));
        let luminance = RgbSpace::Srgb.xyz_from_linear().apply(rgb.map(f64::from))[1];
        (luminance / 100.0).clamp(0.0, 1.0) as f32
    }

    /// The corners of the tetrahedron that holds a colour, with their weights:
    /// from the lowest corner of its cube to the highest, along the channel
    /// with the largest rest first.
    fn corners(&self, rgb: [f32; 3]) -> [(usize, f32); 4] {
        let last = self.lattice - 1;
        let mut base = 0;
        let strides = [self.lattice * self.lattice, self.lattice, 1];
        let mut rests = [0.0; 3];
        for channel in 0..3 {
            let place = rgb[channel].sqrt() * last as f32;
            let cell = (place as usize).min(last - 1);
            rests[channel] = place - cell as f32;
            base += cell * strides[channel];
        }
        let [r, g, b] = rests;
        let order = match (r >= g, g >= b, r >= b) {
            (true, true, _) => [0, 1, 2],
            (true, false, true) => [0, 2, 1],
            (true, false, false) => [2, 0, 1],
            (false, _, true) => [1, 0, 2],
            (false, true, false) => [1, 2, 0],
            (false, false, false) => [2, 1, 0],
        };
        let rest = order.map(|channel| rests[channel]);
        let first = base + strides[order[0]];
        let second = first + strides[order[1]];
        [
            (base, 1.0 - rest[0]),
            (first, rest[0] - rest[1]),
            (second, rest[1] - rest[2]),
            (second + strides[order[2]], rest[2]),
        ]
    }
}

/// The nearest colour inside the sRGB cube; what is no number counts as 0.
fn inside(rgb: [f32; 3]) -> [f32; 3] {
    rgb.map(|value| if value.is_nan() { 0.0 } else { value.clamp(0.0, 1.0) })
}

/// The colour of a point of the table.
fn color(nearest: &Nearest, count: usize, index: usize) -> Lab {
    let place = [index / (count * count), index / count % count, index % count];
    let rgb = place.map(|at| (at as f32 / (count - 1) as f32).powi(2));
    nearest.film.lab_from_rgb(rgb)
}

/// The film of a point after hearing its six neighbours: from its own film and
/// from their mean, whichever ends better.
fn smoothed(nearest: &Nearest, count: usize, films: &[Mixed], index: usize) -> Mixed {
    let place = [index / (count * count), index / count % count, index % count];
    let strides = [count * count, count, 1];
    let mut sum = [0.0; SLOTS];
    let mut neighbours = 0.0;
    for (at, stride) in place.into_iter().zip(strides) {
        // In pairs, so that an even change along the axis is no roughness.
        if at > 0 && at < count - 1 {
            for other in [index - stride, index + stride] {
                let heights = films[other].heights_mm();
                sum.iter_mut().zip(heights).for_each(|(sum, height)| *sum += height);
                neighbours += 1.0;
            }
        }
    }
    if neighbours == 0.0 {
        return films[index];
    }
    let mean = Mixed::of(sum.map(|height| height / neighbours), nearest.film.used()[0]);
    let wanted = nearest.wanted(color(nearest, count, index));
    let anchor = Anchor { mixed: mean, strength: NEIGHBOURS };
    let found = [films[index], mean]
        .iter()
        .map(|start| nearest.descended(&wanted, start, Some(&anchor), STEPS))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    found.expect("two starts").1
}

impl SeparationSettings {
    pub(super) fn nearest(&self, film: PaintFilm) -> Nearest {
        let hiding = if self.hides { HIDING } else { 0.0 };
        Nearest::new(film, self.least_mm, self.most_mm, hiding)
    }

    pub(super) fn check(&self) -> Result<(), SeparationError> {
        if !(5..=65).contains(&self.lattice) {
            return Err(SeparationError::Lattice { lattice: self.lattice });
        }
        let range = self.least_mm > 0.0 && self.least_mm <= self.most_mm && self.most_mm <= 100.0;
        if !range {
            let (least_mm, most_mm) = (self.least_mm, self.most_mm);
            return Err(SeparationError::Heights { least_mm, most_mm });
        }
        Ok(())
    }
}

/// A separation that cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SeparationError {
    /// A palette without pigments.
    #[error("a palette has at least one pigment, found `0`")]
    NoPigment,
    /// A table too coarse or too large.
    #[error("a table has 5 to 65 points along each side, found `{lattice}`")]
    Lattice {
        /// What was asked for.
        lattice: usize,
    },
    /// No range of heights.
    #[error("heights run from above 0 to 100 mm, rising, found `{least_mm}:{most_mm}`")]
    Heights {
        /// The least.
        least_mm: f64,
        /// The greatest.
        most_mm: f64,
    },
}

impl SeparationError {
    /// What to try.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::NoPigment => "name pigments of the library, or none, to have them chosen",
            Self::Lattice { .. } => "25 points are usual",
            Self::Heights { .. } => "0.03:0.3 is usual; the same number twice for an even film",
        }
    }
}
