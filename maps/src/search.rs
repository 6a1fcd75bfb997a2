//! Whole search of one pixel: all sets of pigments, best first.

use std::collections::BTreeMap;

use crate::film::{Difference, Films, Pixel, Work};
use crate::set_fit::{Quadratic, SetFit};
use crate::table::Table;
use crate::whitening::WhiteningNoise;

/// Linearised sets that are kept, by their number of pigments.
const KEPT: [usize; 4] = [6, 20, 20, 8];
/// Sets of one size that are extended by each other pigment.
const BEAM: usize = 8;
/// Sets that are refined in measured reflectance, in the first round and in the second.
const REFINED: [usize; 2] = [12, 10];
/// Gauss-Newton steps of each set, and of the best one at the end.
const STEPS: [usize; 2] = [3, 3];
/// Penalty of a pigment among linearised sets, before what its share costs is known.
const SHORTLIST_PENALTY: f32 = 6.0;
/// Scores above the best beyond which a set does not matter: its weight is below 1e-4.
pub(crate) const NEGLIGIBLE: f32 = 20.0;

/// Additions to the scores of sets, by their keys, from how often a survey found them.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Prior {
    pub(crate) of_set: BTreeMap<u32, f32>,
    /// Addition to the score of any other set.
    pub(crate) of_others: f32,
}

impl Prior {
    pub(crate) fn of(&self, key: u32) -> f32 {
        self.of_set.get(&key).copied().unwrap_or(self.of_others)
    }
}

/// All that a search needs, but the pixel.
#[derive(Debug, Clone)]
pub(crate) struct Engine {
    pub(crate) films: Films,
    pub(crate) table: Table,
    pub(crate) noise: WhiteningNoise,
    pub(crate) at_most: usize,
    /// Additions to the score by number of pigments.
    pub(crate) of_count: [f32; 4],
    /// Degrees of freedom of the residuals' distribution; infinite for a normal one.
    pub(crate) tail: f64,
}

/// Memory of a search, reused from pixel to pixel.
#[derive(Debug)]
pub(crate) struct Scratch {
    work: Work,
    pub(crate) found: Vec<SetFit>,
    by_size: [Vec<SetFit>; 4],
    shortlist: Vec<SetFit>,
}

impl Scratch {
    pub(crate) fn new(films: &Films) -> Self {
        Self {
            work: Work::new(films),
            found: Vec::new(),
            by_size: [const { Vec::new() }; 4],
            shortlist: Vec::new(),
        }
    }
}

impl Engine {
    /// -2 ln of the probability of a refined set, less a constant: its misfit, the part of all shares that
    /// agree with the pixel, and the prior. A set of any number of pigments is as likely as one of another, and
    /// so is any set of one number.
    pub(crate) fn score(&self, set: &SetFit, difference: &Difference, prior: &Prior) -> f32 {
        let exactness = difference.exactness(set.len(), self.excess(set.chi2)) as f32;
        self.misfit(set.chi2) + exactness + self.of_count[set.len() - 1] + prior.of(set.key())
    }

    /// Additions to the score by number of pigments, for `pigments` of which up to four are mixed.
    pub(crate) fn of_count(pigments: usize, penalty: f64) -> [f32; 4] {
        let mut sets = 1.0;
        std::array::from_fn(|size| {
            sets *= pigments.saturating_sub(size).max(1) as f64 / (size + 1) as f64;
            (2.0 * sets.ln() + penalty * (size + 1) as f64) as f32
        })
    }

    pub(crate) fn misfit(&self, chi2: f32) -> f32 {
        if self.tail.is_infinite() {
            return chi2;
        }
        let scale = self.tail + self.films.bands as f64;
        (scale * (f64::from(chi2.max(0.0)) / self.tail).ln_1p()) as f32
    }

    /// Factor by which the variance of a pixel's errors exceeds the usual one.
    pub(crate) fn excess(&self, chi2: f32) -> f64 {
        if self.tail.is_infinite() {
            return 1.0;
        }
        (self.tail + f64::from(chi2)) / (self.tail + self.films.bands as f64)
    }

    /// Searches all sets, beginning at the film `place` of the table. The sets are left in `scratch.found`,
    /// the best first.
    pub(crate) fn search(
        &self,
        pixel: &Pixel,
        place: usize,
        prior: &Prior,
        scratch: &mut Scratch,
    ) {
        scratch.found.clear();
        let (internal, inverse) = self.table.film(place);
        self.films.products(pixel, (internal, inverse), &mut scratch.work);
        self.shortlist(prior, scratch);
        for index in 0..REFINED[0].min(scratch.shortlist.len()) {
            self.add_refined(pixel, index, prior, scratch);
        }
        let best = |a: SetFit, b: SetFit| if b.score < a.score { b } else { a };
        let Some(winner) = scratch.found.iter().copied().reduce(best) else { return };
        let parts: Vec<(usize, f32)> = winner.parts().collect();
        let (internal, inverse) = self.films.film(&parts);
        self.films.products(pixel, (&internal, &inverse), &mut scratch.work);
        self.shortlist(prior, scratch);
        let mut refined = 0;
        for index in 0..scratch.shortlist.len() {
            let set = scratch.shortlist[index];
            if scratch.found.iter().any(|found| found.key() == set.key()) {
                continue;
            }
            self.add_refined(pixel, index, prior, scratch);
            refined += 1;
            if refined == REFINED[1] {
                break;
            }
        }
        self.sort(pixel, prior, &mut scratch.found);
    }

