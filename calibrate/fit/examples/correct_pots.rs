//! Corrects pots of paint that were weighed badly, with paints that differ from the library. Prints the colour error of
//! the pots from their standards before and after the correction, and the error that the correction expected:
//! `cargo run --release -p impasto-calibrate --example correct_pots [READINGS [POTS [SEED]]]`.
//!
//! We deal the mixtures of a file of readings into halves and fit a library to each, both with all masstones. The
//! corrections use one library. The pots are made of the paints of the other. Every pot holds white and one to three other paints,
//! each weighed with an error of 15 %. The standard is the colour that the recipe has with the real paints, then the
//! colour that the library predicts for it.

use std::error::Error;
use std::io::Write;

use calibrate::matching::{Batch, BatchRound, ColorTarget, CorrectRequest, Corrections};
use calibrate::{FitRequest, PreparedFit, Readings};
use documents::Task;
use pigment::evaluate::lab;
use pigment::{PigmentLibrary, Viewing};
use rand::seq::index;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp1, StandardNormal};
use spectra::color::{Lab, delta_e_ciede2000};
use spectra::{Reflectance, Spectrum};

/// Paint in a pot, in grams.
const POT: f64 = 500.0;
/// Standard deviation of the logarithm of what was weighed against what should have been.
const WEIGHING: f64 = 0.15;
/// Standard deviation of a reading, as a fraction of itself, and common to all wavelengths.
const READING: f64 = 0.001;
/// Shares of the white in a pot.
const WHITE: std::ops::Range<f64> = 0.2..0.95;

/// Names of the paints in a pot, each with its grams.
type Parts = Vec<(String, f64)>;

fn main() -> Result<(), Box<dyn Error>> {
    let oils = concat!(env!("CARGO_MANIFEST_DIR"), "/../../measurements/van-gogh-oils.csv");
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().unwrap_or_else(|| oils.to_owned());
    let pots = arguments.next().map_or(Ok(50), |text| text.parse())?;
    let seed: u64 = arguments.next().map_or(Ok(1), |text| text.parse())?;
    let readings = Readings::open(path)?;
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (library, reality) = halves(&readings, &mut random)?;
    let mut out = std::io::stdout().lock();
    for (name, standard) in [("the same paints", &reality), ("the library's colour", &library)] {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let trial = Trial { library: &library, reality: &reality, standard };
        let rounds = (0..pots).map(|_| trial.pot(&mut random)).collect::<Result<Vec<_>, _>>()?;
        for (round, wanted) in [("first round", 0), ("second round", 1)] {
            let pots: Vec<&Outcome> = rounds.iter().filter_map(|pot| pot.get(wanted)).collect();
            writeln!(out, "standard of {name}, {round}: {}", summary(&pots))?;
        }
    }
    Ok(())
}

/// Libraries of two halves of the mixtures.
fn halves(
    readings: &Readings,
    random: &mut ChaCha8Rng,
) -> Result<(PigmentLibrary, PigmentLibrary), Box<dyn Error>> {
    let prepared = PreparedFit::new(readings, &FitRequest::default(), &Task::default())?;
    let swatches = prepared.set.swatches.iter();
    let mut mixtures: Vec<(Vec<bool>, u64, String)> = swatches
        .filter(|swatch| swatch.shares.iter().filter(|share| **share > 0.0).count() > 1)
        .map(|swatch| {
            let pigments = swatch.shares.iter().map(|share| *share > 0.0).collect();
            (pigments, random.random(), swatch.sample.clone())
        })
        .collect();
    // Mixtures of the same paints go to both halves.
    mixtures.sort();
    let mut libraries = Vec::new();
    for half in [0, 1] {
        let other = mixtures.iter().skip(half).step_by(2);
        let exclude = other.map(|(_, _, sample)| sample.clone()).collect();
        let fit = calibrate::fit(readings, &FitRequest { exclude, ..FitRequest::default() })?;
        libraries.push(fit.library);
    }
    let second = libraries.pop().ok_or("two halves are fitted")?;
    let first = libraries.pop().ok_or("two halves are fitted")?;
    Ok((first, second))
}

struct Trial<'a> {
    library: &'a PigmentLibrary,
    reality: &'a PigmentLibrary,
    /// Library whose colour of the recipe is the standard.
    standard: &'a PigmentLibrary,
}

/// Errors of a pot in CIEDE2000 from its standard.
struct Outcome {
    before: f64,
    after: f64,
    /// Predicted distance, and the error to expect.
    predicted: f64,
    expected: f64,
    grams: f64,
    foreign: bool,
}

