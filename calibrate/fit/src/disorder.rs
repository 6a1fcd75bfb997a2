//! Recipes that stand beside the wrong readings.
//!
//! If rows of recipes and readings are mixed up, a fit explains the colours hardly better than their mean
//! does. We then try other orders of the recipes, and say which one explains the colours.

use documents::Task;
use pigment::PigmentId;
use pigment::evaluate::{Viewing, lab};
use pigment::library::SampleEvidence;
use spectra::color::{Lab, delta_e_ciede2000};
use spectra::optics::Surface;

use crate::calibration::calibrate;
use crate::fit::{FitSettings, Method};
use crate::observation::Observation;
use crate::swatch::{Swatch, SwatchSet};

/// Recipes by which a quick fit (method `weighted`) explains less than this share of the colour differences
/// are doubtful. It explains 0.89 of the oils of Van Gogh and all of the acrylics of Kimera, and with shuffled
/// recipes 0.28 at most (8 shuffles of each).
const DOUBTFUL: f64 = 0.5;
/// We try a quick fit if the fit itself explains less than this. A flexible fit hides shuffled recipes: of the
/// acrylics, with one sample for each unknown, it then explains up to 0.79, and 0.95 or more of both sets as
/// measured.
const SUSPECT: f64 = 0.9;
/// A fit with a smaller mean CIEDE2000 is not suspect: the samples may all have nearly one colour.
const LEAST_ERROR: f64 = 4.0;
/// Another order must explain at least this much more (chosen by eye).
const GAIN: f64 = 0.2;

/// Share of the colour differences between the samples that a fit explains: 1 minus the mean CIEDE2000 of
/// the fit divided by the mean CIEDE2000 from the mean colour. 1 is perfect, and 0 is no better than one
/// colour for all. `None` without differences.
pub(crate) fn explained(
    set: &SwatchSet,
    observations: &[Observation],
    per_sample: &[SampleEvidence],
    viewing: &Viewing,
) -> Option<f64> {
    let weights = viewing.weights(set.grid).expect("the method fits the grid");
    let samples = per_sample.iter().filter_map(|sample| {
        let film = observations.iter().find(|film| film.sample == sample.sample)?;
        Some((lab(&weights, &film.as_read), sample.delta_e))
    });
    let samples: Vec<(Lab, f64)> = samples.collect();
    let count = samples.len() as f64;
    let mean = |axis: usize| samples.iter().map(|(lab, _)| lab.to_array()[axis]).sum::<f64>();
    let [l, a, b] = [0, 1, 2].map(|axis: usize| mean(axis) / count);
    let mean = Lab { lightness: l, a, b };
    let spread: f64 = samples.iter().map(|(lab, _)| delta_e_ciede2000(mean, *lab)).sum();
    let error: f64 = samples.iter().map(|(_, error)| error).sum();
    (spread > 0.0).then(|| 1.0 - error / spread)
}

/// A fit of `set` with recipes that are to be checked.
pub(crate) struct SuspectFit<'a> {
    pub(crate) set: &'a SwatchSet,
    pub(crate) reference: PigmentId,
    pub(crate) surface: Surface,
    pub(crate) settings: &'a FitSettings,
    pub(crate) viewing: &'a Viewing,
}

/// Whether the recipes of a fit that explains the share `explained`, with the mean error `mean`, are to be
/// checked.
pub(crate) fn is_suspect(explained: Option<f64>, mean: f64) -> bool {
    mean > LEAST_ERROR && explained.is_some_and(|share| share < SUSPECT)
}

