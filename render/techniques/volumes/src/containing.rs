//! Finds out whether a volume holds a point. For this we look for the face through which the ray
//! from the centre to the point leaves, and its distance.
//!
//! Every ray from the centre of a star-shaped volume leaves through one face. We start at the face
//! through which the ray leaves the sphere at rest. Then we cross edges until the ray lies between
//! the three planes through the centre and the edges of the face (Devillers, Pion and Teillaud
//! 2002, "Walking in a triangulation").

use std::sync::OnceLock;

use glam::{DVec3, Vec3};

use crate::volume::{MOST_DETAIL, SphereMesh, Volume};

/// After this many crossed edges we search all faces instead, because a walk over flat faces may
/// circle.
const MOST_CROSSED: usize = 64;

/// The inside of a star-shaped volume. You prepare this once for many points.
#[derive(Debug, Clone)]
pub struct Inside {
    center: DVec3,
    places: Vec<DVec3>,
    routes: &'static Routes,
    /// Distance from the centre within which there are no faces.
    least: f64,
    /// Distance of the farthest vertex from the centre.
    most: f64,
}

/// The point at which the ray from the centre through a point leaves a volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exit {
    /// Index of the face.
    pub face: u32,
    /// Distance from the centre, in the unit of the scene.
    pub distance: f64,
}

impl Inside {
    /// The inside of `volume`. It must be star-shaped about its centre, which the guard of its
    /// motion ensures. Faces are flat.
    #[must_use]
    pub fn of(volume: &Volume) -> Self {
        let [x, y, z] = &volume.particles.places;
        let places: Vec<DVec3> =
            (0..x.len()).map(|i| Vec3::new(x[i], y[i], z[i]).as_dvec3()).collect();
        let routes = Routes::of_detail(volume.detail);
        let most = places.iter().fold(0.0, |most: f64, at| most.max(at.length_squared())).sqrt();
        let to_plane = routes.faces.iter().map(|face| {
            let [a, b, c] = face.map(|corner| places[corner as usize]);
            let normal = (b - a).cross(c - a);
            normal.dot(a) / normal.length()
        });
        let least = to_plane.fold(most, f64::min).max(0.0);
        Self { center: volume.center.as_dvec3(), places, routes, least, most }
    }

    /// Whether the volume holds the point `at`. This includes points on its skin.
    #[must_use]
    pub fn holds(&self, at: Vec3) -> bool {
        let ray = at.as_dvec3() - self.center;
        let distance = ray.length_squared();
        // The bounds are rounded. The margin leaves points near them to the faces.
        if distance < (self.least * self.least) * (1.0 - 1e-12) {
            return true;
        }
        if distance > (self.most * self.most) * (1.0 + 1e-12) {
            return false;
        }
        let (_, along, whole) = self.leaving(ray);
        along <= whole
    }

    /// Finds where the ray from the centre through `at` leaves the volume. If `at` is the centre
    /// itself, the distance is infinite.
    #[must_use]
    pub fn exit(&self, at: Vec3) -> Exit {
        let ray = at.as_dvec3() - self.center;
        let (face, along, whole) = self.leaving(ray);
        let distance = if along > 0.0 { ray.length() * whole / along } else { f64::INFINITY };
        Exit { face, distance }
    }

    /// Centre in the unit of the scene.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        self.center
    }

    /// Distance of the farthest vertex from the centre, in the unit of the scene.
    #[must_use]
    pub fn farthest(&self) -> f64 {
        self.most
    }

    /// The face through which `ray` leaves. Also returns the dot products of the normal of its
    /// plane with `ray` and with a point of the plane. The ray crosses the plane at their ratio.
    fn leaving(&self, ray: DVec3) -> (u32, f64, f64) {
        let face = self.face_along(ray);
        let [a, b, c] = self.corners(face);
        let normal = a.cross(b) + b.cross(c) + c.cross(a);
        (face, normal.dot(ray), a.cross(b).dot(c))
    }

    fn face_along(&self, ray: DVec3) -> u32 {
        let mut face = self.routes.starts[cell_of(ray, self.routes.side)];
        for _ in 0..MOST_CROSSED {
            let sides = self.sides(face, ray);
            let Some(edge) = (0..3).find(|&edge| sides[edge] < 0.0) else { return face };
            face = self.routes.across[face as usize][edge];
        }
        let worst = |face: u32| self.sides(face, ray).into_iter().fold(f64::INFINITY, f64::min);
        let faces = 0..self.routes.faces.len() as u32;
        faces.max_by(|&a, &b| worst(a).total_cmp(&worst(b))).unwrap_or(face)
    }

    /// On which side of the planes through the centre and the edges of `face` the ray lies. No
    /// number is negative if the ray leaves through the face. Two faces get opposite values at
    /// their common edge, to the bit.
    fn sides(&self, face: u32, ray: DVec3) -> [f64; 3] {
        let [a, b, c] = self.corners(face);
        [a.cross(b).dot(ray), b.cross(c).dot(ray), c.cross(a).dot(ray)]
    }

    fn corners(&self, face: u32) -> [DVec3; 3] {
        self.routes.faces[face as usize].map(|corner| self.places[corner as usize])
    }
}

