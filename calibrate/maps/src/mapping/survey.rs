//! The survey: some pixels of a scan searched whole, and how often each set explains them.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use documents::{Cancellation, Cancelled};
use rayon::prelude::*;

use super::book::{Book, BookEntry, BookSet, SetFrequency};
use super::palette::palette;
use super::prepared::{Folded, Prepared};
use crate::search::engine::{Engine, Scratch};
use crate::search::scores::{NEGLIGIBLE, Scores};
use crate::search::set_fit::SetFit;

/// Pixels that a survey searches, about.
pub const SURVEYED: usize = 20_000;
/// Scores above the best up to which an entry keeps a set.
const KEPT_SCORE: f32 = 9.0;
/// Most sets of an entry.
const KEPT_SETS: usize = 6;
/// Distance between surveyed pixels: every such pixel of `pixels`, in their order, is searched.
#[must_use]
pub fn survey_step(pixels: usize) -> usize {
    (pixels / SURVEYED).max(1)
}

/// Searches the pixels of `folded` whole, finds their palette, and fills the empty `book`. Pixels that are nearest
/// to one film of the engine's table are one paint. `progress` is called after each pixel,
/// from any thread; if it breaks, the survey ends.
pub(crate) fn survey(
    prepared: &Prepared,
    mut book: Book,
    folded: &[Folded],
    progress: &(dyn Fn() -> ControlFlow<()> + Sync),
) -> Result<Book, Cancelled> {
    let engine = &prepared.engine;
    let ended = Cancellation::default();
    let search = |scratch: &mut Scratch, folded: &Folded| {
        ended.check()?;
        let place = engine.table.nearest(&folded.point);
        engine.search(&folded.pixel, place, scratch);
        if progress().is_break() {
            ended.cancel();
        }
        let best = scratch.found.first().map_or(0.0, |set| set.score);
        let near = scratch.found.iter().take_while(|set| set.score < best + NEGLIGIBLE);
        Ok((place, near.copied().collect::<Vec<SetFit>>()))
    };
    let found: Vec<(usize, Vec<SetFit>)> = folded
        .par_iter()
        .map_init(|| Scratch::new(&engine.films), search)
        .collect::<Result<_, _>>()?;
    ended.check()?;
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
    let members = |key: u32| -> Vec<u8> {
        key.to_be_bytes().into_iter().filter(|member| *member != u8::MAX).collect()
    };
    book.sets = frequencies(&found)
        .into_iter()
        .map(|(key, part)| SetFrequency { pigments: members(key), part: part as f32 })
        .collect();
    book.sets.sort_by(|a, b| b.part.total_cmp(&a.part).then(a.pigments.cmp(&b.pigments)));
    book.entries = (found.iter().zip(folded))
        .map(|(sets, folded)| BookEntry {
            point: folded.point.to_vec(),
            chi2: sets.first().map_or(0.0, |set| set.chi2),
            sets: sets.iter().map(of_fit).collect(),
        })
        .collect();
    Ok(book)
}

fn of_fit(set: &SetFit) -> BookSet {
    BookSet {
        pigments: set.members[..set.len()].to_vec(),
        shares: set.shares[..set.len()].to_vec(),
    }
}

/// Median chi-square per degree of freedom, at least 1: how far the errors of library and scan exceed those that the
/// engine reckons with.
fn excess(engine: &Engine, found: &[Vec<SetFit>]) -> f32 {
    let of_best =
        |set: &SetFit| set.chi2 / engine.films.bands.saturating_sub(set.len() - 1).max(1) as f32;
    let mut values: Vec<f32> = found.iter().filter_map(|sets| sets.first().map(of_best)).collect();
    values.sort_by(f32::total_cmp);
    values.get(values.len() / 2).map_or(1.0, |median| median.max(1.0))
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
        let weight = |set: &SetFit| Scores::weight(set.score - best.score);
        let total: f64 = sets.iter().map(weight).sum();
        for set in sets {
            *parts.entry(set.key()).or_insert(0.0) += weight(set) / total / found.len() as f64;
        }
    }
    parts
}
