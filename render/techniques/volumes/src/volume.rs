//! One volume of paint. It is a closed mesh, and its vertices are particles. Meshes come from unit
//! spheres of six levels of detail, which are subdivided icosahedra.

use std::sync::OnceLock;

use glam::{DVec3, Vec3};
use paint::layer::Cell;

/// Places and velocities of the particles of a volume, in the order of its [`SphereMesh`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Particles {
    /// Places relative to the centre of the volume along x, y and z, in the unit of the scene.
    pub places: [Vec<f32>; 3],
    /// Velocities along x, y and z, in units of the scene per second.
    pub velocities: [Vec<f32>; 3],
    /// Index of the sample of the surface that pulls each particle. The greatest number means
    /// none.
    pub samples: Vec<u32>,
}

/// A volume of paint.
#[derive(Debug, Clone, PartialEq)]
pub struct Volume {
    /// Centre, in the unit of the scene.
    pub center: Vec3,
    /// Its centre moves to this place.
    pub target_center: Vec3,
    /// Radius at which it rests at present, above 0, in the unit of the scene.
    pub radius: f32,
    /// It grows or shrinks to this radius.
    pub target_radius: f32,
    /// Level of detail of its mesh, 0 to [`MOST_DETAIL`].
    pub detail: u8,
    /// Index of the region that it colours.
    pub region: u16,
    /// Cell of the grid in which it stands. `None` for a single volume.
    pub cell: Option<u32>,
    /// Number of the body that it colours, see `wetting::Bodies`. 0 means all.
    pub body: u32,
    /// Mean unit normal of the surface that it lies on, or zero.
    pub normal: Vec3,
    /// Seed of its kicks.
    pub seed: u64,
    /// Whether its shape and paint are frozen.
    pub dry: bool,
    /// Its paint in quanta.
    pub paint: Cell,
    /// Its particles.
    pub particles: Particles,
    /// Fingerprint of the forces under which it came to rest, 0 if it moves.
    pub(crate) rests_under: u64,
}

impl Volume {
    /// A resting ball without paint.
    ///
    /// # Panics
    /// If `detail` is above [`MOST_DETAIL`].
    #[must_use]
    pub fn ball(center: Vec3, radius: f32, detail: u8, seed: u64) -> Self {
        let mesh = SphereMesh::of_detail(detail);
        let scale = radius / mesh.inradius;
        let still = vec![0.0; mesh.directions.len()];
        let particles = Particles {
            places: std::array::from_fn(|axis: usize| {
                mesh.directions.iter().map(|at| at[axis] * scale).collect()
            }),
            velocities: std::array::from_fn(|_| still.clone()),
            samples: vec![u32::MAX; still.len()],
        };
        let paint = Cell::default();
        let region = 0;
        let cell = None;
        let dry = false;
        let target_radius = radius;
        let normal = Vec3::ZERO;
        let rests_under = 0;
        Self {
            center,
            target_center: center,
            radius,
            target_radius,
            detail,
            region,
            cell,
            body: 0,
            normal,
            seed,
            dry,
            paint,
            particles,
            rests_under,
        }
    }

    /// Its mesh at rest.
    #[must_use]
    pub fn mesh(&self) -> &'static SphereMesh {
        SphereMesh::of_detail(self.detail)
    }

    /// Places of its vertices, in the unit of the scene.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = [f32; 3]> + '_ {
        let [x, y, z] = &self.particles.places;
        let center = self.center;
        (0..x.len()).map(move |i| (center + Vec3::new(x[i], y[i], z[i])).to_array())
    }
}

/// Highest level of detail, of 10,242 vertices.
pub const MOST_DETAIL: u8 = 5;

/// A unit sphere of triangles. It starts as an icosahedron. Each level of detail halves the faces
/// along every edge and moves all vertices onto the sphere.
///
/// The vertices of a level are the first ones of the next level. The faces `4 f` to `4 f + 3` of
/// the next level lie in face `f` of this one.
#[derive(Debug)]
pub struct SphereMesh {
    /// Unit vectors from the centre to the vertices.
    pub directions: Vec<[f32; 3]>,
    /// Components of the unit vectors along x, y and z, one array each.
    pub axes: [Vec<f32>; 3],
    /// Corners of the faces, counter-clockwise seen from outside.
    pub faces: Vec<[u32; 3]>,
    /// The vertices joined to each vertex by an edge, in ascending order. There are six. The first
    /// 12 vertices have only five, and their last entry is the vertex itself.
    pub neighbours: Vec<[u32; 6]>,
    /// Distance from the centre to the nearest face, below 1.
    pub inradius: f32,
    /// Least determinant of the unit vectors to the corners of a face, above 0.
    pub least_cone: f32,
}

