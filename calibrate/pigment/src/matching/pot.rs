//! Estimates the content of a pot of paint from its readings: the grams of each paint, and K and S of each paint.
//!
//! A pot differs from its predicted colour for two reasons: nobody weighs exactly, and its paints differ a little from
//! the paints of the library. You correct these differently. If too little blue was weighed, more blue helps. If your
//! blue is weaker than the library's, the blue that you add is weaker too. From the readings we compute the most
//! probable errors of all weights and of all K and S (a maximum a posteriori estimate, Rodgers 2000, chapter 2). The
//! covariance of this estimate says how well we can predict an addition.
//!
//! We describe the relative errors of a paint by its strength, which scales K and S alike, and by smooth changes of
//! each curve over wavelength. How large we expect them to be follows from the standard deviations of the library
//! and from the mean error of its fit.

use nalgebra::{DMatrix, DVector};
use spectra::optics::{absorption_over_scattering, infinite_film_slope};

use super::forward::Slopes;
use crate::library::{Pigment, PigmentLibrary};
use crate::recipe::PigmentId;

/// We use no internal reflectance below this. Smaller readings say nothing about K / S.
pub(super) const LEAST_INTERNAL: f64 = 1e-4;
/// Distance in nm between nodes over wavelength. Errors of K and S change smoothly from node to node. We chose it by
/// eye.
const BEND_NM: f64 = 50.0;
/// Relative deviation of K and S of a library that states none. We chose it by eye.
const UNKNOWN: f64 = 0.1;
/// Greatest relative deviation, also of K and S that are a guess. We chose it by eye.
const GREATEST: f64 = 0.5;
/// Besides the standard deviations of a fit, which take the errors of a sample at all wavelengths as independent, K and S
/// deviate by this much for each CIEDE2000 of the mean error of the fit, since its samples were weighed with errors too.
/// A tint changes by about 8 CIEDE2000 if the amount of its pigment changes by a factor of e.
const OF_AN_ERROR: f64 = 0.15;
/// Range of the deviation by the mean error. One batch of a paint differs at least so much from another.
const BY_ERROR: [f64; 2] = [0.02, 0.3];
/// Standard deviation of a strength that you state. We chose it by eye.
const STATED_STRENGTH: f64 = 0.03;
/// Standard deviation of a reading of reflectance.
const READING: f64 = 0.002;
/// Relative deviation of K / S of a mixture from the rule of mixing. We chose it by eye.
const MIXING: f64 = 0.01;
/// The estimate has converged after this many steps on all pots that we tried.
const STEPS: usize = 12;

/// A reading of a pot.
#[derive(Debug)]
pub(super) struct PotReading {
    /// Measured reflectance on the library's grid.
    pub(super) reflectance: Vec<f64>,
    /// Additions so far, in grams, by pigment of the pot.
    pub(super) added: Vec<f64>,
}

/// Errors to expect of one paint, in units in which each is standard normal: its strength, then K and S at nodes
/// over wavelength. We hold the change of log K and log S at each wavelength for one unit of each.
#[derive(Debug, Clone)]
pub(super) struct PaintErrors {
    pub(super) over_absorption: DMatrix<f64>,
    pub(super) over_scattering: DMatrix<f64>,
}

impl PaintErrors {
    /// Errors of a pigment of `library`. `stated` if you know its strength.
    pub(super) fn of(library: &PigmentLibrary, pigment: PigmentId, stated: bool) -> Self {
        let wavelengths_nm: Vec<f64> = library.grid.wavelengths_nm().collect();
        let pigment = &library[pigment];
        let by_error = library
            .mean_error()
            .map_or(UNKNOWN, |error| (OF_AN_ERROR * error).clamp(BY_ERROR[0], BY_ERROR[1]));
        let [k, s] = [
            (&pigment.absorption, &pigment.absorption_sd),
            (&pigment.scattering, &pigment.scattering_sd),
        ]
        .map(|(curve, sd): (&Vec<f64>, &Vec<f64>)| relative(curve, sd, pigment));
        let strength = median(&k).min(median(&s));
        let strength_sd =
            if stated { STATED_STRENGTH } else { strength.hypot(by_error).min(GREATEST) };
        let nodes = Nodes::over(&wavelengths_nm);
        let matrix = |deviations: &[f64], before: usize| {
            DMatrix::from_fn(wavelengths_nm.len(), 1 + 2 * nodes.count, |at, column| {
                if column == 0 {
                    return strength_sd;
                }
                let own = (deviations[at].powi(2) - strength.powi(2)).max(0.0).sqrt();
                let node = (column - 1).checked_sub(before * nodes.count);
                node.map_or(0.0, |node| {
                    own.hypot(by_error).min(GREATEST) * nodes.at(node, wavelengths_nm[at])
                })
            })
        };
        Self { over_absorption: matrix(&k, 0), over_scattering: matrix(&s, 1) }
    }

