//! Pairs of mixtures that match under one light and differ under another. You also learn how far each
//! paint's colour shifts from one light to another.

use std::collections::BTreeSet;

use spectra::color::{
    Adaptation, Lab, Xyz, adapt, delta_e_cie76, delta_e_ciede2000, metamerism_index,
};
use spectra::{Illuminant, TristimulusWeights};

use super::paints::{MeasuredSample, Palette};
use crate::color::Appearance;
use crate::evaluate::Viewing;
use crate::recipe::{PigmentId, Recipe};

/// We try each pair at these shares of the first paint. We chose them by eye.
const SHARES: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];
/// We try each mixture with these parts of white. We chose them by eye.
const WHITES: [f64; 3] = [0.0, 1.5, 6.0];

/// Two colours that nearly match under the first light.
#[derive(Debug, Clone, PartialEq)]
pub struct Metamers {
    /// Names of the two: a measured sample, or a recipe in words.
    pub names: [String; 2],
    /// Recipes of the two.
    pub recipes: [Recipe; 2],
    /// By light: the colours of the two.
    pub colors: Vec<[Appearance; 2]>,
    /// By light: CIEDE2000 between the two. We do not correct it for the first light.
    pub differences: Vec<f64>,
    /// By light: the special metamerism index (CIE 15:2018, section 9.2). We correct the second colour for
    /// the difference under the first light, so the index of this light is 0.
    pub indices: Vec<f64>,
}

struct Candidate {
    name: String,
    recipe: Recipe,
    paints: Vec<PigmentId>,
    xyz: Vec<Xyz>,
    lab: Lab,
}

/// Finds pairs that differ by less than `alike` CIEDE2000 under the first of `lights` and differ most under
/// another one by the metamerism index. You get at most `count` pairs, the worst first. No colour occurs
/// twice.
///
/// We try the measured samples, every paint, and every two paints at five ratios, with and without white.
/// We do not count two mixtures of the same pigments, nor pairs with L* below 5, because noise dominates
/// their index.
#[must_use]
pub fn metamers(
    palette: &Palette<'_>,
    lights: &[TestLight],
    measured: &[MeasuredSample],
    alike: f64,
    count: usize,
) -> Vec<Metamers> {
    let mut candidates = candidates(palette, lights, measured);
    candidates.retain(|candidate| candidate.lab.lightness >= 5.0);
    // CIEDE2000 is at least the lightness difference divided by its largest weight. We sort candidates by
    // lightness, so we need to compare each only with those in a window.
    candidates.sort_by(|a, b| a.lab.lightness.total_cmp(&b.lab.lightness));
    let window = 1.8 * alike;
    let ratios = Ratios::of(&candidates, lights);
    let mut worst = WorstPairs::new(count);
    for (i, first) in candidates.iter().enumerate() {
        let near = candidates[i + 1..]
            .iter()
            .take_while(|second| second.lab.lightness - first.lab.lightness <= window);
        for (j, second) in (i + 1..).zip(near) {
            // Of many thousand pairs we look closely only at those that may be among the worst.
            if ratios.most(i, j) < worst.floor
                || first.paints == second.paints
                || !near_in_lab(first.lab, second.lab, alike)
            {
                continue;
            }
            let indices = (1..lights.len()).filter_map(|light| index(first, second, lights, light));
            worst.push((indices.fold(0.0, f64::max), i, j));
        }
    }
    let chosen = worst.disjoint(count).into_iter();
    chosen.map(|(_, i, j)| described(&candidates[i], &candidates[j], lights)).collect()
}

/// Index of a pair, and the places of its colours among the candidates.
type IndexedPair = (f64, usize, usize);

/// The pairs that may be among the worst `count` ones without a common colour.
struct WorstPairs {
    count: usize,
    pairs: Vec<IndexedPair>,
    /// Pairs below this index are not among the worst.
    floor: f64,
    /// We look for a higher floor when we have this many pairs.
    room: usize,
}

impl WorstPairs {
    /// Pairs that we keep before we look for a floor (chosen by time).
    const ROOM: usize = 4096;

    fn new(count: usize) -> Self {
        Self { count, pairs: Vec::new(), floor: 0.0, room: Self::ROOM }
    }