impl SuspectFit<'_> {
    /// A warning that the recipes explain little, with the order that explains more. `None` if a quick fit
    /// explains enough: then the method is to blame, and not the recipes.
    pub(crate) fn warning(&self, task: &Task) -> Option<String> {
        let all: Vec<Option<&Swatch>> = self.set.swatches.iter().map(Some).collect();
        let now = self.reordered(&all, task).unwrap_or(0.0);
        if now >= DOUBTFUL {
            return None;
        }
        let mut text = format!(
            "the recipes explain only {:.0} % of the differences between the colours, so that K and S mean nothing: recipes and readings probably do not belong together",
            100.0 * now.max(0.0)
        );
        let tried = orders(self.set).into_iter().filter_map(|(order, words)| {
            let recipes: Vec<Option<&Swatch>> =
                order.iter().map(|at| at.map(|at| &self.set.swatches[at])).collect();
            Some((self.reordered(&recipes, task)?, words))
        });
        let best = tried.max_by(|a, b| a.0.total_cmp(&b.0));
        match best {
            Some((share, words)) if share > DOUBTFUL && share > now + GAIN => {
                text += &format!("; they explain {:.0} % {words}", 100.0 * share);
            }
            _ => {
                text += "; we tried recipes one row higher and lower, in reverse order, and sorted by name, and none of these explains them";
            }
        }
        Some(text)
    }

    /// Share that a quick fit explains if each swatch takes the recipe at its place in `recipes`.
    fn reordered(&self, recipes: &[Option<&Swatch>], task: &Task) -> Option<f64> {
        let pairs = self.set.swatches.iter().zip(recipes);
        let swatches = pairs.filter_map(|(swatch, recipe)| {
            let recipe = (*recipe)?;
            let amounts = recipe.amounts.clone();
            Some(Swatch { amounts, shares: recipe.shares.clone(), ..swatch.clone() })
        });
        let whole = SwatchSet { swatches: swatches.collect(), ..self.set.clone() };
        // Drops pigments that lost their only sample.
        let set = whole.retaining(|_| true);
        let name = &self.set.pigments[self.reference.index()];
        let reference = PigmentId(set.pigments.iter().position(|pigment| pigment == name)?);
        let settings = FitSettings { method: Method::Weighted, ..self.settings.clone() };
        let found = calibrate(&set, reference, self.surface, &settings, self.viewing, task).ok()?;
        let evidence = found.library.evidence?;
        explained(&set, &found.observations, &evidence.per_sample, self.viewing)
    }
}

/// For each swatch the index of the recipe that it takes.
type Order = Vec<Option<usize>>;

