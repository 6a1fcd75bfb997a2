//! Whole search of one pixel: all sets of pigments, best first.

use super::quadratic::Quadratic;
use super::scores::Scores;
use super::set_fit::SetFit;
use super::table::Table;
use super::triples::Marks;
use crate::films::film::{Films, Pixel, Work};
use crate::films::whitening::WhiteningNoise;

/// Linearised sets that are kept, by their number of pigments.
const KEPT: [usize; 4] = [6, 20, 24, 8];
/// Sets of three that are extended by each other pigment.
const BEAM: usize = 8;
/// Sets that are refined in measured reflectance: about the nearest film of the table, then about the best
/// set of these.
const REFINED: [usize; 2] = [32, 24];
/// Gauss-Newton steps of each set, of one that may be among the best, and of the best one at the end.
const STEPS: [usize; 3] = [1, 2, 3];
/// Score above the best after the first step from which a set is not refined further.
const HOPELESS: f32 = 12.0;
/// Penalty of a pigment among linearised sets, before what its share costs is known.
const SHORTLIST_PENALTY: f32 = 6.0;
/// Score above the best from which a linearised set is not refined.
const FAR: f32 = 30.0;
/// Chi-square of three pigments relative to that of the best pair from which they are passed over.
const WORSE: f64 = 1.5;
/// All that a search needs, but the pixel.
#[derive(Debug, Clone)]
pub(crate) struct Engine {
    pub(crate) films: Films,
    pub(crate) table: Table,
    pub(crate) noise: WhiteningNoise,
    pub(crate) at_most: usize,
    pub(crate) scores: Scores,
    /// Standard deviation of the logarithm of a paint's strength.
    pub(crate) strength_sd: f64,
}

/// Memory of a search, reused from pixel to pixel.
#[derive(Debug)]
pub(crate) struct Scratch {
    work: Work,
    quadratic: Quadratic,
    marks: Marks,
    pub(crate) found: Vec<SetFit>,
    by_size: [Vec<SetFit>; 4],
    shortlist: Vec<SetFit>,
    /// Least score of a refined set.
    least: f32,
}

impl Scratch {
    pub(crate) fn new(films: &Films) -> Self {
        Self {
            work: Work::new(films),
            quadratic: Quadratic::new(films.pigments),
            marks: Marks::new(films.pigments),
            found: Vec::new(),
            by_size: [const { Vec::new() }; 4],
            shortlist: Vec::new(),
            least: f32::INFINITY,
        }
    }
}

impl Engine {
    /// The engine for a scan whose palette holds each pigment with these probabilities.
    pub(crate) fn with_palette(&self, palette: &[f32]) -> Self {
        Self { scores: self.scores.with_palette(palette), ..self.clone() }
    }

    /// Searches all sets, beginning at the film `place` of the table. The sets are left in `scratch.found`,
    /// the best first.
    pub(crate) fn search(&self, pixel: &Pixel, place: usize, scratch: &mut Scratch) {
        scratch.found.clear();
        scratch.least = f32::INFINITY;
        let (internal, inverse) = self.table.film(place);
        self.films.products(pixel, (internal, inverse), &mut scratch.work);
        self.shortlist(scratch);
        for index in 0..REFINED[0].min(scratch.shortlist.len()) {
            self.add_refined(pixel, index, scratch);
        }
        let Some(winner) = scratch
            .found
            .iter()
            .copied()
            .reduce(|a: SetFit, b: SetFit| if b.score < a.score { b } else { a })
        else {
            return;
        };
        let parts: Vec<(usize, f32)> = winner.parts().collect();
        let (internal, inverse) = self.films.film(&parts);
        self.films.products(pixel, (&internal, &inverse), &mut scratch.work);
        self.shortlist(scratch);
        let mut refined = 0;
        for index in 0..scratch.shortlist.len() {
            let key = scratch.shortlist[index].key();
            let near =
                scratch.shortlist[index].score < scratch.least + FAR * self.scores.steepest();
            if near && refined < REFINED[1] && scratch.found.iter().all(|found| found.key() != key)
            {
                self.add_refined(pixel, index, scratch);
                refined += 1;
            }
        }
        self.sort(pixel, &mut scratch.found);
    }

