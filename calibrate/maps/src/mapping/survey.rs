//! The survey. We search some pixels of a scan over all sets and find the palette from them.
//!
//! A painter uses few of a library's pigments, and each of them more than once. So if no pixel
//! needs a pigment, it is unlikely everywhere, even where it would fit as well as others, e.g. in
//! dark paint.

use std::collections::BTreeMap;

use documents::{Cancelled, Task};
use rayon::prelude::*;

use super::book::{Book, BookEntry, BookSet, Folded, Prepared, SetFrequency};
use crate::search::set_fit::{NEGLIGIBLE, Scores, SetFit};
use crate::search::{Engine, Scratch};

/// A survey searches about this many pixels.
pub const SURVEYED: usize = 20_000;
/// An entry of the book keeps the sets with a score up to this above its best one.
const KEPT_SCORE: f32 = 9.0;
/// An entry of the book keeps at most this many sets.
const KEPT_SETS: usize = 6;
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
    book.palette = palette(&found, &paints, &prepared.entries, excess(engine, &found));
    let informed = engine.scores.with_palette(&book.palette);
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
    book.sets = frequencies(&found)
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

/// Median chi-square per degree of freedom, at least 1. It shows how far the errors of library and
/// scan exceed the ones that the engine expects.
fn excess(engine: &Engine, found: &[Vec<SetFit>]) -> f32 {
    let mut values: Vec<f32> = found
        .iter()
        .filter_map(|sets| {
            sets.first().map(|set: &SetFit| {
                set.chi2 / engine.films.bands.saturating_sub(set.len() - 1).max(1) as f32
            })
        })
        .collect();
    values.sort_by(f32::total_cmp);
    values.get(values.len() / 2).map_or(1.0, |median| median.max(1.0))
}

/// 95th percentile of the chi-square of the best sets.
fn usual(found: &[Vec<SetFit>]) -> f32 {
    let mut values: Vec<f32> = found.iter().filter_map(|sets| Some(sets.first()?.chi2)).collect();
    values.sort_by(f32::total_cmp);
    let place = values.len() * 19 / 20;
    values.get(place.min(values.len().saturating_sub(1))).copied().unwrap_or(0.0)
}

/// Mean probability of each set over all pixels.
fn frequencies(found: &[Vec<SetFit>]) -> BTreeMap<u32, f64> {
    let mut parts = BTreeMap::new();
    for sets in found {
        let Some(best) = sets.first() else { continue };
        let weights = sets.iter().map(|set| Scores::weight(set.score - best.score));
        let total: f64 = weights.clone().sum();
        for (set, weight) in sets.iter().zip(weights) {
            *parts.entry(set.key()).or_insert(0.0) += weight / total / found.len() as f64;
        }
    }
    parts
}

/// The probability that a pigment is in the palette is one half if the score rises by this without
/// it, on average over the paints that need it most. We tried 4 to 18 on simulated paintings.
const NEEDED: f32 = 14.0;
/// If a scan has many paints, we average over this many of them, the ones that need a pigment most.
/// A single one of many may be off by chance.
const PAINTS: usize = 2;
/// A scan with at least this many paints has many.
const MANY: usize = 16;

