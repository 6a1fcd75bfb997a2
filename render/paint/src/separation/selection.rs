//! Choice of the pigments that paint a photograph best, and the colour error of a separation.

use std::collections::BTreeMap;

use graphics::field::Field;
use graphics::picture::Picture;
use pigment::PigmentId;
use pigment::evaluate::percentile;
use rayon::prelude::*;
use spectra::color::delta_e_ciede2000;

use super::film::{FilmMaterials, PaintFilm};
use super::film_search::SampledFilms;
use super::table::{OUT_OF_GAMUT, Separation, SeparationError, SeparationSettings};
use crate::document::Slots;
use crate::layer::SLOTS;

/// Most frequent colours of the photograph that are matched.
const COLORS: usize = 96;
/// Bins per channel in which pixels are counted.
const BINS: f32 = 12.0;
/// Least gain in mean CIEDE2000 for which a pigment is added or exchanged.
const WORTHWHILE: f64 = 0.03;
/// Sets of pigments tried for each colour. [`STEPS`] is the number of iterations for each set.
const STARTS: usize = 2;
const STEPS: usize = 10;

/// A palette chosen for a photograph.
#[derive(Debug, Clone, PartialEq)]
pub struct ChosenPalette {
    /// The pigments in the order of choice: first the pigment with the least error alone, then each
    /// pigment that reduced the error most together with those before it. If we exchanged a pigment
    /// later, its replacement is in its slot.
    pub slots: Slots,
    /// Mean CIEDE2000 over the photograph's colours. We weight it by the square root of their area
    /// so that small coloured things count. If you want paint to hide, each error includes the
    /// ground showing through.
    pub mean: f64,
}

