//! Principal curvatures of a mesh and their directions at every vertex.
//!
//! We compute them over places, which are the distinct positions of a mesh with one normal each,
//! so that seams do not matter. The curvature tensors of triangles and places follow Rusinkiewicz,
//! "Estimating curvatures and their derivatives on triangle meshes", 2004, section 3.
//!
//! Tensors are carried from one tangent plane to the next. For this, plane vectors are complex
//! numbers: x along the first axis, y along the second. A line (a direction of arbitrary sign) is
//! the square of its vector. This doubles its angle and makes both signs one number (Palacios and
//! Zhang, "Rotational symmetry field design on surfaces", 2007). [`DVec2::rotate`] is the complex
//! product.

use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

use super::model::{Mesh, Neighbours};

/// Principal curvatures of a surface at a vertex, in 1/length of the model. They are positive
/// where the surface bends away from its normal. For example, a sphere of radius 2 has 0.5 twice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curvature {
    /// Principal curvature of least absolute value.
    pub least: f32,
    /// Principal curvature of greatest absolute value.
    pub greatest: f32,
    /// Unit direction of the least curvature, perpendicular to the normal, of arbitrary sign.
    pub along_least: [f32; 3],
    /// Unit direction of the greatest curvature, perpendicular to the other and to the normal.
    pub along_greatest: [f32; 3],
    /// Whether a triangle with area meets the vertex. If none does, both curvatures are 0 and you
    /// cannot rely on the directions.
    pub known: bool,
}

impl Curvature {
    /// Principal curvatures of every vertex of a mesh, from the change of the normals along the
    /// edges (Rusinkiewicz, "Estimating curvatures and their derivatives on triangle meshes",
    /// 2004).
    ///
    /// Vertices with the same position count as one, so seams do not show. The normals of the mesh
    /// are first averaged with their neighbours `rounds` times. Use 0 for a fine model, and 1 to 3
    /// if you see facets or roughness. Every number is finite for a mesh that passes
    /// [`Mesh::check`].
    ///
    /// # Panics
    /// If a triangle has a vertex that does not exist, or there are fewer normals than positions.
    #[must_use]
    pub fn of_mesh(mesh: &Mesh, rounds: usize) -> Vec<Self> {
        let places = Places::of(mesh, rounds);
        let normals = places.normals.par_iter();
        let planes: Vec<_> = normals.map(|&normal| TangentPlane::of_normal(normal)).collect();
        let shapes = place_shapes(&places, &planes);
        let pairs = shapes.par_iter().zip(&planes);
        let curvatures: Vec<_> = pairs.map(|(shape, plane)| Self::new(shape, plane)).collect();
        places.of_vertex.iter().map(|&place| curvatures[place as usize]).collect()
    }

    /// Curvature from the tensor of a place in its tangent plane.
    fn new(shape: &PlaceShape, plane: &TangentPlane) -> Self {
        let ShapeTensor { mean, difference } = shape.tensor;
        let half = difference.length();
        let upper = if half > 0.0 { difference } else { DVec2::X };
        let (least, greatest, square) = match mean >= 0.0 {
            true => (mean - half, mean + half, upper),
            false => (mean + half, mean - half, -upper),
        };
        let along_greatest = plane.along(square);
        let along_least = plane.normal.cross(along_greatest);
        Self {
            least: finite(least),
            greatest: finite(greatest),
            along_least: single(along_least),
            along_greatest: single(along_greatest),
            known: shape.area > 0.0,
        }
    }
}

/// The nearest finite number in single precision.
fn finite(value: f64) -> f32 {
    value.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32
}

fn single(vector: DVec3) -> [f32; 3] {
    vector.as_vec3().to_array()
}

/// Below this height over the longest edge, a triangle's normals say nothing about the curvature
/// across it. In f32 both ends of the height are then the same point except for rounding.
const LEAST_HEIGHT: f64 = 1e-5;

