//! Cameras that see a picture.

use super::perspective::Camera;
use glam::{Vec2, Vec3};

/// Vertical angle of view of the camera that sees exactly the picture.
const VIEW_DEG: f32 = 25.0;

/// The cameras of a picture. Its longer side is 1 unit; it lies in the plane z = 0 around the origin,
/// and its relief on both sides of that plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PictureView {
    sides: Vec2,
}

impl PictureView {
    /// Of a picture of `width` x `height` pixels, at least one each.
    #[must_use]
    pub fn of((width, height): (usize, usize)) -> Self {
        let longer = width.max(height).max(1) as f32;
        Self { sides: Vec2::new(width.max(1) as f32, height.max(1) as f32) / longer }
    }

    /// The camera that sees exactly the picture, in pictures of its shape.
    #[must_use]
    pub fn camera(&self) -> Camera {
        self.turned(0.0, 0.0)
    }

    /// That camera moved around the middle of the picture, in degrees to the right and upwards (-80
    /// to 80): a picture with depth shows its relief.
    #[must_use]
    pub fn turned(&self, right_deg: f32, up_deg: f32) -> Camera {
        let distance = self.distance();
        let [right, up] = [right_deg, up_deg].map(f32::to_radians);
        let eye = Vec3::new(right.sin() * up.cos(), up.sin(), right.cos() * up.cos());
        Camera {
            eye: eye * distance,
            target: Vec3::ZERO,
            up: Vec3::Y,
            field_of_view_deg: VIEW_DEG,
            near: 0.3 * distance,
            far: 2.0 * distance,
        }
    }

    /// Width and height in units; the longer is 1.
    #[must_use]
    pub fn sides(&self) -> Vec2 {
        self.sides
    }

    /// Distance of the eye from the plane.
    #[must_use]
    pub fn distance(&self) -> f32 {
        0.5 * self.sides.y / (0.5 * VIEW_DEG).to_radians().tan()
    }
}
