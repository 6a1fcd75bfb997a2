//! Full search of one pixel. It finds all sets of pigments that explain the pixel, best first, with
//! their shares.
//!
//! We take first guesses from a table of films: every pigment, and every pair in thirteen ratios. A
//! k-d tree finds the nearest film.

pub(crate) mod set_fit;
mod triples;

use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};

use crate::films::film::{Difference, Films, Paints, Pixel, Work};
use crate::films::settings::{Noise, Scale};
use crate::films::whitening::{Spectrum, WhiteningNoise};
use set_fit::{Scores, SetFit};
use triples::{Marks, Quadratic};

/// We keep this many of the best linearised sets of one, two, three and four pigments.
const KEPT: [usize; 4] = [6, 20, 24, 8];
/// To find sets of four, we extend this many sets of three by every further pigment.
const BEAM: usize = 8;
/// We refine this many sets in measured reflectance: first sets that we linearised about the
/// nearest film of the table, then sets that we linearised about the best of the first ones.
const REFINED: [usize; 2] = [32, 24];
/// Gauss-Newton steps: of each set, of a set that may be among the best, and of the best one at the
/// end.
const STEPS: [usize; 3] = [1, 2, 3];
/// We stop refining a set if its score after the first step exceeds the best score by this, times
/// [`Scores::steepest`].
const HOPELESS: f32 = 12.0;
/// Penalty of each pigment in linearised sets. It stands for the price of exact shares, which we
/// know only after refining.
const SHORTLIST_PENALTY: f32 = 6.0;
/// We do not refine a linearised set if its score exceeds the best score by this, times
/// [`Scores::steepest`].
const FAR: f32 = 30.0;
/// We skip sets of three if their chi-square exceeds this many times the best of one or two
/// pigments, plus [`FAR`].
const WORSE: f64 = 1.5;
/// Score and key as long as no set was found.
const NOTHING: (f32, u32) = (f32::INFINITY, u32::MAX);

/// Everything that a search needs, except the pixel.
#[derive(Debug, Clone)]
pub(crate) struct Engine {
    pub(crate) films: Films,
    pub(crate) table: Table,
    pub(crate) noise: WhiteningNoise,
    pub(crate) at_most: usize,
    pub(crate) scores: Scores,
    /// Standard deviation of the logarithm of each paint's strength.
    pub(crate) strength_sd: Vec<f64>,
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
    /// Score and key of the best refined set so far.
    best: (f32, u32),
    /// How the pixel differs from the best set.
    pub(crate) of_best: Difference,
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
            best: NOTHING,
            of_best: Difference::default(),
        }
    }

    /// Forgets the sets of the last pixel.
    pub(crate) fn clear(&mut self) {
        self.found.clear();
        self.best = NOTHING;
    }

    /// Adds a refined set with its score, and how the pixel differs from it.
    fn add(&mut self, set: SetFit, difference: Difference) {
        let place = (set.score, set.key());
        if place < self.best {
            self.best = place;
            self.of_best = difference;
        }
        self.found.push(set);
    }
}

impl Engine {
    /// The engine for a scan that holds each pigment with the probability `palette`, and has the
    /// median chi-square `median` per degree of freedom.
    pub(crate) fn with_survey(&self, palette: &[f32], median: f64) -> Self {
        Self { scores: self.scores.with_survey(palette, median), ..self.clone() }
    }