    fn push(&mut self, pair: IndexedPair) {
        if pair.0 < self.floor {
            return;
        }
        self.pairs.push(pair);
        if self.pairs.len() < self.room {
            return;
        }
        // Each chosen pair excludes at most two of these, so that the last chosen is no better than the last of
        // them.
        let enough = (2 * self.count).saturating_sub(1).max(1);
        if let Some(last) = self.disjoint(enough).get(enough - 1) {
            self.floor = last.0;
            self.pairs.retain(|pair| pair.0 >= last.0);
        }
        self.room = Self::ROOM.max(2 * self.pairs.len());
    }

    /// The worst pairs of which no two share a colour, at most `count`.
    fn disjoint(&mut self, count: usize) -> Vec<IndexedPair> {
        self.pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let mut taken = BTreeSet::new();
        let mut chosen = Vec::new();
        for &pair in &self.pairs {
            if chosen.len() == count {
                break;
            }
            if !taken.contains(&pair.1) && !taken.contains(&pair.2) {
                taken.extend([pair.1, pair.2]);
                chosen.push(pair);
            }
        }
        chosen
    }
}

/// Cube roots from which we know the largest index that a pair can have, without a cube root for each pair.
struct Ratios {
    /// By candidate and channel: of XYZ under the first light.
    first: Vec<[f64; 3]>,
    /// By candidate, light and channel: of XYZ under the light divided by XYZ under the first, both relative to
    /// white.
    others: Vec<[f64; 3]>,
    /// Number of lights but the first.
    lights: usize,
    /// Whether a candidate is so dark that L*a*b* has a straight line for the cube root.
    is_dark: Vec<bool>,
}

/// CIEDE2000 is at most this many times the distance in L*a*b*: it stretches a* by up to 1.5 near grey, and by
/// 1.37 where hue and chroma act together in the blues.
const MOST_STRETCH: f64 = 2.06;

impl Ratios {
    fn of(candidates: &[Candidate], lights: &[TestLight]) -> Self {
        let whites: Vec<[f64; 3]> =
            lights.iter().map(|light| light.weights.white().to_array()).collect();
        let mut found = Self {
            first: Vec::with_capacity(candidates.len()),
            others: Vec::with_capacity(candidates.len() * lights.len()),
            lights: lights.len().saturating_sub(1),
            is_dark: Vec::with_capacity(candidates.len()),
        };
        for candidate in candidates {
            let relative: Vec<[f64; 3]> = candidate
                .xyz
                .iter()
                .zip(&whites)
                .map(|(xyz, white)| {
                    let xyz = xyz.to_array();
                    [0, 1, 2].map(|channel| xyz[channel] / white[channel])
                })
                .collect();
            let first = relative[0];
            found.first.push(first.map(f64::cbrt));
            let others = relative[1..].iter();
            found
                .others
                .extend(others.map(|other| {
                    [0, 1, 2].map(|channel| (other[channel] / first[channel]).cbrt())
                }));
            // The line ends at (24/116)^3 = 0.009, and the pair's other colour may be a bit darker.
            found.is_dark.push(!relative.iter().flatten().all(|value| *value > 0.02));
        }
        found
    }

    /// At least the index of a pair, infinite if a colour reflects nothing.
    fn most(&self, i: usize, j: usize) -> f64 {
        let first = self.first[i];
        let is_dark = self.is_dark[i] || self.is_dark[j];
        let of = |candidate: usize| &self.others[candidate * self.lights..][..self.lights];
        let mut most: f64 = 0.0;
        for (a, b) in of(i).iter().zip(of(j)) {
            let [x, y, z] = [0, 1, 2].map(|channel| first[channel] * (a[channel] - b[channel]));
            let (red, blue) =
                if is_dark { (x.abs() + y.abs(), y.abs() + z.abs()) } else { (x - y, y - z) };
            let square = (116.0 * y).powi(2) + (500.0 * red).powi(2) + (200.0 * blue).powi(2);
            if square.is_nan() {
                return f64::INFINITY;
            }
            most = most.max(square);
        }
        MOST_STRETCH * most.sqrt()
    }
}

/// Whether two colours differ by `alike` CIEDE2000 or less. We test the cheap Euclidean distance first. It
/// is less than eight times CIEDE2000, except for the most vivid blues.
fn near_in_lab(first: Lab, second: Lab, alike: f64) -> bool {
    delta_e_cie76(first, second) <= 8.0 * alike && delta_e_ciede2000(first, second) <= alike
}

