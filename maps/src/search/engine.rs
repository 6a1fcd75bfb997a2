//! Whole search of one pixel: all sets of pigments, best first.

use super::quadratic::Quadratic;
use super::set_fit::SetFit;
use super::table::Table;
use crate::films::film::{Difference, Films, Pixel, Work};
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
/// Scores above the best beyond which a set does not matter: its weight is below 2e-3.
pub(crate) const NEGLIGIBLE: f32 = 20.0;
/// Factor by which differences of scores count less than those of exact likelihoods: the errors of a library are
/// known roughly, so that probabilities would promise too much. Chosen of 1 to 3 on simulated paintings.
const TEMPERATURE: f64 = 1.5;
/// Probability of a pigment that a survey needs nowhere.
const LEAST_LIKELY: f32 = 0.05;
/// Least addition to the score by a further pigment of a palette: -2 ln of one half.
const FURTHER: f32 = 2.0 * std::f32::consts::LN_2;

/// All that a search needs, but the pixel.
#[derive(Debug, Clone)]
pub(crate) struct Engine {
    pub(crate) films: Films,
    pub(crate) table: Table,
    pub(crate) noise: WhiteningNoise,
    pub(crate) at_most: usize,
    /// Additions to the score by number of pigments.
    pub(crate) of_count: [f32; 4],
    /// Additions to the score by pigment: none, or what a survey knows of the palette.
    pub(crate) of_pigment: Vec<f32>,
    /// Chi-square that a pigment must save of which no survey says that it is in the palette.
    pub(crate) penalty: f64,
    /// Standard deviation of the logarithm of a paint's strength.
    pub(crate) strength_sd: f64,
    /// Degrees of freedom of the residuals' distribution; infinite for a normal one.
    pub(crate) tail: f64,
}

/// Memory of a search, reused from pixel to pixel.
#[derive(Debug)]
pub(crate) struct Scratch {
    work: Work,
    quadratic: Quadratic,
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
            found: Vec::new(),
            by_size: [const { Vec::new() }; 4],
            shortlist: Vec::new(),
            least: f32::INFINITY,
        }
    }
}

impl Engine {
    /// -2 ln of the probability of a refined set, less a constant: its misfit, the part of all shares that
    /// agree with the pixel, and the prior: a set of any number of pigments is as likely as one of another, and
    /// so is any set of one number, but for what a survey tells of the palette. How often it found a set is no
    /// part of it: pixels of one paint share the errors of the library, so that they are no independent
    /// evidence. As a prior they made probabilities between 0.5 and 0.9 too high by 0.2.
    pub(crate) fn score(&self, set: &SetFit, difference: &Difference) -> f32 {
        let exactness = difference.exactness(set.len(), self.excess(set.chi2)) as f32;
        self.misfit(set.chi2) + exactness + self.prior(set)
    }

    /// Additions to the score of a set that do not depend on the pixel.
    pub(crate) fn prior(&self, set: &SetFit) -> f32 {
        self.of_count[set.len() - 1] + self.of_pigments(set)
    }

    fn of_pigments(&self, set: &SetFit) -> f32 {
        set.parts().map(|(member, _)| self.of_pigment[member]).sum()
    }

    /// Weight of a set whose score is `above` that of the best one.
    pub(crate) fn weight(above: f32) -> f64 {
        (-0.5 / TEMPERATURE * f64::from(above)).exp()
    }

    /// The engine for a scan whose palette holds each pigment with these probabilities. Pigments outside it pay
    /// for that and the penalty, and those inside it no penalty: it guards against pigments that are not there.
    pub(crate) fn with_palette(&self, palette: &[f32]) -> Self {
        let size: f64 = palette.iter().map(|p| f64::from(*p)).sum();
        let cost = |&inside: &f32| {
            let likely = LEAST_LIKELY + (1.0 - LEAST_LIKELY) * inside;
            self.penalty as f32 * (1.0 - inside) - 2.0 * likely.ln()
        };
        Self {
            of_count: Self::never_likelier(Self::of_count(size, 0.0)),
            of_pigment: palette.iter().map(cost).collect(),
            ..self.clone()
        }
    }

    /// Additions to the score by number of pigments, for `pigments` of which up to four are mixed, and each
    /// of which must save `penalty`.
    pub(crate) fn of_count(pigments: f64, penalty: f64) -> [f32; 4] {
        let mut sets = 1.0;
        std::array::from_fn(|size| {
            sets *= (pigments - size as f64).max(1.0) / (size + 1) as f64;
            (2.0 * sets.ln() + penalty * (size + 1) as f64) as f32
        })
    }

    /// The additions `of_count` raised so that each further pigment makes a set half as likely at most. A palette of
    /// three has three pairs and one triple, which would cost less than a pair.
    fn never_likelier(mut of_count: [f32; 4]) -> [f32; 4] {
        let before = of_count;
        for size in 1..of_count.len() {
            let more = before[size] - before[size - 1];
            of_count[size] = of_count[size - 1] + more.max(FURTHER);
        }
        of_count
    }