/// A curvature tensor in a tangent plane, `[[mean + x, y], [y, mean - x]]`, in 1/length: curvature
/// is positive where the surface bends away from its normal.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct ShapeTensor {
    pub(super) mean: f64,
    /// (x, y) as a complex number. Its length is half the difference of both curvatures. Its
    /// direction is the square of the direction in which the curvature is greater (by sign).
    pub(super) difference: DVec2,
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct PlaceShape {
    /// Mean of the tensors of its triangles, weighted by their areas around the place.
    pub(super) tensor: ShapeTensor,
    /// Area of the surface that belongs to the place, 0 if no triangle with area meets there.
    pub(super) area: f64,
}

/// Curvature tensor of a triangle in its own plane, and the area of each corner.
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

/// Lists the corners at every place in ascending order. Returns each place's first index into the
/// list, and the list itself. Corner c of triangle t is 3 t + c there.
fn corners_of_places(places: &Places) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0_u32; places.positions.len() + 1];
    places.triangles.iter().flatten().for_each(|&place| starts[place as usize + 1] += 1);
    for place in 0..places.positions.len() {
        starts[place + 1] += starts[place];
    }
    let mut next = starts.clone();
    let mut list = vec![0; 3 * places.triangles.len()];
    for (corner, &place) in places.triangles.iter().flatten().enumerate() {
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
    /// Fits the tensor to the differences of the normals along the edges (equation 4 of
    /// Rusinkiewicz). `None` for a triangle that is flat to a line.
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

    /// The tensor in the tangent plane of one of the corners (section 3.2 of Rusinkiewicz).
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
        let from_next = at[next].distance_squared(at[i]) * dots[last] / twice;
        let from_last = at[last].distance_squared(at[i]) * dots[next] / twice;
        (from_next + from_last) / 8.0
    })
}

/// A vector cannot be carried between two normals if 1 + the cosine of their angle is below this.
const LEAST_OPENING: f64 = 1e-9;

/// A tangent plane: its unit normal and two unit axes, right-handed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TangentPlane {
    pub(super) normal: DVec3,
    pub(super) right: DVec3,
    pub(super) up: DVec3,
}

impl TangentPlane {
    /// A plane with this unit normal. The normal determines the axes.
    pub(super) fn of_normal(normal: DVec3) -> Self {
        let (right, up) = normal.any_orthonormal_pair();
        Self { normal, right, up }
    }

    /// The plane seen from its other side. This keeps the first axis.
    pub(super) fn reversed(&self) -> Self {
        Self { normal: -self.normal, right: self.right, up: -self.up }
    }

    pub(super) fn projected(&self, vector: DVec3) -> DVec2 {
        DVec2::new(vector.dot(self.right), vector.dot(self.up))
    }

    /// Unit vector along the line with this square, of arbitrary sign. The square may have any
    /// length but 0.
    pub(super) fn along(&self, squared: DVec2) -> DVec3 {
        let root = square_root(squared);
        (self.right * root.x + self.up * root.y).normalize_or(self.right)
    }

    /// Factor that carries squares of vectors from this plane to another. It describes the
    /// shortest turn between both normals, in the axes of both. `None` if the normals are
    /// opposite.
    pub(super) fn turn_of_squares(&self, other: &Self) -> Option<DVec2> {
        let right = carried(self.right, self.normal, other.normal)?;
        let turn = other.projected(right).try_normalize()?;
        Some(turn.rotate(turn))
    }
}

/// Carries a vector that is perpendicular to the unit normal `from` by the shortest turn that takes
/// `from` to `to`. `None` if they are opposite.
pub(super) fn carried(vector: DVec3, from: DVec3, to: DVec3) -> Option<DVec3> {
    let opening = 1.0 + from.dot(to);
    (opening > LEAST_OPENING).then(|| vector - (from + to) * (to.dot(vector) / opening))
}

/// Complex square root, scaled to length 1. For 0 this is 1.
fn square_root(squared: DVec2) -> DVec2 {
    let unit = squared.normalize_or(DVec2::X);
    // Each form loses digits on the other side.
    if unit.x >= 0.0 {
        let x = f64::sqrt(0.5 * (1.0 + unit.x));
        DVec2::new(x, unit.y / (2.0 * x))
    } else {
        let y = f64::sqrt(0.5 * (1.0 - unit.x));
        DVec2::new(unit.y / (2.0 * y), y)
    }
}

