//! The camera of a scene. You turn, move and zoom it.

use eframe::egui::{Vec2, vec2};
use glam::Vec3;
use graphics::camera::Camera;

/// Vertical field of view in degrees.
const FIELD_DEG: f32 = 35.0;

/// Width divided by height of the picture in which we frame a scene.
const FRAMED_ASPECT: f32 = 4.0 / 3.0;

/// A drag of one point turns the camera by this, in degrees (chosen by hand).
const TURN_DEG: f32 = 0.35;

/// Highest elevation of the camera, in degrees. Above it, the picture would turn over.
const STEEPEST_DEG: f32 = 85.0;

/// A camera that turns around a target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orbit {
    bounds: [Vec3; 2],
    /// The camera that frames the scene in a picture of 4 by 3.
    home: Camera,
    /// Azimuth about the y axis and elevation, in degrees.
    angles: [f32; 2],
    target: Vec3,
    distance: f32,
    /// Width of the picture divided by its height.
    aspect: f32,
    /// Whether we frame the scene again whenever the picture changes its shape.
    framed: bool,
}

impl Orbit {
    /// A camera around the box between two corners. `home` frames this in a picture of 4 by 3.
    #[must_use]
    pub fn around(bounds: [Vec3; 2], home: Camera) -> Self {
        let mut orbit = Self {
            bounds,
            home,
            angles: [0.0; 2],
            target: Vec3::ZERO,
            distance: 1.0,
            aspect: FRAMED_ASPECT,
            framed: true,
        };
        orbit.frame();
        orbit
    }

    /// Frames the whole scene, as you see it first.
    pub fn frame(&mut self) {
        *self = self.seen_by(&self.home);
        // In a narrower picture we go farther away.
        self.distance *= (FRAMED_ASPECT / self.aspect).max(1.0);
        self.framed = true;
    }

    /// Sets the shape of the picture: its width divided by its height.
    pub fn set_aspect(&mut self, aspect: f32) {
        if aspect != self.aspect && aspect.is_finite() && aspect > 0.0 {
            self.aspect = aspect;
            if self.framed {
                self.frame();
            }
        }
    }

    /// This camera around the same scene, with the view of `camera`.
    #[must_use]
    pub fn seen_by(self, camera: &Camera) -> Self {
        let from_target = camera.eye - camera.target;
        let distance = from_target.length().max(1e-6);
        let elevation_deg = (from_target.y / distance).asin().to_degrees();
        let azimuth_deg = from_target.x.atan2(from_target.z).to_degrees();
        // This camera keeps its field of view, and things at the target keep their size.
        let [theirs, own] =
            [camera.field_of_view_deg, FIELD_DEG].map(|degrees| (0.5 * degrees).to_radians().tan());
        let distance = distance * theirs / own;
        let angles = [azimuth_deg, elevation_deg.clamp(-STEEPEST_DEG, STEEPEST_DEG)];
        Self { angles, target: camera.target, distance, framed: false, ..self }
    }

    /// Turns around the target by a drag of `by` points.
    pub fn turn(&mut self, by: Vec2) {
        let [azimuth, elevation] = self.angles;
        let elevation = (elevation + TURN_DEG * by.y).clamp(-STEEPEST_DEG, STEEPEST_DEG);
        self.angles = [(azimuth - TURN_DEG * by.x).rem_euclid(360.0), elevation];
        self.framed = false;
    }

    /// Moves the picture by `by` points in a picture of `height` points. Things as far away as the
    /// target follow the pointer.
    pub fn pan(&mut self, by: Vec2, height: f32) {
        let [right, up, _] = self.camera().axes();
        let size = 2.0 * self.distance * (0.5 * FIELD_DEG).to_radians().tan() / height.max(1.0);
        self.target += (up * by.y - right * by.x) * size;
        self.framed = false;
    }

    /// Comes nearer if the factor is above 1, or moves away if it is below. The point at
    /// `from_middle` points from the middle of a picture of `height` points stays there.
    pub fn zoom(&mut self, factor: f32, from_middle: Vec2, height: f32) {
        let radius = self.radius();
        let before = self.distance;
        self.distance = (self.distance / factor).clamp(0.05 * radius, 40.0 * radius);
        let kept = 1.0 - self.distance / before;
        let distance = std::mem::replace(&mut self.distance, before);
        self.pan(vec2(-from_middle.x, -from_middle.y) * kept, height);
        self.distance = distance;
        self.framed = false;
    }

    /// Length in points of `length` units at the distance of the target, in a picture of `height`
    /// points.
    #[must_use]
    pub fn points(&self, length: f64, height: f32) -> f32 {
        let size = 2.0 * self.distance * (0.5 * FIELD_DEG).to_radians().tan() / height.max(1.0);
        length as f32 / size
    }

    fn radius(&self) -> f32 {
        (0.5 * (self.bounds[1] - self.bounds[0]).length()).max(1e-6)
    }

