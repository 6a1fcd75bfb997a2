//! A scene in the memory of what draws it.

use graphics::compute::{Compute, Image};
use graphics::field::Field;
use graphics::gpu::{Device, DeviceError};
use graphics::surface::{InsideCounter, Model, PackedMesh};

use crate::hatching::{Hatching, ThresholdTexture};
use crate::pigments::Facets;

/// A scene in the memory of a [`Compute`], ready for pictures.
#[derive(Debug)]
pub(super) struct LoadedScene {
    pub(super) compute: Compute,
    pub(super) model: Model,
    pub(super) hatching: Hatching,
    /// Normals of the triangles.
    pub(super) normals: Image<[f32; 4]>,
    pub(super) counter: InsideCounter,
}

impl LoadedScene {
    pub(super) fn new(
        mut compute: Compute,
        packed: &PackedMesh,
        facets: &Facets,
        texture: &ThresholdTexture,
    ) -> Result<Self, DeviceError> {
        let normals = facets.normals().iter().map(|normal| normal.extend(0.0).to_array());
        let normals: Vec<_> = normals.collect();
        let normals = Field::from_values(normals.len(), 1, normals);
        Ok(Self {
            model: Model::new(&mut compute, packed.clone())?,
            hatching: Hatching::new(&mut compute, texture, packed)?,
            normals: compute.upload(&normals)?,
            counter: InsideCounter::default(),
            compute,
        })
    }

    /// Whether it is in the processor's memory.
    pub(super) fn is_host(&self) -> bool {
        matches!(self.compute, Compute::Cpu)
    }

    /// Whether it counts volumes with a gate.
    pub(super) fn gates(&self) -> bool {
        self.compute.device().is_none_or(Device::scatters)
    }
}
