//! Tables over the sRGB cube from colours to pigment heights.
//!
//! The lattice is even in the square roots of linear red, green and blue, which are perceptually
//! nearly even. Each point holds the film nearest to its colour (see `film_search`). Between
//! points, we interpolate heights within tetrahedra, as usual for colour tables.
//!
//! Where the relief demands the height of a film, you can only choose its mixture: over a light
//! ground, thin paint needs a stronger colour than thick paint. We keep a table for each of a few
//! heights. Recipes change little from height to height, so we interpolate them between the tables,
//! evenly in the logarithm of the height.

use documents::hint::Explain;
use graphics::field::Field;
use graphics::picture::Picture;
use rayon::prelude::*;
use spectra::color::{Lab, RgbSpace, delta_e_ciede2000};

use super::film::PaintFilm;
use super::film_search::{Anchor, FilmMix, FilmSearch, SampledFilms};
use crate::layer::SLOTS;

/// Settings of a separation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeparationSettings {
    /// Lattice points along each side of the table, 5 to 65. 25 by default. Time grows with
    /// the cube.
    pub lattice: usize,
    /// Least height of a film in mm, above 0. 0.03 by default.
    pub least_mm: f64,
    /// Greatest height of a film in mm, from `least_mm` to 100. 0.3 by default.
    pub most_mm: f64,
    /// Whether you want films to hide the ground as well as the heights allow. True by default. If
    /// you pass false, the ground may show through. Over white you then reach lighter and more
    /// saturated colours.
    pub hides: bool,
    /// Whether [`Separation::separate`] refines the table's film for every pixel. This takes some
    /// microseconds each. True by default.
    pub refined: bool,
}

impl Default for SeparationSettings {
    fn default() -> Self {
        Self { lattice: 25, least_mm: 0.03, most_mm: 0.3, hides: true, refined: true }
    }
}

/// Weight of the difference between a film over black and over the ground, relative to the
/// difference from the target colour. It applies if films should hide (chosen by eye).
const HIDING: f64 = 0.07;

/// Sets of pigments tried at each lattice point.
const STARTS: usize = 3;
/// Iterations of each search.
const STEPS: usize = 20;
/// Passes that smooth the table.
const SMOOTHINGS: usize = 2;
/// Weight that keeps a lattice point near the mean of its neighbours (chosen by eye).
const NEIGHBOURS: f64 = 0.3;
/// Weight that keeps a pixel near the table's film (chosen by eye). [`REFINEMENTS`] is the number
/// of iterations that start from this film.
const FROM_TABLE: f64 = 1.0;
const REFINEMENTS: usize = 8;

/// If the nearest reproducible colour differs by more than this, in CIEDE2000, a colour is out of
/// gamut.
pub const OUT_OF_GAMUT: f64 = 1.0;

/// Table from linear sRGB to the heights of a palette's pigments.
#[derive(Debug, Clone, PartialEq)]
pub struct Separation {
    search: FilmSearch,
    refined: bool,
    lattice: usize,
    /// Heights in mm by slot. Blue varies fastest.
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

    /// A table of films of the given height. Each is as near to the recipe of this table's film as
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

    /// The films for which you computed the table.
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

