//! Groups of pigments that the bands of a scan cannot tell apart. We also sum up a pixel's shares
//! and probabilities here, and estimate the error in the strength of paints.

use calibrate::{LeftOutMixture, Residuals};

use super::book::Prepared;
use crate::films::film::{Paints, Pixel};
use crate::films::settings::PigmentGroup;
use crate::pixel_maps::{BlockMaps, MapError, Mask};
use crate::search::set_fit::{NEGLIGIBLE, Scores, SetFit, TRACE};
use crate::search::{Engine, Scratch};

/// We compare films in which a companion has these parts of the optical strength.
const COMPANION_PARTS: [f64; 3] = [0.2, 0.5, 0.8];
/// Gauss-Newton steps of a comparison.
const STEPS: usize = 6;
/// If you take one pigment for another with this probability or a higher one, we put them into one
/// group. Pigments that you cannot tell apart at all have 0.5.
pub const ALIKE: f64 = 0.12;

/// For each pair of pigments, the probability of taking one for the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Confusion {
    count: usize,
    of_pair: Vec<f64>,
}

impl Confusion {
    /// Probability, 0 to 0.5, of taking pigment `a` for pigment `b` or the other way round. For
    /// each direction we take the lower quartile over films of one pigment, alone and with each
    /// other pigment. The result is the mean of both directions.
    ///
    /// # Panics
    /// If `a` or `b` is not the index of a pigment.
    #[must_use]
    pub fn of(&self, a: usize, b: usize) -> f64 {
        self.of_pair[a * self.count + b]
    }

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

    /// Groups of two pigments or more, each as rising indices. We join the two most alike groups first,
    /// as long as the mean over all pairs between them is [`ALIKE`] or above.
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

/// Probability of taking `a` for `b`: the lower quartile over films of `a`, alone and with each
/// other pigment.
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

/// Probability of taking the film `truth` for the nearest film of the pigments of `start`.
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
    libm::exp(-0.5 * z * z) / (2.0 * std::f64::consts::PI).sqrt() * series
}

/// A pigment of a map, or a group of pigments that the map shows as one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Name of the pigment or group.
    pub name: String,
    /// Names of its pigments. A pigment by itself has one.
    pub pigments: Vec<String>,
}

