//! Curvature tensors of triangles and of the places of a mesh (Rusinkiewicz, "Estimating curvatures
//! and their derivatives on triangle meshes", 2004, section 3).

use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

use super::places::Places;
use super::tangent_plane::TangentPlane;

/// Height of a triangle over its longest edge below which normals say nothing about the curvature
/// across it: in f32 both ends of the height are the same point but for rounding.
const LEAST_HEIGHT: f64 = 1e-5;

/// A curvature tensor in a tangent plane, `[[mean + x, y], [y, mean - x]]`, in 1/length: curvature
/// is positive where the surface bends away from its normal.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct ShapeTensor {
    /// Mean of both principal curvatures.
    pub(super) mean: f64,
    /// (x, y): half their difference, along the square of the direction of the greater one (by sign).
    pub(super) difference: DVec2,
}

/// Curvature tensor of a place, in its tangent plane.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct PlaceShape {
    /// Mean of the tensors of its triangles, weighted by their areas around the place.
    pub(super) tensor: ShapeTensor,
    /// Area of the surface that belongs to the place; 0 if no triangle with area meets there.
    pub(super) area: f64,
}

/// Curvature tensor of a triangle, in its own plane, and the area that belongs to each corner.
#[derive(Debug, Clone, Copy)]
struct FaceShape {
    plane: TangentPlane,
    tensor: ShapeTensor,
    areas: [f64; 3],
}

/// Curvature tensor of every place in the tangent plane given for it.
pub(super) fn place_shapes(places: &Places, planes: &[TangentPlane]) -> Vec<PlaceShape> {
    let triangles = places.triangles.par_iter().with_min_len(1 << 9);
    let faces: Vec<Option<FaceShape>> = triangles
        .map(|corners| {
            let positions = corners.map(|corner| places.positions[corner as usize]);
            let normals = corners.map(|corner| places.normals[corner as usize]);
            FaceShape::new(positions, normals)
        })
        .collect();
    let (starts, corners) = corners_of_places(places);
    let planes = planes.par_iter().with_min_len(1 << 9).enumerate();
    planes
        .map(|(place, plane)| {
            let mut shape = PlaceShape::default();
            for &corner in &corners[starts[place] as usize..starts[place + 1] as usize] {
                if let Some(face) = &faces[corner as usize / 3] {
                    shape.add(face.tensor_in(plane), face.areas[corner as usize % 3]);
                }
            }
            shape.finished()
        })
        .collect()
}

/// Corners at every place in ascending order: a place's first index into the list, and the list,
/// where corner c of triangle t is 3 t + c.
fn corners_of_places(places: &Places) -> (Vec<u32>, Vec<u32>) {
    let corners = || places.triangles.iter().flatten();
    let mut starts = vec![0_u32; places.positions.len() + 1];
    corners().for_each(|&place| starts[place as usize + 1] += 1);
    for place in 0..places.positions.len() {
        starts[place + 1] += starts[place];
    }
    let mut next = starts.clone();
    let mut list = vec![0; 3 * places.triangles.len()];
    for (corner, &place) in corners().enumerate() {
        list[next[place as usize] as usize] = corner as u32;
        next[place as usize] += 1;
    }
    (starts, list)
}

impl PlaceShape {
    fn add(&mut self, tensor: ShapeTensor, area: f64) {
        self.tensor.mean += area * tensor.mean;
        self.tensor.difference += area * tensor.difference;
        self.area += area;
    }

    fn finished(self) -> Self {
        let mean = self.tensor.mean / self.area;
        let difference = self.tensor.difference / self.area;
        match mean.is_finite() && difference.is_finite() {
            true => Self { tensor: ShapeTensor { mean, difference }, area: self.area },
            false => Self { area: self.area, ..Self::default() },
        }
    }
}

impl FaceShape {
    /// Fits the tensor to the differences of the normals along the edges (equation 4 there). `None`
    /// for a triangle that is flat to a line.
    fn new(positions: [DVec3; 3], normals: [DVec3; 3]) -> Option<Self> {
        let edges = [0, 1, 2].map(|i| positions[(i + 2) % 3] - positions[(i + 1) % 3]);
        let longest = edges.iter().fold(0.0_f64, |most, edge| most.max(edge.length()));
        let cross = edges[0].cross(edges[1]);
        if cross.length() <= LEAST_HEIGHT * longest * longest {
            return None;
        }
        // Triangles may be wound either way, and sides of thin sheets share places.
        let side = if cross.dot(normals.iter().sum()) < 0.0 { -1.0 } else { 1.0 };
        let normal = cross.normalize() * side;
        let right = edges[0].normalize();
        let plane = TangentPlane { normal, right, up: normal.cross(right) };
        let normals = normals.map(|own| if own.dot(normal) < 0.0 { -own } else { own });
        let mut squares = DMat3::ZERO;
        let mut products = DVec3::ZERO;
        for (i, edge) in edges.iter().enumerate() {
            let step = plane.projected(*edge) / longest;
            let change = plane.projected(normals[(i + 2) % 3] - normals[(i + 1) % 3]);
            // Rows of the tensor [[e, f], [f, g]] times the step are the change.
            for (row, change) in [DVec3::new(step.x, step.y, 0.0), DVec3::new(0.0, step.x, step.y)]
                .into_iter()
                .zip([change.x, change.y])
            {
                squares += DMat3::from_cols(row * row.x, row * row.y, row * row.z);
                products += row * change;
            }
        }
        let [e, f, g] = (squares.inverse() * products / longest).to_array();
        let tensor = ShapeTensor { mean: 0.5 * (e + g), difference: DVec2::new(0.5 * (e - g), f) };
        let finite = tensor.mean.is_finite() && tensor.difference.is_finite();
        finite.then(|| Self { plane, tensor, areas: mixed_areas(positions) })
    }

