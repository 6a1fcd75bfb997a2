//! Coherent noise, which stays on its object while the camera moves.

mod popping;
mod spectrum;
mod twins;

use std::sync::Arc;

use glam::Vec3;
use graphics::camera::Camera;
use graphics::coherence::{
    AnchoredNoise, Anchors, FeatureNoise, Features, Hierarchy, Particles, Projection, Splat,
    depth_field, draw_anchored, draw_splats, repeating_noise,
};
use graphics::compute::Compute;
use graphics::field::Field;
use graphics::mesh::{Mesh, Triangle};
use graphics::surface::visible;

/// A mesh with what noise needs of it: hierarchy, features and a repeating texture.
struct Subject {
    mesh: Mesh,
    hierarchy: Arc<Hierarchy>,
    features: Features,
    texture: Field<f32>,
}

/// Projection and depth of a view, without noise.
struct Bare {
    projection: Projection,
    depth: Field<f32>,
}

impl Subject {
    fn new(mesh: Mesh) -> Self {
        let hierarchy = Arc::new(Hierarchy::new(&mesh));
        let features = Features::new(Arc::clone(&hierarchy), 1);
        Self { mesh, hierarchy, features, texture: repeating_noise(32, 1) }
    }

    fn bare(&self, camera: &Camera, width: usize, height: usize) -> Bare {
        let depth = depth_field(&visible(&self.mesh, camera, width, height));
        Bare { projection: Projection::new(camera, width, height), depth }
    }

    fn of_features(&self, bare: &Bare, noise: FeatureNoise) -> Field<f32> {
        let splats = self.features.splats(&bare.projection, noise);
        splats_on(&mut Compute::cpu(), &bare.depth, &splats)
    }

    fn of_particles(&self, bare: &Bare, particles: &Particles, wave_px: f32) -> Field<f32> {
        let anchors = particles.anchors(&bare.projection, waves(wave_px));
        anchored_on(&mut Compute::cpu(), &bare.depth, &self.texture, &anchors)
    }
}

/// Draws features over a field of depths.
fn splats_on(compute: &mut Compute, depth: &Field<f32>, splats: &[Splat]) -> Field<f32> {
    let depth = compute.upload(depth).unwrap();
    let drawn = draw_splats(compute, &depth, splats).unwrap();
    compute.download(&drawn).unwrap()
}

/// Draws copies of a texture over a field of depths.
fn anchored_on(
    compute: &mut Compute,
    depth: &Field<f32>,
    texture: &Field<f32>,
    anchors: &Anchors,
) -> Field<f32> {
    let depth = compute.upload(depth).unwrap();
    let texture = compute.upload(texture).unwrap();
    let drawn = draw_anchored(compute, &depth, &texture, anchors).unwrap();
    compute.download(&drawn).unwrap()
}

fn waves(wave_px: f32) -> AnchoredNoise {
    AnchoredNoise { wave_px, ..AnchoredNoise::FLOW }
}

/// A wall of two triangles, and a camera whose picture it fills.
fn wall() -> (Mesh, Camera) {
    let corners = [[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [5.0, 5.0, 0.0], [-5.0, 5.0, 0.0]];
    let triangles = [[0, 1, 2], [0, 2, 3]].map(|corners| Triangle { corners, material: 0 });
    let mesh = Mesh {
        positions: corners.to_vec(),
        normals: vec![[0.0, 0.0, 1.0]; 4],
        texture_coordinates: vec![[0.0; 2]; 4],
        colors: vec![[1.0; 3]; 4],
        triangles: triangles.to_vec(),
        materials: Mesh::sphere(20).materials,
    };
    (mesh, from_front(10.0, 20.0))
}

/// A camera on the z axis at `distance` that looks at the origin.
fn from_front(distance: f32, field_of_view_deg: f32) -> Camera {
    Camera {
        eye: Vec3::Z * distance,
        target: Vec3::ZERO,
        up: Vec3::Y,
        field_of_view_deg,
        near: 0.02,
        far: 20.0,
    }
}

/// Mean and standard deviation of the noise at pixels that show the object.
fn spread(noise: &Field<f32>, depth: &Field<f32>) -> [f64; 2] {
    let pairs = noise.values().iter().zip(depth.values());
    let seen: Vec<f64> =
        pairs.filter(|(_, depth)| **depth < 1.0).map(|(value, _)| f64::from(*value)).collect();
    let count = seen.len() as f64;
    let mean = seen.iter().sum::<f64>() / count;
    [mean, (seen.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt()]
}