    fn count(&self) -> usize {
        self.over_absorption.ncols()
    }
}

/// Relative standard deviations of a curve of a pigment.
fn relative(curve: &[f64], sd: &[f64], pigment: &Pigment) -> Vec<f64> {
    if sd.is_empty() {
        let is_guess = pigment.guessed || !pigment.identified;
        return vec![if is_guess { GREATEST } else { UNKNOWN }; curve.len()];
    }
    let both = curve.iter().zip(sd);
    both.map(|(value, sd)| if *value > 0.0 { (sd / value).min(1.0) } else { 1.0 }).collect()
}

fn median(values: &[f64]) -> f64 {
    crate::evaluate::percentile(values, 50.0)
}

/// Functions of wavelength, one around each node. Their squares sum to 1 everywhere.
struct Nodes {
    first: f64,
    apart: f64,
    count: usize,
}

impl Nodes {
    fn over(wavelengths_nm: &[f64]) -> Self {
        let [first, last] = [wavelengths_nm[0], wavelengths_nm[wavelengths_nm.len() - 1]];
        let spans = ((last - first) / BEND_NM).round().max(1.0);
        Self { first, apart: (last - first) / spans, count: spans as usize + 1 }
    }

    fn at(&self, node: usize, nm: f64) -> f64 {
        let off = (nm - self.first) / self.apart.max(f64::MIN_POSITIVE) - node as f64;
        (1.0 - off.abs()).max(0.0).sqrt()
    }
}

/// The paints of a pot and what its readings say about them.
#[derive(Debug)]
pub(super) struct PotEstimate {
    /// Pigments that were made into the pot or added to it.
    pub(super) pigments: Vec<PigmentId>,
    /// Grams of each that are in the pot by the last reading.
    pub(super) grams: Vec<f64>,
    /// Strength of each paint relative to the library.
    pub(super) strengths: Vec<f64>,
    /// K and S of each paint.
    pub(super) paints: Vec<[Vec<f64>; 2]>,
    /// S of the pot, of which each part counts as a share of its mass.
    pub(super) scattering: Vec<f64>,
    errors: Vec<PaintErrors>,
    /// Change of log S of the pot for one unit of each unknown.
    over_scattering: DMatrix<f64>,
    covariance: DMatrix<f64>,
}

/// A pot to be estimated.
#[derive(Debug)]
pub(super) struct Pot<'a> {
    pub(super) library: &'a PigmentLibrary,
    pub(super) pigments: Vec<PigmentId>,
    /// Grams of each pigment that were made at first.
    pub(super) made: Vec<f64>,
    /// Grams of paint that were made at first.
    pub(super) grams: f64,
    /// Standard deviation of the logarithm of what was weighed.
    pub(super) weighing: f64,
    /// Errors of each pigment.
    pub(super) errors: Vec<PaintErrors>,
    /// Readings, at least one, in order.
    pub(super) readings: Vec<PotReading>,
}

/// K and S of the pot at a reading for some values of the unknowns.
struct Mixed {
    grams: Vec<f64>,
    /// Derivative of the grams of each pigment with respect to the log of what was weighed of each.
    over_weights: DMatrix<f64>,
    absorption: Vec<f64>,
    scattering: Vec<f64>,
}