/// Orders in which recipes may stand, each with its description.
fn orders(set: &SwatchSet) -> Vec<(Order, &'static str)> {
    let count = set.swatches.len();
    let names: Vec<&str> = set.swatches.iter().map(|swatch| swatch.sample.as_str()).collect();
    let by_text = sorted(&names, |name| vec![(0, name.to_lowercase())]);
    let by_number = sorted(&names, numbered);
    let all = [
        ((0..count).map(|at| at.checked_sub(1)).collect(), "if each stands one row lower"),
        (
            (0..count).map(|at| Some(at + 1).filter(|next| *next < count)).collect(),
            "if each stands one row higher",
        ),
        ((0..count).rev().map(Some).collect(), "in reverse order"),
        (of(&by_text), "if the readings are sorted by name as text (1, 10, 2)"),
        (inverse(&by_text), "if the recipes are sorted by name as text (1, 10, 2)"),
        (of(&by_number), "if the readings are sorted by number (1, 2, 10)"),
        (inverse(&by_number), "if the recipes are sorted by number (1, 2, 10)"),
    ];
    let mut found: Vec<(Order, &'static str)> = Vec::new();
    for (order, words) in all {
        let is_same = order.iter().enumerate().all(|(at, recipe)| *recipe == Some(at));
        if !is_same && found.iter().all(|(other, _)| *other != order) {
            found.push((order, words));
        }
    }
    found
}

/// Indices of `names` in the order of their keys.
fn sorted<K: Ord>(names: &[&str], key: impl Fn(&str) -> K) -> Vec<usize> {
    let mut indices: Vec<usize> = (0..names.len()).collect();
    indices.sort_by_key(|&at| key(names[at]));
    indices
}

fn of(order: &[usize]) -> Order {
    order.iter().copied().map(Some).collect()
}

fn inverse(order: &[usize]) -> Order {
    let mut inverse = vec![None; order.len()];
    for (place, &at) in order.iter().enumerate() {
        inverse[at] = Some(place);
    }
    inverse
}

/// A name as numbers and the texts between them.
fn numbered(name: &str) -> Vec<(u64, String)> {
    let mut parts: Vec<(u64, String)> = Vec::new();
    let mut rest = name;
    while !rest.is_empty() {
        let digits = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let (number, after) = rest.split_at(digits);
        let text = after.find(|c: char| c.is_ascii_digit()).unwrap_or(after.len());
        let (text, after) = after.split_at(text);
        parts.push((number.parse().unwrap_or(0), text.to_lowercase()));
        rest = after;
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fitting::fit;
    use crate::readings::Readings;
    use crate::request::FitRequest;

    /// Films of white, red and blue that hide. `recipe` gives the row of the recipe that stands beside
    /// the readings of each row, and `name` the name of each row.
    fn mixed_up(
        recipe: impl Fn(usize) -> Option<usize>,
        name: impl Fn(usize) -> String,
    ) -> Readings {
        let shares = |at: usize| -> [f64; 3] {
            let red = [0.0, 1.0, 0.0, 0.5, 0.1, 0.0, 0.0, 0.3, 0.9, 0.05, 0.6, 0.2, 0.0, 0.4][at];
            let blue = [0.0, 0.0, 1.0, 0.0, 0.0, 0.5, 0.1, 0.3, 0.1, 0.0, 0.4, 0.6, 0.02, 0.0][at];
            [f64::max(1.0 - red - blue, 0.0), red, blue]
        };
        let nm: Vec<usize> = (0..16).map(|step| 400 + 20 * step).collect();
        let head: Vec<String> = nm.iter().map(ToString::to_string).collect();
        let mut text = format!("sample,White,Red,Blue,{}\n", head.join(","));
        for at in 0..14 {
            let Some(from) = recipe(at) else { continue };
            let [white, red, blue] = shares(at);
            let values = nm.iter().map(|&nm| {
                let is_long = if nm > 580 { 0.03 } else { 4.0 };
                let is_short = if nm > 500 { 5.0 } else { 0.1 };
                let k = 0.005 * white + is_long * red + is_short * blue;
                let s = white + 0.4 * red + 0.2 * blue;
                let internal = spectra::optics::infinite_film_from_ratio(k / s);
                let surface = Surface::of_most_paints(spectra::optics::Specular::Included);
                surface.measured_from_internal(internal).to_string()
            });
            let values: Vec<String> = values.collect();
            let amounts = shares(from).map(|share: f64| share.to_string()).join(",");
            text += &format!("{},{amounts},{}\n", name(at), values.join(","));
        }
        Readings::from_csv("mixed.csv", text.as_bytes()).unwrap()
    }

    #[test]
    fn the_order_that_explains_the_colours_is_told() {
        let row = |at: usize| format!("S{}", at + 1);
        let names: Vec<String> = (0..14).map(row).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let by_text = sorted(&names, |name| vec![(0, name.to_lowercase())]);
        let back = inverse(&by_text);
        let shuffled = [9, 4, 11, 0, 7, 13, 2, 5, 1, 12, 3, 8, 6, 10];
        type Recipe<'a> = &'a dyn Fn(usize) -> Option<usize>;
        for (recipe, says) in [
            (&Some as Recipe<'_>, None),
            (&|at: usize| at.checked_sub(1), Some("one row higher")),
            (&|at: usize| Some(at + 1).filter(|at| *at < 14), Some("one row lower")),
            (&|at| Some(13 - at), Some("in reverse order")),
            (&|at| Some(by_text[at]), Some("recipes are sorted by name as text")),
            (&|at| back[at], Some("readings are sorted by name as text")),
            (&|at| Some(shuffled[at]), Some("none of these explains them")),
        ] {
            let fitted = fit(&mixed_up(recipe, row), &FitRequest::default()).unwrap();
            let first = fitted.warnings().first().cloned().unwrap_or_default();
            match says {
                None => assert!(
                    fitted.explained.unwrap() > 0.9 && !first.contains("explain"),
                    "{first}"
                ),
                Some(says) => {
                    assert!(first.contains("the recipes explain only"), "{says}: {first}");
                    assert!(first.contains(says), "{says}: {first}");
                }
            }
        }
    }

    #[test]
    fn names_are_sorted_as_text_or_by_number() {
        let names = ["S10", "s2", "S1", "a3"];
        assert_eq!(sorted(&names, numbered), [3, 2, 1, 0]);
        assert_eq!(sorted(&names, |name| name.to_lowercase()), [3, 2, 0, 1]);
        assert_eq!(inverse(&[2, 0, 1]), [Some(1), Some(2), Some(0)]);
    }
}
