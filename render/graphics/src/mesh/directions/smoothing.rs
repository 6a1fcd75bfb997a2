//! Smooth lines through evidence: the field of squares that deviates least from the evidence and
//! from link to link.
//!
//! With squares z of unit lines, and links that carry them between tangent planes, it minimises
//! spread * sum of stiffness |z_i - turn z_j|^2 over the links + sum of weight |z_i - wanted_i|^2
//! over the places (Knoeppel, Crane, Pinkall and Schroeder, "Globally optimal direction fields",
//! 2013, section 4, with the alignment as a quadratic term). That is one linear system, solved by
//! conjugate gradients with a diagonal preconditioner (Hestenes and Stiefel, 1952).

use glam::DVec2;
use rayon::prelude::*;

use super::evidence::Evidence;
use super::links::Links;

/// Residual, relative to that of no lines at all, at which the solver stops.
const RESIDUAL: f64 = 1e-8;

/// Most steps of the solver. A plane of 100,000 triangles that a guide in one corner decides takes
/// about 1000, a still life of that size 400.
const MOST_STEPS: usize = 4000;

/// Places in one portion of a sum; sums are added portion by portion, so that the number of threads
/// does not matter.
const PORTION: usize = 1 << 11;

/// The system whose solution is the smooth field.
struct System<'a> {
    links: &'a Links,
    /// Square of the smoothing length.
    spread: f64,
    evidence: &'a Evidence,
    fixed: &'a [bool],
    /// One over the diagonal of the matrix; 0 at fixed places and at those that nothing determines.
    inverse_diagonal: Vec<f64>,
}

/// Squares of the smooth lines at all places; their length, at most 1 but for rounding, tells how
/// well the surroundings agree. Places that are `fixed` keep the value of `given`; one that
/// nothing determines gets 0.
pub(super) fn smooth_squares(
    links: &Links,
    evidence: &Evidence,
    spread: f64,
    fixed: &[bool],
    given: &[DVec2],
) -> Vec<DVec2> {
    let system = System::new(links, evidence, spread, fixed);
    let mut squares = system.start(given);
    let mut product = vec![DVec2::ZERO; squares.len()];
    system.multiply(&squares, &mut product);
    let rest = |place: usize| evidence.squares[place] - product[place];
    let free = |place: usize| if fixed[place] { DVec2::ZERO } else { rest(place) };
    let mut residual: Vec<DVec2> = (0..squares.len()).map(free).collect();
    let mut scaled = system.preconditioned(&residual);
    let mut direction = scaled.clone();
    let mut size = dot(&residual, &scaled);
    let enough = RESIDUAL * RESIDUAL * system.size_without_lines(given);
    for _ in 0..MOST_STEPS {
        if size <= enough {
            break;
        }
        system.multiply(&direction, &mut product);
        let step = size / dot(&direction, &product);
        if !step.is_finite() {
            break;
        }
        add_scaled(&mut squares, step, &direction);
        add_scaled(&mut residual, -step, &product);
        scaled = system.preconditioned(&residual);
        let next_size = dot(&residual, &scaled);
        let keep = next_size / size;
        size = next_size;
        let pairs = direction.par_iter_mut().with_min_len(PORTION).zip(&scaled);
        pairs.for_each(|(direction, scaled)| *direction = *scaled + *direction * keep);
    }
    squares
}

impl<'a> System<'a> {
    fn new(links: &'a Links, evidence: &'a Evidence, spread: f64, fixed: &'a [bool]) -> Self {
        let inverse_diagonal = (0..links.count())
            .into_par_iter()
            .map(|place: usize| {
                let stiffness: f64 = links.of(place).iter().map(|link| link.stiffness).sum();
                let diagonal = spread * stiffness + evidence.weights[place];
                if diagonal > 0.0 && !fixed[place] { 1.0 / diagonal } else { 0.0 }
            })
            .collect();
        Self { links, spread, evidence, fixed, inverse_diagonal }
    }

    /// The field from which the solver starts: fixed values, and elsewhere the evidence alone.
    fn start(&self, given: &[DVec2]) -> Vec<DVec2> {
        (0..given.len())
            .into_par_iter()
            .map(|place: usize| match self.fixed[place] {
                true => given[place],
                false => {
                    let weight = self.evidence.weights[place];
                    if weight > 0.0 { self.evidence.squares[place] / weight } else { DVec2::ZERO }
                }
            })
            .collect()
    }

    /// Size of the residual if all places but the fixed ones had no line.
    fn size_without_lines(&self, given: &[DVec2]) -> f64 {
        let only_fixed: Vec<DVec2> = given
            .iter()
            .zip(self.fixed)
            .map(|(given, fixed)| if *fixed { *given } else { DVec2::ZERO })
            .collect();
        let mut residual = vec![DVec2::ZERO; given.len()];
        self.multiply(&only_fixed, &mut residual);
        let pairs = residual.iter_mut().zip(&self.evidence.squares);
        pairs.for_each(|(residual, wanted)| *residual = *wanted - *residual);
        dot(&residual, &self.preconditioned(&residual))
    }

    /// Product of the matrix and a field; at fixed places the product is of no use.
    fn multiply(&self, field: &[DVec2], product: &mut [DVec2]) {
        let rows = product.par_iter_mut().with_min_len(1 << 9).enumerate();
        rows.for_each(|(place, product)| {
            let own = field[place];
            let mut sum = DVec2::ZERO;
            for link in self.links.of(place) {
                sum += link.stiffness * (own - link.turn.rotate(field[link.to as usize]));
            }
            let all = self.spread * sum + self.evidence.weights[place] * own;
            *product = if self.fixed[place] { DVec2::ZERO } else { all };
        });
    }

    fn preconditioned(&self, residual: &[DVec2]) -> Vec<DVec2> {
        let pairs = residual.par_iter().with_min_len(PORTION).zip(&self.inverse_diagonal);
        pairs.map(|(residual, inverse)| *residual * *inverse).collect()
    }
}

/// Sum of the products of both fields, in a fixed order.
fn dot(a: &[DVec2], b: &[DVec2]) -> f64 {
    let portions = a.par_chunks(PORTION).zip(b.par_chunks(PORTION));
    let sums: Vec<f64> =
        portions.map(|(a, b)| a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()).collect();
    sums.iter().sum()
}

fn add_scaled(field: &mut [DVec2], factor: f64, other: &[DVec2]) {
    let pairs = field.par_iter_mut().with_min_len(PORTION).zip(other);
    pairs.for_each(|(value, other)| *value += *other * factor);
}