#[derive(Debug)]
struct Routes {
    faces: &'static [[u32; 3]],
    /// For each face, the neighbours across its three edges. Edge 0 joins the first and second
    /// corner, edge 1 the second and third, edge 2 the third and first.
    across: Vec<[u32; 3]>,
    side: usize,
    /// We divide each side of a cube around the centre into `side` x `side` squares. This holds,
    /// for each square, the face through which the ray through its middle leaves.
    starts: Vec<u32>,
}

impl Routes {
    fn of_detail(detail: u8) -> &'static Self {
        static ROUTES: [OnceLock<Routes>; MOST_DETAIL as usize + 1] =
            [const { OnceLock::new() }; MOST_DETAIL as usize + 1];
        ROUTES[usize::from(detail)].get_or_init(|| {
            let mesh = SphereMesh::of_detail(detail);
            // Squares are a little smaller than faces.
            Self::over(mesh, 4 << detail)
        })
    }

    fn over(mesh: &'static SphereMesh, side: usize) -> Self {
        let across = across(&mesh.faces);
        let places: Vec<DVec3> =
            mesh.directions.iter().map(|&at| Vec3::from(at).as_dvec3()).collect();
        let mut starts: Vec<u32> = Vec::with_capacity(6 * side * side);
        let mut face = 0;
        for cell in 0..6 * side * side {
            let ray = middle_of(cell, side);
            // Walks over the faces of a sphere always arrive (Delaunay).
            loop {
                let [a, b, c] = mesh.faces[face as usize].map(|corner| places[corner as usize]);
                let sides = [a.cross(b), b.cross(c), c.cross(a)].map(|side| side.dot(ray));
                let Some(edge) = sides.iter().position(|&side| side < 0.0) else { break };
                face = across[face as usize][edge];
            }
            starts.push(face);
        }
        Self { faces: &mesh.faces, across, side, starts }
    }
}

fn across(faces: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let directed = faces
        .iter()
        .zip(0..)
        .flat_map(|(&[a, b, c], face)| [(a, b, face), (b, c, face), (c, a, face)]);
    let mut edges: Vec<(u32, u32, u32)> = directed.collect();
    edges.sort_unstable();
    let beyond = faces.iter().map(|&[a, b, c]| {
        [(b, a), (c, b), (a, c)].map(|side| {
            let found = edges.partition_point(|&(from, to, _)| (from, to) < side);
            edges[found].2
        })
    });
    beyond.collect()
}

/// Index of the square ([`Routes::starts`]) through which a ray goes.
fn cell_of(ray: DVec3, side: usize) -> usize {
    let size = ray.abs();
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let at = ray.to_array();
    let [u, v] = [at[(axis + 1) % 3], at[(axis + 2) % 3]].map(|value| {
        let share = 0.5 + 0.5 * value / at[axis].abs();
        ((share * side as f64) as usize).min(side - 1)
    });
    ((2 * axis + usize::from(at[axis] < 0.0)) * side + v) * side + u
}