    /// The tensor in the tangent plane of one of the corners (section 3.2 there).
    fn tensor_in(&self, plane: &TangentPlane) -> ShapeTensor {
        let ShapeTensor { mean, difference } = self.tensor;
        let facing = self.plane.normal.dot(plane.normal) >= 0.0;
        let (from, sign) = match facing {
            true => (self.plane, 1.0),
            false => (self.plane.reversed(), -1.0),
        };
        let mirrored = if facing { difference } else { DVec2::new(difference.x, -difference.y) };
        let turn = from.turn_of_squares(plane).unwrap_or(DVec2::X);
        ShapeTensor { mean: sign * mean, difference: sign * turn.rotate(mirrored) }
    }
}

/// Area that belongs to each corner of a triangle: its Voronoi cell, or in an obtuse triangle one
/// half for the obtuse corner and a quarter for the others (Meyer, Desbrun, Schroeder and Barr,
/// "Discrete differential-geometry operators for triangulated 2-manifolds", 2003, section 3.3).
fn mixed_areas(at: [DVec3; 3]) -> [f64; 3] {
    let twice = (at[1] - at[0]).cross(at[2] - at[0]).length();
    let dots = [0, 1, 2].map(|i| (at[(i + 1) % 3] - at[i]).dot(at[(i + 2) % 3] - at[i]));
    if let Some(obtuse) = dots.iter().position(|&dot| dot <= 0.0) {
        let mut areas = [twice / 8.0; 3];
        areas[obtuse] = twice / 4.0;
        return areas;
    }
    [0, 1, 2].map(|i| {
        let [next, last] = [(i + 1) % 3, (i + 2) % 3];
        let toward = |from: usize, opposite: usize| {
            at[from].distance_squared(at[i]) * dots[opposite] / twice
        };
        (toward(next, last) + toward(last, next)) / 8.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_of_the_corners_add_up_to_the_triangle() {
        for (corner, obtuse) in [([0.4, 1.0], None), ([-1.0, 0.3], Some(0)), ([0.5, 0.1], Some(2))]
        {
            let at = [[0.0, 0.0], [1.0, 0.0], corner].map(|[x, y]| DVec3::new(x, y, 0.0));
            let areas = mixed_areas(at);
            let whole = 0.5 * corner[1];
            assert!((areas.iter().sum::<f64>() - whole).abs() < 1e-15, "{areas:?}");
            if let Some(obtuse) = obtuse {
                assert_eq!(areas[obtuse], 0.5 * whole, "{areas:?}");
            }
        }
        let even = mixed_areas(
            [[0.0, 0.0], [1.0, 0.0], [0.5, 0.75_f64.sqrt()]].map(|[x, y]| DVec3::new(x, y, 0.0)),
        );
        assert!((even[0] - even[2]).abs() < 1e-15, "{even:?}");
    }

    #[test]
    fn a_triangle_on_a_saddle_has_the_tensor_of_the_saddle() {
        // Height z = (p x^2 + 2 q x y + r y^2) / 2: the normal's change is minus the tensor.
        let [p, q, r] = [0.8, -0.3, -0.5];
        let normal = |x: f64, y: f64| DVec3::new(-(p * x + q * y), -(q * x + r * y), 1.0);
        let places = [[-1e-4, -1e-4], [2e-4, 0.0], [0.0, 1e-4]];
        let positions =
            places.map(|[x, y]| DVec3::new(x, y, 0.5 * (p * x * x + 2.0 * q * x * y + r * y * y)));
        let normals = places.map(|[x, y]| normal(x, y).normalize());
        let face = FaceShape::new(positions, normals).unwrap();
        let plane = TangentPlane { normal: DVec3::Z, right: DVec3::X, up: DVec3::Y };
        let found = face.tensor_in(&plane);
        assert!((found.mean + 0.5 * (p + r)).abs() < 1e-6, "{found:?}");
        let wanted = DVec2::new(-0.5 * (p - r), -q);
        assert!((found.difference - wanted).length() < 1e-6, "{found:?}, {wanted}");
        // Seen from the other side every curvature has the other sign.
        let below = TangentPlane { normal: -DVec3::Z, right: DVec3::X, up: -DVec3::Y };
        let found = face.tensor_in(&below);
        assert!((found.mean - 0.5 * (p + r)).abs() < 1e-6, "{found:?}");
        let wanted = DVec2::new(0.5 * (p - r), -q);
        assert!((found.difference - wanted).length() < 1e-6, "{found:?}, {wanted}");
    }
}