impl Pot<'_> {
    /// Grams of each pigment that should be in the pot by the last reading.
    pub(super) fn stated_grams(&self) -> Vec<f64> {
        let added = self.readings.last().map_or(&[][..], |reading| &reading.added);
        self.made.iter().zip(added).map(|(made, added)| made + added).collect()
    }

    /// Number of unknowns. The weights of all pigments come first, then the errors of each pigment.
    fn unknowns(&self) -> usize {
        self.pigments.len() + self.errors.iter().map(PaintErrors::count).sum::<usize>()
    }

    fn first_error(&self, paint: usize) -> usize {
        self.pigments.len() + self.errors[..paint].iter().map(PaintErrors::count).sum::<usize>()
    }

    /// K and S of a paint.
    fn paint(&self, paint: usize, point: &DVector<f64>) -> [Vec<f64>; 2] {
        let pigment = &self.library[self.pigments[paint]];
        let errors = &self.errors[paint];
        let own = point.rows(self.first_error(paint), errors.count());
        let changed = |curve: &[f64], over: &DMatrix<f64>| {
            let changes = over * own;
            curve.iter().zip(changes.iter()).map(|(value, change)| value * change.exp()).collect()
        };
        [
            changed(&pigment.absorption, &errors.over_absorption),
            changed(&pigment.scattering, &errors.over_scattering),
        ]
    }

    fn mixed(&self, point: &DVector<f64>, paints: &[[Vec<f64>; 2]], added: &[f64]) -> Mixed {
        let weighed: Vec<f64> = self
            .made
            .iter()
            .enumerate()
            .map(|(at, grams)| grams * (self.weighing * point[at]).exp())
            .collect();
        let total: f64 = weighed.iter().sum();
        let shares: Vec<f64> = weighed.iter().map(|grams| grams / total).collect();
        let count = shares.len();
        let over_weights = DMatrix::from_fn(count, count, |i, j| {
            let same = if i == j { 1.0 } else { 0.0 };
            self.weighing * self.grams * shares[i] * (same - shares[j])
        });
        let grams: Vec<f64> =
            shares.iter().zip(added).map(|(share, added)| share * self.grams + added).collect();
        let all: f64 = grams.iter().sum();
        let sum = |curve: usize| {
            let mut sum = vec![0.0; self.library.grid.count()];
            for (paint, grams) in paints.iter().zip(&grams) {
                for (total, value) in sum.iter_mut().zip(&paint[curve]) {
                    *total += grams / all * value;
                }
            }
            sum
        };
        Mixed { absorption: sum(0), scattering: sum(1), grams, over_weights }
    }

    /// Change of log K and log S of the pot for one unit of each unknown.
    fn slopes(&self, paints: &[[Vec<f64>; 2]], mixed: &Mixed) -> [DMatrix<f64>; 2] {
        let all: f64 = mixed.grams.iter().sum();
        let of = |curve: usize, sum: &[f64]| {
            let mut slopes = DMatrix::zeros(sum.len(), self.unknowns());
            for (paint, curves) in paints.iter().enumerate() {
                let errors = &self.errors[paint];
                let over =
                    if curve == 0 { &errors.over_absorption } else { &errors.over_scattering };
                let first = self.first_error(paint);
                for (at, (value, sum)) in curves[curve].iter().zip(sum).enumerate() {
                    let each = value / (all * sum.max(f64::MIN_POSITIVE));
                    for column in 0..errors.count() {
                        slopes[(at, first + column)] +=
                            each * mixed.grams[paint] * over[(at, column)];
                    }
                    for weight in 0..self.pigments.len() {
                        slopes[(at, weight)] += each * mixed.over_weights[(paint, weight)];
                    }
                }
            }
            slopes
        };
        [of(0, &mixed.absorption), of(1, &mixed.scattering)]
    }

    /// The most probable pot.
    pub(super) fn estimate(self) -> PotEstimate {
        let count = self.unknowns();
        let mut point = DVector::zeros(count);
        let mut normal = DMatrix::identity(count, count);
        let measured: Vec<Vec<(f64, f64)>> =
            self.readings.iter().map(|reading| self.ratios(&reading.reflectance)).collect();
        for _ in 0..STEPS {
            let paints: Vec<_> = (0..self.pigments.len()).map(|p| self.paint(p, &point)).collect();
            normal = DMatrix::identity(count, count);
            let mut right = DVector::zeros(count);
            for (reading, measured) in self.readings.iter().zip(&measured) {
                let mixed = self.mixed(&point, &paints, &reading.added);
                let [over_k, over_s] = self.slopes(&paints, &mixed);
                let mut slopes = over_k - over_s;
                let off = measured.iter().enumerate().map(|(at, (ratio, weight))| {
                    let predicted = mixed.absorption[at].max(f64::MIN_POSITIVE).ln()
                        - mixed.scattering[at].max(f64::MIN_POSITIVE).ln();
                    weight * (ratio - predicted)
                });
                let off = DVector::from_iterator(measured.len(), off);
                for (mut row, (_, weight)) in slopes.row_iter_mut().zip(measured) {
                    row *= *weight;
                }
                // The linear problem at this point, for the unknowns themselves rather than for a step.
                right += slopes.transpose() * (off + &slopes * &point);
                normal += slopes.transpose() * &slopes;
            }
            let Some(factor) = normal.clone().cholesky() else { break };
            point = factor.solve(&right);
        }
        let covariance =
            normal.cholesky().map_or_else(|| DMatrix::identity(count, count), |f| f.inverse());
        self.estimated(&point, covariance)
    }

    /// Logarithm of the measured K / S, with the reciprocal of its standard deviation.
    fn ratios(&self, reflectance: &[f64]) -> Vec<(f64, f64)> {
        let surface = self.library.saunderson;
        let ratios = reflectance.iter().map(|&reading| {
            let internal = surface.internal_from_measured(reading).unwrap_or(0.0);
            let internal = internal.clamp(LEAST_INTERNAL, 1.0 - LEAST_INTERNAL);
            let ratio = absorption_over_scattering(internal);
            let slope = surface.measured_slope(internal) * infinite_film_slope(internal) * ratio;
            let deviation = (READING / slope).hypot(MIXING);
            (ratio.ln(), 1.0 / deviation)
        });
        ratios.collect()
    }

    fn estimated(self, point: &DVector<f64>, covariance: DMatrix<f64>) -> PotEstimate {
        let paints: Vec<_> = (0..self.pigments.len()).map(|p| self.paint(p, point)).collect();
        let last = &self.readings[self.readings.len() - 1];
        let mixed = self.mixed(point, &paints, &last.added);
        let [_, over_scattering] = self.slopes(&paints, &mixed);
        let strengths = (0..self.pigments.len()).map(|paint| {
            let first = self.first_error(paint);
            (point[first] * self.errors[paint].over_absorption[(0, 0)]).exp()
        });
        PotEstimate {
            strengths: strengths.collect(),
            pigments: self.pigments,
            grams: mixed.grams,
            paints,
            scattering: mixed.scattering,
            errors: self.errors,
            over_scattering,
            covariance,
        }
    }
}

