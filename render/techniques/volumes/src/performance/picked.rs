//! Places picked in a picture.

use glam::Vec3;
use graphics::camera::Camera;
use graphics::mesh::Mesh;
use graphics::surface::{NO_TRIANGLE, VisibilityBuffer, position_at, visible};

/// The first picture of a scene, in which a script picks places.
#[derive(Debug, Clone)]
pub struct FirstView {
    seen: VisibilityBuffer,
}

impl FirstView {
    /// The view of `scene` by `camera` in a picture of this size.
    ///
    /// # Panics
    /// If a triangle has a corner that the mesh does not have.
    #[must_use]
    pub fn new(scene: &Mesh, camera: &Camera, (width, height): (usize, usize)) -> Self {
        Self { seen: visible(scene, camera, width, height) }
    }

    /// The place on `scene` at a share of the picture's width, from the left, and of its height,
    /// from the top; none where the picture shows no surface.
    #[must_use]
    pub fn place(&self, scene: &Mesh, share: [f64; 2]) -> Option<Vec3> {
        place_seen(scene, &self.seen, share)
    }
}

/// The place on `scene` that `seen`, a picture of it, shows at a share of its width and height;
/// none where it shows no surface, and outside of it.
#[must_use]
pub fn place_seen(scene: &Mesh, seen: &VisibilityBuffer, share: [f64; 2]) -> Option<Vec3> {
    let width = seen.width();
    let height = seen.height();
    if !share.iter().all(|share| (0.0..=1.0).contains(share)) || width * height == 0 {
        return None;
    }
    let at = |share: f64, count: usize| ((share * count as f64) as usize).min(count - 1);
    let fragment = seen[(at(share[0], width), at(share[1], height))];
    (fragment.triangle != NO_TRIANGLE).then(|| position_at(scene, fragment))
}
