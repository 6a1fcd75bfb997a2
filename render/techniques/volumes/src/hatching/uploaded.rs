//! Hatching in the memory of whatever draws it.

use glam::Vec3;
use graphics::compute::{Compute, Image};
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::surface::PackedMesh;

use super::coordinates::has_useful_coordinates;
use super::strokes::SIDE;
use super::threshold::ThresholdTexture;

/// Strokes in the memory of a [`Compute`], and how they lie on one model. Made once for a model.
#[derive(Debug, Clone)]
pub struct Hatching {
    pub(crate) quads: Image<u32>,
    pub(crate) mesh_is_useful: bool,
    /// Lowest and highest corner of the model.
    pub(crate) bounds: [Vec3; 2],
}

impl Hatching {
    /// Copies the strokes of `texture` into the memory of `compute`, for `mesh`.
    ///
    /// # Errors
    /// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
    pub fn new(
        compute: &mut Compute,
        texture: &ThresholdTexture,
        mesh: &PackedMesh,
    ) -> Result<Self, DeviceError> {
        let quads = texture.quads().to_vec();
        let quads = Field::from_values(SIDE, quads.len() / SIDE, quads);
        Ok(Self {
            quads: compute.upload(&quads)?,
            mesh_is_useful: has_useful_coordinates(mesh),
            bounds: mesh.bounds,
        })
    }
}