    /// The camera now. Its near and far planes enclose the scene and paint around it.
    #[must_use]
    pub fn camera(&self) -> Camera {
        let [azimuth, elevation] = self.angles.map(f32::to_radians);
        let back = Vec3::new(
            azimuth.sin() * elevation.cos(),
            elevation.sin(),
            azimuth.cos() * elevation.cos(),
        );
        let middle = 0.5 * (self.bounds[0] + self.bounds[1]);
        let eye = self.target + back * self.distance;
        let reach = 1.5 * self.radius();
        let away = eye.distance(middle);
        Camera {
            eye,
            target: self.target,
            up: Vec3::Y,
            field_of_view_deg: FIELD_DEG,
            near: (away - reach).max(0.01 * self.distance.min(reach)),
            far: away + reach,
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec4Swizzles;
    use graphics::camera::Framing;

    use super::*;

    const BOX: [Vec3; 2] = [Vec3::new(-1.0, 0.0, -2.0), Vec3::new(3.0, 2.0, 2.0)];

    fn framed_box() -> Orbit {
        let framing =
            Framing { field_of_view_deg: FIELD_DEG, aspect: FRAMED_ASPECT, ..Framing::default() };
        Orbit::around(BOX, framing.camera(BOX))
    }

    fn corner_of_box(corner: usize) -> Vec3 {
        let [x, y, z] = [1, 2, 4].map(|bit| BOX[usize::from(corner & bit != 0)]);
        Vec3::new(x.x, y.y, z.z)
    }

    /// Place in the picture, from the middle, in halves of its width and height.
    fn seen(orbit: &Orbit, place: Vec3) -> [f32; 2] {
        let clip = orbit.camera().clip_from_model(orbit.aspect) * place.extend(1.0);
        let at = clip.xyz() / clip.w;
        [at.x, at.y]
    }

    #[test]
    fn the_whole_scene_is_framed_in_every_shape() {
        for aspect in [0.5, 1.0, 1.6, 2.5] {
            let mut orbit = framed_box();
            orbit.set_aspect(aspect);
            for corner in 0..8 {
                let place = corner_of_box(corner);
                let [x, y] = seen(&orbit, place);
                assert!(x.abs() < 1.0 && y.abs() < 1.0, "{corner} at {x} {y}, {aspect}");
            }
        }
    }

    #[test]
    fn a_drag_turns_and_home_comes_back() {
        let mut orbit = framed_box();
        let start = orbit.camera();
        orbit.turn(vec2(100.0, 0.0));
        let turned = orbit.camera();
        assert_eq!(turned.target, start.target);
        let [before, after] = [start, turned].map(|camera| camera.eye.distance(camera.target));
        assert!((before - after).abs() < 1e-4, "{before} {after}");
        assert!(turned.eye.x < start.eye.x, "what is in front follows the pointer");
        orbit.turn(vec2(0.0, 1e4));
        assert!(orbit.camera().eye.y > turned.eye.y, "from above");
        assert!(orbit.camera().clip_from_model(1.0).is_finite(), "it never turns over");
        orbit.frame();
        assert_eq!(orbit.camera(), start);
    }

    #[test]
    fn a_camera_of_the_same_lens_is_found_again() {
        let mut orbit = framed_box();
        orbit.turn(vec2(-310.0, 40.0));
        orbit.pan(vec2(20.0, 10.0), 400.0);
        let camera = orbit.camera();
        let again = framed_box().seen_by(&camera).camera();
        assert!(again.eye.distance(camera.eye) < 1e-3, "{again:?} {camera:?}");
        assert!(again.target.distance(camera.target) < 1e-5, "{again:?}");
    }

    #[test]
    fn panning_and_zooming_keep_what_is_under_the_pointer() {
        let mut orbit = framed_box();
        orbit.set_aspect(1.5);
        let [height, width] = [400.0, 600.0];
        let target = orbit.target;
        orbit.pan(vec2(60.0, -40.0), height);
        let [x, y] = seen(&orbit, target);
        assert!((x - 60.0 / (0.5 * width)).abs() < 1e-3, "{x}");
        assert!((y - 40.0 / (0.5 * height)).abs() < 1e-3, "{y}");
        orbit.zoom(1.5, vec2(60.0, -40.0), height);
        let [zoomed_x, zoomed_y] = seen(&orbit, target);
        assert!((zoomed_x - x).abs() < 1e-3 && (zoomed_y - y).abs() < 1e-3, "{zoomed_x} {x}");
        for factor in [1e6, 1e-6] {
            orbit.zoom(factor, vec2(0.0, 0.0), height);
            let Camera { near, far, .. } = orbit.camera();
            assert!(0.0 < near && near < far && far.is_finite(), "{near} {far}");
        }
    }

    #[test]
    fn the_near_and_the_far_plane_hold_the_scene_from_all_sides() {
        let mut orbit = framed_box();
        for turn in 0..24_u8 {
            orbit.turn(vec2(71.0, if turn % 2 == 0 { 60.0 } else { -45.0 }));
            let camera = orbit.camera();
            let [_, _, back] = camera.axes();
            for corner in 0..8 {
                let place = corner_of_box(corner);
                let depth = (camera.eye - place).dot(back);
                assert!(camera.near < depth && depth < camera.far, "{depth} of {camera:?}");
            }
            assert!(camera.near > 0.005 * camera.far, "depth keeps its precision: {camera:?}");
        }
    }

    #[test]
    fn a_drag_to_the_side_turns_about_the_upright_and_one_upwards_lowers_the_eye() {
        let mut orbit = framed_box();
        let start = orbit.camera();
        orbit.turn(vec2(40.0, 0.0));
        let aside = orbit.camera();
        assert!((aside.eye.y - start.eye.y).abs() < 1e-4, "{aside:?}");
        orbit.turn(vec2(0.0, -40.0));
        let lower = orbit.camera();
        assert!(lower.eye.y < aside.eye.y, "{lower:?}");
        let [start, aside, lower] = [start, aside, lower]
            .map(|camera| (camera.eye - camera.target) * Vec3::new(1.0, 0.0, 1.0));
        let [before, after] = [aside, lower].map(Vec3::normalize);
        assert!(before.distance(after) < 1e-4, "{before} {after}");
        // A drag of one point turns by 0.35 degrees.
        let turned = start.angle_between(aside).to_degrees();
        assert!((turned - 14.0).abs() < 0.01, "{turned}");
    }
}
