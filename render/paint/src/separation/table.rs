//! Table over the sRGB cube from colours to pigment heights.
//!
//! The lattice is even in the square roots of linear red, green and blue, which are
//! perceptually nearly even. Each point holds the film nearest to its colour (see
//! `film_search`); between points, heights are interpolated within tetrahedra, as usual for
//! colour tables.

use documents::hint::{Explain, Hint};
use rayon::prelude::*;
use spectra::color::{Lab, RgbSpace, delta_e_ciede2000};

use super::film::PaintFilm;
use super::film_search::{Anchor, FilmMix, FilmSearch};
use super::sampled_films::SampledFilms;
use crate::layer::SLOTS;
use graphics::field::Field;
use graphics::picture::Picture;

/// Settings of a separation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeparationSettings {
    /// Lattice points along each side of the table, 5 to 65; 25 by default. Time grows with
    /// the cube.
    pub lattice: usize,
    /// Least height of a film in mm, above 0; 0.03 by default.
    pub least_mm: f64,
    /// Greatest height of a film in mm, from `least_mm` to 100; 0.3 by default.
    pub most_mm: f64,
    /// Whether films should hide the ground as well as the heights allow; true by default. If
    /// false, the ground may show through, which over white reaches lighter and more
    /// saturated colours.
    pub hides: bool,
    /// Whether [`Separation::separate`] refines the table's film for every pixel, at some
    /// microseconds each; true by default.
    pub refined: bool,
}

impl Default for SeparationSettings {
    fn default() -> Self {
        Self { lattice: 25, least_mm: 0.03, most_mm: 0.3, hides: true, refined: true }
    }
}

/// Weight of the difference between a film over black and over the ground, relative to
/// that from the target colour, if films should hide (chosen by eye).
const HIDING: f64 = 0.07;

/// Sets of pigments tried at each lattice point.
const STARTS: usize = 3;
/// Iterations of each search.
const STEPS: usize = 20;
/// Passes that smooth the table.
const SMOOTHINGS: usize = 2;
/// Weight that keeps a lattice point near the mean of its neighbours (chosen by eye).
const NEIGHBOURS: f64 = 0.3;
/// Weight that keeps a pixel near the table's film (chosen by eye), and iterations from
/// there.
const FROM_TABLE: f64 = 1.0;
const REFINEMENTS: usize = 8;

/// A colour is out of gamut if the nearest reproducible colour differs by more than this,
/// in CIEDE2000.
pub const OUT_OF_GAMUT: f64 = 1.0;

/// Table from linear sRGB to the heights of a palette's pigments.
#[derive(Debug, Clone, PartialEq)]
pub struct Separation {
    search: FilmSearch,
    refined: bool,
    lattice: usize,
    /// Heights in mm by slot; blue varies fastest.
    heights: Vec<[f32; SLOTS]>,
}

impl Separation {
    /// Computes the table for the palette, ground and light of `film`.
    ///
    /// # Errors
    /// [`SeparationError`] for an empty palette or settings out of range.
    pub fn new(film: PaintFilm, settings: &SeparationSettings) -> Result<Self, SeparationError> {
        settings.check()?;
        if film.used().is_empty() {
            return Err(SeparationError::NoPigment);
        }
        let search = settings.film_search(film);
        let count = settings.lattice;
        let mixtures = SampledFilms::new(&search);
        let mut films: Vec<FilmMix> = (0..count.pow(3))
            .into_par_iter()
            .map(|index| {
                let target = search.target(color(&search, count, index));
                let found = mixtures
                    .nearest_to(&target, STARTS)
                    .iter()
                    .map(|start| search.minimize(&target, start, None, STEPS))
                    .min_by(|a, b| a.0.total_cmp(&b.0));
                found.expect("a palette has at least one sampled film").1
            })
            .collect();
        for _ in 0..SMOOTHINGS {
            films = (0..films.len())
                .into_par_iter()
                .map(|index| smoothed(&search, count, &films, index))
                .collect();
        }
        let heights: Vec<[f32; SLOTS]> =
            films.iter().map(|mixed| mixed.heights_mm().map(|height| height as f32)).collect();
        Ok(Self { search, refined: settings.refined, lattice: count, heights })
    }

    /// The table of films of the given height, each as near to the recipe of this table's film as
    /// its colour allows.
    pub(super) fn at_height(&self, height_mm: f64) -> Self {
        let search = self.search.at_height(height_mm);
        let films =
            self.heights.par_iter().enumerate().map(|(index, heights): (usize, &[f32; SLOTS])| {
                let own = FilmMix::of(heights.map(f64::from), search.film.used()[0]);
                let start = FilmMix { height_mm, ..own };
                let anchor = Anchor { mixed: start, strength: NEIGHBOURS };
                let target = search.target(color(&search, self.lattice, index));
                search.minimize(&target, &start, Some(&anchor), STEPS).1
            });
        let heights = films.map(|mixed| mixed.heights_mm().map(|height| height as f32)).collect();
        Self { search, heights, ..*self }
    }

    /// The films that the table was computed for.
    #[must_use]
    pub fn film(&self) -> &PaintFilm {
        &self.search.film
    }

