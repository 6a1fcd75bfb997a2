//! The survey. We search some pixels of a scan over all sets, and find from them how often the scan
//! holds each pigment.
//!
//! A painter uses few of a library's pigments, and each of them more than once. So if no pixel
//! needs a pigment, it is unlikely everywhere, even where it would fit as well as others, e.g. in
//! dark paint.

use std::collections::BTreeMap;

use documents::{Cancelled, Task};
use rayon::prelude::*;

use super::book::{Book, BookEntry, BookSet, Folded, Prepared, SetFrequency, WITHIN};
use crate::search::set_fit::{NEGLIGIBLE, SetFit, TRACE, of_odds};
use crate::search::{Engine, Scratch};

/// A survey searches about this many pixels.
pub const SURVEYED: usize = 20_000;
/// An entry of the book keeps the sets with a score up to this above its best one.
const KEPT_SCORE: f32 = 12.0;
/// An entry of the book keeps at most this many sets.
const KEPT_SETS: usize = 9;
/// Distance between surveyed pixels. With 3, for example, a survey searches every third pixel.
#[must_use]
pub fn survey_step(pixels: usize) -> usize {
    (pixels / SURVEYED).max(1)
}

/// Searches all sets for each pixel of `folded`, finds the palette, and fills the empty `book`.
/// Pixels with the same nearest film in the engine's table count as one paint. `task` counts the
/// pixels.
pub(crate) fn survey(
    prepared: &Prepared,
    mut book: Book,
    folded: &[Folded],
    task: &Task,
) -> Result<Book, Cancelled> {
    let engine = &prepared.engine;
    let steps = task.steps_of("surveying", folded.len());
    let found: Vec<(usize, Vec<SetFit>)> = folded
        .par_iter()
        .map_init(
            || Scratch::new(&engine.films),
            |scratch: &mut Scratch, folded: &Folded| {
                task.check()?;
                let place = engine.table.nearest(&folded.projected);
                engine.search(&folded.pixel, place, scratch);
                steps.step();
                let best = scratch.found.first().map_or(0.0, |set| set.score);
                let near = scratch.found.iter().take_while(|set| set.score < best + NEGLIGIBLE);
                Ok((place, near.copied().collect::<Vec<SetFit>>()))
            },
        )
        .collect::<Result<_, Cancelled>>()?;
    task.check()?;
    let (paints, mut found): (Vec<usize>, Vec<Vec<SetFit>>) = found.into_iter().unzip();
    book.median_chi2 = median_chi2(engine, &found);
    book.palette = palette(engine, &found, &paints);
    let informed = engine.scores.with_survey(&book.palette, f64::from(book.median_chi2));
    for sets in &mut found {
        for set in sets.iter_mut() {
            set.score += informed.prior(set) - engine.scores.prior(set);
        }
        sets.sort_by(|a, b| a.score.total_cmp(&b.score).then(a.key().cmp(&b.key())));
        let best = sets.first().map_or(0.0, |set| set.score);
        let near = sets.iter().take_while(|set| set.score < best + KEPT_SCORE).count();
        sets.truncate(near.min(KEPT_SETS));
    }
    book.usual_chi2 = usual(&found);
    book.sets = frequencies(engine, &found)
        .into_iter()
        .map(|(key, part)| SetFrequency { pigments: members(key), part: part as f32 })
        .collect();
    book.sets.sort_by(|a, b| b.part.total_cmp(&a.part).then(a.pigments.cmp(&b.pigments)));
    book.entries = (found.iter().zip(folded))
        .map(|(sets, folded)| BookEntry {
            point: folded.projected.to_vec(),
            chi2: sets.first().map_or(0.0, |set| set.chi2),
            sets: sets.iter().map(of_fit).collect(),
        })
        .collect();
    Ok(book)
}

fn members(key: u32) -> Vec<u8> {
    key.to_be_bytes().into_iter().filter(|member| *member != u8::MAX).collect()
}

fn of_fit(set: &SetFit) -> BookSet {
    BookSet {
        pigments: set.members[..set.len()].to_vec(),
        shares: set.shares[..set.len()].to_vec(),
    }
}