/// Columns of a map of `paints`, in the order of their first pigments: the groups that the user
/// named, groups of `alike` pigments outside them, and every other pigment by itself.
///
/// # Errors
/// [`MapError::Name`] for an unknown pigment, [`MapError::TwoGroups`] if a pigment is in two
/// groups, [`MapError::GroupName`] if a group cannot have its name.
pub(crate) fn columns(
    paints: &Paints,
    named: &[PigmentGroup],
    find: impl Fn(&str) -> Result<String, pigment::RecipeError>,
    alike: &[Vec<usize>],
) -> Result<Vec<Column>, MapError> {
    let mut group_of: Vec<Option<usize>> = vec![None; paints.count()];
    let mut names: Vec<String> = Vec::new();
    for group in named {
        if let Some(expected) = documents::name_violation(&group.name) {
            return Err(MapError::GroupName { name: documents::excerpt(&group.name), expected });
        }
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

/// Results for one pixel. Lists have a number for each column of the map.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PixelResult {
    pub(crate) share: Vec<f64>,
    pub(crate) share_sd: Vec<f64>,
    pub(crate) presence: Vec<f64>,
    pub(crate) chi2: f64,
    pub(crate) rms: f64,
    /// Columns of the second-best set, as bits: the best set with other columns than the best of
    /// all. If there is none, this is 0.
    pub(crate) second: u64,
}

impl PixelResult {
    pub(crate) fn new(columns: usize) -> Self {
        Self {
            share: vec![0.0; columns],
            share_sd: vec![0.0; columns],
            presence: vec![0.0; columns],
            chi2: 0.0,
            rms: 0.0,
            second: 0,
        }
    }

    pub(crate) fn push_to(&self, maps: &mut BlockMaps) {
        maps.share.extend(self.share.iter().map(|value| *value as f32));
        maps.share_sd.extend(self.share_sd.iter().map(|value| *value as f32));
        maps.presence.extend(self.presence.iter().map(|value| *value as f32));
        maps.chi2.push(self.chi2 as f32);
        maps.rms.push(self.rms as f32);
        maps.second.push(self.second);
        maps.mask.push(Mask::Mapped);
    }

    /// Sums up the sets of a pixel. `column_of` is the column of each pigment.
    ///
    /// Presence is the weight of the sets with a share of [`TRACE`] or more, by [`Scores::weight`],
    /// and below one half where the mean share is less. Shares are means by
    /// [`Scores::weight_of_shares`]. Their variance has three parts: one from the curvature of the
    /// best set, one from the strengths of its paints, and the weighted mean square by which the
    /// sets differ.
    pub(crate) fn sum(
        &mut self,
        engine: &Engine,
        Scratch { found, of_best, .. }: &Scratch,
        column_of: &[usize],
    ) {
        self.share.fill(0.0);
        self.share_sd.fill(0.0);
        self.presence.fill(0.0);
        self.second = 0;
        let Some(best) = found.first() else { return };
        let near = found.partition_point(|set| set.score < best.score + NEGLIGIBLE);
        let near = &found[..near];
        let mut all = 0.0;
        for set in near {
            let weight = Scores::weight_of_shares(set.score - best.score);
            all += weight;
            for (member, share) in set.parts() {
                self.share[column_of[member]] += weight * f64::from(share);
            }
        }
        self.share.iter_mut().for_each(|share| *share /= all);
        let best_bits = best.columns(column_of);
        let mut total = 0.0;
        let mut shares = vec![0.0; self.share.len()];
        for set in near {
            let weight = engine.scores.weight(set.score - best.score);
            total += weight;
            let columns = set.columns(column_of);
            if self.second == 0 && columns != best_bits {
                self.second = columns;
            }
            shares.fill(0.0);
            for (member, share) in set.parts() {
                shares[column_of[member]] += f64::from(share);
            }
            for (column, share) in shares.iter().enumerate() {
                self.presence[column] += weight * f64::from(u8::from(*share >= TRACE));
                self.share_sd[column] += weight * (share - self.share[column]).powi(2);
            }
        }
        let excess = engine.scores.excess(best.chi2);
        let covariance = best.covariance(of_best);
        // A share changes with the logarithm of a paint's strength by share x (own column - column's share).
        let mut variance: Vec<f64> = (0..self.share.len())
            .map(|column: usize| -> f64 {
                let slopes = best.parts().map(|(member, share)| {
                    let own = f64::from(u8::from(column_of[member] == column));
                    (engine.strength_sd[member] * f64::from(share) * (own - self.share[column]))
                        .powi(2)
                });
                slopes.sum()
            })
            .collect();
        for (i, (a, _)) in best.parts().enumerate() {
            for (j, (b, _)) in best.parts().enumerate() {
                if column_of[a] == column_of[b] {
                    variance[column_of[a]] += covariance[i][j] * excess;
                }
            }
        }
        for ((sd, presence), variance) in
            self.share_sd.iter_mut().zip(&mut self.presence).zip(&variance)
        {
            *sd = (*sd / total + variance.max(0.0)).sqrt().min(1.0);
            *presence /= total;
        }
        for (presence, share) in self.presence.iter_mut().zip(&self.share) {
            if *share < TRACE {
                *presence = presence.min(0.5 * share / TRACE);
            }
        }
        let bands = engine.films.bands;
        let free = bands.saturating_sub(best.len() - 1).max(1) as f64;
        self.chi2 = f64::from(best.chi2) / free;
        self.rms = (f64::from(of_best.squares) / bands as f64).sqrt();
    }
}

/// A set of columns that explains a pixel.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ColumnSet {
    /// Columns with their shares, the greatest first.
    pub(crate) parts: Vec<(usize, f64)>,
    /// Probability of the set, 0 to 1. All sets of a pixel add up to 1.
    pub(crate) probability: f64,
    /// Chi-square per degree of freedom.
    pub(crate) chi2: f64,
}