impl SphereMesh {
    /// The sphere with `detail` 0 to [`MOST_DETAIL`]. It has 10 4^detail + 2 vertices and 20
    /// 4^detail faces.
    ///
    /// # Panics
    /// If `detail` is above [`MOST_DETAIL`].
    #[must_use]
    pub fn of_detail(detail: u8) -> &'static Self {
        static MESHES: [OnceLock<SphereMesh>; MOST_DETAIL as usize + 1] =
            [const { OnceLock::new() }; MOST_DETAIL as usize + 1];
        MESHES[usize::from(detail)].get_or_init(|| Self::subdivided(detail))
    }

    fn subdivided(detail: u8) -> Self {
        let (mut vertices, mut faces) = icosahedron();
        for _ in 0..detail {
            faces = halved(&mut vertices, &faces);
        }
        let neighbours = neighbours(vertices.len(), &faces);
        let to_plane = faces.iter().map(|face| {
            let [a, b, c] = face.map(|corner| vertices[corner as usize]);
            (b - a).cross(c - a).normalize().dot(a)
        });
        let inradius = to_plane.fold(1.0, f64::min) as f32;
        let cones = faces.iter().map(|face| {
            let [a, b, c] = face.map(|corner| vertices[corner as usize]);
            a.dot(b.cross(c))
        });
        let least_cone = cones.fold(1.0, f64::min) as f32;
        let directions = vertices.iter().map(|at| at.to_array().map(|value| value as f32));
        let directions: Vec<_> = directions.collect();
        let axes = std::array::from_fn(|axis| directions.iter().map(|at| at[axis]).collect());
        Self { directions, axes, faces, neighbours, inradius, least_cone }
    }
}

fn icosahedron() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut vertices = Vec::with_capacity(12);
    for (a, b) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
        let turned = [DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)];
        vertices.extend(turned.map(DVec3::normalize));
    }
    // All edges of the icosahedron are equally long. Three vertices joined by edges make a face.
    let mut faces = Vec::with_capacity(20);
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let joined = [(a, b), (b, c), (c, a)]
                    .map(|(a, b): (usize, usize)| vertices[a].distance(vertices[b]) < 1.1);
                if joined == [true; 3] {
                    let volume = vertices[a].cross(vertices[b]).dot(vertices[c]);
                    let [b, c] = if volume > 0.0 { [b, c] } else { [c, b] };
                    faces.push([a as u32, b as u32, c as u32]);
                }
            }
        }
    }
    (vertices, faces)
}

/// Cuts every face into four, and appends the new vertices at the middles of edges.
fn halved(vertices: &mut Vec<DVec3>, faces: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut edges: Vec<[u32; 2]> = faces
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    edges.sort_unstable();
    edges.dedup();
    let first = vertices.len() as u32;
    for &[a, b] in &edges {
        vertices.push((vertices[a as usize] + vertices[b as usize]).normalize());
    }
    let four = faces.iter().flat_map(|&[a, b, c]| {
        let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(a, b): (u32, u32)| {
            let found = edges.partition_point(|&edge| edge < [a.min(b), a.max(b)]);
            first + found as u32
        });
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    });
    four.collect()
}

fn neighbours(count: usize, faces: &[[u32; 3]]) -> Vec<[u32; 6]> {
    let mut lists = vec![Vec::with_capacity(6); count];
    // Every edge has two faces. They run along it in opposite directions.
    for &[a, b, c] in faces {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            lists[from as usize].push(to);
        }
    }
    let own = lists.into_iter().zip(0..).map(|(mut list, own): (Vec<u32>, u32)| {
        list.sort_unstable();
        let mut six = [own; 6];
        six[..list.len()].copy_from_slice(&list);
        six
    });
    own.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ball_lies_outside_of_its_radius() {
        let ball = Volume::ball(Vec3::new(1.0, 2.0, 3.0), 0.5, 2, 1);
        let vertices: Vec<_> = ball.vertices().map(Vec3::from).collect();
        for face in &ball.mesh().faces {
            let [a, b, c] = face.map(|corner| vertices[corner as usize]);
            let to_plane = (b - a).cross(c - a).normalize().dot(a - ball.center);
            assert!((0.4999..0.53).contains(&to_plane), "{to_plane}");
        }
    }

    #[test]
    fn every_level_is_a_closed_sphere_of_known_size() {
        // These distances of the nearest face come from a second implementation in numpy.
        for (detail, inradius) in [(0, 0.795), (2, 0.982), (3, 0.9955), (4, 0.9989)] {
            let mesh = SphereMesh::of_detail(detail);
            assert_eq!(mesh.directions.len(), 10 * 4_usize.pow(detail.into()) + 2);
            assert_eq!(mesh.faces.len(), 20 * 4_usize.pow(detail.into()));
            assert!((mesh.inradius - inradius).abs() < 1e-2, "{detail}: {}", mesh.inradius);
            let mut edges: Vec<[u32; 2]> =
                mesh.faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
            edges.sort_unstable();
            let count = edges.len();
            edges.dedup();
            assert_eq!(edges.len(), count);
            assert!(edges.iter().all(|&[a, b]| edges.binary_search(&[b, a]).is_ok()));
        }
    }

    #[test]
    fn faces_of_a_level_lie_in_those_of_the_level_above() {
        let [coarse, fine] = [2, 3].map(SphereMesh::of_detail);
        assert_eq!(coarse.directions, fine.directions[..coarse.directions.len()]);
        for (i, face) in coarse.faces.iter().enumerate() {
            let children = &fine.faces[4 * i..4 * i + 4];
            for &corner in face {
                assert!(children.iter().any(|child| child.contains(&corner)), "{i}");
            }
        }
    }

    #[test]
    fn a_vertex_has_six_neighbours_or_five() {
        let mesh = SphereMesh::of_detail(3);
        for (vertex, neighbours) in mesh.neighbours.iter().enumerate() {
            let own = neighbours.iter().filter(|&&other| other as usize == vertex).count();
            assert_eq!(own, usize::from(vertex < 12), "{vertex}");
            for &other in neighbours {
                assert!(mesh.neighbours[other as usize].contains(&(vertex as u32)) || own == 1);
            }
        }
    }
}
