//! Principal curvatures of a mesh and their directions at every vertex.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::model::Mesh;
use super::places::Places;
use super::shape_tensor::{PlaceShape, ShapeTensor, place_shapes};
use super::tangent_plane::TangentPlane;

/// Principal curvatures of a surface at a vertex, in 1/length of the model: positive where the
/// surface bends away from its normal (a sphere of radius 2 has 0.5 twice).
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
    /// Whether a triangle with area meets the vertex. If none does, both curvatures are 0 and the
    /// directions are any.
    pub known: bool,
}

impl Curvature {
    /// Curvature with this tensor in this tangent plane.
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

impl Mesh {
    /// Principal curvatures of every vertex, from the change of the normals along the edges
    /// (Rusinkiewicz, "Estimating curvatures and their derivatives on triangle meshes", 2004).
    ///
    /// Vertices with the same position count as one, so seams do not show. The normals are the
    /// mesh's own, averaged with their neighbours `rounds` times: 0 for a fine model, 1 to 3 for
    /// one whose facets or roughness show. Every number is finite for a mesh that passes
    /// [`Mesh::check`].
    ///
    /// # Panics
    /// If a triangle has a vertex that does not exist, or there are fewer normals than positions.
    #[must_use]
    pub fn curvatures(&self, rounds: usize) -> Vec<Curvature> {
        let places = Places::of(self, rounds);
        let normals = places.normals.par_iter();
        let planes: Vec<_> = normals.map(|&normal| TangentPlane::of_normal(normal)).collect();
        let shapes = place_shapes(&places, &planes);
        let pairs = shapes.par_iter().zip(&planes);
        let curvatures: Vec<_> = pairs.map(|(shape, plane)| Curvature::new(shape, plane)).collect();
        places.of_vertex.iter().map(|&place| curvatures[place as usize]).collect()
    }
}

/// The nearest finite number in single precision.
fn finite(value: f64) -> f32 {
    value.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32
}

/// A vector in single precision.
fn single(vector: DVec3) -> [f32; 3] {
    vector.as_vec3().to_array()
}

#[cfg(test)]
mod tests {
    use glam::{Quat, Vec3};

    use super::*;
    use crate::mesh::test_shapes::{bare, cylinder, degrees_between, ragged, rough, torus, turned};

    /// Greatest errors against known curvatures: of k, relative to the greatest at the vertex, and
    /// of the direction of the least, in degrees.
    fn errors(mesh: &Mesh, known: impl Fn(Vec3) -> ([f32; 2], Vec3), radius: f32) -> [f32; 2] {
        let mut worst = [0.0_f32; 2];
        for (curvature, &position) in mesh.curvatures(0).iter().zip(&mesh.positions) {
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
        for curvature in mesh.curvatures(0) {
            assert!((curvature.greatest + 1.0).abs() < 0.02, "{curvature:?}");
        }
    }

    #[test]
    fn a_turned_mesh_has_the_turned_curvatures() {
        let turn = Quat::from_scaled_axis(Vec3::new(0.7, -1.9, 0.4));
        for mesh in [torus(3000, 1.0, 0.4), Mesh::torus_knot(5000)] {
            let pairs = mesh.curvatures(1).into_iter().zip(turned(&mesh, turn).curvatures(1));
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
        let whole_curvatures = whole.curvatures(2);
        let apart_curvatures = apart.curvatures(2);
        let corners = whole.triangles.iter().flat_map(|triangle| triangle.corners);
        for (corner, apart) in corners.zip(&apart_curvatures) {
            assert_eq!(whole_curvatures[corner as usize], *apart, "vertex {corner}");
        }
    }

    #[test]
    fn smoothing_calms_the_curvature_of_a_rough_model() {
        let mesh = rough(&Mesh::sphere(2000), 0.01);
        let spread = |rounds| {
            let curvatures = mesh.curvatures(rounds);
            let squares = curvatures.iter().map(|own| (own.greatest - own.least).powi(2));
            (squares.sum::<f32>() / curvatures.len() as f32).sqrt()
        };
        assert!(spread(3) < 0.5 * spread(0), "{} of {}", spread(3), spread(0));
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
            for (vertex, own) in mesh.curvatures(1).into_iter().enumerate() {
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
}
