//! The directions that curvature asks for at every place, and how strongly.

use std::ops::Range;

use glam::{DVec2, DVec3};

use super::links::Links;
use super::settings::{Along, Line};
use crate::mesh::shape_tensor::{PlaceShape, ShapeTensor};
use crate::mesh::tangent_plane::TangentPlane;
use crate::smoothstep;

/// Difference of both curvatures, relative to the greater one, from which a direction begins to
/// count, and from which it counts fully: below, the shape of the triangles decides it.
const ANISOTROPY: [f64; 2] = [0.03, 0.15];

/// Mean reliability of a connected part above which no axis is added, and below which it is added
/// fully.
const SHAPELESS: [f64; 2] = [0.005, 0.03];

/// An axis counts for a connected part if it lies along its surface at least half as well as the
/// best axis.
const AXIS_SHARE: f64 = 0.5;

/// Directions asked for at all places: sums of squares of vectors in the tangent planes and of
/// their weights (reliability in 0..1 times area).
#[derive(Debug, Clone)]
pub(super) struct Evidence {
    /// Weight at every place.
    pub(super) weights: Vec<f64>,
    /// Weighted unit square at every place.
    pub(super) squares: Vec<DVec2>,
}

impl Evidence {
    /// Principal directions of a model of this radius.
    pub(super) fn of_curvature(shapes: &[PlaceShape], radius: f64, along: Along) -> Self {
        let weight = |shape: &PlaceShape| shape.area * reliability(&shape.tensor, radius);
        let weights: Vec<f64> = shapes.iter().map(weight).collect();
        let pairs = shapes.iter().zip(&weights);
        let squares =
            pairs.map(|(shape, weight)| principal_square(&shape.tensor, along) * *weight).collect();
        Self { weights, squares }
    }

    /// Lines of the vertices, weighted by the area of their places.
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

    /// Adds an axis of the model to every connected part whose curvature tells no direction, for
    /// example a sphere or a plane, unless it has a fixed place.
    pub(super) fn add_axes(
        &mut self,
        links: &Links,
        planes: &[TangentPlane],
        shapes: &[PlaceShape],
        fixed: &[bool],
    ) {
        let (order, parts) = links.parts();
        for part in parts {
            let places = || order[part.clone()].iter().map(|&place| place as usize);
            if places().any(|place| fixed[place]) {
                continue;
            }
            let area: f64 = places().map(|place| shapes[place].area).sum();
            let weight: f64 = places().map(|place| self.weights[place]).sum();
            let share = 1.0 - smoothstep(SHAPELESS, weight / area.max(f64::MIN_POSITIVE));
            if share == 0.0 {
                continue;
            }
            let axis = axis_along(&order, part.clone(), planes, shapes);
            for place in places() {
                let flat = planes[place].projected(axis);
                let weight = share * shapes[place].area;
                self.weights[place] += weight * flat.length_squared();
                self.squares[place] += weight * flat.rotate(flat);
            }
        }
    }
}

/// How far the principal directions of a tensor can be relied on, 0..1: grows with the difference
/// between the absolute values of both curvatures times the model's radius, and is 0 where they are
/// nearly equal. On a saddle with curvatures +k and -k neither is the least.
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

/// Unit square of the principal direction, or 0 if there is none.
fn principal_square(tensor: &ShapeTensor, along: Along) -> DVec2 {
    // The direction of the greater curvature by sign is that of the greater by size if convex.
    let greatest = if tensor.mean >= 0.0 { tensor.difference } else { -tensor.difference };
    let square = greatest.normalize_or_zero();
    match along {
        Along::Least => -square,
        Along::Greatest => square,
    }
}

/// The axis that lies along the surface of a part: y, or else x, or else z.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn tensor(mean: f64, half: f64) -> ShapeTensor {
        ShapeTensor { mean, difference: DVec2::new(half, 0.0) }
    }

    #[test]
    fn the_evidence_is_continuous_where_a_saddle_is_symmetric() {
        let pull = |mean| {
            let tensor = tensor(mean, 1.0);
            reliability(&tensor, 1.0) * principal_square(&tensor, Along::Least)
        };
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
