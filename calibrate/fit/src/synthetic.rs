//! Synthetic paint of known K and S. Use it for tests, benches and trials of a method. Nothing here was
//! measured.

use rand::seq::index;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp1, StandardNormal};
use spectra::Grid;
use spectra::optics::{Specular, Surface, absorption_over_scattering};

use crate::observation::{BLACK, Hiding, Observation};
use pigment::Curves;
use pigment::evaluate::{Viewing, delta_e};

/// Swatches that people paint of each pigment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SwatchKind {
    /// The white, and of each pigment four tints with it (2, 6, 20 and 50 %).
    Tints,
    /// The masstone, three tints with white (5, 20 and 50 %), and two shades: 10 % of black, and 5 % of black
    /// in the tint of 50 %.
    TintsAndShades,
    /// The masstone and one tint with white (20 %).
    MasstonesAndTints,
}

/// Standard deviations of the errors of swatches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SwatchErrors {
    /// Error of a reading, in reflectance.
    pub reading: f64,
    /// Error of the logarithm of each weighed amount.
    pub weighing: f64,
}

/// Mixtures of synthetic pigments, the first of which is a white with S = 1.
#[derive(Debug, Clone, PartialEq)]
pub struct SyntheticMixtures {
    /// Wavelengths of all curves.
    pub grid: Grid,
    /// Surface of the films.
    pub surface: Surface,
    /// True K and S by pigment.
    pub curves: Vec<Curves>,
    /// Reflectance of each mixture without noise.
    truth: Vec<Vec<f64>>,
    /// Observation of each mixture by a noisy instrument.
    pub observations: Vec<Observation>,
}

impl SyntheticMixtures {
    /// Data of the size of the published experiment (Baxter, Wendt and Lin 2004): 11 pigments and 71
    /// mixtures at 101 wavelengths (400 to 700 nm by 3 nm), as [`Self::of_size`] makes them.
    #[must_use]
    pub fn paper_size(seed: u64, noise: f64) -> Self {
        Self::of_size(seed, noise, Grid::from_nm(400.0, 3.0, 101).expect("a grid"), 11, 71)
    }

    /// Makes `count` mixtures: every masstone, two tints with white of each other pigment (10 % and 40 %),
    /// then random mixtures of two or three of `pigments`. Give two pigments or more. Readings on `grid`
    /// have normal noise of standard deviation `noise` in reflectance.
    ///
    /// K and S are exponentials of a level plus a few smooth bumps.
    #[must_use]
    pub fn of_size(seed: u64, noise: f64, grid: Grid, pigments: usize, count: usize) -> Self {
        let surface = Surface::of_most_paints(Specular::Included);
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let white = Curves {
            grid,
            absorption: curve(&mut random, grid, (-6.0, -5.0), 2),
            scattering: vec![1.0; grid.count()],
        };
        let mut curves = vec![white];
        for _ in 1..pigments {
            let absorption = curve(&mut random, grid, (-2.5, 1.5), 4);
            let scattering = curve(&mut random, grid, (-2.0, 0.3), 3);
            curves.push(Curves { grid, absorption, scattering });
        }
        let recipes = recipes(&mut random, pigments, count);
        let mut mixtures =
            Self { grid, surface, curves, truth: Vec::new(), observations: Vec::new() };
        let errors = SwatchErrors { reading: noise, weighing: 0.0 };
        mixtures.observe(recipes, errors, &mut random);
        mixtures
    }

    /// Swatches of the paints with K and S `curves`, the first of which is a white with S = 1 and the last a
    /// black.
    #[must_use]
    pub fn swatches(
        curves: Vec<Curves>,
        surface: Surface,
        kind: SwatchKind,
        errors: SwatchErrors,
        seed: u64,
    ) -> Self {
        let pigments = curves.len();
        let black = pigments - 1;
        let mut swatches = vec![vec![(0, 1.0)]];
        for p in 1..pigments {
            let tints: &[f64] = match kind {
                SwatchKind::Tints => &[0.02, 0.06, 0.2, 0.5],
                SwatchKind::TintsAndShades => &[0.05, 0.2, 0.5],
                SwatchKind::MasstonesAndTints => &[0.2],
            };
            if kind != SwatchKind::Tints {
                swatches.push(vec![(p, 1.0)]);
            }
            swatches.extend(tints.iter().map(|&share| vec![(0, 1.0 - share), (p, share)]));
            if kind == SwatchKind::TintsAndShades && p != black {
                swatches.push(vec![(p, 0.9), (black, 0.1)]);
                swatches.push(vec![(0, 0.475), (p, 0.475), (black, 0.05)]);
            }
        }
        let grid = curves[0].grid;
        let mut mixtures =
            Self { grid, surface, curves, truth: Vec::new(), observations: Vec::new() };
        let recipes = swatches.iter().map(|parts| shares_of(pigments, parts)).collect();
        mixtures.observe(recipes, errors, &mut ChaCha8Rng::seed_from_u64(seed));
        mixtures
    }

