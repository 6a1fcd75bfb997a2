//! Pigments that the bands of a scan cannot tell apart, told from K, S and the noise alone.

use crate::films::film::Pixel;
use crate::films::paints::Paints;
use crate::films::settings::PigmentGroup;
use crate::map_error::MapError;
use crate::search::engine::Engine;
use crate::search::set_fit::SetFit;

/// Parts of a companion's optical strength in the films that are compared.
const COMPANION_PARTS: [f64; 3] = [0.2, 0.5, 0.8];
/// Gauss-Newton steps of a comparison.
const STEPS: usize = 6;
/// Probability of taking one pigment for another from which they are one group. Two pigments that
/// cannot be told apart at all have 0.5.
pub const ALIKE: f64 = 0.12;

/// Mean probabilities of taking one pigment for another, by pair.
#[derive(Debug, Clone, PartialEq)]
pub struct Confusion {
    count: usize,
    of_pair: Vec<f64>,
}

impl Confusion {
    /// Mean probability, 0 to 0.5, of taking pigment `a` for pigment `b` or the other way round, over films
    /// of one of them with each other pigment.
    ///
    /// # Panics
    /// If `a` or `b` is not the place of a pigment.
    #[must_use]
    pub fn of(&self, a: usize, b: usize) -> f64 {
        self.of_pair[a * self.count + b]
    }

    /// Compares all pigments of `paints`.
    pub(crate) fn new(engine: &Engine, paints: &Paints) -> Self {
        use rayon::prelude::*;
        let count = paints.count();
        let pairs: Vec<(usize, usize)> =
            (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b))).collect();
        let found: Vec<f64> = (pairs.par_iter())
            .map(|&(a, b)| {
                f64::midpoint(taken_for(engine, paints, a, b), taken_for(engine, paints, b, a))
            })
            .collect();
        let mut of_pair = vec![0.5; count * count];
        for (&(a, b), &confusion) in pairs.iter().zip(&found) {
            of_pair[a * count + b] = confusion;
            of_pair[b * count + a] = confusion;
        }
        Self { count, of_pair }
    }

    /// Groups of two pigments or more, each as rising places: the two most alike are joined first, as long as
    /// the mean over all pairs of a group stays at [`ALIKE`] or above.
    #[must_use]
    pub fn groups(&self) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = (0..self.count).map(|p| vec![p]).collect();
        loop {
            let mut best: Option<(f64, usize, usize)> = None;
            for first in 0..groups.len() {
                for second in first + 1..groups.len() {
                    let pairs = (groups[first].iter())
                        .flat_map(|&a| groups[second].iter().map(move |&b| self.of(a, b)));
                    let values: Vec<f64> = pairs.collect();
                    let mean = values.iter().sum::<f64>() / values.len() as f64;
                    if mean >= ALIKE && best.is_none_or(|(most, ..)| mean > most) {
                        best = Some((mean, first, second));
                    }
                }
            }
            let Some((_, first, second)) = best else { break };
            let joined = groups.remove(second);
            groups[first].extend(joined);
            groups[first].sort_unstable();
        }
        groups.retain(|group| group.len() > 1);
        groups
    }
}

/// Mean probability of taking `a` for `b` in films of `a`, alone and with each other pigment.
fn taken_for(engine: &Engine, paints: &Paints, a: usize, b: usize) -> f64 {
    let mut found = vec![probability(engine, paints, &[(a, 1.0)], &[(b, 1.0)])];
    for other in (0..paints.count()).filter(|other| ![a, b].contains(other)) {
        let ratio = paints.strength(a) / paints.strength(other);
        for part in COMPANION_PARTS {
            let weight = ratio * part / (1.0 - part);
            let own = 1.0 / (1.0 + weight);
            let with = weight / (1.0 + weight);
            let start = [(b, own), (other, with)];
            found.push(probability(engine, paints, &[(a, own), (other, with)], &start));
        }
    }
    found.sort_by(f64::total_cmp);
    found[found.len() / 4]
}

