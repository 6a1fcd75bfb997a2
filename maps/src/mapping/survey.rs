//! The survey: some pixels of a scan searched whole, and how often each set explains them.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::book::{Book, BookEntry, BookSet, SetFrequency};
use super::prepared::{Folded, Prepared};
use crate::search::engine::{Engine, Prior, Scratch};
use crate::search::set_fit::SetFit;

/// Pixels that a survey searches, about.
pub const SURVEYED: usize = 20_000;
/// Scores above the best up to which an entry keeps a set.
const KEPT_SCORE: f32 = 9.0;
/// Most sets of an entry.
const KEPT_SETS: usize = 6;
/// Part of the prior that all sets share alike.
const ALIKE: f64 = 0.3;
/// Rounds in which probabilities and prior of sets settle.
const ROUNDS: usize = 4;
/// Greatest change of the score of a set by how often the survey found it.
const MOST_SAVED: f64 = 10.0;

/// Distance between surveyed pixels: every such pixel of `pixels`, in their order, is searched.
#[must_use]
pub fn survey_step(pixels: usize) -> usize {
    (pixels / SURVEYED).max(1)
}

/// Searches the pixels of `folded` whole, and fills the empty `book`. `progress` is called after each pixel, from any thread.
pub(crate) fn survey(
    prepared: &Prepared,
    mut book: Book,
    folded: &[Folded],
    progress: &(dyn Fn() + Sync),
) -> Book {
    let engine = &prepared.engine;
    let search = |scratch: &mut Scratch, folded: &Folded| {
        let place = engine.table.nearest(&folded.point);
        engine.search(&folded.pixel, place, &Prior::default(), scratch);
        progress();
        let best = scratch.found.first().map_or(0.0, |set| set.score);
        let near = scratch.found.iter().take_while(|set| set.score < best + KEPT_SCORE);
        near.take(KEPT_SETS).copied().collect::<Vec<SetFit>>()
    };
    let mut found: Vec<Vec<SetFit>> =
        folded.par_iter().map_init(|| Scratch::new(&engine.films), search).collect();
    let alone: Vec<BTreeMap<u32, f32>> =
        found.iter().map(|sets| sets.iter().map(|set| (set.key(), set.score)).collect()).collect();
    let mut parts = BTreeMap::new();
    for _ in 0..ROUNDS {
        let prior = if parts.is_empty() { Prior::default() } else { prior(engine, &parts) };
        for (sets, alone) in found.iter_mut().zip(&alone) {
            for set in sets.iter_mut() {
                set.score = alone[&set.key()] + prior.of(set.key());
            }
            sets.sort_by(|a, b| a.score.total_cmp(&b.score).then(a.key().cmp(&b.key())));
        }
        parts = frequencies(&found);
    }
    book.usual_chi2 = usual(&found);
    let members = |key: u32| -> Vec<u8> {
        key.to_be_bytes().into_iter().filter(|member| *member != u8::MAX).collect()
    };
    book.sets = parts
        .iter()
        .map(|(&key, &part)| SetFrequency { pigments: members(key), part: part as f32 })
        .collect();
    book.sets.sort_by(|a, b| b.part.total_cmp(&a.part).then(a.pigments.cmp(&b.pigments)));
    book.entries = (found.iter().zip(folded))
        .map(|(sets, folded)| BookEntry {
            point: folded.point.to_vec(),
            chi2: sets.first().map_or(0.0, |set| set.chi2),
            sets: sets.iter().map(of_fit).collect(),
        })
        .collect();
    book
}

fn of_fit(set: &SetFit) -> BookSet {
    BookSet {
        pigments: set.members[..set.len()].to_vec(),
        shares: set.shares[..set.len()].to_vec(),
    }
}

/// Chi-square that nineteen of twenty pixels do not exceed.
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
        let weight = |set: &SetFit| f64::from(-0.5 * (set.score - best.score)).exp();
        let total: f64 = sets.iter().map(weight).sum();
        for set in sets {
            *parts.entry(set.key()).or_insert(0.0) += weight(set) / total / found.len() as f64;
        }
    }
    parts
}

/// Prior of sets that explain these parts of a survey, relative to one in which all sets of one size are
/// alike.
fn prior(engine: &Engine, parts: &BTreeMap<u32, f64>) -> Prior {
    let saved = |(&key, &part): (&u32, &f64)| {
        let size = key.to_be_bytes().iter().filter(|member| **member != u8::MAX).count();
        let sets = number_of_sets(engine.films.pigments, size) * engine.at_most as f64;
        let ratio = (1.0 - ALIKE) * part * sets + ALIKE;
        (key, (-2.0 * ratio.ln()).clamp(-MOST_SAVED, MOST_SAVED) as f32)
    };
    Prior { of_set: parts.iter().map(saved).collect(), of_others: -2.0 * ALIKE.ln() as f32 }
}

/// Prior that a book tells.
pub(crate) fn prior_of_book(engine: &Engine, book: &Book) -> Prior {
    let key = |pigments: &[u8]| {
        let mut members = [u8::MAX; 4];
        members[..pigments.len()].copy_from_slice(pigments);
        u32::from_be_bytes(members)
    };
    let parts = book.sets.iter().map(|set| (key(&set.pigments), f64::from(set.part)));
    prior(engine, &parts.collect())
}

/// Number of sets of `size` of `pigments`.
fn number_of_sets(pigments: usize, size: usize) -> f64 {
    (0..size).map(|i| pigments.saturating_sub(i).max(1) as f64 / (i + 1) as f64).product()
}