    /// Searches all sets. It starts from the film with the index `place` in the table. You find the
    /// sets in `scratch.found`, the best first.
    pub(crate) fn search(&self, pixel: &Pixel, place: usize, scratch: &mut Scratch) {
        scratch.clear();
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
                scratch.shortlist[index].score < scratch.best.0 + FAR * self.scores.steepest();
            if near && refined < REFINED[1] && scratch.found.iter().all(|found| found.key() != key)
            {
                self.add_refined(pixel, index, scratch);
                refined += 1;
            }
        }
        self.sort(pixel, scratch);
    }

    /// Refines the best set further, then sorts all by score.
    pub(crate) fn sort(&self, pixel: &Pixel, scratch: &mut Scratch) {
        let Scratch { found, best: (_, known), of_best, .. } = scratch;
        found.sort_unstable_by(order);
        let Some(best) = found.first_mut() else { return };
        if best.key() != *known {
            *of_best = best.difference(&self.films, pixel);
        }
        *of_best = best.refine_from(*of_best, &self.films, pixel, STEPS[2]);
        best.score = self.scores.of_set(best, of_best);
        let refined = best.key();
        found.sort_unstable_by(order);
        if let Some(best) = found.first().filter(|best| best.key() != refined) {
            *of_best = best.difference(&self.films, pixel);
        }
    }

    /// Refines a set in measured reflectance by `steps`, computes its score and adds it to those
    /// that `scratch` has found.
    pub(crate) fn add(&self, pixel: &Pixel, set: SetFit, steps: usize, scratch: &mut Scratch) {
        let (set, difference) = self.refined(pixel, set, steps);
        scratch.add(set, difference);
    }

    /// Refines a set in measured reflectance by `steps`. Returns it with its score, and how the
    /// pixel differs from it.
    pub(crate) fn refined(
        &self,
        pixel: &Pixel,
        mut set: SetFit,
        steps: usize,
    ) -> (SetFit, Difference) {
        let difference = set.refine(&self.films, pixel, steps);
        set.score = self.scores.of_set(&set, &difference);
        (set, difference)
    }

    fn add_refined(&self, pixel: &Pixel, index: usize, scratch: &mut Scratch) {
        let mut set = scratch.shortlist[index];
        let mut difference = set.refine(&self.films, pixel, STEPS[0]);
        set.score = self.scores.of_set(&set, &difference);
        if set.score < scratch.best.0 + HOPELESS * self.scores.steepest() {
            difference = set.refine_from(difference, &self.films, pixel, STEPS[1]);
            set.score = self.scores.of_set(&set, &difference);
        }
        scratch.add(set, difference);
    }

    /// Finds the best sets of the linearised problem and leaves them in `scratch.shortlist`, the
    /// best first. This leaves out sets far above the best refined score, or in the beginning far
    /// above the best of these sets.
    fn shortlist(&self, scratch: &mut Scratch) {
        let Scratch { work, quadratic, marks, by_size, shortlist, best: (refined, _), .. } =
            scratch;
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
        let best = if refined.is_finite() { *refined } else { best };
        let far = best + FAR * self.scores.steepest();
        shortlist.retain(|set| set.score < far);
        shortlist.sort_unstable_by(|a: &SetFit, b: &SetFit| {
            a.score.total_cmp(&b.score).then(a.key().cmp(&b.key()))
        });
    }
}