/// Probability of each pigment to be in the palette.
///
/// Pass the sets of each surveyed pixel as `found`, the best first. `paints` holds a number for
/// each pixel. Pixels with the same number are one paint, because they share the errors of the
/// library. Each of `entries` lists the indices of pigments that look alike. Such
/// pigments are one entry of the palette and share its probability, as far as the paints do not
/// tell them apart. `excess` is the factor, 1 or more, by which the errors of the survey exceed the
/// ones that scores expect. If it is so great that no paint can need a pigment, each pigment has
/// the probability one half.
pub(crate) fn palette(
    found: &[Vec<SetFit>],
    paints: &[usize],
    entries: &[Vec<usize>],
    excess: f32,
) -> Vec<f32> {
    let pigments = entries.iter().map(Vec::len).sum();
    if NEGLIGIBLE / excess <= NEEDED {
        return vec![0.5; pigments];
    }
    let survey = Survey::new(found, paints, excess);
    let of_entry: Vec<u64> = entries
        .iter()
        .map(|entry: &Vec<usize>| entry.iter().fold(0, |bits, pigment| bits | 1u64 << pigment))
        .collect();
    let mut palette = of_entry.iter().fold(0, |all, entry| all | entry);
    // What is needed least goes first: others may take its place.
    loop {
        let inside: Vec<u64> = of_entry.iter().copied().filter(|e| palette & e != 0).collect();
        let needs = survey.needs(palette, &inside);
        let least = inside.into_iter().zip(needs).min_by(|(_, a), (_, b)| a.total_cmp(b));
        match least.filter(|(_, need)| *need < NEEDED) {
            Some((entry, _)) => palette &= !entry,
            None => break,
        }
    }
    let mut probabilities = vec![0.0; pigments];
    for (entry, &of_entry) in entries.iter().zip(&of_entry) {
        let palette = palette | of_entry;
        let one_of_them = likely(survey.needs(palette, &[of_entry])[0]);
        let own: Vec<u64> = entry.iter().map(|pigment| 1 << pigment).collect();
        let others: Vec<u64> = own.iter().map(|own| of_entry & !own).collect();
        // Each may replace the others, and is more likely the less the score rises by that.
        let alone = survey.needs(palette, &others);
        let weights: Vec<f32> = alone.iter().map(|loss| libm::expf(-0.5 * loss)).collect();
        let sum: f32 = weights.iter().sum();
        let needs = survey.needs(palette, &own);
        for ((&pigment, weight), need) in entry.iter().zip(weights).zip(needs) {
            probabilities[pigment] = (one_of_them * weight / sum).max(likely(need));
        }
    }
    probabilities
}

fn likely(need: f32) -> f32 {
    1.0 / (1.0 + libm::expf(0.5 * (NEEDED - need)))
}

/// Sets of all surveyed pixels as bits of their pigments, with their scores.
struct Survey {
    sets: Vec<Vec<(u64, f32)>>,
    paints: Vec<usize>,
    sizes: Vec<f32>,
    /// Factor on differences of scores: 1 / `excess` of [`palette`].
    counted: f32,
}

impl Survey {
    fn new(found: &[Vec<SetFit>], numbers: &[usize], excess: f32) -> Self {
        let mut places = BTreeMap::new();
        let mut sizes = Vec::new();
        let paints = numbers
            .iter()
            .map(|number: &usize| {
                let place = *places.entry(*number).or_insert_with(|| {
                    sizes.push(0.0);
                    sizes.len() - 1
                });
                sizes[place] += 1.0;
                place
            })
            .collect();
        Self {
            sets: found
                .iter()
                .map(|sets: &Vec<SetFit>| sets.iter().map(|set| (bits(set), set.score)).collect())
                .collect(),
            paints,
            sizes,
            counted: 1.0 / excess,
        }
    }

    /// For each of `parts`, how much the score rises if `palette` loses it, in the paints that need
    /// it most.
    fn needs(&self, palette: u64, parts: &[u64]) -> Vec<f32> {
        let mut rises = vec![vec![0.0; self.sizes.len()]; parts.len()];
        for (sets, &paint) in self.sets.iter().zip(&self.paints) {
            let best = |palette: u64| sets.iter().find(|(set, _)| set & !palette == 0);
            let Some(&(set, score)) = best(palette) else { continue };
            for (part, rises) in parts.iter().zip(&mut rises) {
                if set & part != 0 {
                    let without = best(palette & !part);
                    let rise = without.map_or(NEGLIGIBLE, |(_, without)| without - score);
                    rises[paint] += self.counted * rise.min(NEGLIGIBLE) / self.sizes[paint];
                }
            }
        }
        let counted = if self.sizes.len() < MANY { 1 } else { PAINTS };
        rises
            .into_iter()
            .map(|mut rises: Vec<f32>| {
                rises.sort_by(|a, b| b.total_cmp(a));
                rises.iter().take(counted).sum::<f32>() / counted as f32
            })
            .collect()
    }
}

fn bits(set: &SetFit) -> u64 {
    set.parts().fold(0, |bits, (member, _)| bits | 1 << member)
}

#[cfg(test)]
mod tests {
    use super::*;

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

    /// Entries of pigments that do not look alike.
    fn apart(pigments: usize) -> Vec<Vec<usize>> {
        (0..pigments).map(|pigment| vec![pigment]).collect()
    }