    /// Sorts sets by their scores, after the best one is refined further.
    pub(crate) fn sort(&self, pixel: &Pixel, found: &mut [SetFit]) {
        let order =
            |a: &SetFit, b: &SetFit| a.score.total_cmp(&b.score).then(a.key().cmp(&b.key()));
        found.sort_unstable_by(order);
        let Some(best) = found.first_mut() else { return };
        let difference = best.refine(&self.films, pixel, STEPS[2]);
        best.score = self.scores.of_set(best, &difference);
        found.sort_unstable_by(order);
    }

    /// Refines a set in measured reflectance by `steps`, and tells its score.
    pub(crate) fn refined(&self, pixel: &Pixel, mut set: SetFit, steps: usize) -> SetFit {
        let difference = set.refine(&self.films, pixel, steps);
        set.score = self.scores.of_set(&set, &difference);
        set
    }

    fn add_refined(&self, pixel: &Pixel, index: usize, scratch: &mut Scratch) {
        let mut set = scratch.shortlist[index];
        let first = set.refine(&self.films, pixel, STEPS[0]);
        set.score = self.scores.of_set(&set, &first);
        if set.score < scratch.least + HOPELESS * self.scores.steepest() {
            let second = set.refine_from(first, &self.films, pixel, STEPS[1]);
            set.score = self.scores.of_set(&set, &second);
        }
        scratch.least = scratch.least.min(set.score);
        scratch.found.push(set);
    }

    /// Best sets of the linearised problem, in `scratch.shortlist`, the best first. Those far from the best score
    /// that was refined are left out, or in the beginning those far from the best of these.
    fn shortlist(&self, scratch: &mut Scratch) {
        let Scratch { work, quadratic, marks, by_size, shortlist, least, .. } = scratch;
        let count = self.films.pigments;
        quadratic.read(work);
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
            // A third pigment that does not save much on the best pair is of no use.
            let least = singles.iter().chain(&*pairs).map(|set| set.chi2).reduce(f32::min);
            let limit = f64::from(least.unwrap_or(f32::INFINITY)) * WORSE + f64::from(FAR);
            quadratic.triples(limit, marks, |members, shares, chi2| {
                keep(triples, KEPT[2], quadratic.fit(members, shares, chi2));
                let full = triples.len() == KEPT[2];
                triples.last().filter(|_| full).map_or(limit, |last| f64::from(last.chi2))
            });
        }
        if self.at_most > 3 {
            for triple in triples.iter().take(BEAM) {
                let [a, b, c] = [0, 1, 2].map(|i| usize::from(triple.members[i]));
                for d in (0..count).filter(|d| ![a, b, c].contains(d)) {
                    // Several sets of three lead to the same set of four.
                    if let Some(set) = quadratic.set([a, b, c, d])
                        && fours.iter().all(|known| known.key() != set.key())
                    {
                        keep(fours, KEPT[3], set);
                    }
                }
            }
        }
        shortlist.clear();
        for set in by_size.iter().flatten() {
            let penalty = SHORTLIST_PENALTY * set.len() as f32;
            let score = self.scores.misfit(set.chi2) + penalty + self.scores.of_pigments(set);
            shortlist.push(SetFit { score, ..*set });
        }
        let best = shortlist.iter().map(|set| set.score).fold(f32::INFINITY, f32::min);
        let best = if least.is_finite() { *least } else { best };
        let far = best + FAR * self.scores.steepest();
        shortlist.retain(|set| set.score < far);
        shortlist.sort_unstable_by(|a: &SetFit, b: &SetFit| {
            a.score.total_cmp(&b.score).then(a.key().cmp(&b.key()))
        });
    }
}

fn is_kept(list: &[SetFit], most: usize, chi2: f32) -> bool {
    list.len() < most || list.last().is_none_or(|last| chi2 < last.chi2)
}