/// Sets of columns among the sets `found` for a pixel, the most likely first. Sets of pigments with the same
/// columns count as one, with the shares of the best of them. Pass the best first. We weight sets by
/// [`Scores::weight`].
pub(crate) fn column_sets(
    found: &[SetFit],
    column_of: &[usize],
    engine: &Engine,
) -> Vec<ColumnSet> {
    let Some(best) = found.first() else { return Vec::new() };
    let mut sets: Vec<(u64, ColumnSet)> = Vec::new();
    for set in found.iter().take_while(|set| set.score < best.score + NEGLIGIBLE) {
        let weight = engine.scores.weight(set.score - best.score);
        let columns = set.columns(column_of);
        if let Some((_, known)) = sets.iter_mut().find(|(bits, _)| *bits == columns) {
            known.probability += weight;
            continue;
        }
        let mut parts: Vec<(usize, f64)> = Vec::new();
        for (member, share) in set.parts() {
            let column = column_of[member];
            match parts.iter_mut().find(|(known, _)| *known == column) {
                Some((_, sum)) => *sum += f64::from(share),
                None => parts.push((column, f64::from(share))),
            }
        }
        parts.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let free = engine.films.bands.saturating_sub(set.len() - 1).max(1) as f64;
        let chi2 = f64::from(set.chi2) / free;
        sets.push((columns, ColumnSet { parts, probability: weight, chi2 }));
    }
    let total: f64 = sets.iter().map(|(_, set)| set.probability).sum();
    let mut sets: Vec<ColumnSet> = sets.into_iter().map(|(_, set)| set).collect();
    for set in &mut sets {
        set.probability /= total;
    }
    sets.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    sets
}

/// Gauss-Newton steps when we fit a mixture's own pigments.
const STRENGTH_STEPS: usize = 12;
/// Part of a normal distribution within one standard deviation.
const WITHIN: f64 = 0.6827;
/// Least predicted reflectance by which we divide a measured one.
const LEAST: f64 = 1e-3;

/// Estimates the standard deviation of the logarithm of a paint's strength. We fit each mixture in
/// `residuals` with its own pigments and choose the deviation that covers 68 % of the shares. This
/// is 0 if there are no such mixtures.
///
/// A paint of a wrong strength looks like a paint with another share, and you cannot see which from
/// the spectrum.
pub(crate) fn strength_sd(prepared: &Prepared, residuals: &Residuals) -> f64 {
    let mut needed: Vec<f64> = residuals
        .mixtures
        .iter()
        .flat_map(|mixture| needed(prepared, mixture).unwrap_or_default())
        .collect();
    needed.sort_by(f64::total_cmp);
    let place = (WITHIN * needed.len() as f64) as usize;
    needed.get(place).map_or(0.0, |variance| variance.sqrt())
}

