//! Designs of a plan: the pool of recipes, the design for unknown paint, and the design of greatest
//! information.
//!
//! We estimate the information on K and S from a library of similar paint. Fedorov's exchange then
//! improves the design one recipe at a time.

use documents::{Cancelled, Task};
use nalgebra::DMatrix;
use pigment::evaluate::percentile;
use pigment::library::PigmentLibrary;
use pigment::{Curves, PigmentId};
use rayon::prelude::*;
use spectra::Grid;

use super::paints::{PaintSet, PlanError, Purpose, SwatchRecipe};
use crate::fit::{AssumedPaints, ExpectedNoise, PRIOR_INFORMATION, Slopes};

/// We sweep at most this often over the design. In practice fewer sweeps are enough.
const SWEEPS: usize = 30;
/// We exchange a recipe only if log det, summed over wavelengths, gains more than this. It is above
/// rounding.
const LEAST_GAIN: f64 = 1e-9;

/// Improves a design, a list of indices into the pool, until no exchange of one recipe for another gains
/// information. The result has as many recipes as `start`, each once. The first `kept` recipes of `start`
/// stay. The others are in order of the pool.
///
/// This is Fedorov's exchange (1972). We replace each recipe in turn by the one that adds most to log det
/// of the information. We start twice, from `start` itself and from a greedy design, and return the better
/// result. So it is never worse than `start`. Nothing is random.
///
/// # Errors
/// [`Cancelled`] once `task` is cancelled.
pub fn optimal(
    information: &Information,
    start: &[usize],
    kept: usize,
    task: &Task,
) -> Result<Vec<usize>, Cancelled> {
    let mut greedy = start[..kept].to_vec();
    let mut state = State::of(information, &greedy);
    while greedy.len() < start.len() {
        task.check()?;
        let (best, _) = state.best(&greedy).expect("the pool contains the start");
        state.change(best, 1.0);
        greedy.push(best);
    }
    let mut first = exchanged(information, start.to_vec(), kept, task)?;
    let mut second = exchanged(information, greedy, kept, task)?;
    first[kept..].sort_unstable();
    second[kept..].sort_unstable();
    let better = information.log_determinant(&second) > information.log_determinant(&first);
    Ok(if better { second } else { first })
}

fn exchanged(
    information: &Information,
    mut design: Vec<usize>,
    kept: usize,
    task: &Task,
) -> Result<Vec<usize>, Cancelled> {
    for _ in 0..SWEEPS {
        // We compute this anew in each sweep, so that rounding errors do not add up.
        let mut state = State::of(information, &design);
        let mut changed = false;
        for place in kept..design.len() {
            task.check()?;
            let leaving = design[place];
            state.change(leaving, -1.0);
            let stay = state.gain(leaving);
            design.swap_remove(place);
            let entering = match state.best(&design) {
                Some((index, gain)) if gain > stay + LEAST_GAIN => index,
                _ => leaving,
            };
            state.change(entering, 1.0);
            design.push(entering);
            let last = design.len() - 1;
            design.swap(place, last);
            changed |= entering != leaving;
        }
        if !changed {
            break;
        }
    }
    Ok(design)
}

/// Covariances of a design, updated with each exchange.
struct State<'a> {
    information: &'a Information,
    covariances: Vec<DMatrix<f64>>,
}

impl<'a> State<'a> {
    fn of(information: &'a Information, design: &[usize]) -> Self {
        Self { information, covariances: information.covariances(design) }
    }

    /// Gain of log det by adding recipe `index`, from the matrix determinant lemma at each wavelength.
    fn gain(&self, index: usize) -> f64 {
        let places = &self.information.slopes.places[index];
        let gains = self.covariances.iter().enumerate().map(|(at, covariance)| {
            let slopes = self.information.slopes.at(index, at);
            let mut variance = 0.0;
            for (&row, a) in places.iter().zip(slopes) {
                for (&column, b) in places.iter().zip(slopes) {
                    variance += a * b * covariance[(row, column)];
                }
            }
            variance.ln_1p()
        });
        gains.sum()
    }