fn order(a: &SetFit, b: &SetFit) -> std::cmp::Ordering {
    a.score.total_cmp(&b.score).then(a.key().cmp(&b.key()))
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

/// Number of films of each pair in the table. The logarithms of their ratios are evenly spaced.
const RATIOS: i32 = 13;
/// The logarithms of the ratios of a pair reach this far to each side of the middle ratio.
const GREATEST: f64 = 5.0;
/// We shift the middle ratio towards the weaker pigment. Its logarithm changes by at most this.
const SHIFT: f64 = 2.0;

/// Films about which we linearise a pixel first.
#[derive(Debug, Clone)]
pub(crate) struct Table {
    /// Internal reflectance and 1/S of each film.
    films: Vec<(Spectrum, Spectrum)>,
    pub(crate) projection: Projection,
    nearest: Nearest,
}

impl Table {
    pub(crate) fn new(paints: &Paints, films: &Films, noise: &Noise) -> Self {
        let recipes = recipes(paints);
        let projection = Projection::new(paints, noise, &recipes);
        let points: Vec<Point> = recipes
            .iter()
            .map(|recipe| {
                let reflectance = paints.reflectance(recipe);
                projection.of(&reflectance.iter().map(|r| *r as f32).collect::<Vec<f32>>())
            })
            .collect();
        Self {
            films: recipes
                .iter()
                .map(|recipe: &Vec<(usize, f64)>| {
                    let shares: Vec<(usize, f32)> =
                        recipe.iter().map(|&(p, share)| (p, share as f32)).collect();
                    films.film(&shares)
                })
                .collect(),
            projection,
            nearest: Nearest::new(&points),
        }
    }

    /// Index of the film that is nearest to a projected pixel.
    pub(crate) fn nearest(&self, point: &Point) -> usize {
        let [(_, place)] = self.nearest.find::<1>(point);
        place as usize
    }

    pub(crate) fn film(&self, place: usize) -> (&Spectrum, &Spectrum) {
        let (internal, inverse) = &self.films[place];
        (internal, inverse)
    }
}

fn recipes(paints: &Paints) -> Vec<Vec<(usize, f64)>> {
    let count = paints.count();
    let mut recipes: Vec<Vec<(usize, f64)>> = (0..count).map(|p| vec![(p, 1.0)]).collect();
    for a in 0..count {
        for b in a + 1..count {
            let shift = 0.5 * libm::log(paints.strength(b) / paints.strength(a));
            for step in 0..RATIOS {
                let place = 2.0 * f64::from(step) / f64::from(RATIOS - 1) - 1.0;
                let ratio = libm::exp(GREATEST * place + shift.clamp(-SHIFT, SHIFT));
                recipes.push(vec![(a, ratio / (1.0 + ratio)), (b, 1.0 / (1.0 + ratio))]);
            }
        }
    }
    recipes
}

/// Approximate slope of the fourth root of reflectance by the logarithm of K/S for films of middle
/// lightness.
const ROOT_SLOPE: f64 = 0.15;

/// Projects a spectrum to a few coordinates in which distances tell films apart. These are the main
/// axes of all films of the table, in fourth roots of reflectance that we whiten by the library's
/// error.
#[derive(Debug, Clone)]
pub(crate) struct Projection {
    /// For each band the weights of all coordinates.
    weights: Vec<Point>,
}

impl Projection {
    fn new(paints: &Paints, noise: &Noise, recipes: &[Vec<(usize, f64)>]) -> Self {
        let bands = paints.bands();
        let reflectances = recipes.iter().map(|recipe| paints.reflectance(recipe).into_iter());
        let roots: Vec<DVector<f64>> = reflectances
            .map(|values| DVector::from_iterator(bands, values.map(|r| r.max(0.0).sqrt().sqrt())))
            .collect();
        let scale = match noise.scale {
            Scale::FourthRoot => 1.0,
            Scale::LogRatio => ROOT_SLOPE,
        };
        let covariance = DMatrix::from_fn(bands, bands, |i, j| {
            let common: f64 =
                noise.curves[i].iter().zip(&noise.curves[j]).map(|(a, b)| a * b).sum();
            // The sensor's noise on the fourth root of a reflectance of 0.1.
            let own =
                if i == j { noise.own[i] * scale * scale + 2.0 * noise.sensor[i] } else { 0.0 };
            common * scale * scale + own
        });
        let factor = Cholesky::new(covariance).map(|cholesky| cholesky.l());
        let inverse =
            factor.and_then(|l| l.solve_lower_triangular(&DMatrix::identity(bands, bands)));
        let whitening = inverse.unwrap_or_else(|| DMatrix::identity(bands, bands));
        let white: Vec<DVector<f64>> = roots.iter().map(|root| &whitening * root).collect();
        let mean = white.iter().sum::<DVector<f64>>() / white.len() as f64;
        let mut spread = DMatrix::zeros(bands, bands);
        for point in &white {
            let offset = point - &mean;
            spread += &offset * offset.transpose();
        }
        let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(spread);
        let mut order: Vec<usize> = (0..bands).collect();
        order.sort_by(|&a, &b| eigenvalues[b].total_cmp(&eigenvalues[a]));
        let mut weights = vec![[0.0; DIMENSIONS]; bands];
        for (coordinate, &axis) in order.iter().take(DIMENSIONS).enumerate() {
            let row = eigenvectors.column(axis).transpose() * &whitening;
            for (band, weights) in weights.iter_mut().enumerate() {
                weights[coordinate] = row[band] as f32;
            }
        }
        Self { weights }
    }

    pub(crate) fn of(&self, reflectance: &[f32]) -> Point {
        let mut point = [0.0; DIMENSIONS];
        for (weights, &reflectance) in self.weights.iter().zip(reflectance) {
            let root = reflectance.max(0.0).sqrt().sqrt();
            for (sum, weight) in point.iter_mut().zip(weights) {
                *sum += weight * root;
            }
        }
        point
    }
}

/// Number of coordinates of a point.
pub(crate) const DIMENSIONS: usize = 8;
const LEAF: usize = 16;

/// A spectrum in the coordinates of [`Projection`].
pub(crate) type Point = [f32; DIMENSIONS];

/// A k-d tree of points.
#[derive(Debug, Clone)]
pub(crate) struct Nearest {
    points: Vec<Point>,
    /// Index of each sorted point in the original list.
    places: Vec<u32>,
    /// Nodes of the tree in depth-first order.
    nodes: Vec<Node>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    first: u32,
    last: u32,
    /// Dimension of the split, or `DIMENSIONS` for a leaf.
    dimension: u32,
    value: f32,
    /// Index of the node above the split. The node below the split comes right after this one.
    above: u32,
}

impl Nearest {
    pub(crate) fn new(list: &[Point]) -> Self {
        let mut order: Vec<u32> = (0..list.len() as u32).collect();
        let mut nodes = Vec::new();
        split(list, &mut order, 0, &mut nodes);
        let points = order.iter().map(|&place| list[place as usize]).collect();
        Self { points, places: order, nodes }
    }

    /// Squared distances and indices of the `K` nearest points, the nearest first. If two are
    /// equally near, the smaller index comes first. If there are fewer points, the remaining
    /// indices are `u32::MAX`.
    pub(crate) fn find<const K: usize>(&self, point: &Point) -> [(f32, u32); K] {
        let mut best = [(f32::INFINITY, u32::MAX); K];
        if !self.nodes.is_empty() {
            self.visit(0, point, 0.0, &mut [0.0; DIMENSIONS], &mut best);
        }
        best
    }

    fn visit<const K: usize>(
        &self,
        node: usize,
        point: &Point,
        outside: f32,
        offsets: &mut Point,
        best: &mut [(f32, u32); K],
    ) {
        let Node { first, last, dimension, value, above } = self.nodes[node];
        let dimension = dimension as usize;
        if dimension == DIMENSIONS {
            let range = first as usize..last as usize;
            for (other, &place) in self.points[range.clone()].iter().zip(&self.places[range]) {
                let mut found = (distance(point, other), place);
                // NaN is near nothing.
                let is_near = found < best[K - 1];
                if !is_near {
                    continue;
                }
                for slot in best.iter_mut() {
                    if found < *slot {
                        std::mem::swap(slot, &mut found);
                    }
                }
            }
            return;
        }
        let offset = point[dimension] - value;
        let (near, far) =
            if offset < 0.0 { (node + 1, above as usize) } else { (above as usize, node + 1) };
        self.visit(near, point, outside, offsets, best);
        let before = offsets[dimension];
        let beyond = outside - before * before + offset * offset;
        // Rounding must not hide a point at the same distance.
        if beyond * 0.9999 <= best[K - 1].0 {
            offsets[dimension] = offset;
            self.visit(far, point, beyond, offsets, best);
            offsets[dimension] = before;
        }
    }
}

fn distance(a: &Point, b: &Point) -> f32 {
    let d: Point = std::array::from_fn(|i| (a[i] - b[i]) * (a[i] - b[i]));
    ((d[0] + d[4]) + (d[1] + d[5])) + ((d[2] + d[6]) + (d[3] + d[7]))
}

/// Sorts `order`, the part of the list from `start` on, into a tree along the widest dimensions.
fn split(list: &[Point], order: &mut [u32], start: usize, nodes: &mut Vec<Node>) {
    let node = nodes.len();
    let range = (start as u32, (start + order.len()) as u32);
    let leaf = DIMENSIONS as u32;
    nodes.push(Node { first: range.0, last: range.1, dimension: leaf, value: 0.0, above: 0 });
    let spreads: [f32; DIMENSIONS] = std::array::from_fn(|dimension| {
        let values = order.iter().map(|&place| list[place as usize][dimension]);
        let ends = values
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        ends.1 - ends.0
    });
    let dimension = (0..DIMENSIONS)
        .reduce(|a: usize, b: usize| if spreads[b] > spreads[a] { b } else { a })
        .unwrap_or(0);
    let differs = spreads[dimension] > 0.0;
    if order.len() <= LEAF || !differs {
        return;
    }
    let middle = order.len() / 2;
    let value = |place: &u32| list[*place as usize][dimension];
    order.select_nth_unstable_by(middle, |a, b| value(a).total_cmp(&value(b)).then(a.cmp(b)));
    let at = value(&order[middle]);
    // Each range is sorted by place, so that the tree does not depend on the way of selecting.
    let (below, above) = order.split_at_mut(middle);
    below.sort_unstable();
    above.sort_unstable();
    split(list, below, start, nodes);
    nodes[node].dimension = dimension as u32;
    nodes[node].value = at;
    nodes[node].above = nodes.len() as u32;
    split(list, above, start + middle, nodes);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::films::film::{Films, Paints};
    use crate::films::settings::{ModelError, Noise};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// An engine for the oils that ship, their paints, and their bands.
    fn oils(at_most: usize) -> (Engine, Paints) {
        let library = pigment::PigmentLibrary::van_gogh_oils();
        let nm: Vec<f64> = library.grid.wavelengths_nm().collect();
        let bands = crate::films::bands::Bands::new(&nm, library.grid).unwrap();
        let paints = Paints::new(&library, &[], &bands).unwrap();
        let noise = Noise::new(&bands, 0.003, &ModelError::Stated(0.1));
        let films = Films::new(&paints);
        let table = Table::new(&paints, &films, &noise);
        let scores = Scores::new(paints.count(), 2.0, noise.evidence);
        let noise = WhiteningNoise::new(&noise);
        let strength_sd = vec![0.0; paints.count()];
        (Engine { films, table, noise, at_most, scores, strength_sd }, paints)
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

    #[test]
    fn the_tree_finds_what_a_search_of_all_points_finds() {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut points = std::iter::repeat_with(|| -> Point {
            std::array::from_fn(|i| random.random::<f32>() / (1 + i) as f32)
        });
        let mut list: Vec<Point> = points.by_ref().take(3000).collect();
        list.extend_from_slice(&list.clone()[..50]);
        let tree = Nearest::new(&list);
        for wanted in points.take(200) {
            let mut all: Vec<(f32, u32)> =
                list.iter().zip(0..).map(|(p, place)| (distance(&wanted, p), place)).collect();
            all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            assert_eq!(tree.find::<4>(&wanted).as_slice(), &all[..4]);
        }
    }

    #[test]
    fn few_or_equal_points_are_found() {
        assert_eq!(Nearest::new(&[]).find::<2>(&[0.0; 8])[0].1, u32::MAX);
        let tree = Nearest::new(&[[1.0; 8]; 40]);
        let found = tree.find::<3>(&[0.0; 8]);
        assert_eq!(found.map(|(_, place)| place), [0, 1, 2]);
        assert_eq!(Nearest::new(&[[1.0; 8]]).find::<2>(&[0.0; 8])[1].1, u32::MAX);
    }
}