/// Chooses up to eight pigments that come nearest to a photograph's colours. We add pigments
/// greedily one at a time, and then exchange each once if another is better. We leave out pigments
/// with unknown S.
///
/// Raise the picture's black to a tone that paint reaches first, else you spend pigments on tones
/// that none reaches. `film` makes the films of a palette, for example by [`PaintFilm::at_nodes`]
/// under the light of the painting.
///
/// # Errors
/// [`SeparationError`] if no pigment is usable, or for settings out of range.
pub fn choose_palette(
    picture: &Picture,
    materials: FilmMaterials<'_>,
    film: impl Fn(FilmMaterials<'_>) -> PaintFilm + Sync,
    settings: &SeparationSettings,
) -> Result<ChosenPalette, SeparationError> {
    settings.check()?;
    let colors = frequent_colors(picture);
    let library = materials.library;
    let mut open: Vec<PigmentId> =
        library.ids().filter(|&pigment| library[pigment].identified).collect();
    if open.is_empty() {
        return Err(SeparationError::NoPigment);
    }
    // Pigment of `open` with the least error at index `place` of the palette.
    let best = |chosen: &[PigmentId], place: usize, open: &[PigmentId]| {
        let tried: Vec<(f64, PigmentId)> = open
            .par_iter()
            .map(|&pigment| {
                let mut with = chosen.to_vec();
                if place < with.len() {
                    with[place] = pigment;
                } else {
                    with.push(pigment);
                }
                let film = film(FilmMaterials { slots: &slots_of(&with), ..materials });
                (mean_error(&film, settings, &colors), pigment)
            })
            .collect();
        tried.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let mut chosen: Vec<PigmentId> = Vec::new();
    let mut least = f64::INFINITY;
    while chosen.len() < SLOTS {
        let Some((found, pigment)) = best(&chosen, chosen.len(), &open) else { break };
        if least - found < WORTHWHILE {
            break;
        }
        least = found;
        chosen.push(pigment);
        open.retain(|&other| other != pigment);
    }
    for place in 0..chosen.len() {
        let Some((found, pigment)) = best(&chosen, place, &open) else { break };
        if least - found >= WORTHWHILE {
            least = found;
            open.retain(|&other| other != pigment);
            open.push(chosen[place]);
            chosen[place] = pigment;
        }
    }
    Ok(ChosenPalette { slots: slots_of(&chosen), mean: least })
}

fn slots_of(chosen: &[PigmentId]) -> Slots {
    std::array::from_fn(|slot| chosen.get(slot).copied())
}

/// Weighted mean CIEDE2000 of the colours painted with a palette.
fn mean_error(film: &PaintFilm, settings: &SeparationSettings, colors: &[(f64, [f32; 3])]) -> f64 {
    let search = settings.film_search(film.clone());
    let mixtures = SampledFilms::new(&search);
    let errors: Vec<f64> = colors
        .par_iter()
        .map(|&(weight, rgb)| {
            let lab = film.lab_from_rgb(rgb);
            let target = search.target(lab);
            let found = mixtures
                .nearest_to(&target, STARTS)
                .iter()
                .map(|start| search.minimize(&target, start, None, STEPS))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let (_, mixed) = found.expect("a palette has at least one sampled film");
            let difference = delta_e_ciede2000(lab, film.lab(&mixed.heights_mm()));
            weight * difference.hypot(search.ground_residual(&mixed))
        })
        .collect();
    errors.iter().sum::<f64>() / colors.iter().map(|(weight, _)| weight).sum::<f64>()
}

/// Most frequent colours of a picture with their weights.
fn frequent_colors(picture: &Picture) -> Vec<(f64, [f32; 3])> {
    let mut bins: BTreeMap<[u8; 3], (f64, [f64; 3])> = BTreeMap::new();
    for rgb in picture.values() {
        let bin = rgb.map(|value| (value.clamp(0.0, 1.0).sqrt() * BINS) as u8);
        let (count, sum) = bins.entry(bin).or_default();
        *count += 1.0;
        sum.iter_mut().zip(rgb).for_each(|(sum, value)| *sum += f64::from(*value));
    }
    let mut colors: Vec<(f64, [f32; 3])> = bins
        .into_values()
        .map(|(count, sum)| (count.sqrt(), sum.map(|value| (value / count) as f32)))
        .collect();
    // The sort is stable: bins of equal size stay ordered by colour.
    colors.sort_by(|a, b| b.0.total_cmp(&a.0));
    colors.truncate(COLORS);
    colors
}

/// Picture that you get from films of the given heights (in mm, by slot) over the ground, in linear
/// sRGB. We compute Kubelka-Munk for every pixel, so this does not depend on the separation's
/// table.
#[must_use]
pub fn rebuild_picture(film: &PaintFilm, heights_mm: &Field<[f32; SLOTS]>) -> Picture {
    let colors = heights_mm.values().par_iter().with_min_len(256).map(|at| film.rgb(at));
    Field::from_values(heights_mm.width(), heights_mm.height(), colors.collect())
}

/// Statistics of CIEDE2000 over the pixels of a picture.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct ColorErrors {
    /// Arithmetic mean of CIEDE2000.
    pub mean: f64,
    /// Median of CIEDE2000.
    pub median: f64,
    /// 95th percentile of CIEDE2000.
    pub p95: f64,
    /// Largest CIEDE2000 of all pixels.
    pub max: f64,
    /// Mean CIEDE2000 over the pixels within the palette's gamut. 0 if there are none.
    pub mean_in_gamut: f64,
    /// Share of pixels outside the palette's gamut, 0..1.
    pub out_of_gamut: f64,
}

impl ColorErrors {
    /// Errors of `painted` against `target` under the light of `separation`, which also
    /// decides which colours are out of gamut.
    ///
    /// # Panics
    /// If the pictures differ in size, or are empty.
    #[must_use]
    pub fn between(separation: &Separation, target: &Picture, painted: &Picture) -> Self {
        assert_eq!(target.bounds(), painted.bounds(), "pictures differ in size");
        let film = separation.film();
        let pairs = target.values().par_iter().zip(painted.values()).with_min_len(256);
        let all: Vec<f64> = pairs
            .map(|(&target, &painted)| {
                delta_e_ciede2000(film.lab_from_rgb(target), film.lab_from_rgb(painted))
            })
            .collect();
        // A colour that we painted within `OUT_OF_GAMUT` is in gamut, so we skip the slower check.
        let doubtful = all.iter().zip(target.values()).filter(|(error, _)| **error > OUT_OF_GAMUT);
        let outside = Outside::of(separation, doubtful.map(|(_, &target)| target));
        let pixels = all.iter().zip(target.values());
        let within =
            pixels.filter(|(error, target)| **error <= OUT_OF_GAMUT || !outside.holds(**target));
        let within: Vec<f64> = within.map(|(error, _)| *error).collect();
        Self {
            mean: mean_of(&all),
            median: percentile(&all, 50.0),
            p95: percentile(&all, 95.0),
            max: percentile(&all, 100.0),
            mean_in_gamut: mean_of(&within),
            out_of_gamut: 1.0 - within.len() as f64 / all.len() as f64,
        }
    }
}

fn mean_of(errors: &[f64]) -> f64 {
    errors.iter().sum::<f64>() / errors.len().max(1) as f64
}

/// Colours out of gamut. It takes long to find one film. So we judge all colours that agree in the
/// first 7 bits of the fractions of their linear channels by the one in their middle. This is about
/// a step of 8-bit sRGB.
struct Outside {
    colors: Vec<[u16; 3]>,
}

impl Outside {
    /// The `colors` that are out of gamut.
    fn of(separation: &Separation, colors: impl Iterator<Item = [f32; 3]>) -> Self {
        let mut colors: Vec<_> = colors.map(leading_bits).collect();
        colors.par_sort_unstable();
        colors.dedup();
        Self {
            colors: colors
                .into_par_iter()
                .filter(|color: &[u16; 3]| {
                    separation.is_out_of_gamut(
                        color.map(|bits: u16| f32::from_bits(u32::from(bits) << 16 | 0x8000)),
                    )
                })
                .collect(),
        }
    }

    fn holds(&self, color: [f32; 3]) -> bool {
        self.colors.binary_search(&leading_bits(color)).is_ok()
    }
}

/// Sign, exponent and the first 7 bits of the fraction of each channel.
fn leading_bits(color: [f32; 3]) -> [u16; 3] {
    color.map(|channel| (channel.to_bits() >> 16) as u16)
}
