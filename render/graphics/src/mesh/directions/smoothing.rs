//! Finds smooth lines, one at every place of a surface. They deviate as little as possible from the
//! lines that we want there (the evidence), and from the lines of neighbouring places.
//!
//! With squares z of unit lines, and links that carry them between tangent planes, we minimise
//! spread * sum of stiffness |z_i - turn z_j|^2 over the links + sum of weight |z_i - wanted_i|^2
//! over the places (Knoeppel, Crane, Pinkall and Schroeder, "Globally optimal direction fields",
//! 2013, section 4, with the alignment as a quadratic term). This is one linear system. We solve
//! it by conjugate gradients with a diagonal preconditioner (Hestenes and Stiefel, 1952).
//!
//! The evidence is the direction and strength that curvature asks for at every place. A link joins
//! two neighbouring places. It knows how squares of tangent vectors turn on the way, and how
//! strongly it ties both places.

use std::ops::Range;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::{Along, Line};
use crate::mesh::curvature::{PlaceShape, Places, ShapeTensor, TangentPlane, carried};
use crate::smoothstep;

/// The solver stops at this residual, relative to the residual without any lines.
const RESIDUAL: f64 = 1e-8;

/// Most steps of the solver. For example, a plane of 100,000 triangles with one guide in a corner
/// takes about 1000, and a still life of that size 400.
const MOST_STEPS: usize = 4000;

/// Places in one portion of a sum. We add sums portion by portion, so that the number of threads
/// does not matter.
const PORTION: usize = 1 << 11;

struct System<'a> {
    links: &'a Links,
    /// Square of the smoothing length.
    spread: f64,
    evidence: &'a Evidence,
    fixed: &'a [bool],
    /// One over the diagonal of the matrix. It is 0 at fixed places and where nothing determines
    /// the line.
    inverse_diagonal: Vec<f64>,
}

/// Squares of the smooth lines at all places. Their length is at most 1 except for rounding, and
/// shows how well the surroundings agree. Places in `fixed` keep the value of `given`. If nothing
/// determines a place, it gets 0.
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
    let mut residual: Vec<DVec2> = (0..squares.len())
        .map(
            |place: usize| {
                if fixed[place] { DVec2::ZERO } else { evidence.squares[place] - product[place] }
            },
        )
        .collect();
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

    /// The field from which the solver starts: fixed values, and elsewhere only the evidence.
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

    /// Size of the residual if all places except the fixed ones had no line.
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

    /// Product of the matrix and a field. Do not use the product at fixed places.
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

/// A principal direction begins to count where the curvatures differ by the first share of the
/// greater one, and counts fully from the second share on. If they differ less, the direction
/// depends on the shape of the triangles.
const ANISOTROPY: [f64; 2] = [0.03, 0.15];

/// We add no axis to a connected part if its mean reliability is above the second number. Below
/// the first, we add it fully.
const SHAPELESS: [f64; 2] = [0.005, 0.03];

/// An axis counts for a connected part if it lies along the surface at least half as well as the
/// best axis.
const AXIS_SHARE: f64 = 0.5;

/// The directions that we want at all places. A place has the sum of its weights (each is a
/// reliability in 0..1 times an area), and the weighted sum of the squares of tangent vectors.
#[derive(Debug, Clone)]
pub(super) struct Evidence {
    pub(super) weights: Vec<f64>,
    pub(super) squares: Vec<DVec2>,
}

impl Evidence {
    pub(super) fn of_curvature(shapes: &[PlaceShape], radius: f64, along: Along) -> Self {
        let weights: Vec<f64> = shapes
            .iter()
            .map(|shape: &PlaceShape| shape.area * reliability(&shape.tensor, radius))
            .collect();
        let pairs = shapes.iter().zip(&weights);
        let squares =
            pairs.map(|(shape, weight)| principal_square(&shape.tensor, along) * *weight).collect();
        Self { weights, squares }
    }

    pub(super) fn of_lines(
        of_vertex: &[u32],
        planes: &[TangentPlane],
        shapes: &[PlaceShape],
        lines: &[Line],
    ) -> Self {
        let mut own =
            Self { weights: vec![0.0; planes.len()], squares: vec![DVec2::ZERO; planes.len()] };
        for (&place, line) in of_vertex.iter().zip(lines) {
            let place = place as usize;
            let flat = planes[place].projected(DVec3::from(line.along.map(f64::from)));
            let Some(unit) = flat.try_normalize() else { continue };
            let weight = f64::from(line.weight.clamp(0.0, 1.0)) * shapes[place].area;
            own.weights[place] += weight;
            own.squares[place] += weight * unit.rotate(unit);
        }
        own
    }