/// Unit normals cancel out if their sum, relative to the sum of their weights, is below this (e.g.
/// on a sheet with two sides). We then take one of them.
const LEAST_SUM: f64 = 1e-3;

/// Least and greatest stiffness of an edge. Without these limits an obtuse triangle would give a
/// negative one, and a needle an unlimited one.
const STIFFNESS: [f64; 2] = [0.05, 5.0];

#[derive(Debug, Clone)]
pub(super) struct Places {
    pub(super) of_vertex: Vec<u32>,
    pub(super) positions: Vec<DVec3>,
    pub(super) normals: Vec<DVec3>,
    /// Places of the corners of every triangle that has three distinct ones.
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) neighbours: Neighbours,
    /// Stiffness of the edge to each neighbour, see [`Neighbours::slots`].
    pub(super) stiffness: Vec<f64>,
}

impl Places {
    /// The places of a mesh. This averages every normal `rounds` times with the mean of its
    /// neighbours.
    pub(super) fn of(mesh: &Mesh, rounds: usize) -> Self {
        let (of_vertex, count) = mesh.weld();
        let mut positions = vec![DVec3::ZERO; count];
        for (&place, position) in of_vertex.iter().zip(&mesh.positions) {
            positions[place as usize] = DVec3::from(position.map(f64::from));
        }
        let corners = mesh.triangles.iter().map(|triangle| triangle.corners);
        let triangles = corners.map(|corners| corners.map(|corner| of_vertex[corner as usize]));
        let triangles: Vec<[u32; 3]> =
            triangles.filter(|[a, b, c]| a != b && b != c && c != a).collect();
        let neighbours = Neighbours::of_triangles(triangles.iter().copied(), count);
        let normals = joined_normals(mesh, &of_vertex, &positions);
        let stiffness = stiffness(&triangles, &positions, &neighbours);
        let normals = averaged(normals, &neighbours, &stiffness, rounds);
        Self { of_vertex, positions, normals, triangles, neighbours, stiffness }
    }

    /// Root mean square distance of the surface from its centre, weighted by area (the radius of a
    /// sphere), 0 for a surface without area. Unlike a bounding box, this does not change when you
    /// turn the model.
    pub(super) fn radius(&self) -> f64 {
        let corners = self.triangles.iter().map(|corners| {
            let at = corners.map(|corner| self.positions[corner as usize]);
            (at, (at[1] - at[0]).cross(at[2] - at[0]).length())
        });
        let mean = |value: &dyn Fn(DVec3) -> DVec3| {
            let (sum, area) = corners.clone().fold((DVec3::ZERO, 0.0), |(sum, all), (at, area)| {
                (sum + at.map(value).iter().sum::<DVec3>() * (area / 3.0), all + area)
            });
            if area > 0.0 { sum / area } else { DVec3::ZERO }
        };
        let center = mean(&|at| at);
        let squares = mean(&|at| (at - center) * (at - center));
        squares.element_sum().sqrt()
    }
}

/// One unit normal for every place: the sum of its vertices' normals. Each triangle adds to the
/// weight of a vertex normal the sine of its angle divided by the lengths of both edges (Max,
/// "Weights for computing vertex normals from facet normals", 1999). This way neither seams nor
/// the cut into triangles shift it. A vertex without a normal takes the triangle's. A place
/// without triangles takes the mean of its vertices' normals, or +y.
fn joined_normals(mesh: &Mesh, of_vertex: &[u32], positions: &[DVec3]) -> Vec<DVec3> {
    fn normal_of(vertex: usize, mesh: &Mesh) -> DVec3 {
        DVec3::from(mesh.normals[vertex].map(f64::from))
    }
    let mut any = vec![DVec3::ZERO; positions.len()];
    for (vertex, &place) in of_vertex.iter().enumerate() {
        let own = &mut any[place as usize];
        // Opposite normals would cancel out: the first side counts.
        let normal = normal_of(vertex, mesh);
        *own += if own.dot(normal) < 0.0 { -normal } else { normal };
    }
    let mut sums = vec![(DVec3::ZERO, 0.0); positions.len()];
    for triangle in &mesh.triangles {
        let places = triangle.corners.map(|corner| of_vertex[corner as usize] as usize);
        let at = places.map(|place| positions[place]);
        let facet = (at[1] - at[0]).cross(at[2] - at[0]).normalize_or_zero();
        for i in 0..3 {
            let [next, last] = [(i + 1) % 3, (i + 2) % 3].map(|other| at[other] - at[i]);
            let weight =
                next.cross(last).length() / (next.length_squared() * last.length_squared());
            if weight.is_finite() {
                let (sum, all) = &mut sums[places[i]];
                *sum += weight * normal_of(triangle.corners[i] as usize, mesh).normalize_or(facet);
                *all += weight;
            }
        }
    }
    let pairs = sums.par_iter().zip(&any);
    let joined = pairs.map(|(&(sum, all), any)| {
        let cancelled = sum.length() <= LEAST_SUM * all;
        if cancelled { any.normalize_or(DVec3::Y) } else { sum.normalize_or(DVec3::Y) }
    });
    joined.collect()
}

