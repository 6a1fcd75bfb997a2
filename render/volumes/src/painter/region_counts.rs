//! Volumes and their shells that hold each visible point, region by region.

use glam::Vec3;
use graphics::camera::Camera;
use graphics::compute::{Compute, Image};
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::surface::{Crossing, CrossingSum, Crossings, Fragment, InsideCounter, Model};

use super::looks::RegionLook;
use crate::pigments::SeenPlaces;
use crate::surfaces::VolumeSurfaces;
use crate::volume::Volume;

/// All volumes at one time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Volumes<'a> {
    pub(super) volumes: &'a [Volume],
    /// Mean normal of each volume's cell; zero for a single volume.
    pub(super) facing: &'a [Vec3],
}

/// The surfaces of a region: each volume with all its shells.
#[derive(Debug, Clone, Default)]
pub(super) struct RegionSurfaces {
    surfaces: VolumeSurfaces,
    /// What each surface faces.
    facing: Vec<Vec3>,
}

impl RegionSurfaces {
    /// Replaces the surfaces by those of region `number`.
    pub(super) fn update(&mut self, all: Volumes<'_>, number: usize, look: &RegionLook) {
        self.surfaces.clear();
        self.facing.clear();
        for (volume, &facing) in all.volumes.iter().zip(all.facing) {
            if usize::from(volume.region) == number {
                for &scale in look.shells.scales() {
                    self.surfaces.add(volume, scale, self.facing.len() as u32);
                    self.facing.push(facing);
                }
            }
        }
    }

    /// The count of each pixel on the processor, leaving out surfaces of the scene that face away
    /// from their volume's cell by a cosine below `gate`.
    pub(super) fn gated(
        &self,
        crossings: &mut Crossings,
        (seen, camera): (&SeenPlaces<'_>, &Camera),
        gate: f32,
    ) -> Field<i32> {
        let gated = GatedCount { facing: &self.facing, seen, gate };
        crossings.sum(&gated, self.surfaces.closed(), camera, seen.visible())
    }

    /// The count of each pixel on whatever computes, without a gate.
    pub(super) fn counts(
        &self,
        compute: &mut Compute,
        counter: &mut InsideCounter,
        scene: (&Model, &Image<Fragment>),
        camera: &Camera,
    ) -> Result<Image<i32>, DeviceError> {
        counter.counts(compute, scene, camera, self.surfaces.closed())
    }
}

/// Counts surfaces whose volume stands on the side of the wall that is seen.
struct GatedCount<'a> {
    facing: &'a [Vec3],
    seen: &'a SeenPlaces<'a>,
    gate: f32,
}

impl CrossingSum for GatedCount<'_> {
    type Sum = i32;

    #[inline]
    fn add(&self, sum: &mut i32, crossing: &Crossing) {
        let normal = self.seen.normal(crossing.pixel);
        if normal.dot(self.facing[crossing.surface as usize]) >= self.gate {
            *sum = sum.wrapping_add(crossing.sign);
        }
    }
}
