//! Which pigments of a library paint a photograph best.

use std::collections::BTreeMap;

use rayon::prelude::*;
use spectra::color::delta_e_ciede2000;

use super::film::{Materials, PaintFilm};
use super::mixtures::Mixtures;
use super::table::{SeparationError, SeparationSettings};
use crate::document::Slots;
use crate::layer::SLOTS;
use graphics::picture::Picture;

/// Colours of the photograph that are tried.
const COLORS: usize = 96;
/// Bins of each channel in which its pixels are gathered.
const BINS: f32 = 12.0;
/// A pigment that gains less than this, in mean CIEDE2000, is left out.
const WORTHWHILE: f64 = 0.03;
/// Sets of pigments tried for each colour, and the steps of each.
const STARTS: usize = 2;
const STEPS: usize = 10;

/// A palette chosen for a photograph.
#[derive(Debug, Clone, PartialEq)]
pub struct ChosenPalette {
    /// Indices into the library: the pigment that does most alone, then each
    /// that helped most beside those before it.
    pub slots: Slots,
    /// Mean CIEDE2000 over the photograph's colours, each by the square root of
    /// its area, so that small coloured things count; where paint is to hide,
    /// together with what the ground's showing through counts.
    pub mean: f64,
}

/// Chooses up to eight pigments of `library` that come nearest to a
/// photograph's colours: greedily, one at a time; then each is exchanged once for a
/// better one if there is any. Pigments whose S is not known take no part.
///
/// A photograph in its own blacks spends pigments on tones that no paint reaches: see
/// [`super::black_compensated`]. `film` makes the films of some slots, as [`PaintFilm::at_nodes`] with the
/// ground and the light of the painting.
///
/// # Errors
/// [`SeparationError`] if no pigment can be used, or for settings out of range.
pub fn choose_palette(
    picture: &Picture,
    materials: Materials<'_>,
    film: impl Fn(Materials<'_>) -> PaintFilm + Sync,
    settings: &SeparationSettings,
) -> Result<ChosenPalette, SeparationError> {
    settings.check()?;
    let colors = gathered(picture);
    let mut open: Vec<usize> = (0..materials.library.pigments.len())
        .filter(|&index| materials.library.pigments[index].identified)
        .collect();
    if open.is_empty() {
        return Err(SeparationError::NoPigment);
    }
    let mean = |chosen: &[usize]| {
        let slots = slots_of(chosen);
        error(&film(Materials { slots: &slots, ..materials }), settings, &colors)
    };
    // The pigment that does best at a place of the palette.
    let best = |chosen: &[usize], place: usize, open: &[usize]| {
        let tried: Vec<(f64, usize)> = open
            .par_iter()
            .map(|&index| {
                let mut with = chosen.to_vec();
                if place < with.len() {
                    with[place] = index;
                } else {
                    with.push(index);
                }
                (mean(&with), index)
            })
            .collect();
        tried.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let mut chosen: Vec<usize> = Vec::new();
    let mut least = f64::INFINITY;
    while chosen.len() < SLOTS {
        let Some((found, index)) = best(&chosen, chosen.len(), &open) else { break };
        if least - found < WORTHWHILE {
            break;
        }
        least = found;
        chosen.push(index);
        open.retain(|&other| other != index);
    }
    for place in 0..chosen.len() {
        let Some((found, index)) = best(&chosen, place, &open) else { break };
        if least - found >= WORTHWHILE {
            least = found;
            open.retain(|&other| other != index);
            open.push(chosen[place]);
            chosen[place] = index;
        }
    }
    Ok(ChosenPalette { slots: slots_of(&chosen), mean: least })
}

fn slots_of(chosen: &[usize]) -> Slots {
    std::array::from_fn(|slot| chosen.get(slot).copied())
}

/// Weighted mean CIEDE2000 of the colours by the films of a palette.
fn error(film: &PaintFilm, settings: &SeparationSettings, colors: &[(f64, [f32; 3])]) -> f64 {
    let nearest = settings.nearest(film.clone());
    let mixtures = Mixtures::of(&nearest);
    let errors: Vec<f64> = colors
        .par_iter()
        .map(|&(weight, rgb)| {
            let lab = film.lab_from_rgb(rgb);
            let wanted = nearest.wanted(lab);
            let found = mixtures
                .nearest_to(&wanted, STARTS)
                .iter()
                .map(|start| nearest.descended(&wanted, start, None, STEPS))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let (_, mixed) = found.expect("a palette has a film");
            let difference = delta_e_ciede2000(lab, film.lab(&mixed.heights_mm()));
            weight * difference.hypot(nearest.showing(&mixed))
        })
        .collect();
    errors.iter().sum::<f64>() / colors.iter().map(|(weight, _)| weight).sum::<f64>()
}

/// The photograph's most frequent colours with their weights.
fn gathered(picture: &Picture) -> Vec<(f64, [f32; 3])> {
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
    // Stable: bins of one size stay in the order of their colours.
    colors.sort_by(|a, b| b.0.total_cmp(&a.0));
    colors.truncate(COLORS);
    colors
}