    /// Returns whether the nearest colour that you reach with the palette differs by more than
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

/// The nearest colour inside the sRGB cube. NaN counts as 0.
fn clamped(rgb: [f32; 3]) -> [f32; 3] {
    rgb.map(|value| if value.is_nan() { 0.0 } else { value.clamp(0.0, 1.0) })
}

/// CIELAB of the colour of a lattice point.
fn color(search: &FilmSearch, count: usize, index: usize) -> Lab {
    let place = [index / (count * count), index / count % count, index % count];
    let rgb = place.map(|at| (at as f32 / (count - 1) as f32).powi(2));
    search.film.lab_from_rgb(rgb)
}

/// Film of a lattice point after smoothing with its neighbours. We start from its own film and from
/// their mean, and keep the better result.
fn smoothed(search: &FilmSearch, count: usize, films: &[FilmMix], index: usize) -> FilmMix {
    let place = [index / (count * count), index / count % count, index % count];
    let strides = [count * count, count, 1];
    let mut sum = [0.0; SLOTS];
    let mut neighbours = 0.0;
    for (at, stride) in place.into_iter().zip(strides) {
        // We count neighbours in opposite pairs only, so that heights linear along an axis stay as
        // they are.
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
            return Err(SeparationError::Lattice(self.lattice));
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
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum SeparationError {
    /// The palette has no pigment.
    #[error("a palette has at least one pigment, found `0`")]
    #[hint("name pigments of the library, or none, to have them chosen")]
    NoPigment,
    /// The lattice is too coarse or too large.
    #[error("a table has 5 to 65 points along each side, found `{0}`")]
    #[hint("25 points are usual")]
    Lattice(usize),
    /// The heights are not a valid range.
    #[error(
        "heights are two numbers above 0 and at most 100 mm, the smaller first, found `{least_mm}:{most_mm}`"
    )]
    #[hint("0.03:0.3 is usual; the same number twice for an even film")]
    Heights {
        /// Least height in mm.
        least_mm: f64,
        /// Greatest height in mm.
        most_mm: f64,
    },
}

/// Ratio of the heights of neighbouring tables, at most.
const RATIO: f64 = 2.0;

/// Tables from colours to mixtures of a palette's pigments, by the height of the film.
#[derive(Debug, Clone, PartialEq)]
pub struct SeparationByHeight {
    /// From the thinnest film to the highest.
    tables: Vec<Separation>,
    /// Height of the films of each table in mm.
    heights_mm: Vec<f64>,
}

impl SeparationByHeight {
    /// Computes tables for films from `settings.least_mm` to `settings.most_mm`, at least one for
    /// each doubling of the height. This takes seconds.
    ///
    /// # Errors
    /// [`SeparationError`] for an empty palette or settings out of range.
    pub fn new(film: PaintFilm, settings: &SeparationSettings) -> Result<Self, SeparationError> {
        settings.check()?;
        let SeparationSettings { least_mm, most_mm, .. } = *settings;
        let steps = (most_mm / least_mm).ln() / RATIO.ln();
        let steps = (steps - 1e-9).ceil().max(0.0) as usize;
        let heights_mm: Vec<f64> = (0..=steps)
            .map(|step: usize| {
                let share = if steps == 0 { 0.0 } else { step as f64 / steps as f64 };
                least_mm * (most_mm / least_mm).powf(share)
            })
            .collect();
        // Recipes spread from the middle, where a film hides and is not yet a masstone.
        let middle = steps / 2;
        let least_mm = heights_mm[middle];
        let most_mm = heights_mm[middle];
        let first = Separation::new(film, &SeparationSettings { least_mm, most_mm, ..*settings })?;
        let mut tables = vec![first.clone()];
        for &height_mm in &heights_mm[middle + 1..] {
            let next = tables.last().unwrap_or(&first).at_height(height_mm);
            tables.push(next);
        }
        for &height_mm in heights_mm[..middle].iter().rev() {
            let next = tables.first().unwrap_or(&first).at_height(height_mm);
            tables.insert(0, next);
        }
        Ok(Self { tables, heights_mm })
    }

    /// The films for which you computed the tables.
    #[must_use]
    pub fn film(&self) -> &PaintFilm {
        self.tables[0].film()
    }

    /// Heights in mm by slot of the film of a linear sRGB colour that is `height_mm` high: they sum
    /// to this height. Beyond the tables you get the recipe of the nearest.
    #[must_use]
    pub fn heights_mm(&self, rgb: [f32; 3], height_mm: f32) -> [f32; SLOTS] {
        let last = self.tables.len() - 1;
        let above = self.heights_mm.partition_point(|mm| *mm < f64::from(height_mm));
        let lower = above.saturating_sub(1).min(last);
        let upper = above.min(last);
        let thin = self.tables[lower].heights_mm(rgb);
        let thin_mm = self.heights_mm[lower];
        let own = f64::from(height_mm);
        if lower == upper {
            return thin.map(|mm| (f64::from(mm) * own / thin_mm) as f32);
        }
        let thick = self.tables[upper].heights_mm(rgb);
        let thick_mm = self.heights_mm[upper];
        let share = (own / thin_mm).ln() / (thick_mm / thin_mm).ln();
        let [thin_share, thick_share] = [(1.0 - share) / thin_mm, share / thick_mm];
        std::array::from_fn(|slot| {
            let [thin, thick] = [thin[slot], thick[slot]].map(f64::from);
            (own * (thin * thin_share + thick * thick_share)) as f32
        })
    }

    /// Luminance, 0..1, down to which films of every height reproduce grey.
    #[must_use]
    pub fn black(&self) -> f32 {
        self.tables.iter().map(Separation::black).fold(0.0, f32::max)
    }

