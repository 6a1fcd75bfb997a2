//! Volumes and their shells that hold each visible point, region by region.

use glam::Vec3;
use graphics::camera::Camera;
use graphics::compute::Image;
use graphics::gpu::DeviceError;
use graphics::surface::{Fragment, Gates};

use super::in_sight::InSight;
use super::loaded_scene::LoadedScene;
use super::looks::RegionLook;
use crate::surfaces::VolumeSurfaces;
use crate::volume::Volume;

/// The gate of a surface that holds what faces any way, of any body.
const OPEN: [f32; 8] = [0.0, 0.0, 0.0, -2.0, 0.0, 0.0, 0.0, 0.0];

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
    /// Of each surface what it faces, the least cosine, and its body.
    gates: Vec<[f32; 8]>,
}

impl RegionSurfaces {
    /// Replaces the surfaces by those of region `number` that may hold what is seen. Volumes of the
    /// grid hold only what is of the body of their cell and faces as it does, by a cosine of `gate`
    /// at least.
    pub(super) fn update(
        &mut self,
        all: Volumes<'_>,
        (number, look): (usize, &RegionLook),
        gate: f32,
        in_sight: &InSight,
    ) {
        self.surfaces.clear();
        self.gates.clear();
        for (volume, &facing) in all.volumes.iter().zip(all.facing) {
            if usize::from(volume.region) != number || !in_sight.may_hold(volume) {
                continue;
            }
            let mut own = OPEN;
            if facing != Vec3::ZERO {
                own[..4].copy_from_slice(&facing.extend(gate).to_array());
            }
            own[4] = volume.body as f32;
            for &scale in look.shells.scales() {
                self.surfaces.add(volume, scale, self.gates.len() as u32);
                self.gates.push(own);
            }
        }
    }

    /// Whether a surface has a gate.
    pub(super) fn gated(&self) -> bool {
        self.gates.iter().any(|gate| *gate != OPEN)
    }

    /// The count of each sample, by a scene that counts with gates if a surface has one.
    pub(super) fn counts(
        &self,
        scene: &mut LoadedScene,
        visible: &Image<Fragment>,
        camera: &Camera,
    ) -> Result<Image<i32>, DeviceError> {
        let closed = self.surfaces.closed();
        let LoadedScene { compute, model, normals, counter, .. } = scene;
        if !self.gated() {
            return counter.counts(compute, (model, visible), camera, closed);
        }
        let gates = Gates { surfaces: &self.gates, normals };
        counter.gated(compute, visible, camera, (closed, gates))
    }
}