    /// Recipe outside `design` with the greatest gain, and that gain. Of equal ones, the first.
    fn best(&self, design: &[usize]) -> Option<(usize, f64)> {
        let pool = self.information.slopes.places.len();
        let gains: Vec<Option<f64>> = (0..pool)
            .into_par_iter()
            .map(|index| (!design.contains(&index)).then(|| self.gain(index)))
            .collect();
        let gains = gains.into_iter().enumerate().filter_map(|(i, gain)| Some((i, gain?)));
        gains.reduce(|best, next| if next.1 > best.1 { next } else { best })
    }

    /// Adds recipe `index` (`sign` 1) or removes it (-1), by the formula of Sherman and Morrison (1950).
    fn change(&mut self, index: usize, sign: f64) {
        let slopes = &self.information.slopes;
        let places = &slopes.places[index];
        for (at, covariance) in self.covariances.iter_mut().enumerate() {
            let row = slopes.at(index, at);
            let mut image = nalgebra::DVector::zeros(covariance.nrows());
            for (&place, slope) in places.iter().zip(row) {
                image.axpy(*slope, &covariance.column(place), 1.0);
            }
            let variance: f64 =
                places.iter().zip(row).map(|(&place, slope)| slope * image[place]).sum();
            covariance.ger(-sign / (1.0 + sign * variance), &image, &image, 1.0);
        }
    }
}

/// Information that each recipe of a pool gives on log K and log S of every paint, over a library's
/// wavelengths.
///
/// It is the Fisher information of the fit's own residuals: reflectances of films that hide, surface
/// included, under its noise model, plus the little information of the fit's prior. We leave out smoothness
/// over wavelength, so you get predicted deviations that are rather too large.
#[derive(Debug, Clone)]
pub struct Information {
    pub(super) slopes: Slopes,
    paints: usize,
    grid: Grid,
}

/// Predicted relative standard deviations of one paint's K and S, as medians over wavelength. They are the
/// standard deviations of log K and log S.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativeDeviation {
    /// Relative standard deviation of K.
    pub absorption: f64,
    /// Relative standard deviation of S, or `None` for the white, with S = 1.
    pub scattering: Option<f64>,
}

impl Information {
    /// Computes the information of `pool`. Paint i of the pool is assumed to have the K and S of
    /// `pigments[i]` of `library`.
    #[must_use]
    pub fn new(
        library: &PigmentLibrary,
        pigments: &[PigmentId],
        pool: &[SwatchRecipe],
        noise: ExpectedNoise,
    ) -> Self {
        let paints = AssumedPaints {
            surface: library.saunderson,
            reference: PaintSet::WHITE,
            curves: pigments.iter().map(|id| library.curves(*id)).collect(),
        };
        let recipes = pool
            .iter()
            .map(|recipe: &SwatchRecipe| -> Vec<(usize, f64)> {
                recipe.shares().iter().map(|&(paint, share)| (paint.index(), share)).collect()
            })
            .collect();
        let slopes = Slopes::of(&paints, recipes, noise);
        Self { slopes, paints: pigments.len(), grid: library.grid }
    }

    /// Covariance of log K and log S by wavelength: the inverse of the information of `design`.
    pub(super) fn covariances(&self, design: &[usize]) -> Vec<DMatrix<f64>> {
        (0..self.slopes.wavelengths())
            .map(|at| {
                let factor = self.matrix(design, at).cholesky();
                factor.expect("the prior makes it positive definite").inverse()
            })
            .collect()
    }

    /// Mean per unknown of log det of the information of `design`, a list of indices into the pool.
    #[must_use]
    pub fn log_determinant(&self, design: &[usize]) -> f64 {
        let wavelengths = self.slopes.wavelengths();
        let sum: f64 = (0..wavelengths)
            .map(|at| {
                let factor = self.matrix(design, at).cholesky();
                let factor = factor.expect("the prior makes it positive definite").unpack();
                2.0 * factor.diagonal().iter().map(|v| v.ln()).sum::<f64>()
            })
            .sum();
        sum / (wavelengths * self.slopes.unknowns()) as f64
    }

    /// D-efficiency of `design` against `other`. For example, 0.8 means that you get the same information
    /// from 80 % as many readings of `other`.
    #[must_use]
    pub fn efficiency(&self, design: &[usize], other: &[usize]) -> f64 {
        (self.log_determinant(design) - self.log_determinant(other)).exp()
    }

