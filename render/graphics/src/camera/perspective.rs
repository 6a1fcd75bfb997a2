//! A camera that sees in perspective.

use glam::camera::rh::proj::directx::perspective;
use glam::camera::rh::view::look_at_mat4;
use glam::{Mat4, Vec3};

/// A camera; all places in the unit of the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Where it stands.
    pub eye: Vec3,
    /// What it looks at, in the middle of the picture.
    pub target: Vec3,
    /// Roughly upwards; not along the direction of sight.
    pub up: Vec3,
    /// From the lower to the upper edge of the picture, in degrees, above 0 and
    /// below 180.
    pub field_of_view_deg: f32,
    /// Nothing nearer is seen, above 0.
    pub near: f32,
    /// Nothing farther is seen, above `near`.
    pub far: f32,
}

impl Camera {
    /// Rightwards, upwards and backwards, each of length 1.
    #[must_use]
    pub fn axes(&self) -> [Vec3; 3] {
        let back = (self.eye - self.target).normalize();
        let right = self.up.cross(back).normalize();
        [right, back.cross(right), back]
    }

    /// From the model's coordinates to clip coordinates as WebGPU has them: x
    /// right, y up, z from 0 (near) to w (far). `aspect` is width by height.
    #[must_use]
    pub fn clip_from_model(&self, aspect: f32) -> Mat4 {
        let view = look_at_mat4(self.eye, self.target, self.up);
        let field = self.field_of_view_deg.to_radians();
        perspective(field, aspect, self.near, self.far) * view
    }
}
