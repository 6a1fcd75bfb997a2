//! The design of greatest information, by Fedorov's exchange.

use documents::{Cancellation, Cancelled};
use nalgebra::DMatrix;
use rayon::prelude::*;

use super::information::Information;

/// Most sweeps over the design; fewer are needed in practice.
const SWEEPS: usize = 30;
/// Least gain of log det, summed over wavelengths, for which a recipe is exchanged; above rounding.
const LEAST_GAIN: f64 = 1e-9;

/// Improves a design, a list of indices into the pool, until no exchange of one recipe for another gains
/// information. The result has as many recipes as `start`, each once; the first `kept` recipes of `start`
/// stay. The others are in order of the pool.
///
/// Fedorov's exchange (1972): each recipe in turn is replaced by the one that adds most to log det of the
/// information. There are two starts, `start` itself and a greedy design, of which the better result is
/// returned, so it is never worse than `start`. Nothing is random.
///
/// # Errors
/// [`Cancelled`] once `cancellation` asks for it.
pub fn optimal(
    information: &Information,
    start: &[usize],
    kept: usize,
    cancellation: &Cancellation,
) -> Result<Vec<usize>, Cancelled> {
    let mut greedy = start[..kept].to_vec();
    let mut state = State::of(information, &greedy);
    while greedy.len() < start.len() {
        cancellation.check()?;
        let (best, _) = state.best(&greedy).expect("the pool contains the start");
        state.change(best, 1.0);
        greedy.push(best);
    }
    let exchanged = |design| exchanged(information, design, kept, cancellation);
    let mut first = exchanged(start.to_vec())?;
    let mut second = exchanged(greedy)?;
    first[kept..].sort_unstable();
    second[kept..].sort_unstable();
    let better = information.log_determinant(&second) > information.log_determinant(&first);
    Ok(if better { second } else { first })
}

fn exchanged(
    information: &Information,
    mut design: Vec<usize>,
    kept: usize,
    cancellation: &Cancellation,
) -> Result<Vec<usize>, Cancelled> {
    for _ in 0..SWEEPS {
        // Computed anew in each sweep, so that rounding errors do not add up.
        let mut state = State::of(information, &design);
        let mut changed = false;
        for place in kept..design.len() {
            cancellation.check()?;
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
        let at_wavelength = |(at, covariance): (usize, &DMatrix<f64>)| {
            let slopes = self.information.slopes.at(index, at);
            let mut variance = 0.0;
            for (&row, a) in places.iter().zip(slopes) {
                for (&column, b) in places.iter().zip(slopes) {
                    variance += a * b * covariance[(row, column)];
                }
            }
            variance.ln_1p()
        };
        self.covariances.iter().enumerate().map(at_wavelength).sum()
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
