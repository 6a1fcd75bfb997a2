//! A light so far away that its direction is the same everywhere.

use glam::Vec3;

use crate::camera::Camera;

/// A light with the same direction everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DistantLight {
    /// Moves with the camera, e.g. a lamp beside it. The vector points towards the light: x to the
    /// right in the picture, y upwards, z towards the viewer.
    WithCamera(Vec3),
    /// Fixed to the model, e.g. the sun. The vector points towards the light, in model
    /// coordinates.
    WithModel(Vec3),
}

impl DistantLight {
    /// A light that moves with the camera. `azimuth_deg` counts clockwise from the top of the
    /// picture, `elevation_deg` from the plane of the picture (0) towards the viewer (90).
    #[must_use]
    pub fn with_camera(azimuth_deg: f32, elevation_deg: f32) -> Self {
        let (sin_a, cos_a) = azimuth_deg.to_radians().sin_cos();
        let (sin_e, cos_e) = elevation_deg.to_radians().sin_cos();
        Self::WithCamera(Vec3::new(sin_a * cos_e, cos_a * cos_e, sin_e))
    }

    /// The direction towards the light in model coordinates, of length 1. If you set the light's
    /// own vector to zero, this is zero too.
    #[must_use]
    pub fn direction(self, camera: &Camera) -> Vec3 {
        let direction = match self {
            Self::WithModel(direction) => direction,
            Self::WithCamera(Vec3 { x, y, z }) => {
                let [right, up, back] = camera.axes();
                right * x + up * y + back * z
            }
        };
        direction.normalize_or_zero()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_light_with_the_camera_turns_with_it_and_one_with_the_model_stays() {
        fn camera(eye: Vec3) -> Camera {
            Camera {
                eye,
                target: Vec3::ZERO,
                up: Vec3::Y,
                field_of_view_deg: 30.0,
                near: 0.1,
                far: 10.0,
            }
        }
        let front = camera(Vec3::Z * 3.0);
        let side = camera(Vec3::X * 3.0);
        let with_camera = DistantLight::with_camera(0.0, 90.0);
        assert!(with_camera.direction(&front).distance(Vec3::Z) < 1e-6);
        assert!(with_camera.direction(&side).distance(Vec3::X) < 1e-6);
        let above = DistantLight::with_camera(0.0, 0.0);
        assert!(above.direction(&side).distance(Vec3::Y) < 1e-6);
        let fixed = DistantLight::WithModel(Vec3::new(0.0, 2.0, 0.0));
        assert_eq!(fixed.direction(&front), Vec3::Y);
        assert_eq!(fixed.direction(&front), fixed.direction(&side));
    }
}
