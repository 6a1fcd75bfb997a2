//! Shadow maps: what a distant light sees of a model (Williams 1978).

use glam::{Mat4, Vec3};

use graphics::camera::Camera;
use graphics::compute::{Compute, Image};
use graphics::gpu::DeviceError;
use graphics::surface::{Fragment, Model};

/// Vertical angle of view of the camera in the place of a distant light, in degrees: narrow, so
/// that its rays are nearly parallel.
const VIEW_DEG: f32 = 4.0;

/// The surfaces that a distant light reaches first.
#[derive(Debug, Clone)]
pub struct ShadowMap {
    /// The surfaces that the light reaches first, on a square grid.
    pub fragments: Image<Fragment>,
    /// The camera in the place of the light.
    pub camera: Camera,
}

/// The measures of a shadow map that shading needs.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShadowView {
    /// From model coordinates to those of the light's picture, as for a camera.
    pub(super) clip_from_model: Mat4,
    /// Distances of the near and the far plane from the light.
    pub(super) planes: [f32; 2],
    /// Width of a pixel of the map in the unit of the model.
    pub(super) pixel: f32,
}

impl ShadowMap {
    /// The map of `side` x `side` pixels of `model`, which lies in a sphere, for a light in
    /// `direction` (towards the light, of length 1).
    ///
    /// # Errors
    /// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
    ///
    /// # Panics
    /// If another form of [`Compute`] made the model.
    pub fn new(
        compute: &mut Compute,
        model: &mut Model,
        direction: Vec3,
        (center, radius): (Vec3, f32),
        side: usize,
    ) -> Result<Self, DeviceError> {
        let radius = if radius > 0.0 { 1.02 * radius } else { 1.0 };
        let distance = radius / (VIEW_DEG / 2.0).to_radians().sin();
        let up = if direction.y.abs() < 0.9 { Vec3::Y } else { Vec3::X };
        let camera = Camera {
            eye: center + direction * distance,
            target: center,
            up,
            field_of_view_deg: VIEW_DEG,
            near: distance - radius,
            far: distance + radius,
        };
        let fragments = model.visible(compute, &camera, side, side)?;
        Ok(Self { fragments, camera })
    }

    pub(super) fn view(&self) -> ShadowView {
        let Camera { near, far, field_of_view_deg, .. } = self.camera;
        let width = (near + far) * (field_of_view_deg / 2.0).to_radians().tan();
        let side = self.fragments.size().0.max(1) as f32;
        ShadowView {
            clip_from_model: self.camera.clip_from_model(1.0),
            planes: [near, far],
            pixel: width / side,
        }
    }
}