fn index(first: &Candidate, second: &Candidate, lights: &[TestLight], light: usize) -> Option<f64> {
    metamerism_index(
        [first.xyz[0], first.xyz[light]],
        [second.xyz[0], second.xyz[light]],
        lights[light].weights.white(),
    )
    .ok()
}

fn described(first: &Candidate, second: &Candidate, lights: &[TestLight]) -> Metamers {
    let colors: Vec<[Appearance; 2]> = (0..lights.len())
        .map(|light| {
            let white = lights[light].weights.white();
            [first, second].map(|candidate| Appearance::of(candidate.xyz[light], white))
        })
        .collect();
    let all = 0..lights.len();
    Metamers {
        names: [first.name.clone(), second.name.clone()],
        recipes: [first.recipe.clone(), second.recipe.clone()],
        differences: colors.iter().map(|[a, b]| delta_e_ciede2000(a.lab, b.lab)).collect(),
        indices: all.map(|light| index(first, second, lights, light).unwrap_or(0.0)).collect(),
        colors,
    }
}

fn candidates(
    palette: &Palette<'_>,
    lights: &[TestLight],
    measured: &[MeasuredSample],
) -> Vec<Candidate> {
    let mut recipes: Vec<Recipe> = Vec::new();
    for &paint in palette.paints() {
        recipes.extend(WHITES.iter().map(|&parts| palette.tint(paint, parts)));
    }
    for (a, b) in palette.pairs() {
        for share in SHARES {
            let pair = Recipe::from([(a, share), (b, 1.0 - share)]);
            recipes.extend(WHITES.iter().map(|&parts| palette.thinned(&pair, parts)));
        }
    }
    let read = measured.iter().map(|sample| {
        let name =
            format!("{} ({}, measured)", palette.recipe_label(&sample.recipe), sample.sample);
        candidate(lights, name, sample.recipe.clone(), &sample.reflectance)
    });
    let mixed = recipes.into_iter().map(|recipe| {
        let reflectance = palette.reflectance(&recipe);
        candidate(lights, palette.recipe_label(&recipe), recipe, &reflectance)
    });
    read.chain(mixed).collect()
}

fn candidate(lights: &[TestLight], name: String, recipe: Recipe, reflectance: &[f64]) -> Candidate {
    let mut paints: Vec<PigmentId> = recipe.pigments().collect();
    paints.sort_unstable();
    let xyz: Vec<Xyz> = lights.iter().map(|light| light.weights.xyz(reflectance)).collect();
    let lab = Lab::from_xyz(xyz[0], lights[0].weights.white());
    Candidate { name, recipe, paints, xyz, lab }
}

/// We show a palette under these lights, besides its own.
const LIGHTS: [&str; 3] = ["D65", "A", "FL11"];

/// A light under which you see a palette.
#[derive(Debug, Clone, PartialEq)]
pub struct TestLight {
    /// Name of the light.
    pub name: String,
    /// Tristimulus weights on the library's grid, for the palette's observer.
    pub weights: TristimulusWeights,
}

/// Colours of one recipe under several lights.
#[derive(Debug, Clone, PartialEq)]
pub struct ColorShift {
    /// Paints with their shares.
    pub recipe: Recipe,
    /// Colour under each light, relative to that light's white.
    pub colors: Vec<Appearance>,
    /// By light: CIEDE2000 between the colour under the first light and the colour under this one,
    /// adapted to the first light (Bradford), 0 for the first.
    pub shifts: Vec<f64>,
}

/// The palette's own light, followed by D65, A and FL11, each if it differs from the first.
#[must_use]
pub fn test_lights(palette: &Palette<'_>) -> Vec<TestLight> {
    let own = palette.viewing();
    let first =
        TestLight { name: own.illuminant.name().to_owned(), weights: palette.weights().clone() };
    let others = LIGHTS.iter().filter(|name| **name != own.illuminant.name()).map(|name| {
        let illuminant = Illuminant::named(name).expect("a CIE illuminant is shipped");
        let viewing = Viewing { illuminant, observer: own.observer };
        let weights = viewing.weights(palette.library().grid).expect("the method fits the grid");
        TestLight { name: (*name).to_owned(), weights }
    });
    std::iter::once(first).chain(others).collect()
}