    /// Adds an axis of the model to every connected part without a direction of curvature, for
    /// example a sphere or a plane. This skips parts with a fixed place.
    pub(super) fn add_axes(
        &mut self,
        links: &Links,
        planes: &[TangentPlane],
        shapes: &[PlaceShape],
        fixed: &[bool],
    ) {
        let (order, parts) = links.parts();
        for part in parts {
            let places = order[part.clone()].iter().map(|&place| place as usize);
            if places.clone().any(|place| fixed[place]) {
                continue;
            }
            let area: f64 = places.clone().map(|place| shapes[place].area).sum();
            let weight: f64 = places.clone().map(|place| self.weights[place]).sum();
            let share = 1.0 - smoothstep(SHAPELESS, weight / area.max(f64::MIN_POSITIVE));
            if share == 0.0 {
                continue;
            }
            let axis = axis_along(&order, part, planes, shapes);
            for place in places {
                let flat = planes[place].projected(axis);
                let weight = share * shapes[place].area;
                self.weights[place] += weight * flat.length_squared();
                self.squares[place] += weight * flat.rotate(flat);
            }
        }
    }
}

/// How far you can rely on the principal directions of a tensor, 0..1. This grows with the
/// difference between the absolute values of both curvatures times the model's radius, and is 0
/// where they are nearly equal. On a saddle with curvatures +k and -k neither is the least.
fn reliability(tensor: &ShapeTensor, radius: f64) -> f64 {
    let mean = tensor.mean.abs();
    let half = tensor.difference.length();
    let difference = 2.0 * mean.min(half);
    if difference <= 0.0 {
        return 0.0;
    }
    let scaled = difference * radius;
    scaled / (1.0 + scaled) * smoothstep(ANISOTROPY, difference / (mean + half))
}

/// The principal direction as a unit vector, squared as a complex number, so that a direction and
/// its opposite give the same. This is 0 if the tensor has no principal direction.
fn principal_square(tensor: &ShapeTensor, along: Along) -> DVec2 {
    // On a convex surface the curvature that is greater by sign is also greater by size.
    let greatest = if tensor.mean >= 0.0 { tensor.difference } else { -tensor.difference };
    let square = greatest.normalize_or_zero();
    match along {
        Along::Least => -square,
        Along::Greatest => square,
    }
}

/// The axis that lies along the surface of a part. This prefers y, then x, then z.
fn axis_along(
    order: &[u32],
    part: Range<usize>,
    planes: &[TangentPlane],
    shapes: &[PlaceShape],
) -> DVec3 {
    let axes = [DVec3::Y, DVec3::X, DVec3::Z];
    let lengths = axes.map(|axis| {
        let places = order[part.clone()].iter().map(|&place| place as usize);
        places
            .map(|place| shapes[place].area * planes[place].projected(axis).length_squared())
            .sum::<f64>()
    });
    let most = lengths.iter().fold(0.0_f64, |most, &length| most.max(length));
    let found = lengths.iter().position(|&length| length >= AXIS_SHARE * most);
    axes[found.unwrap_or(0)]
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    pub(super) to: u32,
    /// Above 0, and the same in both directions.
    pub(super) stiffness: f64,
    /// Factor that carries squares of vectors from the neighbour's tangent plane to this one.
    pub(super) turn: DVec2,
}

#[derive(Debug, Clone)]
pub(super) struct Links {
    starts: Vec<u32>,
    all: Vec<Link>,
}

impl Links {
    /// The links along the edges of the triangles. Their stiffness is the stiffness of the edge
    /// times (1 + cosine of the angle between the normals) / 2. Places with opposite normals have
    /// no link.
    pub(super) fn new(places: &Places, planes: &[TangentPlane]) -> Self {
        let mut starts = vec![0];
        let mut all = Vec::with_capacity(places.stiffness.len());
        for place in 0..places.neighbours.count() {
            let stiffness = &places.stiffness[places.neighbours.slots(place)];
            for (&to, stiffness) in places.neighbours.of(place).iter().zip(stiffness) {
                let here = &planes[place];
                let there = &planes[to as usize];
                if let Some(turn) = there.turn_of_squares(here) {
                    let folded = 0.5 * (1.0 + here.normal.dot(there.normal));
                    all.push(Link { to, stiffness: stiffness * folded, turn });
                }
            }
            starts.push(all.len() as u32);
        }
        Self { starts, all }
    }

