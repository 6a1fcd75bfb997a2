//! The guard that keeps volumes star-shaped: from the centre you see every face on its inside. Each
//! face forms a cone with the centre. If all cones have positive volumes, the mesh does not cut
//! itself, so it holds a point once or not at all.
//!
//! Also the microstructure of surfaces, which varies the resting radius with the place in the
//! world.

use graphics::noise::{SolidHills, random};

use super::settings::MotionSettings;
use crate::volume::SphereMesh;

/// The determinant of every cone stays above this share of the least one at rest. This leaves room
/// for the rounding of places in the scene.
pub(super) const LEAST_SHARE: f32 = 1.0 / 64.0;

/// In this many rounds, the corners of failing faces go half-way to the rays through their original
/// directions. After that they go all the way.
const HALF_WAY_ROUNDS: usize = 8;

/// After this many rounds all corners go to their rays.
const MOST_ROUNDS: usize = 16;

/// The place of a corner relative to the centre, and its distance.
pub(super) type Corner = [f32; 4];

#[inline(always)]
fn is_open([a, b, c]: [Corner; 3], least: f32) -> bool {
    let x = a[0] * (b[1] * c[2] - b[2] * c[1]);
    let y = a[1] * (b[2] * c[0] - b[0] * c[2]);
    let z = a[2] * (b[0] * c[1] - b[1] * c[0]);
    x + y + z > least * (a[3] * b[3] * c[3])
}

#[inline(always)]
pub(super) fn is_star(mesh: &SphereMesh, corners: &[Corner]) -> bool {
    let least = LEAST_SHARE * mesh.least_cone;
    let mut all = true;
    for face in &mesh.faces {
        all &= is_open(face.map(|corner| corners[corner as usize]), least);
    }
    all
}

/// Mends faces if their cones fail. Their corners go half-way to the ray through their original
/// direction, at their own distance, at most 8 times. Then they go onto it. This halves their
/// velocities each time.
pub(super) fn mend(mesh: &SphereMesh, corners: &mut [Corner], velocities: [&mut [f32]; 3]) {
    let least = LEAST_SHARE * mesh.least_cone;
    let mut failing = vec![false; corners.len()];
    let [x, y, z] = velocities;
    for round in 0..=MOST_ROUNDS {
        failing.fill(round == MOST_ROUNDS);
        for face in &mesh.faces {
            if !is_open(face.map(|corner| corners[corner as usize]), least) {
                for &corner in face {
                    failing[corner as usize] = true;
                }
            }
        }
        if !failing.contains(&true) {
            return;
        }
        for i in (0..corners.len()).filter(|&i| failing[i]) {
            let ray = mesh.directions[i].map(|along| along * corners[i][3]);
            corners[i] = if round < HALF_WAY_ROUNDS {
                half_way(corners[i], ray)
            } else {
                [ray[0], ray[1], ray[2], corners[i][3]]
            };
            for velocity in [&mut x[i], &mut y[i], &mut z[i]] {
                *velocity *= 0.5;
            }
        }
    }
}

/// The place between `corner` and `ray` at the distance of both. If they are opposite, this is
/// `ray`.
fn half_way([x, y, z, distance]: Corner, ray: [f32; 3]) -> Corner {
    let middle = [x + ray[0], y + ray[1], z + ray[2]];
    let length = middle.iter().fold(0.0, |sum, along| sum + along * along).sqrt();
    if length > distance / 1024.0 {
        let scale = distance / length;
        [middle[0] * scale, middle[1] * scale, middle[2] * scale, distance]
    } else {
        [ray[0], ray[1], ray[2], distance]
    }
}

/// Hills in the whole scene. They vary the resting radius of every particle. Volumes at one place
/// share these hills.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Microstructure {
    hills: SolidHills,
}

impl Microstructure {
    /// The microstructure for a `seed`.
    #[must_use]
    pub fn of_seed(seed: u64) -> Self {
        // The random numbers of this seed have a separate stream for it.
        const STREAM: u64 = 0x6772_6169;
        Self { hills: SolidHills::new(&mut random(seed, STREAM)) }
    }