/// Median chi-square per degree of freedom. It shows how large the errors of library and scan are
/// beside the ones that the engine expects.
fn median_chi2(engine: &Engine, found: &[Vec<SetFit>]) -> f32 {
    let mut values: Vec<f32> = found
        .iter()
        .filter_map(|sets| {
            sets.first().map(|set: &SetFit| {
                set.chi2 / engine.films.bands.saturating_sub(set.len() - 1).max(1) as f32
            })
        })
        .collect();
    values.sort_by(f32::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(1.0)
}

/// 95th percentile of the chi-square of the best sets.
fn usual(found: &[Vec<SetFit>]) -> f32 {
    let mut values: Vec<f32> = found.iter().filter_map(|sets| Some(sets.first()?.chi2)).collect();
    values.sort_by(f32::total_cmp);
    let place = values.len() * 19 / 20;
    values.get(place.min(values.len().saturating_sub(1))).copied().unwrap_or(0.0)
}

/// Mean probability of each set over all pixels.
fn frequencies(engine: &Engine, found: &[Vec<SetFit>]) -> BTreeMap<u32, f64> {
    let mut parts = BTreeMap::new();
    for sets in found {
        let Some(best) = sets.first() else { continue };
        let weights = sets.iter().map(|set| engine.scores.weight(set.score - best.score));
        let total: f64 = weights.clone().sum();
        for (set, weight) in sets.iter().zip(weights) {
            *parts.entry(set.key()).or_insert(0.0) += weight / total / found.len() as f64;
        }
    }
    parts
}

/// We begin with this probability of each pigment.
const AT_FIRST: f64 = 0.3;
/// Rounds of [`palette`]. Paints that tell little slow it down.
const ROUNDS: usize = 40;

/// How much of the scan holds each pigment: the prior that explains the survey best, by expectation
/// and maximisation.
///
/// Pass the sets of each surveyed pixel as `found`. `paints` holds a number for each pixel. Pixels
/// with the same number are one paint, because they share the errors of the library. A paint counts
/// by the square root of its pixels.
fn palette(engine: &Engine, found: &[Vec<SetFit>], paints: &[usize]) -> Vec<f32> {
    let mut sizes = BTreeMap::new();
    for paint in paints {
        *sizes.entry(*paint).or_insert(0.0_f64) += 1.0;
    }
    let all: f64 = sizes.values().map(|size| size.sqrt()).sum();
    let mut palette = vec![AT_FIRST; engine.films.pigments];
    let mut weights = Vec::new();
    for _ in 0..ROUNDS {
        let added: Vec<f32> = palette.iter().map(|inside| of_odds(*inside)).collect();
        let mut sums = vec![0.0; palette.len()];
        for (sets, paint) in found.iter().zip(paints) {
            let score = |set: &SetFit| {
                let prior: f32 = set.parts().map(|(member, _)| added[member]).sum();
                set.score - engine.scores.prior(set) + prior
            };
            let best = sets.iter().map(score).fold(f32::INFINITY, f32::min);
            weights.clear();
            weights.extend(sets.iter().map(|set| engine.scores.weight(score(set) - best)));
            let total = weights.iter().sum::<f64>() * sizes[paint].sqrt();
            for (set, weight) in sets.iter().zip(&weights) {
                for (member, _) in set.parts().filter(|part| f64::from(part.1) >= TRACE) {
                    sums[member] += weight / total;
                }
            }
        }
        for (inside, sum) in palette.iter_mut().zip(&sums) {
            // As if one more paint held it in two of four cases.
            *inside = ((sum + 0.5) / (all + 2.0)).clamp(WITHIN[0], WITHIN[1]);
        }
    }
    palette.into_iter().map(|inside| inside as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::films::settings::{MapSettings, ModelError};

    /// Sets of a pixel with their scores, the best first.
    fn pixel(sets: &[(&[usize], f32)]) -> Vec<SetFit> {
        sets.iter()
            .map(|(members, score): &(&[usize], f32)| {
                let share = 1.0 / members.len() as f32;
                let parts: Vec<(usize, f32)> = members.iter().map(|&m| (m, share)).collect();
                SetFit { score: *score, ..SetFit::of_parts(&parts).unwrap() }
            })
            .collect()
    }

    /// An engine for four pigments, with no prior.
    fn engine() -> Engine {
        let oils = pigment::PigmentLibrary::van_gogh_oils();
        let nm: Vec<f64> = oils.grid.wavelengths_nm().collect();
        let names = ["Zinc White", "Viridian", "Vermilion", "Bone Black"];
        let settings = MapSettings {
            palette: names.map(str::to_owned).to_vec(),
            penalty: 0.0,
            ..MapSettings::default()
        };
        Prepared::new(&oils, &nm, &settings, &ModelError::Stated(0.1)).unwrap().engine
    }

    #[test]
    fn a_pigment_is_as_frequent_as_the_paints_that_need_it() {
        let engine = engine();
        let needed = pixel(&[(&[0, 1], 5.0), (&[0, 2], 60.0)]);
        let not = pixel(&[(&[0], 5.0), (&[0, 3], 60.0)]);
        let found = [needed.clone(), needed, not.clone(), not];
        let palette = palette(&engine, &found, &[7, 3, 9, 4]);
        assert!(palette[0] > 0.7, "in each paint: {palette:?}");
        assert!((palette[1] - 0.42).abs() < 0.02, "in two of four: {palette:?}");
        assert!(palette[2] < 0.1 && palette[3] < 0.1, "in none: {palette:?}");
    }

    #[test]
    fn doubtful_paints_follow_those_that_are_sure() {
        let engine = engine();
        let sure = pixel(&[(&[0, 1], 5.0), (&[0, 2], 60.0)]);
        let doubtful = pixel(&[(&[0, 1], 5.0), (&[0, 2], 5.0)]);
        let found = [sure, doubtful.clone(), doubtful.clone(), doubtful];
        let palette = palette(&engine, &found, &[1, 2, 3, 4]);
        // Without the one that is sure, both would have about 0.4.
        assert!(palette[1] > 0.55 && palette[2] < 0.27, "{palette:?}");
    }

    #[test]
    fn a_paint_counts_by_the_root_of_its_pixels() {
        let engine = engine();
        let needed = pixel(&[(&[0, 1], 5.0), (&[0], 60.0)]);
        let not = pixel(&[(&[0], 5.0), (&[0, 1], 60.0)]);
        let found = [vec![needed; 9], vec![not; 1]].concat();
        let mut paints = vec![1; 9];
        paints.push(2);
        // Three of four, beside the two of four that we begin with.
        let inside = palette(&engine, &found, &paints)[1];
        assert!((inside - 3.5 / 6.0).abs() < 0.01, "{inside}");
    }
}