    /// Standard deviations of log K and log S that `design` should give, by paint, or 0 for the S of the
    /// white.
    #[must_use]
    pub fn log_deviations(&self, design: &[usize]) -> Vec<Curves> {
        let covariances = self.covariances(design);
        let by_wavelength = |place: Option<usize>| -> Vec<f64> {
            covariances
                .iter()
                .map(|c: &DMatrix<f64>| place.map_or(0.0, |place| c[(place, place)].sqrt()))
                .collect()
        };
        (0..self.paints)
            .map(|paint: usize| Curves {
                grid: self.grid,
                absorption: by_wavelength(Some(paint)),
                scattering: by_wavelength(self.slopes.scattering(paint)),
            })
            .collect()
    }

    /// Median over wavelength of the standard deviations of [`Self::log_deviations`], by paint.
    #[must_use]
    pub fn deviations(&self, design: &[usize]) -> Vec<RelativeDeviation> {
        self.log_deviations(design)
            .iter()
            .enumerate()
            .map(|(paint, Curves { absorption, scattering, .. }): (usize, &Curves)| {
                let is_white = paint == PaintSet::WHITE.index();
                RelativeDeviation {
                    absorption: percentile(absorption, 50.0),
                    scattering: (!is_white).then(|| percentile(scattering, 50.0)),
                }
            })
            .collect()
    }

    fn matrix(&self, design: &[usize], at: usize) -> DMatrix<f64> {
        let unknowns = self.slopes.unknowns();
        let mut matrix = DMatrix::from_diagonal_element(unknowns, unknowns, PRIOR_INFORMATION);
        for &index in design {
            let places = &self.slopes.places[index];
            let slopes = self.slopes.at(index, at);
            for (&row, a) in places.iter().zip(slopes) {
                for (&column, b) in places.iter().zip(slopes) {
                    matrix[(row, column)] += a * b;
                }
            }
        }
        matrix
    }
}

/// Total parts of the first tint, 1:4.
const FIRST_TINT: u32 = 5;
/// Greatest total of parts of the second tint, 1:19.
const SECOND_TINT: u32 = 20;
/// Most parts of the colour to one part of black in a shade.
const SHADE: u32 = 9;

/// Selects `swatches` recipes of `pool`, which comes from [`super::candidates`], as indices into it. The
/// order is: masstones, a tint of every paint at 1:4, one at 1:19 (or the weakest that you can weigh), a
/// shade of every colour with black at 9:1, each colour mixed 1:1 with the next, then the rest of the
/// pool in its order, the strongest tints first.
///
/// We measured the ratios on the Van Gogh oils. Of two tints of one pigment with zinc white, the optimal
/// design most often contained 4:1, 1:4 and 1:19, and of shades with bone black 4:1 and 9:1. With masstones
/// and the two tints, 11 of 17 pigments had a D-efficiency above 0.9. Weak ones, for which 4:1 is better,
/// had 0.56 to 0.72.
///
/// # Errors
/// [`PlanError::Swatches`] for fewer swatches than unknowns per wavelength, or more than the pool holds.
pub fn usual(
    paints: &PaintSet,
    pool: &[SwatchRecipe],
    swatches: usize,
) -> Result<Vec<usize>, PlanError> {
    let least = paints.unknowns();
    let most = pool.len();
    if !(least..=most).contains(&swatches) {
        return Err(PlanError::Swatches { paints: paints.names.len(), least, most, swatches });
    }
    let mut design = rounds(paints, pool);
    let rest: Vec<usize> = (0..pool.len()).filter(|index| !design.contains(index)).collect();
    design.extend(rest);
    design.truncate(swatches);
    Ok(design)
}

/// This many swatches are in the usual design if you request no number.
#[must_use]
pub fn usual_count(paints: &PaintSet, pool: &[SwatchRecipe]) -> usize {
    rounds(paints, pool).len().max(paints.unknowns()).min(pool.len())
}