    /// The hills. Different microstructures have different hills.
    pub(super) fn hills(self) -> SolidHills {
        self.hills
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct RestingRadii {
    pub(super) hills: SolidHills,
    /// The hills add at most this share of the radius.
    pub(super) height: f32,
    pub(super) units: f32,
    pub(super) center: [f32; 3],
    pub(super) radius: f32,
    pub(super) scale: f32,
}

impl RestingRadii {
    pub(super) fn new(
        microstructure: Microstructure,
        settings: &MotionSettings,
        cell: f32,
        center: [f32; 3],
        inradius: f32,
    ) -> Self {
        // The hills are strongest at a wavelength of `grain` cells.
        let units = 1.0 / (SolidHills::STRONGEST * settings.grain * cell);
        let hills = microstructure.hills;
        let height = settings.microstructure;
        Self { hills, height, units, center, radius: 0.0, scale: 1.0 / inradius }
    }

    /// Writes the resting radius in every direction: R (1 + a N(c + R u)) over the inradius.
    #[inline(always)]
    pub(super) fn write(&self, directions: [&[f32]; 3], out: &mut [f32]) {
        let (radius, scaled) = (self.radius, self.radius * self.scale);
        let [x, y, z] = directions.map(|along| &along[..out.len()]);
        if self.height == 0.0 {
            out.fill(scaled);
            return;
        }
        let [from_x, from_y, from_z] = self.center;
        for i in 0..out.len() {
            let hill = self.hills.at([
                (from_x + radius * x[i]) * self.units,
                (from_y + radius * y[i]) * self.units,
                (from_z + radius * z[i]) * self.units,
            ]);
            out[i] = scaled * (1.0 + self.height * hill);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use graphics::noise::random;
    use rand::RngExt;

    fn shaken(detail: u8, amount: f32) -> Vec<Corner> {
        let mut random = random(4, 0);
        SphereMesh::of_detail(detail)
            .directions
            .iter()
            .map(|at: &[f32; 3]| {
                let [x, y, z] =
                    at.map(|along| along + amount * (2.0 * random.random::<f32>() - 1.0));
                [x, y, z, (x * x + y * y + z * z).sqrt()]
            })
            .collect()
    }

    #[test]
    fn a_mesh_turned_inside_out_becomes_a_star_of_the_same_distances() {
        for (detail, amount) in [(0, 3.0), (2, 0.3), (3, 3.0), (4, 100.0), (5, 0.1)] {
            let mesh = SphereMesh::of_detail(detail);
            let before = shaken(detail, amount);
            assert!(!is_star(mesh, &before), "{detail}");
            let mut after = before.clone();
            let mut still = vec![0.0; before.len()];
            let mut other = still.clone();
            mend(mesh, &mut after, [&mut still, &mut other.clone(), &mut other]);
            assert!(is_star(mesh, &after), "{detail}");
            assert!(before.iter().zip(&after).all(|(before, after)| before[3] == after[3]));
        }
    }

    #[test]
    fn only_corners_of_failing_faces_move() {
        let mesh = SphereMesh::of_detail(3);
        let mut corners = shaken(3, 0.0);
        let before = corners.clone();
        let [x, y, z, distance] = corners[100];
        corners[100] = [-x, -y, -z, distance];
        let mut velocities = [vec![1.0; 642], vec![1.0; 642], vec![1.0; 642]];
        mend(mesh, &mut corners, velocities.each_mut().map(Vec::as_mut_slice));
        assert!(is_star(mesh, &corners));
        let moved: Vec<usize> = (0..642).filter(|&i| velocities[0][i] < 1.0).collect();
        let near: Vec<bool> =
            (0..642).map(|i: u32| i == 100 || mesh.neighbours[100].contains(&i)).collect();
        assert!(moved.contains(&100) && moved.iter().all(|&i| near[i]), "{moved:?}");
        assert!((0..642).all(|i: usize| near[i] || corners[i] == before[i]));
    }
}