/// Stiffness of the edges from all places to all neighbours: half the sum of the cotangents of the
/// angles that face the edge (Pinkall and Polthier, "Computing discrete minimal surfaces and their
/// conjugates", 1993), within [`STIFFNESS`]. With these weights, sums over edges do not depend on
/// the cut into triangles.
fn stiffness(triangles: &[[u32; 3]], positions: &[DVec3], neighbours: &Neighbours) -> Vec<f64> {
    let mut sums = vec![0.0; neighbours.slot_count()];
    for corners in triangles {
        let at = corners.map(|corner| positions[corner as usize]);
        for i in 0..3 {
            let [next, last] = [(i + 1) % 3, (i + 2) % 3];
            let to_next = at[next] - at[i];
            let to_last = at[last] - at[i];
            let cotangent = to_next.dot(to_last) / to_next.cross(to_last).length();
            if !cotangent.is_finite() {
                continue;
            }
            for [from, to] in [[next, last], [last, next]] {
                if let Some(slot) = neighbours.slot(corners[from], corners[to]) {
                    sums[slot] += 0.5 * cotangent;
                }
            }
        }
    }
    sums.iter_mut().for_each(|sum| *sum = sum.clamp(STIFFNESS[0], STIFFNESS[1]));
    sums
}

/// Averages unit normals in rounds: each one, half and half, with the mean of its neighbours.
/// Weights by stiffness keep a diagonal or an open edge from pulling them to one side.
fn averaged(
    mut normals: Vec<DVec3>,
    neighbours: &Neighbours,
    stiffness: &[f64],
    rounds: usize,
) -> Vec<DVec3> {
    for _ in 0..rounds {
        let places = normals.par_iter().with_min_len(1 << 9).enumerate();
        let next = places.map(|(place, &own)| {
            let around = neighbours.of(place).iter().zip(&stiffness[neighbours.slots(place)]);
            let sum: DVec3 = around.map(|(&to, &held)| held * (own + normals[to as usize])).sum();
            // Opposite normals cancel out: keep the old one.
            sum.try_normalize().unwrap_or(own)
        });
        normals = next.collect();
    }
    normals
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::test_shapes::{bare, cylinder, degrees_between, ragged, rough, torus, turned};
    use glam::{Quat, Vec3};

    /// Greatest errors against known curvatures. The first is the error of both curvatures,
    /// relative to the greatest at the vertex. The second is the error of the direction of the
    /// least curvature, in degrees.
    fn errors(mesh: &Mesh, known: impl Fn(Vec3) -> ([f32; 2], Vec3), radius: f32) -> [f32; 2] {
        let mut worst = [0.0_f32; 2];
        for (curvature, &position) in Curvature::of_mesh(mesh, 0).iter().zip(&mesh.positions) {
            let ([least, greatest], along) = known(Vec3::from(position));
            let off = (curvature.least - least).abs().max((curvature.greatest - greatest).abs());
            worst[0] = worst[0].max(off / greatest.abs());
            if (greatest - least).abs() * radius > 0.1 {
                worst[1] = worst[1].max(degrees_between(curvature.along_least, along));
            }
        }
        worst
    }

    /// Least and greatest curvature of a torus about z, and the direction of the least.
    fn of_torus(ring: f32, tube: f32) -> impl Fn(Vec3) -> ([f32; 2], Vec3) {
        move |at| {
            let from_axis = at.truncate().length();
            let round = (from_axis - ring) / tube / from_axis;
            ([round, 1.0 / tube], Vec3::Z.cross(at).normalize())
        }
    }

    #[test]
    fn a_sphere_has_one_curvature_everywhere() {
        for (triangles, most) in [(200, 0.02), (5000, 0.005)] {
            let [curvature, _] = errors(&Mesh::sphere(triangles), |_| ([1.0, 1.0], Vec3::X), 0.0);
            assert!(curvature < most, "{triangles}: {curvature}");
        }
    }

    #[test]
    fn a_torus_and_a_cylinder_have_their_curvatures_and_directions() {
        let [curvature, direction] = errors(&torus(6000, 1.0, 0.4), of_torus(1.0, 0.4), 1.0);
        assert!(curvature < 0.02 && direction < 3.0, "torus: {curvature}, {direction} deg");
        let [curvature, direction] = errors(&cylinder(3000, 0.5), |_| ([0.0, 2.0], Vec3::Y), 0.5);
        assert!(curvature < 0.02 && direction < 3.0, "cylinder: {curvature}, {direction} deg");
    }

    #[test]
    fn normals_computed_from_the_triangles_are_good_enough() {
        let mut mesh = torus(20_000, 1.0, 0.4);
        mesh.normals = mesh.vertex_normals();
        let [curvature, direction] = errors(&mesh, of_torus(1.0, 0.4), 1.0);
        assert!(curvature < 0.02 && direction < 3.0, "{curvature}, {direction} deg");
    }

    #[test]
    fn a_bowl_seen_from_inside_has_negative_curvature() {
        let mut mesh = Mesh::sphere(2000);
        mesh.normals.iter_mut().for_each(|normal| *normal = normal.map(|value| -value));
        for curvature in Curvature::of_mesh(&mesh, 0) {
            assert!((curvature.greatest + 1.0).abs() < 0.02, "{curvature:?}");
        }
    }

    #[test]
    fn a_turned_mesh_has_the_turned_curvatures() {
        let turn = Quat::from_scaled_axis(Vec3::new(0.7, -1.9, 0.4));
        for mesh in [torus(3000, 1.0, 0.4), Mesh::torus_knot(5000)] {
            let pairs = Curvature::of_mesh(&mesh, 1)
                .into_iter()
                .zip(Curvature::of_mesh(&turned(&mesh, turn), 1));
            for (before, after) in pairs {
                let wanted = turn * Vec3::from(before.along_least);
                let found = Vec3::from(after.along_least);
                let off = (found - wanted).length().min((found + wanted).length());
                assert!(off < 1e-4, "{before:?}, {after:?}");
                assert!((before.least - after.least).abs() < 1e-4 * before.greatest.abs());
            }
        }
    }

    #[test]
    fn seams_do_not_show() {
        let whole = Mesh::torus_knot(3000);
        let apart = ragged(&whole);
        let whole_curvatures = Curvature::of_mesh(&whole, 2);
        let apart_curvatures = Curvature::of_mesh(&apart, 2);
        let corners = whole.triangles.iter().flat_map(|triangle| triangle.corners);
        for (corner, apart) in corners.zip(&apart_curvatures) {
            assert_eq!(whole_curvatures[corner as usize], *apart, "vertex {corner}");
        }
    }

    #[test]
    fn smoothing_calms_the_curvature_of_a_rough_model() {
        let mesh = rough(&Mesh::sphere(2000), 0.01);
        let [calmed, rough] = [3, 0].map(|rounds| {
            let curvatures = Curvature::of_mesh(&mesh, rounds);
            let squares = curvatures.iter().map(|own| (own.greatest - own.least).powi(2));
            (squares.sum::<f32>() / curvatures.len() as f32).sqrt()
        });
        assert!(calmed < 0.5 * rough, "{calmed} of {rough}");
    }

    #[test]
    fn bad_meshes_have_finite_curvatures() {
        let needle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 1e-7, 0.0], [0.5, 1.0, 1e-30]];
        let tent = [
            [0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, 0.0, 0.0],
            [-1.0, 0.0, 0.2],
            [0.1, 0.0, 1.0],
            [9.0, 9.0, 9.0],
        ];
        let huge = tent.map(|at| at.map(|value| value * 1e18));
        let tiny = tent.map(|at| at.map(|value| value * 1e-30));
        let fan = [[0, 1, 2], [0, 1, 3], [0, 1, 4], [4, 1, 0]];
        for (name, mesh) in [
            ("one triangle", bare(&needle, &[[0, 1, 3]])),
            ("needle", bare(&needle, &[[0, 1, 2], [0, 2, 3], [1, 3, 2]])),
            ("no area", bare(&needle, &[[0, 0, 1], [1, 1, 1]])),
            ("three sheets on an edge", bare(&tent, &fan)),
            ("huge", bare(&huge, &fan)),
            ("tiny", bare(&tiny, &fan)),
        ] {
            mesh.check().unwrap();
            for (vertex, own) in Curvature::of_mesh(&mesh, 1).into_iter().enumerate() {
                let numbers = [own.along_least, own.along_greatest].concat();
                let all = numbers.iter().chain([&own.least, &own.greatest]);
                assert!(all.clone().all(|number| number.is_finite()), "{name} {vertex}: {own:?}");
                let length = Vec3::from(own.along_least).length();
                assert!((length - 1.0).abs() < 1e-5, "{name} {vertex}: {own:?}");
                let used = mesh.triangles.iter().any(|one| one.corners.contains(&(vertex as u32)));
                assert_eq!(own.known, used && name != "no area", "{name} {vertex}: {own:?}");
                assert!(own.known || own.greatest == 0.0, "{name} {vertex}: {own:?}");
            }
        }
    }

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
        let places = [[-1e-4, -1e-4], [2e-4, 0.0], [0.0, 1e-4]];
        let positions =
            places.map(|[x, y]| DVec3::new(x, y, 0.5 * (p * x * x + 2.0 * q * x * y + r * y * y)));
        let normals =
            places.map(|[x, y]| DVec3::new(-(p * x + q * y), -(q * x + r * y), 1.0).normalize());
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

    fn planes() -> Vec<TangentPlane> {
        let normals = [[0.0, 1.0, 0.0], [0.3, -0.5, 0.8], [-1.0, 1e-9, 0.0], [0.6, 0.6, -0.5]];
        normals.map(|normal| TangentPlane::of_normal(DVec3::from(normal).normalize())).to_vec()
    }

    #[test]
    fn a_line_is_the_root_of_its_square_up_to_the_sign() {
        for plane in planes() {
            for degrees in 0..360 {
                let unit = DVec2::from_angle(f64::from(degrees).to_radians());
                let vector = plane.right * unit.x + plane.up * unit.y;
                let line = plane.along(unit.rotate(unit) * 7.0);
                assert!((line.dot(vector).abs() - 1.0).abs() < 1e-14, "{degrees}: {line}");
                assert!(line.dot(plane.normal).abs() < 1e-14, "{degrees}: {line}");
            }
        }
    }

    #[test]
    fn a_square_is_carried_as_the_line_that_it_stands_for_and_back() {
        for from in planes() {
            for to in planes() {
                let turn = from.turn_of_squares(&to).unwrap();
                let back = to.turn_of_squares(&from).unwrap();
                assert!((turn.rotate(back) - DVec2::X).length() < 1e-12, "{turn} {back}");
                let square = DVec2::from_angle(0.7);
                let line = carried(from.along(square), from.normal, to.normal).unwrap();
                let same = to.along(turn.rotate(square)).dot(line).abs();
                assert!((same - 1.0).abs() < 1e-12, "{from:?} {to:?}: {same}");
            }
        }
    }

    #[test]
    fn nothing_is_carried_between_opposite_planes() {
        let plane = TangentPlane::of_normal(DVec3::Y);
        assert_eq!(plane.turn_of_squares(&TangentPlane::of_normal(-DVec3::Y)), None);
    }
}