/// Indices of the masstones, tints, shades and mixtures 1:1 with which [`usual`] begins, in its order.
fn rounds(paints: &PaintSet, pool: &[SwatchRecipe]) -> Vec<usize> {
    let weakest = pool
        .iter()
        .filter(|recipe| recipe.purpose == Purpose::Tint && recipe.total() <= SECOND_TINT)
        .map(SwatchRecipe::total)
        .max();
    let weakest = weakest.unwrap_or(FIRST_TINT);
    let shades = pool.iter().filter(|r| r.purpose == Purpose::Shade && shade(r) <= SHADE);
    let strongest_shade = shades.map(shade).max();
    let colors: Vec<PigmentId> = paints.colors().collect();
    // With two colours, a closed ring would contain their pair twice.
    let links = if colors.len() > 2 { colors.len() } else { colors.len().saturating_sub(1) };
    let ring: Vec<[PigmentId; 2]> = (0..links)
        .map(|i| {
            let mut pair = [colors[i], colors[(i + 1) % colors.len()]];
            pair.sort_unstable();
            pair
        })
        .collect();
    let rounds: [&dyn Fn(&SwatchRecipe) -> bool; 5] = [
        &|recipe| recipe.purpose == Purpose::Masstone,
        &|recipe| tint(recipe, FIRST_TINT),
        &|recipe| weakest > FIRST_TINT && tint(recipe, weakest),
        &|recipe| recipe.purpose == Purpose::Shade && Some(shade(recipe)) == strongest_shade,
        &|recipe| {
            recipe.purpose == Purpose::Cross
                && recipe.total() == 2
                && ring.contains(&[recipe.parts[0].0, recipe.parts[1].0])
        },
    ];
    rounds
        .into_iter()
        .flat_map(|selects: &dyn Fn(&SwatchRecipe) -> bool| -> Vec<usize> {
            (0..pool.len()).filter(|&index| selects(&pool[index])).collect()
        })
        .collect()
}

fn tint(recipe: &SwatchRecipe, total: u32) -> bool {
    recipe.purpose == Purpose::Tint && recipe.parts[0].1 == 1 && recipe.total() == total
}

fn shade(recipe: &SwatchRecipe) -> u32 {
    recipe.parts[0].1
}

/// Parts of the paint and of the white in tints.
const TINTS: [(u32, u32); 10] =
    [(4, 1), (2, 1), (1, 1), (1, 2), (1, 4), (1, 9), (1, 19), (1, 39), (1, 79), (1, 159)];
/// Parts of the colour to one of the black in shades.
const SHADES: [u32; 6] = [2, 4, 9, 19, 39, 79];
/// Parts of two colours mixed with each other.
const CROSSES: [(u32, u32); 3] = [(1, 1), (1, 4), (4, 1)];
/// Parts of two colours and of the white.
const CROSS_TINTS: [(u32, u32, u32); 2] = [(1, 1, 2), (1, 1, 8)];

/// Lists every recipe with a smallest share of `least_share` or more: masstones, tints and shades at a
/// ladder of parts, two colours at three ratios, and two colours with white.
#[must_use]
pub fn candidates(paints: &PaintSet, least_share: f64) -> Vec<SwatchRecipe> {
    let mut pool = Vec::new();
    let mut add = |purpose, parts: &[(PigmentId, u32)]| {
        let recipe = SwatchRecipe { purpose, parts: parts.to_vec() };
        if recipe.least_share() >= least_share - 1e-9 {
            pool.push(recipe);
        }
    };
    for paint in paints.ids() {
        add(Purpose::Masstone, &[(paint, 1)]);
    }
    for (parts, white) in TINTS {
        for paint in paints.ids().skip(1) {
            add(Purpose::Tint, &[(paint, parts), (PaintSet::WHITE, white)]);
        }
    }
    if let Some(black) = paints.black {
        for parts in SHADES {
            for paint in paints.colors() {
                add(Purpose::Shade, &[(paint, parts), (black, 1)]);
            }
        }
    }
    let pairs = paints.colors().flat_map(|a| paints.colors().map(move |b| (a, b)));
    for (a, b) in pairs.filter(|(a, b)| a < b) {
        for (of_a, of_b) in CROSSES {
            add(Purpose::Cross, &[(a, of_a), (b, of_b)]);
        }
        for (of_a, of_b, white) in CROSS_TINTS {
            add(Purpose::CrossTint, &[(a, of_a), (b, of_b), (PaintSet::WHITE, white)]);
        }
    }
    pool
}
