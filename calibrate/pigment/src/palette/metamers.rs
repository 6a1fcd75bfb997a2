//! Pairs of paints that match under one light and part under another.

use spectra::color::{Lab, Xyz, delta_e_cie76, delta_e_ciede2000, metamerism_index};

use super::constancy::TestLight;
use super::paints::{Appearance, Palette, Recipe};
use super::samples::MeasuredSample;

/// Pairs of paints are tried at these shares of the first.
const SHARES: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];
/// And with these parts of white.
const WHITES: [f64; 3] = [0.0, 1.5, 6.0];

/// Two colours nearly alike under the first light.
#[derive(Debug, Clone, PartialEq)]
pub struct Metamers {
    /// What they are: a measured sample, or a recipe in words.
    pub names: [String; 2],
    /// Their recipes.
    pub recipes: [Recipe; 2],
    /// By light: how the two look.
    pub colors: Vec<[Appearance; 2]>,
    /// By light: CIEDE2000 between the two as they are.
    pub differences: Vec<f64>,
    /// By light: the special metamerism index (CIE 15:2018, section 9.2), the
    /// second corrected for what they differ by under the first light; 0 there.
    pub indices: Vec<f64>,
}

struct Candidate {
    name: String,
    recipe: Recipe,
    paints: Vec<usize>,
    xyz: Vec<Xyz>,
    lab: Lab,
}

/// The pairs nearer than `alike` CIEDE2000 under the first of `lights` that part
/// most under any other, by metamerism index; `count` at most, the worst first,
/// no colour twice.
///
/// Tried are the measured samples, every paint, and every two paints at five
/// ratios, with and without white. Two mixtures of the same pigments do not
/// count. Black pairs (L* below 5), where the index rests on noise, do not
/// either.
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
    // In order of lightness, only a window of each needs to be looked at:
    // CIEDE2000 is at least the lightness difference over its largest weight.
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

/// CIEDE2000 within `alike`. The Euclidean distance, which is cheap, sieves
/// first: it is less than eight times CIEDE2000 but for the most vivid blues.
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
    let look = |light: usize| {
        let white = lights[light].weights.white();
        [first, second].map(|candidate| Appearance::of(candidate.xyz[light], white))
    };
    let colors: Vec<[Appearance; 2]> = (0..lights.len()).map(look).collect();
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
    let candidate = |name: String, recipe: Recipe, reflectance: &[f64]| {
        let mut paints: Vec<usize> = recipe.iter().map(|(p, _)| *p).collect();
        paints.sort_unstable();
        let xyz: Vec<Xyz> = lights.iter().map(|light| light.weights.xyz(reflectance)).collect();
        let lab = Lab::from_xyz(xyz[0], lights[0].weights.white());
        Candidate { name, recipe, paints, xyz, lab }
    };
    let mut recipes: Vec<Recipe> = Vec::new();
    for &paint in palette.paints() {
        recipes.extend(WHITES.iter().map(|&parts| palette.tint(paint, parts)));
    }
    for (a, b) in palette.pairs() {
        for share in SHARES {
            let pair = [(a, share), (b, 1.0 - share)];
            recipes.extend(WHITES.iter().map(|&parts| palette.thinned(&pair, parts)));
        }
    }
    let read = measured.iter().map(|sample| {
        let name =
            format!("{} ({}, measured)", palette.recipe_label(&sample.recipe), sample.sample);
        candidate(name, sample.recipe.clone(), &sample.reflectance)
    });
    let mixed = recipes.into_iter().map(|recipe| {
        let reflectance = palette.reflectance(&recipe);
        candidate(palette.recipe_label(&recipe), recipe, &reflectance)
    });
    read.chain(mixed).collect()
}