    /// -2 ln of the likelihood of a chi-square, less a constant.
    fn misfit(&self, chi2: f32) -> f32 {
        if self.tail.is_infinite() {
            return chi2;
        }
        let scale = self.tail + self.films.bands as f64;
        (scale * (f64::from(chi2.max(0.0)) / self.tail).ln_1p()) as f32
    }

    /// Greatest change of the score by chi-square.
    fn steepest(&self) -> f32 {
        if self.tail.is_infinite() {
            return 1.0;
        }
        ((self.tail + self.films.bands as f64) / self.tail) as f32
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
    pub(crate) fn search(&self, pixel: &Pixel, place: usize, scratch: &mut Scratch) {
        scratch.found.clear();
        scratch.least = f32::INFINITY;
        let (internal, inverse) = self.table.film(place);
        self.films.products(pixel, (internal, inverse), &mut scratch.work);
        self.shortlist(scratch);
        let far = scratch.shortlist.first().map_or(0.0, |best| best.score + FAR * self.steepest());
        for index in 0..REFINED[0].min(scratch.shortlist.len()) {
            if scratch.shortlist[index].score < far {
                self.add_refined(pixel, index, scratch);
            }
        }
        let best = |a: SetFit, b: SetFit| if b.score < a.score { b } else { a };
        let Some(winner) = scratch.found.iter().copied().reduce(best) else { return };
        let parts: Vec<(usize, f32)> = winner.parts().collect();
        let (internal, inverse) = self.films.film(&parts);
        self.films.products(pixel, (&internal, &inverse), &mut scratch.work);
        self.shortlist(scratch);
        let mut refined = 0;
        for index in 0..scratch.shortlist.len() {
            let key = scratch.shortlist[index].key();
            let near = scratch.shortlist[index].score < scratch.least + FAR * self.steepest();
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
        best.score = self.score(best, &difference);
        found.sort_unstable_by(order);
    }

    /// Refines a set in measured reflectance by `steps`, and tells its score.
    pub(crate) fn refined(&self, pixel: &Pixel, mut set: SetFit, steps: usize) -> SetFit {
        let difference = set.refine(&self.films, pixel, steps);
        set.score = self.score(&set, &difference);
        set
    }

    fn add_refined(&self, pixel: &Pixel, index: usize, scratch: &mut Scratch) {
        let mut set = scratch.shortlist[index];
        let first = set.refine(&self.films, pixel, STEPS[0]);
        set.score = self.score(&set, &first);
        if set.score < scratch.least + HOPELESS * self.steepest() {
            let second = set.refine_from(first, &self.films, pixel, STEPS[1]);
            set.score = self.score(&set, &second);
        }
        scratch.least = scratch.least.min(set.score);
        scratch.found.push(set);
    }

    /// Best sets of the linearised problem, in `scratch.shortlist`, the best first.
    fn shortlist(&self, scratch: &mut Scratch) {
        let Scratch { work, quadratic, by_size, shortlist, .. } = scratch;
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
            quadratic.triples(limit, |members, shares, chi2| {
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
            let score = self.misfit(set.chi2) + penalty + self.of_pigments(set);
            shortlist.push(SetFit { score, ..*set });
        }
        let order =
            |a: &SetFit, b: &SetFit| a.score.total_cmp(&b.score).then(a.key().cmp(&b.key()));
        shortlist.sort_unstable_by(order);
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
    if list.len() == most {
        list.pop();
    }
    let place = list.iter().position(|known| set.chi2 < known.chi2).unwrap_or(list.len());
    list.insert(place, set);
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
        let of_count = Engine::of_count(paints.count() as f64, 2.0);
        let (noise, tail) = (WhiteningNoise::new(&noise), noise.tail);
        (
            Engine {
                of_pigment: vec![0.0; films.pigments],
                penalty: 2.0,
                strength_sd: 0.0,
                films,
                table,
                noise,
                at_most,
                of_count,
                tail,
            },
            paints,
        )
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
        let (white, black) = (place("Zinc White"), place("Bone Black"));
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

    #[test]
    fn a_further_pigment_of_a_palette_costs_something() {
        let (engine, _) = oils(4);
        // Three whole pigments of the palette, the others hardly in it.
        let mut palette = vec![0.0; engine.films.pigments];
        palette[..3].fill(1.0);
        let few = engine.with_palette(&palette).of_count;
        for (size, pair) in few.windows(2).enumerate() {
            assert!((pair[1] - pair[0] - FURTHER).abs() < 1e-5, "{size}: {few:?}");
        }
        // Of eighteen there are 18, 153, 816 and 3060 sets.
        palette.fill(1.0);
        let many = engine.with_palette(&palette).of_count;
        for (found, sets) in many.iter().zip([18.0, 153.0, 816.0, 3060.0_f32]) {
            assert!((found - 2.0 * sets.ln()).abs() < 1e-3, "{many:?}");
        }
    }
}
