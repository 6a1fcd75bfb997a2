//! Colour differences between two libraries of the same pigments, as in quality control of batches.

use rand::SeedableRng;
use rand::seq::index;
use rand_chacha::ChaCha8Rng;
use spectra::TristimulusWeights;
use spectra::color::{Lab, delta_e_ciede2000};

use crate::evaluate::{Viewing, lab};
use crate::library::PigmentLibrary;
use crate::recipe::{PigmentId, Recipe};

/// Parts of the pigment and of the white in a tint.
const TINT: [f64; 2] = [1.0, 9.0];

/// Colour difference of one pigment between two libraries, in CIEDE2000.
#[derive(Debug, Clone, PartialEq)]
pub struct PigmentDifference {
    /// Name of the pigment, equal in both libraries.
    pub name: String,
    /// Difference of the masstones.
    pub masstone: f64,
    /// Difference of the tints 1:9 in the common white; `None` where S is unknown or there is no
    /// common white.
    pub tint: Option<f64>,
}

/// Colour difference of a mixture of two pigments between two libraries.
#[derive(Debug, Clone, PartialEq)]
pub struct PigmentPair {
    /// Names of the two pigments.
    pub names: [String; 2],
    /// CIEDE2000 of the mixture 1:1, or 1:1:1 with the common white.
    pub delta_e: f64,
}

/// Differences between two libraries under one light, for films that hide.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// White of the tints and pairs: the reference of the first library, if both have it.
    pub white: Option<String>,
    /// Differences by pigment, in the order of the first library.
    pub pigments: Vec<PigmentDifference>,
    /// Differences of pairs of common pigments whose S is known.
    pub pairs: Vec<PigmentPair>,
    /// Names of pigments that only the first library has.
    pub only_first: Vec<String>,
    /// Names of pigments that only the second library has.
    pub only_second: Vec<String>,
}

impl Difference {
    /// Largest of all differences; 0 if there is no common pigment.
    #[must_use]
    pub fn largest(&self) -> f64 {
        let of_pigments = self.pigments.iter().flat_map(|p| [Some(p.masstone), p.tint]);
        let of_pairs = self.pairs.iter().map(|pair| Some(pair.delta_e));
        of_pigments.chain(of_pairs).flatten().fold(0.0, f64::max)
    }
}

/// Compares pigments of equal name, and up to `pairs` mixtures of two, drawn with `seed` from all
/// possible pairs. Each library is evaluated on its own grid and under its own surface.
#[must_use]
pub fn difference(
    first: &PigmentLibrary,
    second: &PigmentLibrary,
    viewing: &Viewing,
    pairs: usize,
    seed: u64,
) -> Difference {
    let sides = [Side::new(first, viewing), Side::new(second, viewing)];
    let names = |library: &PigmentLibrary| -> Vec<String> {
        library.pigments.iter().map(|pigment| pigment.name.clone()).collect()
    };
    let in_first = names(first);
    let in_second = names(second);
    let without = |names: &[String], others: &[String]| -> Vec<String> {
        names.iter().filter(|name| !others.contains(name)).cloned().collect()
    };
    let white = first.reference.clone().filter(|name| in_second.contains(name));
    let apart = |recipe: &[(&str, f64)]| {
        let [a, b] = [&sides[0], &sides[1]].map(|side| side.lab(recipe));
        delta_e_ciede2000(a, b)
    };
    let known = |name: &str| sides.iter().all(|side| side.identified(name));
    let common: Vec<&String> = in_first.iter().filter(|name| in_second.contains(name)).collect();
    let pigments = common
        .iter()
        .map(|name| PigmentDifference {
            name: (*name).clone(),
            masstone: apart(&[(name, 1.0)]),
            tint: white
                .as_deref()
                .filter(|white| known(name) && *white != name.as_str())
                .map(|white| apart(&[(name, TINT[0]), (white, TINT[1])])),
        })
        .collect();
    let mixed: Vec<&str> = (common.iter().map(|name| name.as_str()))
        .filter(|name| known(name) && white.as_deref() != Some(name))
        .collect();
    let all: Vec<[&str; 2]> = (0..mixed.len())
        .flat_map(|a| (a + 1..mixed.len()).map(move |b| (a, b)))
        .map(|(a, b)| [mixed[a], mixed[b]])
        .collect();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut drawn = index::sample(&mut random, all.len(), pairs.min(all.len())).into_vec();
    drawn.sort_unstable();
    let pairs = drawn.into_iter().map(|index| {
        let [a, b] = all[index];
        let mut recipe = vec![(a, 1.0), (b, 1.0)];
        recipe.extend(white.as_deref().map(|white| (white, 1.0)));
        PigmentPair { names: [a.to_owned(), b.to_owned()], delta_e: apart(&recipe) }
    });
    Difference {
        pairs: pairs.collect(),
        pigments,
        only_first: without(&in_first, &in_second),
        only_second: without(&in_second, &in_first),
        white,
    }
}

/// One of the two libraries, with the weights for its grid.
struct Side<'a> {
    library: &'a PigmentLibrary,
    weights: TristimulusWeights,
}

impl<'a> Side<'a> {
    fn new(library: &'a PigmentLibrary, viewing: &Viewing) -> Self {
        let weights = viewing.weights(library.grid).expect("the method fits the grid");
        Self { library, weights }
    }

    fn id(&self, name: &str) -> PigmentId {
        let mut ids = self.library.ids();
        ids.find(|id| self.library[*id].name == name).expect("both libraries have the pigment")
    }

    fn identified(&self, name: &str) -> bool {
        self.library[self.id(name)].identified
    }

    fn lab(&self, recipe: &[(&str, f64)]) -> Lab {
        let parts: Recipe = recipe.iter().map(|(name, part)| (self.id(name), *part)).collect();
        let mixture = self.library.mix(parts).expect("parts above 0");
        lab(&self.weights, &mixture.hiding(self.library.saunderson))
    }
}