/// Adds `set` to a list of at most `most` sets, sorted by chi-square.
fn keep(list: &mut Vec<SetFit>, most: usize, set: SetFit) {
    if !is_kept(list, most, set.chi2) {
        return;
    }
    if list.len() < most {
        list.push(set);
    }
    let mut place = list.len() - 1;
    while place > 0 && set.chi2 < list[place - 1].chi2 {
        list[place] = list[place - 1];
        place -= 1;
    }
    list[place] = set;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::films::film::Films;
    use crate::films::noise::{ModelError, Noise};
    use crate::films::paints::Paints;

    /// An engine for the oils that ship, their paints, and their bands.
    fn oils(at_most: usize) -> (Engine, Paints) {
        let library = pigment::PigmentLibrary::van_gogh_oils();
        let nm: Vec<f64> = library.grid.wavelengths_nm().collect();
        let bands = crate::films::bands::Bands::new(&nm, library.grid).unwrap();
        let paints = Paints::new(&library, &[], &bands).unwrap();
        let noise = Noise::new(&bands, 0.003, &ModelError::Stated(0.1));
        let films = Films::new(&paints);
        let table = Table::new(&paints, &films, &noise);
        let scores = Scores::new((paints.count(), bands.count()), 2.0, noise.tail);
        let noise = WhiteningNoise::new(&noise);
        (Engine { films, table, noise, at_most, scores, strength_sd: 0.0 }, paints)
    }

    fn found(engine: &Engine, paints: &Paints, truth: &[(usize, f64)]) -> Vec<SetFit> {
        let reflectance: Vec<f32> = paints.reflectance(truth).iter().map(|r| *r as f32).collect();
        let place = engine.table.nearest(&engine.table.projection.of(&reflectance));
        let pixel = engine.films.pixel(&engine.noise, &reflectance);
        let mut scratch = Scratch::new(&engine.films);
        engine.search(&pixel, place, &mut scratch);
        scratch.found
    }

    #[test]
    fn exact_films_are_explained_by_their_own_pigments() {
        let (engine, paints) = oils(3);
        let place = |name: &str| paints.place(name).unwrap();
        let white = place("Zinc White");
        let black = place("Bone Black");
        for truth in [
            vec![(place("Viridian"), 1.0)],
            vec![(white, 0.8), (place("Viridian"), 0.2)],
            vec![(white, 0.97), (place("Prussian Blue"), 0.03)],
            vec![(black, 0.05), (place("Vermilion"), 0.95)],
            vec![(white, 0.5), (black, 0.1), (place("Viridian"), 0.4)],
            vec![(white, 0.3), (place("Cobalt Blue"), 0.3), (place("Chrome Yellow"), 0.4)],
        ] {
            let found = found(&engine, &paints, &truth);
            let own = found.iter().min_by(|a, b| a.chi2.total_cmp(&b.chi2)).unwrap();
            let best = found[0];
            assert!(own.chi2 < 0.01, "{truth:?}: {own:?}");
            assert!(best.chi2 < 1.0 && best.len() <= truth.len(), "{truth:?}: {best:?}");
            for &(pigment, share) in &truth {
                let told = own.parts().find(|part| part.0 == pigment).map_or(0.0, |part| part.1);
                assert!((f64::from(told) - share).abs() < 0.01, "{truth:?}: {own:?}");
            }
            assert!(found.windows(2).all(|pair| pair[0].score <= pair[1].score), "sorted");
        }
    }

    #[test]
    fn sets_are_no_greater_than_asked_for() {
        for at_most in 1..=4 {
            let (engine, paints) = oils(at_most);
            let found = found(&engine, &paints, &[(1, 0.4), (4, 0.1), (10, 0.3), (13, 0.2)]);
            let greatest = found.iter().map(SetFit::len).max();
            assert!(greatest.is_some_and(|most| most <= at_most), "{at_most}: {greatest:?}");
            if at_most == 4 {
                assert!(found[0].chi2 < 1.0, "{:?}", found[0]);
            }
        }
    }
}
