//! Features of noise, drawn as splats.

use super::features::{Feature, Features};
use super::octaves::{FeatureNoise, Octaves};
use super::projection::Projection;
use super::selection::{Density, InSight};
use super::splat::Splat;

impl Features {
    /// The features of `noise` to draw in a projection, hidden ones included. Their order
    /// does not depend on the projection.
    #[must_use]
    pub fn splats(&self, projection: &Projection, noise: FeatureNoise) -> Vec<Splat> {
        let octaves = Octaves::new(noise);
        let (end, margin_px) = (octaves.end(), octaves.largest_px());
        let in_sight = InSight::new(projection, Density::Screen, end, margin_px);
        self.selected(&in_sight, |feature, splats| draw(projection, &octaves, feature, splats))
    }
}

/// 1 for a bump, -1 for a hollow.
fn sign(feature: &Feature) -> f32 {
    if feature.unit(4) < 0.5 { 1.0 } else { -1.0 }
}

fn draw(projection: &Projection, octaves: &Octaves, feature: &Feature, splats: &mut Vec<Splat>) {
    let Some(at) = projection.project(feature.position) else { return };
    let towards = feature.normal.dot(feature.position - projection.camera.eye);
    // Pixels that one unit of area covers here.
    let focal = projection.focal_px / at.distance;
    let pixels = focal * focal * towards.abs() / at.distance;
    let rank = feature.priority / pixels;
    // The comparison is false for features seen edge-on, whose rank is NaN or infinite.
    if !(rank < octaves.end() && at.depth <= 1.0) {
        return;
    }
    let [slope_x, slope_y] = projection.slope(feature.normal, towards);
    let near = |at: f32, size: usize, r: f32| at > -r && at < size as f32 + r;
    for [radius, amplitude] in octaves.parts(rank) {
        if !near(at.x, projection.width, radius) || !near(at.y, projection.height, radius) {
            continue;
        }
        // Allows for one pixel, and for the curvature of the surface within the radius.
        let slack =
            projection.depth_scale() * (1.0 + radius / 4.0) / (projection.focal_px * at.distance);
        splats.push(Splat {
            x: at.x,
            y: at.y,
            narrowness: 1.0 / radius,
            amplitude: amplitude * sign(feature),
            depth: at.depth,
            slope_x,
            slope_y,
            tightness: 1.0 / slack,
        });
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::Vec3;

    use super::*;
    use crate::camera::Camera;
    use crate::coherence::hierarchy::Hierarchy;
    use crate::mesh::Mesh;

    fn features(mesh: &Mesh) -> Features {
        Features::new(Arc::new(Hierarchy::new(mesh)), 7)
    }

    #[test]
    fn the_density_on_the_screen_does_not_depend_on_distance_or_triangles() {
        let noise = FeatureNoise { largest_px: 16.0, octaves: 2, persistence: 0.5, coverage: 4.0 };
        let mut densities = Vec::new();
        for (triangles, distance) in [(40_000, 2.0), (400, 2.0), (40_000, 9.0), (400, 0.3)] {
            let features = features(&Mesh::sphere(triangles));
            let camera = Camera {
                eye: Vec3::Z * (1.0 + distance),
                target: Vec3::ZERO,
                up: Vec3::Y,
                field_of_view_deg: 5.0,
                near: distance / 2.0,
                far: distance + 1.0,
            };
            // The far plane cuts off the farther half of the sphere.
            let projection = Projection::new(&camera, 400, 400);
            let splats = features.splats(&projection, noise);
            let inside = splats.iter().filter(|splat| {
                splat.narrowness < 1.0 / 12.0
                    && (0.0..400.0).contains(&splat.x)
                    && (0.0..400.0).contains(&splat.y)
            });
            let silhouette =
                (projection.focal_px / ((1.0 + distance).powi(2) - 1.0).sqrt()).min(226.0);
            let area = (std::f32::consts::PI * silhouette * silhouette).min(160_000.0);
            densities.push(inside.count() as f32 * 256.0 / area);
        }
        let mean = densities.iter().sum::<f32>() / densities.len() as f32;
        let even = densities.iter().all(|density| (density / mean - 1.0).abs() < 0.12);
        assert!(even, "{densities:?}");
    }

    #[test]
    fn an_empty_mesh_has_no_features() {
        let features = features(&Mesh::default());
        let camera = Camera::framing(Mesh::sphere(20).bounds(), 0.0, 0.0, 30.0);
        assert_eq!(features.splats(&Projection::new(&camera, 20, 20), FeatureNoise::FLOW), []);
    }
}
