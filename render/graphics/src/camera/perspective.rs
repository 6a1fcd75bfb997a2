//! A perspective camera.

use glam::camera::rh::proj::directx::{perspective, perspective_infinite};
use glam::camera::rh::view::look_at_mat4;
use glam::{Mat4, Vec3};

/// A perspective camera. Positions are in the model's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Position of the eye.
    pub eye: Vec3,
    /// Point that appears in the centre of the picture.
    pub target: Vec3,
    /// Approximate up direction; must not be parallel to the viewing direction.
    pub up: Vec3,
    /// Vertical field of view in degrees, above 0 and below 180.
    pub field_of_view_deg: f32,
    /// Distance of the near clipping plane, above 0.
    pub near: f32,
    /// Distance of the far clipping plane, above `near`.
    pub far: f32,
}

impl Camera {
    /// The camera's right, up and backward axes as unit vectors.
    #[must_use]
    pub fn axes(&self) -> [Vec3; 3] {
        let back = (self.eye - self.target).normalize();
        let right = self.up.cross(back).normalize();
        [right, back.cross(right), back]
    }

    /// Matrix from model coordinates to clip coordinates as WebGPU defines them: x right, y
    /// up, z from 0 (near) to w (far). `aspect` is width by height.
    #[must_use]
    pub fn clip_from_model(&self, aspect: f32) -> Mat4 {
        let view = look_at_mat4(self.eye, self.target, self.up);
        let field = self.field_of_view_deg.to_radians();
        perspective(field, aspect, self.near, self.far) * view
    }

    /// Matrix as [`Self::clip_from_model`], but of a camera without a far plane: its depth
    /// times [`Self::depth_scale`] is the depth of this camera, above 1 beyond the far plane.
    #[must_use]
    pub fn endless_clip_from_model(&self, aspect: f32) -> Mat4 {
        let view = look_at_mat4(self.eye, self.target, self.up);
        let field = self.field_of_view_deg.to_radians();
        perspective_infinite(field, aspect, self.near) * view
    }

    /// The depth of this camera by that of a camera without a far plane, above 1.
    #[must_use]
    pub fn depth_scale(&self) -> f32 {
        self.far / (self.far - self.near)
    }
}
