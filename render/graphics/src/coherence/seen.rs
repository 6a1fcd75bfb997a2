//! Features of a mesh as a camera sees them, for splats of any kind.

use super::features::{Feature, Features};
use super::projection::Projection;
use super::selection::{Density, InSight};

/// A feature as a camera sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenFeature {
    /// The feature.
    pub feature: Feature,
    /// Distance from the left edge in pixels.
    pub x: f32,
    /// Distance from the upper edge in pixels.
    pub y: f32,
    /// Depth, 0 (near plane) to 1 (far plane).
    pub depth: f32,
    /// Distance in front of the eye along the viewing direction, in the unit of the model.
    pub distance: f32,
    /// Cosine between the normal of its triangle and the direction to the eye; negative on
    /// triangles that face away.
    pub facing: f32,
    /// Density at which it begins, in features per pixel of the [`Density`] asked for.
    pub rank: f32,
}

impl Features {
    /// The features of ranks below `end` that a projection shows, hidden ones included, up to
    /// `margin_px` beyond the edges (with a density on the surface, in its pixels). Their order
    /// does not depend on the projection. A rank changes continuously with the camera.
    #[must_use]
    pub fn seen(
        &self,
        projection: &Projection,
        density: Density,
        end: f32,
        margin_px: f32,
    ) -> Vec<SeenFeature> {
        self.seen_where(projection, density, end, margin_px, |_| true)
    }

    /// Those of [`Features::seen`] for which `keep` is true, in the same order.
    #[must_use]
    pub fn seen_where(
        &self,
        projection: &Projection,
        density: Density,
        end: f32,
        margin_px: f32,
        keep: impl Fn(&SeenFeature) -> bool + Sync,
    ) -> Vec<SeenFeature> {
        let in_sight = InSight::new(projection, density, end, margin_px);
        self.selected(&in_sight, |feature, seen| {
            seen.extend(see(projection, density, feature).filter(|seen| {
                // False for features seen edge-on, whose rank is NaN or infinite.
                seen.rank < end && seen.depth <= 1.0 && keep(seen)
            }));
        })
    }
}

fn see(projection: &Projection, density: Density, feature: &Feature) -> Option<SeenFeature> {
    let at = projection.project(feature.position)?;
    let to_eye = projection.camera.eye - feature.position;
    let towards = feature.normal.dot(to_eye);
    let pixels = match density {
        Density::Screen => {
            let focal = projection.focal_px / at.distance;
            focal * focal * towards.abs() / at.distance
        }
        Density::Facing => (projection.focal_px / at.distance).powi(2),
        Density::Surface { px_per_unit } => px_per_unit * px_per_unit,
    };
    Some(SeenFeature {
        feature: *feature,
        x: at.x,
        y: at.y,
        depth: at.depth,
        distance: at.distance,
        facing: towards / to_eye.length(),
        rank: feature.priority / pixels,
    })
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::camera::Camera;
    use crate::coherence::hierarchy::Hierarchy;
    use crate::mesh::Mesh;

    /// Number of features per pixel of the disc that a sphere covers, seen at two distances.
    fn counts(density: Density) -> [f64; 2] {
        let mesh = Mesh::sphere(4000);
        let features = Features::new(Arc::new(Hierarchy::new(&mesh)), 3);
        [0.0, 15.0].map(|away| {
            let mut camera = Camera::framing(mesh.bounds(), 20.0, 10.0, 20.0);
            let back = (camera.eye - camera.target).normalize();
            camera.eye += back * away;
            camera.far += away;
            let projection = Projection::new(&camera, 200, 200);
            let seen = features.seen(&projection, density, 0.02, 10.0);
            seen.iter().filter(|seen| seen.facing > 0.0).count() as f64
        })
    }

    #[test]
    fn the_rank_keeps_the_density_of_the_picture_or_of_the_surface() {
        let [near, far] = counts(Density::Screen);
        assert!(far < 0.5 * near, "on the screen: {near}, {far}");
        let [near, far] = counts(Density::Facing);
        assert!(far < 0.5 * near, "facing the eye: {near}, {far}");
        let [near, far] = counts(Density::Surface { px_per_unit: 80.0 });
        assert!((far / near - 1.0).abs() < 0.1, "on the surface: {near}, {far}");
    }

    #[test]
    fn ranks_and_places_change_little_with_a_small_turn() {
        let mesh = Mesh::torus_knot(3000);
        let features = Features::new(Arc::new(Hierarchy::new(&mesh)), 3);
        let [before, after] = [30.0, 30.02].map(|azimuth| {
            let camera = Camera::framing(mesh.bounds(), azimuth, 10.0, 30.0);
            let projection = Projection::new(&camera, 200, 200);
            features.seen(&projection, Density::Screen, 0.05, 10.0)
        });
        let mut next = after.iter();
        let mut compared = 0;
        for own in before.iter().filter(|own| own.facing > 0.3 && own.rank < 0.04) {
            let seed = own.feature.seed;
            let then = next.find(|then| then.feature.seed == seed).unwrap();
            assert!((own.rank / then.rank - 1.0).abs() < 0.01, "{own:?} {then:?}");
            assert!((own.x - then.x).abs() < 0.2 && (own.y - then.y).abs() < 0.2);
            compared += 1;
        }
        assert!(compared > 300, "{compared}");
    }
}