    /// Sorts sets, and refines the best ones until they stay the best.
    pub(crate) fn sort(
        &self,
        pixel: &Pixel,
        prior: &Prior,
        found: &mut [SetFit],
    ) {
        let order = |a: &SetFit, b: &SetFit| a.score.total_cmp(&b.score).then(a.key().cmp(&b.key()));
        found.sort_unstable_by(order);
        let Some(best) = found.first_mut() else { return };
        let difference = best.refine(&self.films, pixel, STEPS[1]);
        best.score = self.score(best, &difference, prior);
        found.sort_unstable_by(order);
    }

    /// Refines a set in measured reflectance by `steps`, and tells its score.
    pub(crate) fn refined(
        &self,
        pixel: &Pixel,
        mut set: SetFit,
        steps: usize,
        prior: &Prior,
    ) -> SetFit {
        let difference = set.refine(&self.films, pixel, steps);
        set.score = self.score(&set, &difference, prior);
        set
    }

    fn add_refined(
        &self,
        pixel: &Pixel,
        index: usize,
        prior: &Prior,
        scratch: &mut Scratch,
    ) {
        let set = scratch.shortlist[index];
        let set = self.refined(pixel, set, STEPS[0], prior);
        scratch.found.push(set);
    }

    /// Best sets of the linearised problem, in `scratch.shortlist`, the best first.
    fn shortlist(&self, prior: &Prior, scratch: &mut Scratch) {
        let Scratch { work, by_size, shortlist, .. } = scratch;
        let count = self.films.pigments;
        let quadratic = Quadratic {
            products: &work.products,
            columns: self.films.columns,
            sizes: &work.sizes,
        };
        by_size.iter_mut().for_each(Vec::clear);
        let [singles, pairs, triples, fours] = by_size;
        for a in 0..count {
            keep(singles, KEPT[0], quadratic.single(a));
        }
        if self.at_most > 1 {
            for a in 0..count {
                for b in a + 1..count {
                    if let Some((share, chi2)) = quadratic.pair(a, b)
                        && is_kept(pairs, KEPT[1], chi2 as f32)
                    {
                        keep(pairs, KEPT[1], quadratic.fit([a, b], [share, 1.0 - share], chi2));
                    }
                }
            }
        }
        if self.at_most > 2 {
            quadratic.triples(count, |members, shares, chi2| {
                if is_kept(triples, KEPT[2], chi2 as f32) {
                    keep(triples, KEPT[2], quadratic.fit(members, shares, chi2));
                }
            });
        }
        if self.at_most > 3 {
            for triple in triples.iter().take(BEAM) {
                let [a, b, c] = [0, 1, 2].map(|i| usize::from(triple.members[i]));
                for d in (0..count).filter(|d| ![a, b, c].contains(d)) {
                    if let Some(set) = quadratic.set([a, b, c, d]) {
                        keep(fours, KEPT[3], set);
                    }
                }
            }
        }
        shortlist.clear();
        for set in by_size.iter().flatten() {
            let penalty = SHORTLIST_PENALTY * set.len() as f32;
            let score = self.misfit(set.chi2) + penalty + prior.of(set.key());
            shortlist.push(SetFit { score, ..*set });
        }
        let order = |a: &SetFit, b: &SetFit| a.score.total_cmp(&b.score).then(a.key().cmp(&b.key()));
        shortlist.sort_unstable_by(order);
    }
}

fn is_kept(list: &[SetFit], most: usize, chi2: f32) -> bool {
    list.len() < most || list.last().is_none_or(|last| chi2 < last.chi2)
}

/// Adds `set` to a list of at most `most` sets, sorted by chi-square, unless it is in it.
fn keep(list: &mut Vec<SetFit>, most: usize, set: SetFit) {
    if !is_kept(list, most, set.chi2) || list.iter().any(|known| known.key() == set.key()) {
        return;
    }
    if list.len() == most {
        list.pop();
    }
    let place = list.iter().position(|known| set.chi2 < known.chi2).unwrap_or(list.len());
    list.insert(place, set);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::MapSettings;
    use crate::prepared::Prepared;

    #[test]
    fn probe() {
        let oils = pigment::PigmentLibrary::van_gogh_oils();
        let nm: Vec<f64> = oils.grid.wavelengths_nm().collect();
        let prepared = Prepared::new(&oils, &nm, &MapSettings { model_error: Some(crate::noise::ModelError::Stated(0.1)), ..MapSettings::default() }).unwrap();
        let engine = &prepared.engine;
        let mut scratch = Scratch::new(&engine.films);
        for truth in [vec![(1, 0.8), (10, 0.2)], vec![(1, 0.5), (4, 0.1), (10, 0.4)], vec![(0, 0.3), (1, 0.7)], vec![(3,0.95),(4,0.05)]] {
            let spectrum: Vec<f32> = prepared.paints.reflectance(&truth).iter().map(|r| *r as f32).collect();
            let folded = prepared.fold(&spectrum).unwrap();
            let place = engine.table.nearest(&folded.point);
            println!("truth {truth:?} nearest {:?}", engine.table.recipes[place]);
            engine.search(&folded.pixel, place, &Prior::default(), &mut scratch);
            for set in scratch.found.iter().take(4) { println!("   {:?} chi2 {} score {}", set.parts().collect::<Vec<_>>(), set.chi2, set.score); }
        }
    }
}