    pub(super) fn count(&self) -> usize {
        self.starts.len() - 1
    }

    pub(super) fn of(&self, place: usize) -> &[Link] {
        &self.all[self.starts[place] as usize..self.starts[place + 1] as usize]
    }

    /// The places in connected groups. Returns a list of all places, and the range of each group
    /// in it. Groups are ordered by their first place.
    pub(super) fn parts(&self) -> (Vec<u32>, Vec<Range<usize>>) {
        let mut reached = vec![false; self.count()];
        let mut order: Vec<u32> = Vec::with_capacity(self.count());
        let mut parts = Vec::new();
        for first in 0..self.count() {
            if reached[first] {
                continue;
            }
            reached[first] = true;
            let start = order.len();
            let mut next = start;
            order.push(first as u32);
            while next < order.len() {
                for link in self.of(order[next] as usize) {
                    if !std::mem::replace(&mut reached[link.to as usize], true) {
                        order.push(link.to);
                    }
                }
                next += 1;
            }
            parts.push(start..order.len());
        }
        (order, parts)
    }
}

/// Unit line at a point of a triangle, from the normals and unit lines at its corners. Pass
/// weights that are not negative and add up to 1. This carries the lines to the plane of the
/// interpolated normal and averages them as squares. So their signs do not matter, and two
/// triangles agree along the edge that they share.
pub(super) fn line_within(normals: [DVec3; 3], lines: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    let plane = TangentPlane::of_normal(normal_within(normals, weights));
    let mut sum = DVec2::ZERO;
    for i in 0..3 {
        if let Some(line) = carried(lines[i], normals[i], plane.normal) {
            let flat = plane.projected(line);
            sum += weights[i] * flat.rotate(flat);
        }
    }
    plane.along(sum)
}

/// Tangent vector at a point of a triangle, from the normals and vectors at its corners.
pub(super) fn vector_within(normals: [DVec3; 3], vectors: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    let normal = normal_within(normals, weights);
    let parts = (0..3).filter_map(|i| Some(weights[i] * carried(vectors[i], normals[i], normal)?));
    parts.sum()
}

/// Interpolated unit normal. If the normals cancel out, this is the heaviest corner's.
fn normal_within(normals: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    let sum: DVec3 = (0..3).map(|i| weights[i] * normals[i]).sum();
    let heaviest = (1..3).fold(0, |most, i| if weights[i] > weights[most] { i } else { most });
    sum.try_normalize().unwrap_or(normals[heaviest])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tensor(mean: f64, half: f64) -> ShapeTensor {
        ShapeTensor { mean, difference: DVec2::new(half, 0.0) }
    }

    #[test]
    fn the_evidence_is_continuous_where_a_saddle_is_symmetric() {
        fn pull(mean: f64) -> DVec2 {
            let tensor = tensor(mean, 1.0);
            reliability(&tensor, 1.0) * principal_square(&tensor, Along::Least)
        }
        assert_eq!(pull(0.0), DVec2::ZERO);
        assert!((pull(1e-3) - pull(-1e-3)).length() < 1e-3, "{} {}", pull(1e-3), pull(-1e-3));
        assert!(pull(0.5).x < -0.3 && pull(-0.5).x > 0.3, "{} {}", pull(0.5), pull(-0.5));
    }

    #[test]
    fn reliability_grows_with_the_difference_and_does_not_depend_on_scale() {
        let ball = reliability(&tensor(1.0, 0.005), 1.0);
        let egg = reliability(&tensor(1.0, 0.1), 1.0);
        let branch = reliability(&tensor(1.0, 1.0), 1.0);
        assert!(ball == 0.0 && egg > 0.05 && branch > 2.0 * egg, "{ball} {egg} {branch}");
        assert!((reliability(&tensor(1e-6, 1e-6), 1e6) - branch).abs() < 1e-12);
    }
}
