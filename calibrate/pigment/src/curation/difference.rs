//! How far apart two libraries of the same pigments are: quality control of
//! batches.

use rand::SeedableRng;
use rand::seq::index;
use rand_chacha::ChaCha8Rng;
use spectra::TristimulusWeights;
use spectra::color::{Lab, delta_e_ciede2000};

use crate::evaluate::{Viewing, lab};
use crate::library::PigmentLibrary;

/// Shares of a tint: one part in ten of the white.
const TINT: [f64; 2] = [1.0, 9.0];

/// The colour difference of one pigment, CIEDE2000.
#[derive(Debug, Clone, PartialEq)]
pub struct PigmentDifference {
    /// Its name, the same in both.
    pub name: String,
    /// Between the masstones.
    pub masstone: f64,
    /// Between the tints 1:9 in the common white; none where S is not known or
    /// there is no common white.
    pub tint: Option<f64>,
}

/// The colour difference of two pigments mixed.
#[derive(Debug, Clone, PartialEq)]
pub struct PigmentPair {
    /// Their names.
    pub names: [String; 2],
    /// CIEDE2000 of 1:1, or 1:1:1 with the common white.
    pub delta_e: f64,
}

/// What differs between two libraries under one light, in films that hide.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// The white of tints and pairs: the reference of the first, if both have it.
    pub white: Option<String>,
    /// By pigment, in the first's order.
    pub pigments: Vec<PigmentDifference>,
    /// Pairs of common pigments whose S is known.
    pub pairs: Vec<PigmentPair>,
    /// Pigments of the first alone.
    pub only_first: Vec<String>,
    /// Pigments of the second alone.
    pub only_second: Vec<String>,
}

impl Difference {
    /// The largest of all differences; 0 if nothing is common.
    #[must_use]
    pub fn largest(&self) -> f64 {
        let of_pigments = self.pigments.iter().flat_map(|p| [Some(p.masstone), p.tint]);
        let of_pairs = self.pairs.iter().map(|pair| Some(pair.delta_e));
        of_pigments.chain(of_pairs).flatten().fold(0.0, f64::max)
    }
}

/// The differences of pigments of the same name, and of up to `pairs` mixtures of
/// two, drawn with `seed` from all there are. Each library is seen on its own grid
/// and under its own surface.
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
    let (in_first, in_second) = (names(first), names(second));
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

/// One of the two.
struct Side<'a> {
    library: &'a PigmentLibrary,
    weights: TristimulusWeights,
}

impl<'a> Side<'a> {
    fn new(library: &'a PigmentLibrary, viewing: &Viewing) -> Self {
        let weights = viewing.weights(library.grid).expect("a method for the grid");
        Self { library, weights }
    }

    fn index(&self, name: &str) -> usize {
        let mut pigments = self.library.pigments.iter();
        pigments.position(|pigment| pigment.name == name).expect("a common pigment")
    }

    fn identified(&self, name: &str) -> bool {
        self.library.pigments[self.index(name)].identified
    }

    fn lab(&self, recipe: &[(&str, f64)]) -> Lab {
        let parts: Vec<(usize, f64)> =
            recipe.iter().map(|(name, part)| (self.index(name), *part)).collect();
        let mixture = self.library.mix(&parts).expect("parts above 0");
        lab(&self.weights, &mixture.hiding(self.library.saunderson))
    }
}