/// Probability of taking the film `truth` for the best film of the pigments of `start`.
fn probability(
    engine: &Engine,
    paints: &Paints,
    truth: &[(usize, f64)],
    start: &[(usize, f64)],
) -> f64 {
    let reflectance: Vec<f32> = paints.reflectance(truth).iter().map(|r| *r as f32).collect();
    let pixel: Pixel = engine.films.pixel(&engine.noise, &reflectance);
    let mut set = match *start {
        [(a, _)] => SetFit::new([a], [1.0], f32::INFINITY),
        [(a, x), (b, y), ..] => SetFit::new([a, b], [x as f32, y as f32], f32::INFINITY),
        [] => return 0.0,
    };
    set.refine(&engine.films, &pixel, STEPS);
    // The nearer of two hypotheses at a distance of d standard deviations is wrong with the probability
    // that a normal variable exceeds d / 2.
    normal_above(0.5 * f64::from(set.chi2.max(0.0)).sqrt())
}

/// Probability that a standard normal variable exceeds `z`, 0 and up, to 2e-7 (Abramowitz and Stegun 1964,
/// eq. 26.2.17).
fn normal_above(z: f64) -> f64 {
    let t = 1.0 / (1.0 + 0.231_641_9 * z);
    let series = t
        * (0.319_381_530
            + t * (-0.356_563_782
                + t * (1.781_477_937 + t * (-1.821_255_978 + t * 1.330_274_429))));
    (-0.5 * z * z).exp() / (2.0 * std::f64::consts::PI).sqrt() * series
}

/// A pigment of a map, or a group of pigments that it shows as one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Name of the pigment or group.
    pub name: String,
    /// Names of its pigments; one for a pigment by itself.
    pub pigments: Vec<String>,
}

/// Columns of a map of `paints`: the groups that the user named, those of `alike` pigments that are in none,
/// and each other pigment by itself, in the order of their first pigments.
///
/// # Errors
/// [`MapError::Name`] for an unknown pigment, [`MapError::TwoGroups`] for one in two groups.
pub(crate) fn columns(
    paints: &Paints,
    named: &[PigmentGroup],
    find: impl Fn(&str) -> Result<String, pigment::RecipeError>,
    alike: &[Vec<usize>],
) -> Result<Vec<Column>, MapError> {
    let mut group_of: Vec<Option<usize>> = vec![None; paints.count()];
    let mut names: Vec<String> = Vec::new();
    for group in named {
        for pigment in &group.pigments {
            let name = find(pigment)?;
            // A pigment outside the palette takes no part.
            let Some(place) = paints.place(&name) else { continue };
            if let Some(first) = group_of[place].filter(|&first| first != names.len()) {
                let first = names[first].clone();
                let second = group.name.clone();
                return Err(MapError::TwoGroups { pigment: name, first, second });
            }
            group_of[place] = Some(names.len());
        }
        names.push(group.name.clone());
    }
    for group in alike {
        let free: Vec<usize> = group.iter().copied().filter(|&p| group_of[p].is_none()).collect();
        if free.len() > 1 {
            free.iter().for_each(|&p| group_of[p] = Some(names.len()));
            names.push(
                free.iter().map(|&p| paints.names[p].as_str()).collect::<Vec<_>>().join(" / "),
            );
        }
    }
    let mut columns: Vec<Column> = Vec::new();
    let mut column_of_group: Vec<Option<usize>> = vec![None; names.len()];
    for (pigment, group) in paints.names.iter().zip(&group_of) {
        let known = group.and_then(|group| column_of_group[group]);
        if let Some(column) = known {
            columns[column].pigments.push(pigment.clone());
            continue;
        }
        if let Some(group) = group {
            column_of_group[*group] = Some(columns.len());
        }
        let name = group.map_or_else(|| pigment.clone(), |group| names[group].clone());
        columns.push(Column { name, pigments: vec![pigment.clone()] });
    }
    Ok(columns)
}