impl PotEstimate {
    /// Error to expect of a mixture of the pot and of paints that you add: the root mean square change of its colour
    /// if K, S and weights have their expected errors. You give the `shares` of the mixture, and the derivatives of
    /// each residual of the target as `slopes`. The last pigment of `library` is the pot. `errors` holds the errors
    /// to expect of each pigment of the library. For a paint in the pot we use the errors that its readings leave.
    pub(super) fn spread(
        &self,
        library: &PigmentLibrary,
        errors: &[PaintErrors],
        shares: &[(PigmentId, f64)],
        slopes: &[Slopes],
    ) -> f64 {
        let pot = PigmentId(library.pigments.len() - 1);
        let mut square = 0.0;
        for row in slopes {
            let mut own = DVector::<f64>::zeros(self.covariance.nrows());
            for (pigment, share) in shares {
                let curves = &library[*pigment];
                let weighted = |slopes: &[f64], curve: &[f64]| {
                    let each = slopes.iter().zip(curve).map(|(slope, value)| slope * share * value);
                    DVector::from_iterator(slopes.len(), each)
                };
                let over_k = weighted(&row.over_absorption, &curves.absorption);
                let over_s = weighted(&row.over_scattering, &curves.scattering);
                if *pigment == pot {
                    // K follows S, since the reading gives their ratio.
                    own += self.over_scattering.tr_mul(&(over_k + over_s));
                    continue;
                }
                let known = self.pigments.iter().position(|known| known == pigment);
                let errors = known.map_or(&errors[pigment.index()], |paint| &self.errors[paint]);
                let change =
                    errors.over_absorption.tr_mul(&over_k) + errors.over_scattering.tr_mul(&over_s);
                match known {
                    Some(paint) => {
                        let before: usize =
                            self.errors[..paint].iter().map(PaintErrors::count).sum();
                        let mut rows = own.rows_mut(self.pigments.len() + before, change.len());
                        rows += change;
                    }
                    None => square += change.norm_squared(),
                }
            }
            square += own.dot(&(&self.covariance * &own));
        }
        square.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matching::forward::{Forward, Scratch};
    use crate::matching::limits::{FilmKind, RecipeLimits};
    use crate::matching::target::{Target, ViewingCondition};

    const MADE: [f64; 2] = [440.0, 60.0];

    fn oils() -> (PigmentLibrary, [PigmentId; 2]) {
        let oils = PigmentLibrary::van_gogh_oils();
        let ids = ["Zinc White", "Cobalt Blue"].map(|name| oils.find(name).unwrap());
        (oils, ids)
    }

    /// Reading of a pot of `grams` whose blue has a strength.
    fn reading(grams: [f64; 2], strength: f64, added: [f64; 2]) -> PotReading {
        let (mut oils, ids) = oils();
        oils[ids[1]].absorption.iter_mut().for_each(|k| *k *= strength);
        oils[ids[1]].scattering.iter_mut().for_each(|s| *s *= strength);
        let parts = [0, 1].map(|at| (ids[at], grams[at] + added[at]));
        let reflectance = oils.mix(parts).unwrap().hiding(oils.saunderson);
        PotReading { reflectance, added: added.to_vec() }
    }

    fn estimate(readings: Vec<PotReading>, weighing: f64, stated: bool) -> PotEstimate {
        let (oils, ids) = oils();
        let errors = ids.map(|id| PaintErrors::of(&oils, id, stated && id == ids[1]));
        let pot = Pot {
            library: &oils,
            pigments: ids.to_vec(),
            made: MADE.to_vec(),
            grams: 500.0,
            weighing,
            errors: errors.to_vec(),
            readings,
        };
        pot.estimate()
    }

    #[test]
    fn a_pot_as_its_recipe_predicts_it_stays_as_it_is() {
        let found = estimate(vec![reading(MADE, 1.0, [0.0; 2])], 0.1, false);
        assert!((found.grams[1] - 60.0).abs() < 1e-3, "{:?}", found.grams);
        assert!((found.strengths[1] - 1.0).abs() < 1e-4, "{:?}", found.strengths);
    }

    #[test]
    fn a_wrong_weight_is_found_if_the_strength_is_stated_and_the_other_way_round() {
        let weighed = estimate(vec![reading([430.0, 70.0], 1.0, [0.0; 2])], 0.3, true);
        assert!((weighed.grams[1] - 70.0).abs() < 2.5, "{:?}", weighed.grams);
        let exact = estimate(vec![reading([430.0, 70.0], 1.0, [0.0; 2])], 1e-3, false);
        assert!((exact.grams[1] - 60.0).abs() < 0.1, "{:?}", exact.grams);
        // The paints explain the reading instead, so that more of them does not change the pot.
        let (oils, _) = oils();
        let measured = &reading([430.0, 70.0], 1.0, [0.0; 2]).reflectance;
        for (at, measured) in measured.iter().enumerate() {
            let [k, s] = [0, 1].map(|curve: usize| {
                exact.paints.iter().zip(MADE).map(|(p, grams)| p[curve][at] * grams).sum::<f64>()
            });
            let internal = spectra::optics::infinite_film(k, s);
            let found = oils.saunderson.measured_from_internal(internal);
            assert!((found - measured).abs() < 0.005, "{at}: {found} {measured}");
        }
    }

    #[test]
    fn a_second_reading_tells_strength_from_weight() {
        let [once, twice] = [1, 2].map(|count| {
            let added = [0.0, 60.0].into_iter().take(count);
            let readings = added.map(|added| reading(MADE, 1.3, [0.0, added]));
            estimate(readings.collect(), 0.1, false)
        });
        let once = once.strengths[1];
        assert!((twice.strengths[1] - 1.3).abs() < (once - 1.3).abs() - 0.02, "{once} {twice:?}");
        assert!(twice.grams[1] > 110.0, "{:?}", twice.grams);
    }

    #[test]
    fn more_paint_makes_a_larger_error_and_none_makes_none() {
        let (oils, ids) = oils();
        let found = estimate(vec![reading([430.0, 70.0], 1.0, [0.0; 2])], 0.1, false);
        let errors: Vec<_> = oils.ids().map(|id| PaintErrors::of(&oils, id, false)).collect();
        let mut library = oils.clone();
        let mut pot = oils[ids[1]].clone();
        pot.scattering.clone_from(&found.scattering);
        library.pigments.push(pot);
        let last = PigmentId(library.pigments.len() - 1);
        let conditions = vec![ViewingCondition::default()];
        let limits = RecipeLimits::new(&library, conditions.clone(), FilmKind::Hiding);
        let forward = Forward::new(&library, &limits).unwrap();
        let lab = spectra::color::Lab { lightness: 50.0, a: 0.0, b: -30.0 };
        let target = Target::from_lab("", lab, &conditions);
        let [none, trace, little, much] = [0.0, 0.01, 0.05, 0.2].map(|share: f64| {
            let (pigments, shares) = ([ids[0], last], [share, 1.0 - share]);
            let slopes = forward.slopes(&target, &pigments, &shares, &mut Scratch::default());
            let parts: Vec<_> = pigments.into_iter().zip(shares).collect();
            found.spread(&library, &errors, &parts, &slopes)
        });
        assert!(none < 1e-9, "{none}");
        assert!(trace > 0.0 && much > 2.0 * little, "{much}");
    }
}