    #[test]
    fn a_pigment_that_two_paints_cannot_do_without_is_in_the_palette() {
        let needed = pixel(&[(&[0, 1], 5.0), (&[0, 2], 24.0)]);
        let doubtful = pixel(&[(&[0, 2], 5.0), (&[0, 1], 6.0)]);
        let found = [needed.clone(), needed.clone(), doubtful.clone(), doubtful];
        let palette = palette(&found, &[7, 3, 9, 4], &apart(4), 1.0);
        assert!(palette[0] > 0.9 && palette[1] > 0.9, "{palette:?}");
        assert!(palette[2] < 0.01, "a little better in two paints: {palette:?}");
        assert!(palette[3] < 0.01, "found nowhere: {palette:?}");
    }

    #[test]
    fn one_paint_tells_as_much_as_its_mean_pixel() {
        let needed = pixel(&[(&[0, 1], 5.0), (&[0, 2], 40.0), (&[0], 105.0)]);
        let not = pixel(&[(&[0], 5.0)]);
        let pixels = [needed.clone(), not.clone(), not.clone(), not.clone()];
        let mixed = palette(&pixels, &[1, 1, 1, 1], &apart(3), 1.0);
        assert!(
            mixed[1] < 0.1 && mixed[0] > 0.5,
            "one of four pixels of one paint, however much: {mixed:?}"
        );
        let often =
            palette(&[needed.clone(), needed.clone(), not.clone()], &[1, 1, 2], &apart(3), 1.0);
        assert!(often[1] > 0.9, "one of two paints: {often:?}");
        // Of many paints two must need it.
        let [one, two] = [1, 2].map(|needing| {
            let found: Vec<_> = (0..MANY)
                .map(|paint| if paint < needing { needed.clone() } else { not.clone() })
                .collect();
            palette(&found, &(0..MANY).collect::<Vec<_>>(), &apart(3), 1.0)
        });
        assert!(one[1] < 0.2 && two[1] > 0.9, "{one:?} {two:?}");
    }

    #[test]
    fn of_two_that_do_alike_the_one_that_is_needed_more_stays() {
        let found = [alike(5.0, 7.0), alike(6.0, 5.0), alike(5.0, 8.0)];
        let palette = palette(&found, &[1, 2, 3], &apart(3), 1.0);
        assert!(palette[1] > 0.9 && palette[2] < 0.01, "{palette:?}");
    }

    fn alike(first: f32, second: f32) -> Vec<SetFit> {
        let mut sets = pixel(&[(&[1], first), (&[2], second), (&[0], 50.0)]);
        sets.sort_by(|a, b| a.score.total_cmp(&b.score));
        sets
    }

    #[test]
    fn pigments_that_look_alike_share_an_entry() {
        let pixel = |first: f32, second: f32| {
            let mut sets = pixel(&[(&[1], first), (&[2], second)]);
            sets.sort_by(|a, b| a.score.total_cmp(&b.score));
            sets
        };
        let entries = [vec![0], vec![1, 2]];
        let [equal, better, needed] = [(5.0, 5.0), (5.0, 7.0), (5.0, 24.0)]
            .map(|(first, second)| palette(&[pixel(first, second)], &[1], &entries, 1.0));
        // Alone neither is needed, but one of them is.
        assert!(equal[0] < 0.01, "{equal:?}");
        assert!((equal[1] - 0.48).abs() < 0.01 && equal[1] == equal[2], "{equal:?}");
        assert!(better[1] > 2.5 * better[2] && better[2] > 0.2, "{better:?}");
        assert!(needed[1] > 0.9 && needed[2] < 0.01, "{needed:?}");
        // Two paints, each of which needs another of them.
        let both = palette(&[pixel(5.0, 24.0), pixel(24.0, 5.0)], &[1, 2], &entries, 1.0);
        assert!(both[1] > 0.9 && both[2] > 0.9, "{both:?}");
    }

    #[test]
    fn a_library_that_errs_more_than_it_says_tells_no_palette() {
        let needed = pixel(&[(&[0, 1], 5.0), (&[0, 2], 24.0)]);
        let [sure, less, unsure] = [1.0, 1.2, 1.5]
            .map(|excess: f32| palette(std::slice::from_ref(&needed), &[1], &apart(3), excess));
        assert!(sure[1] > 0.9 && sure[2] < 0.01, "{sure:?}");
        assert!((0.5..0.9).contains(&less[1]) && less[2] < 0.01, "{less:?}");
        assert_eq!(unsure, [0.5; 3]);
    }
}