fn middle_of(cell: usize, side: usize) -> DVec3 {
    let plane = cell / (side * side);
    let v = cell / side % side;
    let u = cell % side;
    let [u, v] = [u, v].map(|at| (2.0 * at as f64 + 1.0) / side as f64 - 1.0);
    let axis = plane / 2;
    let mut ray = [0.0; 3];
    ray[axis] = if plane.is_multiple_of(2) { 1.0 } else { -1.0 };
    ray[(axis + 1) % 3] = u;
    ray[(axis + 2) % 3] = v;
    DVec3::from(ray)
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rayon::prelude::*;

    use super::*;
    use crate::test_volumes::bumpy;

    /// How often the faces of a volume wind around a point (van Oosterom and Strackee 1983).
    fn winding_number(volume: &Volume, at: DVec3) -> f64 {
        let [x, y, z] = &volume.particles.places;
        let solid = volume.mesh().faces.iter().map(|face| {
            let [a, b, c] = face.map(|i: u32| {
                let i = i as usize;
                volume.center.as_dvec3() + Vec3::new(x[i], y[i], z[i]).as_dvec3() - at
            });
            let la = a.length();
            let lb = b.length();
            let lc = c.length();
            let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
            2.0 * a.dot(b.cross(c)).atan2(below)
        });
        solid.sum::<f64>() / (4.0 * std::f64::consts::PI)
    }

    fn points(volume: &Volume, count: usize, seed: u64) -> Vec<Vec3> {
        let random = &mut ChaCha8Rng::seed_from_u64(seed);
        let away = (0..count)
            .map(|_| [(); 3].map(|()| random.random_range(-1.6_f32..1.6) * volume.radius));
        away.map(|away| volume.center + Vec3::from(away)).collect()
    }

    #[test]
    fn points_are_held_where_the_faces_wind_around_them() {
        let mut held = 0;
        for (detail, count) in [(0, 10_000), (1, 38_000), (2, 38_000), (3, 12_000), (4, 2000)] {
            let volume = bumpy(Vec3::new(0.3, -1.2, 0.7), 0.8, detail, 5 + u64::from(detail));
            let inside = Inside::of(&volume);
            held += points(&volume, count, 3)
                .par_iter()
                .map(|&at: &Vec3| {
                    let holds = inside.holds(at);
                    let distance = (at.as_dvec3() - inside.center).length();
                    let from_skin = (distance - inside.exit(at).distance).abs();
                    let winding = winding_number(&volume, at.as_dvec3()) > 0.5;
                    assert!(
                        holds == winding || from_skin < 1e-5 * f64::from(volume.radius),
                        "{at}"
                    );
                    usize::from(holds)
                })
                .sum::<usize>();
        }
        // This is about an eighth of a cube that is 3.2 radii wide.
        assert!((10_000..16_000).contains(&held), "{held}");
    }

    #[test]
    fn rays_leave_where_the_winding_number_falls() {
        for detail in 0..4 {
            let volume = bumpy(Vec3::new(2.0, 0.1, 0.0), 0.2, detail, 9);
            let inside = Inside::of(&volume);
            for at in points(&volume, 500, 4) {
                let Exit { face, distance } = inside.exit(at);
                let along = (at.as_dvec3() - inside.center).normalize();
                let [before, behind] = [0.9999, 1.0001].map(|times: f64| {
                    winding_number(&volume, inside.center + along * distance * times)
                });
                assert!(before > 0.5 && behind < 0.5, "{at} {distance}");
                let sides = inside.sides(face, along);
                assert!(sides.iter().all(|&side| side >= 0.0), "{sides:?}");
            }
        }
    }

    #[test]
    fn the_centre_is_inside_and_what_is_no_number_is_not() {
        let volume = bumpy(Vec3::ONE, 0.5, 3, 1);
        let inside = Inside::of(&volume);
        assert!(inside.holds(Vec3::ONE));
        assert_eq!(inside.exit(Vec3::ONE).distance, f64::INFINITY);
        assert!(!inside.holds(Vec3::new(f32::NAN, 0.0, 0.0)));
        assert!(!inside.holds(Vec3::splat(f32::INFINITY)));
        for at in volume.vertices() {
            let held = [0.9999, 1.0001]
                .map(|times: f32| inside.holds(Vec3::ONE + (Vec3::from(at) - Vec3::ONE) * times));
            assert_eq!(held, [true, false], "{at:?}");
        }
    }

    #[test]
    fn a_walk_that_circles_finds_its_face_among_all() {
        let volume = bumpy(Vec3::ZERO, 1.0, 2, 2);
        let inside = Inside::of(&volume);
        // These directions start at the far side of the volume.
        let turned: Vec<u32> = (0..inside.routes.starts.len())
            .map(|cell| {
                let side = inside.routes.side;
                inside.routes.starts[cell_of(-middle_of(cell, side), side)]
            })
            .collect();
        let routes: &'static Routes = Box::leak(Box::new(Routes {
            faces: inside.routes.faces,
            across: inside.routes.across.iter().map(|&[a, ..]| [a; 3]).collect(),
            side: inside.routes.side,
            starts: turned,
        }));
        let lost = Inside { routes, ..inside.clone() };
        for at in points(&volume, 300, 8) {
            assert_eq!(lost.exit(at), inside.exit(at), "{at}");
        }
    }
}
