//! The surface that a ray from the eye meets first.

use glam::{Vec2, Vec3};
use graphics::camera::Camera;
use graphics::mesh::Mesh;
use rayon::prelude::*;

/// Triangles that share the work of one thread at least.
const TRIANGLES: usize = 4096;

/// A place on a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hit {
    /// The place on it.
    pub(super) place: Vec3,
    /// Unit normal of the triangle, towards the eye.
    pub(super) normal: Vec3,
}

/// The surface at a place of the picture, given as a share of its width and height from the upper
/// left corner; `aspect` is width by height. `None` where nothing is seen.
pub(super) fn surface_at(mesh: &Mesh, camera: &Camera, aspect: f32, at: [f32; 2]) -> Option<Hit> {
    let [right, up, back] = camera.axes();
    let high = (0.5 * camera.field_of_view_deg).to_radians().tan();
    let screen = (Vec2::from(at) * 2.0 - 1.0) * Vec2::new(high * aspect, -high);
    let along = right * screen.x + up * screen.y - back;
    let corners = |index: usize| {
        let corners = mesh.triangles[index].corners;
        corners.map(|corner| Vec3::from(mesh.positions[corner as usize]))
    };
    let nearest = (0..mesh.triangles.len())
        .into_par_iter()
        .with_min_len(TRIANGLES)
        .filter_map(|index| Some((distance(corners(index), camera.eye, along)?, index)))
        // The first of equally near ones, on any number of threads.
        .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let (distance, index) = nearest?;
    let [a, b, c] = corners(index);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let normal = if normal.dot(along) > 0.0 { -normal } else { normal };
    Some(Hit { place: camera.eye + along * distance, normal })
}

/// Distance along a ray, in its lengths, at which it meets a triangle from either side (Moller,
/// Trumbore 1997).
fn distance([a, b, c]: [Vec3; 3], eye: Vec3, along: Vec3) -> Option<f32> {
    let ab = b - a;
    let ac = c - a;
    let across = along.cross(ac);
    let volume = ab.dot(across);
    if volume == 0.0 {
        return None;
    }
    let from = eye - a;
    let u = from.dot(across) / volume;
    let turned = from.cross(ab);
    let v = along.dot(turned) / volume;
    let distance = ac.dot(turned) / volume;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0).then_some(distance)
}

#[cfg(test)]
mod tests {
    use graphics::camera::Framing;
    use graphics::mesh::SampleModel;
    use graphics::surface::{NO_TRIANGLE, position_at, visible};

    use super::*;

    #[test]
    fn a_ray_meets_what_the_pixel_shows() {
        let mesh = SampleModel::StillLife.mesh(4000);
        let width = 64;
        let height = 40;
        let aspect = width as f32 / height as f32;
        let camera = Framing { aspect, ..Framing::default() }.camera(mesh.bounds());
        let seen = visible(&mesh, &camera, width, height);
        let mut hits = 0;
        let mut misses = 0;
        for y in 0..height {
            for x in 0..width {
                let at = [(x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32];
                let hit = surface_at(&mesh, &camera, aspect, at);
                let fragment = seen[(x, y)];
                match (hit, fragment.triangle == NO_TRIANGLE) {
                    (Some(hit), false) => {
                        let apart = hit.place.distance(position_at(&mesh, fragment));
                        let towards = camera.eye - hit.place;
                        assert!(hit.normal.dot(towards) >= 0.0, "it faces the eye");
                        hits += usize::from(apart < 2e-3);
                    }
                    (None, true) => misses += 1,
                    _ => {}
                }
            }
        }
        let share = (hits + misses) as f64 / (width * height) as f64;
        assert!(share > 0.99 && hits > 400 && misses > 100, "{share}: {hits} and {misses}");
    }
}
