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
    /// Normals of the triangles, and the body of each.
    pub(super) normals: Image<[f32; 4]>,
    bodies: Vec<u32>,
    pub(super) counter: InsideCounter,
    /// Whether it counts volumes with gates: only a device whose fragments can write to buffers
    /// does, and the processor.
    pub(super) gates: bool,
}

impl LoadedScene {
    pub(super) fn new(
        mut compute: Compute,
        packed: &PackedMesh,
        facets: &Facets,
        texture: &ThresholdTexture,
    ) -> Result<Self, DeviceError> {
        Ok(Self {
            model: Model::new(&mut compute, packed.clone())?,
            hatching: Hatching::new(&mut compute, texture, packed)?,
            normals: compute.upload(&gated(facets, &[]))?,
            bodies: Vec::new(),
            counter: InsideCounter::default(),
            gates: compute.device().is_none_or(Device::scatters),
            compute,
        })
    }

    /// Tells the bodies of the triangles, 0 for those that volumes of any body may hold.
    pub(super) fn tell_bodies(
        &mut self,
        facets: &Facets,
        bodies: &[u32],
    ) -> Result<(), DeviceError> {
        if self.bodies != bodies {
            self.normals = self.compute.upload(&gated(facets, bodies))?;
            self.bodies = bodies.to_vec();
        }
        Ok(())
    }

    /// Whether it is in the processor's memory.
    pub(super) fn is_host(&self) -> bool {
        matches!(self.compute, Compute::Cpu)
    }
}

/// The normal and the body of each triangle, for gates.
fn gated(facets: &Facets, bodies: &[u32]) -> Field<[f32; 4]> {
    let bodies = bodies.iter().copied().chain(std::iter::repeat(0));
    let own = facets.normals().iter().zip(bodies);
    let own: Vec<_> = own.map(|(normal, body)| normal.extend(body as f32).to_array()).collect();
    Field::from_values(own.len(), 1, own)
}
