//! Pairs of mixtures that match under one light and differ under another. You also learn how far each
//! paint's colour shifts from one light to another.

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
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (i, first) in candidates.iter().enumerate() {
        let near = candidates[i + 1..]
            .iter()
            .take_while(|second| second.lab.lightness - first.lab.lightness <= window);
        for (j, second) in (i + 1..).zip(near) {
            if first.paints == second.paints || !near_in_lab(first.lab, second.lab, alike) {
                continue;
            }
            let worst = (1..lights.len()).filter_map(|light| index(first, second, lights, light));
            pairs.push((worst.fold(0.0, f64::max), i, j));
        }
    }
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut taken = vec![false; candidates.len()];
    let mut chosen = Vec::new();
    for (_, i, j) in pairs {
        if chosen.len() == count {
            break;
        }
        if !taken[i] && !taken[j] {
            (taken[i], taken[j]) = (true, true);
            chosen.push(described(&candidates[i], &candidates[j], lights));
        }
    }
    chosen
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