    /// Heights in mm by slot for a linear sRGB colour, interpolated in the table. Values
    /// outside 0..1 are clamped.
    #[must_use]
    pub fn heights_mm(&self, rgb: [f32; 3]) -> [f32; SLOTS] {
        let corners = self.corners(clamped(rgb));
        let mut sum = [0.0; SLOTS];
        for (index, weight) in corners {
            for (sum, height) in sum.iter_mut().zip(&self.heights[index]) {
                *sum += weight * height;
            }
        }
        sum
    }

    /// Heights in mm by slot for a linear sRGB colour, refined by least squares from the
    /// table's film.
    #[must_use]
    pub fn refined_heights_mm(&self, rgb: [f32; 3]) -> [f32; SLOTS] {
        let search = &self.search;
        let rgb = clamped(rgb);
        let table = self.heights_mm(rgb).map(f64::from);
        let start = FilmMix::of(table, search.film.used()[0]);
        let anchor = Anchor { mixed: start, strength: FROM_TABLE };
        let target = search.target(search.film.lab_from_rgb(rgb));
        let (_, found) = search.minimize(&target, &start, Some(&anchor), REFINEMENTS);
        found.heights_mm().map(|height| height as f32)
    }

    /// Whether the nearest colour that the palette reproduces differs by more than
    /// [`OUT_OF_GAMUT`].
    #[must_use]
    pub fn is_out_of_gamut(&self, rgb: [f32; 3]) -> bool {
        let film = &self.search.film;
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

    /// Luminance, 0..1, of the darkest grey that the palette reproduces.
    #[must_use]
    pub fn black(&self) -> f32 {
        let rgb = self.film().rgb(&self.refined_heights_mm([0.0; 3]));
        let luminance = RgbSpace::Srgb.xyz_from_linear().apply(rgb.map(f64::from))[1];
        (luminance / 100.0).clamp(0.0, 1.0) as f32
    }

    /// Corners of the tetrahedron that contains a colour, with their weights: from the lowest
    /// corner of its cell to the highest, along the channel with the largest fraction first.
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

/// The nearest colour inside the sRGB cube; NaN counts as 0.
fn clamped(rgb: [f32; 3]) -> [f32; 3] {
    rgb.map(|value| if value.is_nan() { 0.0 } else { value.clamp(0.0, 1.0) })
}

/// CIELAB of the colour of a lattice point.
fn color(search: &FilmSearch, count: usize, index: usize) -> Lab {
    let place = [index / (count * count), index / count % count, index % count];
    let rgb = place.map(|at| (at as f32 / (count - 1) as f32).powi(2));
    search.film.lab_from_rgb(rgb)
}

/// Film of a lattice point after smoothing with its neighbours: starts from its own film
/// and from their mean, and keeps the better result.
fn smoothed(search: &FilmSearch, count: usize, films: &[FilmMix], index: usize) -> FilmMix {
    let place = [index / (count * count), index / count % count, index % count];
    let strides = [count * count, count, 1];
    let mut sum = [0.0; SLOTS];
    let mut neighbours = 0.0;
    for (at, stride) in place.into_iter().zip(strides) {
        // Neighbours count in opposite pairs only, so that heights linear along an axis
        // stay as they are.
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
    let mean = FilmMix::of(sum.map(|height| height / neighbours), search.film.used()[0]);
    let target = search.target(color(search, count, index));
    let anchor = Anchor { mixed: mean, strength: NEIGHBOURS };
    let found = [films[index], mean]
        .iter()
        .map(|start| search.minimize(&target, start, Some(&anchor), STEPS))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    found.expect("there are two starts").1
}

impl SeparationSettings {
    pub(super) fn film_search(&self, film: PaintFilm) -> FilmSearch {
        let hiding = if self.hides { HIDING } else { 0.0 };
        FilmSearch::new(film, self.least_mm, self.most_mm, hiding)
    }

    pub(super) fn check(&self) -> Result<(), SeparationError> {
        if !(5..=65).contains(&self.lattice) {
            return Err(SeparationError::Lattice { lattice: self.lattice });
        }
        let range = self.least_mm > 0.0 && self.least_mm <= self.most_mm && self.most_mm <= 100.0;
        if !range {
            let least_mm = self.least_mm;
            let most_mm = self.most_mm;
            return Err(SeparationError::Heights { least_mm, most_mm });
        }
        Ok(())
    }
}

/// A separation cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SeparationError {
    /// The palette has no pigment.
    #[error("a palette has at least one pigment, found `0`")]
    NoPigment,
    /// The lattice is too coarse or too large.
    #[error("a table has 5 to 65 points along each side, found `{lattice}`")]
    Lattice {
        /// Points along each side.
        lattice: usize,
    },
    /// The heights are not a valid range.
    #[error("heights run from above 0 to 100 mm, rising, found `{least_mm}:{most_mm}`")]
    Heights {
        /// Least height in mm.
        least_mm: f64,
        /// Greatest height in mm.
        most_mm: f64,
    },
}

impl Explain for SeparationError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::NoPigment => "name pigments of the library, or none, to have them chosen",
            Self::Lattice { .. } => "25 points are usual",
            Self::Heights { .. } => "0.03:0.3 is usual; the same number twice for an even film",
        }))
    }
}