impl Trial<'_> {
    fn pot(&self, random: &mut ChaCha8Rng) -> Result<Vec<Outcome>, Box<dyn Error>> {
        let made = self.recipe(random);
        let mut pot: Parts = made.clone();
        for (_, grams) in &mut pot {
            let error: f64 = StandardNormal.sample(random);
            *grams *= (WEIGHING * error).exp();
        }
        let standard = color(self.standard, &made)?;
        let target = ColorTarget::measured("standard", standard.clone());
        let mut rounds = Vec::new();
        let mut earlier = Vec::new();
        for _ in 0..2 {
            let truth = color(self.reality, &pot)?;
            let grams = pot.iter().map(|(_, grams)| grams).sum();
            let reflectance = reading(&truth, random)?;
            let batch = Batch {
                made: made.clone(),
                grams,
                reflectance: reflectance.clone(),
                rounds: earlier.clone(),
            };
            let request = CorrectRequest::default();
            let found = request.run(self.library, &target, &batch, &Task::default())?;
            let before = apart(&standard, &truth);
            let added = added(self.library, &found);
            for (name, grams) in &added {
                add(&mut pot, name, *grams);
            }
            let foreign = added.iter().any(|(name, _)| made.iter().all(|(known, _)| known != name));
            earlier.push(BatchRound { reflectance, added: added.clone() });
            let after = apart(&standard, &color(self.reality, &pot)?);
            let (predicted, expected) = promised(&found);
            let grams = added.iter().map(|(_, grams)| grams).sum();
            rounds.push(Outcome { before, after, predicted, expected, grams, foreign });
        }
        Ok(rounds)
    }

    /// White and one to three other paints that both libraries know.
    fn recipe(&self, random: &mut ChaCha8Rng) -> Parts {
        let white = self.library.reference.clone().unwrap_or_default();
        let real = self.reality.pigments.iter().filter(|pigment| pigment.identified);
        let known: Vec<&str> = real.map(|pigment| pigment.name.as_str()).collect();
        let others: Vec<&str> = (self.library.pigments.iter())
            .filter(|pigment| {
                pigment.identified && pigment.name != white && known.contains(&&*pigment.name)
            })
            .map(|pigment| pigment.name.as_str())
            .collect();
        let count = random.random_range(1..=3);
        let drawn: Vec<(usize, f64)> = index::sample(random, others.len(), count)
            .into_iter()
            .map(|at| (at, Exp1.sample(random)))
            .collect();
        let total: f64 = drawn.iter().map(|(_, part)| part).sum();
        let share = random.random_range(WHITE);
        let mut parts = vec![(white, POT * share)];
        parts.extend(
            drawn
                .iter()
                .map(|(at, part)| (others[*at].to_owned(), POT * (1.0 - share) * part / total)),
        );
        parts
    }
}

fn added(library: &PigmentLibrary, found: &Corrections) -> Parts {
    let first = found.corrections.first();
    let additions = first.iter().flat_map(|correction| &correction.additions);
    additions.map(|(id, grams)| (library[*id].name.clone(), *grams)).collect()
}

fn promised(found: &Corrections) -> (f64, f64) {
    match found.corrections.first() {
        Some(correction) => (correction.distance, correction.expected),
        None => (found.batch_delta_e[0], found.batch_delta_e[0]),
    }
}

fn add(parts: &mut Parts, name: &str, grams: f64) {
    match parts.iter_mut().find(|(known, _)| known == name) {
        Some((_, known)) => *known += grams,
        None => parts.push((name.to_owned(), grams)),
    }
}

fn color(library: &PigmentLibrary, parts: &Parts) -> Result<Spectrum<Reflectance>, Box<dyn Error>> {
    let parts = parts.iter().map(|(name, grams)| (name, *grams));
    Ok(library.color(parts, &Viewing::default())?.reflectance)
}

fn reading(
    truth: &Spectrum<Reflectance>,
    random: &mut ChaCha8Rng,
) -> Result<Spectrum<Reflectance>, Box<dyn Error>> {
    let common: f64 = StandardNormal.sample(random);
    let read = truth.values().iter().map(|value| {
        let own: f64 = StandardNormal.sample(random);
        (value * (1.0 + READING * common) + 0.2 * READING * own).clamp(0.0, 1.0)
    });
    Ok(Spectrum::new(truth.grid(), read.collect())?)
}

fn apart(a: &Spectrum<Reflectance>, b: &Spectrum<Reflectance>) -> f64 {
    let weights = Viewing::default().weights(a.grid()).expect("the method fits the grid");
    let [a, b]: [Lab; 2] = [a, b].map(|spectrum| lab(&weights, spectrum.values()));
    delta_e_ciede2000(a, b)
}

fn mean(pots: &[&Outcome], of: fn(&Outcome) -> f64) -> f64 {
    pots.iter().map(|pot| of(pot)).sum::<f64>() / pots.len() as f64
}

fn summary(pots: &[&Outcome]) -> String {
    let worse: Vec<&&Outcome> = pots.iter().filter(|pot| pot.after > pot.before + 0.05).collect();
    let largest = pots.iter().map(|pot| pot.after).fold(0.0, f64::max);
    format!(
        "{:.2} -> {:.2}, largest {largest:.2}, predicted {:.2}, expected {:.2}, worse {}, foreign {}, {:.0} g",
        mean(pots, |pot| pot.before),
        mean(pots, |pot| pot.after),
        mean(pots, |pot| pot.predicted),
        mean(pots, |pot| pot.expected),
        worse.len(),
        pots.iter().filter(|pot| pot.foreign).count(),
        mean(pots, |pot| pot.grams),
    )
}