    /// Mean CIEDE2000 under D65 between predictions from `curves` and from the true K and S for `count`
    /// random mixtures of three paints, white among them in every second.
    #[must_use]
    pub fn error_of_mixtures(&self, curves: &[Curves], count: usize, seed: u64) -> f64 {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let weights = Viewing::default().weights(self.grid).expect("the method fits the grid");
        let mut sum = 0.0;
        for number in 0..count {
            let mut among = index::sample(&mut random, self.curves.len() - 1, 3).into_vec();
            among.iter_mut().for_each(|pigment| *pigment += 1);
            if number % 2 == 0 {
                among[0] = 0;
            }
            let parts: Vec<f64> = (0..3).map(|_| Exp1.sample(&mut random)).collect();
            let total: f64 = parts.iter().sum();
            let parts: Vec<(usize, f64)> =
                among.into_iter().zip(parts).map(|(p, part)| (p, part / total)).collect();
            let shares = shares_of(self.curves.len(), &parts);
            let [truth, found] =
                [&self.curves, curves].map(|curves| self.predicted(curves, &shares));
            sum += delta_e(&weights, &truth, &found);
        }
        sum / count as f64
    }

    fn observe(&mut self, recipes: Vec<Vec<f64>>, errors: SwatchErrors, random: &mut ChaCha8Rng) {
        let Self { surface, .. } = *self;
        let noise = errors.reading;
        for (number, shares) in recipes.into_iter().enumerate() {
            let weighed = weighed(&shares, errors.weighing, random);
            let truth = self.predicted(&self.curves, &weighed);
            let ratio = truth.iter().map(|value: &f64| {
                let error: f64 = StandardNormal.sample(random);
                let internal = surface.internal_from_measured(value + noise * error);
                absorption_over_scattering(internal.unwrap_or(BLACK).clamp(BLACK, 1.0))
            });
            let ratio: Vec<f64> = ratio.collect();
            let reflectance: Vec<f64> = ratio
                .iter()
                .map(|q: &f64| {
                    surface.measured_from_internal(spectra::optics::infinite_film_from_ratio(*q))
                })
                .collect();
            self.observations.push(Observation {
                as_read: reflectance.clone(),
                sample: format!("S{number:02}"),
                shares,
                reflectance,
                ratio,
                hiding: Hiding::Assumed(None),
                spread: None,
                below_surface: 0,
                above_white: 0,
            });
            self.truth.push(truth);
        }
    }

    /// Root mean square difference between predictions from `curves` and the true reflectances.
    #[must_use]
    pub fn rms_to_truth(&self, curves: &[Curves]) -> f64 {
        let mut squares = 0.0;
        for (observation, truth) in self.observations.iter().zip(&self.truth) {
            let predicted = self.predicted(curves, &observation.shares);
            squares += predicted.iter().zip(truth).map(|(p, t)| (p - t).powi(2)).sum::<f64>();
        }
        (squares / (self.truth.len() * self.grid.count()) as f64).sqrt()
    }

    fn predicted(&self, curves: &[Curves], shares: &[f64]) -> Vec<f64> {
        let parts = curves.iter().zip(shares).map(|(curves, share)| {
            let (absorption, scattering) = curves.as_slices();
            (*share, absorption, scattering)
        });
        Curves::weighted_sum(self.grid, parts).hiding(self.surface)
    }
}

/// Shares that were truly mixed for `shares`, each amount with an error of weighing.
fn weighed(shares: &[f64], sd: f64, random: &mut ChaCha8Rng) -> Vec<f64> {
    if sd == 0.0 {
        return shares.to_vec();
    }
    let amounts = shares.iter().map(|share| {
        let error: f64 = StandardNormal.sample(random);
        share * (sd * error).exp()
    });
    let amounts: Vec<f64> = amounts.collect();
    let total: f64 = amounts.iter().sum();
    amounts.iter().map(|amount| amount / total).collect()
}

/// Exponential of a random level within `level` plus a few Gaussian bumps.
fn curve(random: &mut ChaCha8Rng, grid: Grid, level: (f64, f64), bumps: usize) -> Vec<f64> {
    let level = random.random_range(level.0..level.1);
    let bumps: Vec<(f64, f64, f64)> = (0..bumps)
        .map(|_| {
            let height = StandardNormal.sample(random);
            (height, random.random_range(-0.1..1.1), random.random_range(0.1..0.3))
        })
        .collect();
    let last = (grid.count() - 1) as f64;
    (0..grid.count())
        .map(|at| {
            let x = at as f64 / last;
            let sum: f64 = bumps
                .iter()
                .map(|(height, middle, width)| {
                    height * (-0.5 * ((x - middle) / width).powi(2)).exp()
                })
                .sum();
            (level + sum).exp()
        })
        .collect()
}

/// Shares of masstones, tints with pigment 0, and random mixtures.
fn recipes(random: &mut ChaCha8Rng, pigments: usize, count: usize) -> Vec<Vec<f64>> {
    let mut recipes: Vec<Vec<f64>> =
        (0..pigments).map(|p| shares_of(pigments, &[(p, 1.0)])).collect();
    for pigment in 1..pigments {
        recipes.push(shares_of(pigments, &[(0, 0.9), (pigment, 0.1)]));
        recipes.push(shares_of(pigments, &[(0, 0.6), (pigment, 0.4)]));
    }
    while recipes.len() < count {
        let number = random.random_range(2..=3);
        let parts: Vec<(usize, f64)> = index::sample(random, pigments, number)
            .into_iter()
            .map(|pigment| (pigment, Exp1.sample(random)))
            .collect();
        let total: f64 = parts.iter().map(|(_, part)| part).sum();
        let shares: Vec<(usize, f64)> = parts.iter().map(|&(p, part)| (p, part / total)).collect();
        recipes.push(shares_of(pigments, &shares));
    }
    recipes.truncate(count);
    recipes
}

fn shares_of(pigments: usize, parts: &[(usize, f64)]) -> Vec<f64> {
    let mut shares = vec![0.0; pigments];
    parts.iter().for_each(|&(pigment, share)| shares[pigment] = share);
    shares
}
