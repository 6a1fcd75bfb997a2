//! One volume of paint: a closed mesh whose vertices are particles.

use glam::Vec3;
use paint::layer::Cell;

use crate::sphere_mesh::SphereMesh;

/// Places and velocities of the particles of a volume, in the order of its [`SphereMesh`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Particles {
    /// Places relative to the centre of the volume along x, y and z, in the unit of the scene.
    pub places: [Vec<f32>; 3],
    /// Velocities along x, y and z, in units of the scene a second.
    pub velocities: [Vec<f32>; 3],
    /// Index of the sample of the surface that each particle is pulled to; the greatest number for
    /// none.
    pub samples: Vec<u32>,
}

/// A volume of paint.
#[derive(Debug, Clone, PartialEq)]
pub struct Volume {
    /// Centre, in the unit of the scene.
    pub center: Vec3,
    /// Place that its centre moves to.
    pub target_center: Vec3,
    /// Radius at which it rests at present, above 0, in the unit of the scene.
    pub radius: f32,
    /// Radius that it grows or shrinks to.
    pub target_radius: f32,
    /// Level of detail of its mesh, 0 to [`crate::sphere_mesh::MOST_DETAIL`].
    pub detail: u8,
    /// Index of the region that it colours.
    pub region: u16,
    /// Cell of the grid that it stands in; none for a single volume.
    pub cell: Option<u32>,
    /// Number of the body that it colours, see `wetting::Bodies`; 0 for all.
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
    /// The forces under which it came to rest, as a number that tells forces apart; 0 if it moves.
    pub(crate) rests_under: u64,
}

impl Volume {
    /// A resting ball without paint.
    ///
    /// # Panics
    /// If `detail` is above [`crate::sphere_mesh::MOST_DETAIL`].
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
}