    /// Returns whether the nearest colour that you reach with films of the nearest table's height
    /// differs by more than [`OUT_OF_GAMUT`](super::OUT_OF_GAMUT).
    #[must_use]
    pub fn is_out_of_gamut(&self, rgb: [f32; 3], height_mm: f32) -> bool {
        let off = self.heights_mm.iter().map(|mm| (mm / f64::from(height_mm)).ln().abs());
        let nearest = off.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        self.tables[nearest.map_or(0, |(at, _)| at)].is_out_of_gamut(rgb)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Lighting, Medium, palette_slots};
    use crate::ground::GroundKind;
    use crate::light::Light;
    use crate::separation::FilmMaterials;
    use pigment::PigmentLibrary;
    use spectra::color::delta_e_ciede2000;

    const SETTINGS: SeparationSettings = SeparationSettings {
        lattice: 13,
        least_mm: 0.03,
        most_mm: 0.48,
        hides: true,
        refined: false,
    };

    /// Films of oil thinned until a film of 0.03 mm hides nothing and one of 0.5 mm does.
    fn film() -> PaintFilm {
        let library = PigmentLibrary::van_gogh_oils();
        let names = ["Lead White", "Vermilion", "Chrome Yellow", "Ultramarine", "Bone Black"];
        let slots = palette_slots(&names.map(str::to_owned), &library).unwrap();
        let Lighting { illuminant, observer, .. } = Lighting::default();
        let light = Light::named(&library, &illuminant, &observer).unwrap();
        let ground = GroundKind::Panel.spec(1).reflectance(&library).unwrap();
        let scattering_per_mm = Medium::of(&library).scattering_per_mm / 30.0;
        let library = &library;
        let slots = &slots;
        let ground = &ground[..];
        let materials = FilmMaterials { library, slots, ground, scattering_per_mm };
        PaintFilm::at_nodes(materials, &light.quadrature)
    }

    /// Mean difference between colours that the palette mixes at a height, and films of this height
    /// with the recipes for films `recipe_mm` high.
    fn difference(films: &SeparationByHeight, height_mm: f32, recipe_mm: f32) -> f64 {
        let film = films.film();
        (0..100)
            .map(|at: usize| {
                let parts = [7, 5, 3, 2, 1].map(|step| 0.02 + ((at * step) % 11) as f32);
                let total: f32 = parts.iter().sum();
                let rgb = film.rgb(&std::array::from_fn(|slot| {
                    parts.get(slot).map_or(0.0, |part| part / total * height_mm)
                }));
                let scale = f64::from(height_mm / recipe_mm);
                let found = films.heights_mm(rgb, recipe_mm).map(|mm| scale * f64::from(mm));
                delta_e_ciede2000(film.lab_from_rgb(rgb), film.lab(&found))
            })
            .sum::<f64>()
            / 100.0
    }

    #[test]
    fn films_have_the_height_asked_for_and_the_colour_at_every_height() {
        let films = SeparationByHeight::new(film(), &SETTINGS).unwrap();
        assert_eq!(films.heights_mm.len(), 5, "{:?}", films.heights_mm);
        for height_mm in [0.03_f32, 0.043, 0.1, 0.3, 0.48, 1.7] {
            let heights = films.heights_mm([0.3, 0.25, 0.1], height_mm);
            let sum: f32 = heights.iter().sum();
            assert!((sum / height_mm - 1.0).abs() < 1e-5, "{sum} for {height_mm}");
            assert!(heights.iter().all(|mm| *mm >= 0.0), "{heights:?}");
            let mean = difference(&films, height_mm, height_mm);
            assert!(mean < 2.5, "{height_mm} mm: {mean}");
        }
        let [own, other] = [0.03, 0.48].map(|recipe_mm| difference(&films, 0.03, recipe_mm));
        assert!(other > 3.0 * own, "recipes of thick films suit thin ones: {own} {other}");
    }

    #[test]
    fn one_height_makes_one_table() {
        let settings = SeparationSettings { most_mm: 0.03, ..SETTINGS };
        let films = SeparationByHeight::new(film(), &settings).unwrap();
        let table = Separation::new(film(), &settings).unwrap();
        let rgb = [0.2, 0.4, 0.3];
        let doubled = table.heights_mm(rgb).map(|mm| 2.0 * mm);
        let found = films.heights_mm(rgb, 0.06);
        for (found, wanted) in found.iter().zip(doubled) {
            assert!((found - wanted).abs() < 1e-7, "{found} {wanted}");
        }
        let wrong = SeparationSettings { least_mm: 0.0, ..SETTINGS };
        assert!(SeparationByHeight::new(film(), &wrong).is_err());
    }
}