/// Variance of the logarithm of strengths that explains the error of each share of a mixture. You
/// get `None` for a mixture of one pigment, of more than four, or with pigments that take no part.
fn needed(prepared: &Prepared, mixture: &LeftOutMixture) -> Option<Vec<f64>> {
    let parts: Vec<(usize, f64)> = mixture
        .shares
        .iter()
        .map(|(name, share): (&String, &f64)| Some((prepared.paints.place(name)?, *share)))
        .collect::<Option<_>>()?;
    let start: Vec<(usize, f32)> = parts.iter().map(|&(p, share)| (p, share as f32)).collect();
    let mut set = SetFit::of_parts(&start).filter(|set| set.len() > 1)?;
    let measured = prepared.bands.fold_library(&mixture.measured);
    let predicted = prepared.bands.fold_library(&mixture.predicted);
    // This library's film, with the error that the fit without the mixture had.
    let film = prepared.paints.reflectance(&parts);
    let ratios = measured.iter().zip(&predicted).map(|(m, p)| m / p.max(LEAST));
    let off: Vec<f32> =
        film.iter().zip(ratios).map(|(film, ratio)| (film * ratio) as f32).collect();
    let engine = &prepared.engine;
    let pixel = engine.films.pixel(&engine.noise, &off);
    let truth = set.shares;
    let difference = set.refine(&engine.films, &pixel, STRENGTH_STEPS);
    let excess = engine.scores.excess(set.chi2);
    let covariance = set.covariance(&difference);
    let shares: Vec<f64> = set.parts().map(|(_, share)| f64::from(share)).collect();
    let needed = (0..shares.len()).map(|i| {
        let slopes: f64 = shares
            .iter()
            .enumerate()
            .map(|(j, share): (usize, &f64)| {
                let own = f64::from(u8::from(i == j));
                (share * (own - shares[i])).powi(2)
            })
            .sum();
        let square = (shares[i] - f64::from(truth[i])).powi(2);
        (square - covariance[i][i] * excess).max(0.0) / slopes.max(1e-9)
    });
    Some(needed.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::films::settings::{MapSettings, ModelError};
    use pigment::PigmentLibrary;

    /// The error that we find if the second paint of mixtures is `factor` times as strong as in the
    /// library.
    fn told(factor: f64) -> f64 {
        let oils = PigmentLibrary::van_gogh_oils();
        let nm: Vec<f64> = oils.grid.wavelengths_nm().collect();
        let settings = MapSettings { sensor_noise: 0.0, ..MapSettings::default() };
        let exact = ModelError::Stated(0.001);
        let prepared = Prepared::new(&oils, &nm, &settings, &exact).unwrap();
        let paints = &prepared.paints;
        let white = paints.place("Zinc White").unwrap();
        let mut residuals = Residuals::van_gogh_oils();
        residuals.mixtures.truncate(4);
        let names = ["Viridian", "Cobalt Blue", "Vermilion", "Bone Black"];
        for (mixture, name) in residuals.mixtures.iter_mut().zip(names) {
            let place = paints.place(name).unwrap();
            mixture.shares = [("Zinc White".to_owned(), 0.6), (name.to_owned(), 0.4)].into();
            mixture.predicted = paints.reflectance(&[(white, 0.6), (place, 0.4)]);
            mixture.measured = paints.reflectance(&[(white, 0.6), (place, 0.4 * factor)]);
        }
        strength_sd(&prepared, &residuals)
    }

    #[test]
    fn a_strength_that_is_off_is_told() {
        let exact = told(1.0);
        assert!(exact < 0.01, "{exact}");
        // Two paints share the error: each is off by its square root of a half.
        let off = told(1.3);
        let expected = 1.3f64.ln() / 2f64.sqrt();
        assert!((off / expected - 1.0).abs() < 0.15, "{off} {expected}");
    }

    #[test]
    fn pigments_that_take_no_part_tell_nothing() {
        let oils = PigmentLibrary::van_gogh_oils();
        let nm: Vec<f64> = oils.grid.wavelengths_nm().collect();
        let palette = vec!["Viridian".to_owned()];
        let settings = MapSettings { palette, ..MapSettings::default() };
        let prepared = Prepared::new(&oils, &nm, &settings, &ModelError::Stated(0.1)).unwrap();
        let mut residuals = Residuals::van_gogh_oils();
        assert_eq!(strength_sd(&prepared, &residuals), 0.0);
        // Two pigments of three tell no more than one of two.
        for mixture in &mut residuals.mixtures {
            mixture.shares.insert("Viridian".to_owned(), 0.3);
            mixture.shares.insert("Zinc White".to_owned(), 0.3);
        }
        residuals.mixtures.retain(|mixture| mixture.shares.len() > 2);
        assert!(residuals.mixtures.len() > 50, "{} of three or four", residuals.mixtures.len());
        let palette = vec!["Viridian".to_owned(), "Zinc White".to_owned()];
        let settings = MapSettings { palette, ..MapSettings::default() };
        let prepared = Prepared::new(&oils, &nm, &settings, &ModelError::Stated(0.1)).unwrap();
        assert_eq!(strength_sd(&prepared, &residuals), 0.0);
    }
}