/// Computes the shift of each recipe from the first of `lights` to each of them. This is the difference
/// that you still see when your eye has adapted. It is 0 for a paint of constant colour.
#[must_use]
pub fn color_shifts(
    palette: &Palette<'_>,
    lights: &[TestLight],
    recipes: &[Recipe],
) -> Vec<ColorShift> {
    recipes
        .iter()
        .map(|recipe| {
            let reflectance = palette.reflectance(recipe);
            let xyz: Vec<Xyz> =
                lights.iter().map(|light| light.weights.xyz(&reflectance)).collect();
            let whites: Vec<Xyz> = lights.iter().map(|light| light.weights.white()).collect();
            let all = 0..lights.len();
            let under_first = all.clone().map(|at| {
                let xyz = if at == 0 {
                    xyz[0]
                } else {
                    adapt(xyz[at], whites[at], whites[0], Adaptation::Bradford)
                };
                Lab::from_xyz(xyz, whites[0])
            });
            let labs: Vec<Lab> = under_first.collect();
            ColorShift {
                recipe: recipe.clone(),
                colors: all.map(|at| Appearance::of(xyz[at], whites[at])).collect(),
                shifts: labs.iter().map(|lab| delta_e_ciede2000(labs[0], *lab)).collect(),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::paints::Cards;
    use super::*;
    use crate::library::PigmentLibrary;

    /// The worst pairs by looking at every pair.
    fn worst_of_all(pairs: &mut [IndexedPair], count: usize) -> Vec<IndexedPair> {
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let mut chosen: Vec<IndexedPair> = Vec::new();
        for &(index, i, j) in &*pairs {
            let is_new =
                chosen.iter().all(|(_, a, b)| ![*a, *b].contains(&i) && ![*a, *b].contains(&j));
            if is_new && chosen.len() < count {
                chosen.push((index, i, j));
            }
        }
        chosen
    }

    #[test]
    fn few_pairs_are_kept_and_the_worst_are_among_them() {
        for (colors, count) in [(400, 8), (30, 8), (5, 8), (400, 1)] {
            let mut worst = WorstPairs::new(count);
            let mut all = Vec::new();
            let mut random: u64 = 1;
            for _ in 0..200_000 {
                random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                let [i, j] = [40, 20].map(|shift| (random >> shift) as usize % colors);
                let index = ((random >> 33) % 10_000) as f64 / 1000.0;
                worst.push((index, i, j));
                all.push((index, i, j));
            }
            assert_eq!(worst.disjoint(count), worst_of_all(&mut all, count), "{colors}, {count}");
            let most = if colors == 5 { 200_001 } else { 3 * WorstPairs::ROOM };
            assert!(worst.pairs.len() < most, "{colors}, {count}: {}", worst.pairs.len());
        }
    }

    #[test]
    fn no_pair_has_a_larger_index_than_its_bound() {
        let library = PigmentLibrary::van_gogh_oils();
        let viewing = Viewing::default();
        let palette = Palette::new(&library, &viewing, Cards::standard(library.grid)).unwrap();
        let lights = test_lights(&palette);
        let candidates = candidates(&palette, &lights, &[]);
        let ratios = Ratios::of(&candidates, &lights);
        // The bound of dark colours holds for all.
        let dark =
            Ratios { is_dark: vec![true; candidates.len()], ..Ratios::of(&candidates, &lights) };
        let mut close = 0;
        for i in 0..candidates.len() {
            for j in (i + 1..candidates.len()).step_by(17) {
                let [first, second] = [i, j].map(|at| &candidates[at]);
                if !near_in_lab(first.lab, second.lab, 4.0) {
                    continue;
                }
                let indices =
                    (1..lights.len()).filter_map(|light| index(first, second, &lights, light));
                let worst = indices.fold(0.0, f64::max);
                let most = ratios.most(i, j);
                assert!(worst <= most, "{} and {}: {worst} > {most}", first.name, second.name);
                assert!(most <= dark.most(i, j), "{} and {}", first.name, second.name);
                close += usize::from(most < 6.0 * worst);
            }
        }
        assert!(close > 1000, "{close} bounds are close");
    }
}
