//! Counting on whatever computes.

use super::crossing::{Count, WeighedCount};
use super::gates::{GatedCount, Gates};
use super::on_device;
use super::sum::Crossings;
use super::surfaces::ClosedSurfaces;
use crate::camera::Camera;
use crate::compute::{Compute, GpuCompute, Image};
use crate::gpu::{DeviceError, StencilTarget};
use crate::surface::model::Model;
use crate::surface::packed::Positioned;
use crate::surface::visibility::Fragment;

/// Counts the closed surfaces that hold what each pixel shows. Keeps its memory between
/// pictures; of use to one [`Compute`] only.
#[derive(Debug, Default)]
pub struct InsideCounter {
    crossings: Crossings,
    target: Option<StencilTarget>,
}

impl InsideCounter {
    /// The number of `surfaces` that hold the point that each pixel of `visible` shows: of
    /// `model`, as `camera` sees it. 0 where nothing is seen.
    ///
    /// A device draws the model again for its depth and counts in the stencil, in passes of at
    /// most 255 surfaces. It may differ from the processor where a surface's outline passes
    /// within a pixel or its skin within rounding.
    ///
    /// # Errors
    /// [`DeviceError`] if a device has no memory left, was lost or has no stencil that can be
    /// read back; a device also refuses pictures without a pixel and those larger than it can
    /// draw. Never on the processor.
    ///
    /// # Panics
    /// If another form of [`Compute`] made the model or the image, or (on the processor) if a
    /// triangle has a corner that the surfaces do not have.
    pub fn counts(
        &mut self,
        compute: &mut Compute,
        (model, visible): (&Model, &Image<Fragment>),
        camera: &Camera,
        surfaces: ClosedSurfaces<'_, impl Positioned>,
    ) -> Result<Image<i32>, DeviceError> {
        match compute {
            Compute::Cpu => Ok(self.crossings.sum(&Count, surfaces, camera, visible.host()).into()),
            Compute::Gpu(gpu) => {
                let scene = model.device();
                let plane = visible.plane();
                let target = self.target(gpu, plane.size())?;
                on_device::counts(gpu, scene, plane, camera, surfaces, &target).map(Image::from)
            }
        }
    }

    /// The sum of the `weights` of the surfaces that hold the point that each pixel of
    /// `visible` shows; 0 where nothing is seen. There is one weight for each surface; sums
    /// beyond the range of `i32` wrap.
    ///
    /// A device adds at every pixel of every face, which not all devices can
    /// ([`crate::gpu::Device::scatters`]).
    ///
    /// # Errors
    /// As [`Self::counts`], and [`DeviceError::Refused`] on a device whose fragments cannot
    /// write to buffers.
    ///
    /// # Panics
    /// As [`Self::counts`], and if a surface has no weight.
    pub fn weighed(
        &mut self,
        compute: &mut Compute,
        visible: &Image<Fragment>,
        camera: &Camera,
        (surfaces, weights): (ClosedSurfaces<'_, impl Positioned>, &[i32]),
    ) -> Result<Image<i32>, DeviceError> {
        let found = weights.len();
        assert!(found >= least(surfaces), "{found} weights of {} surfaces", least(surfaces));
        match compute {
            Compute::Cpu => {
                let weighed = WeighedCount(|surface: u32, _| weights[surface as usize]);
                Ok(self.crossings.sum(&weighed, surfaces, camera, visible.host()).into())
            }
            Compute::Gpu(gpu) => {
                let plane = visible.plane();
                let target = self.target(gpu, plane.size())?;
                let sums = on_device::weighed(gpu, plane, camera, (surfaces, weights), &target);
                sums.map(Image::from)
            }
        }
    }

    /// The number of `surfaces` that hold the point that each pixel of `visible` shows and whose
    /// gate lets its triangle pass; 0 where nothing is seen.
    ///
    /// # Errors
    /// As [`Self::weighed`].
    ///
    /// # Panics
    /// As [`Self::counts`]; if a surface has no gate, or (on the processor) a triangle that is
    /// seen has no normal.
    pub fn gated(
        &mut self,
        compute: &mut Compute,
        visible: &Image<Fragment>,
        camera: &Camera,
        (surfaces, gates): (ClosedSurfaces<'_, impl Positioned>, Gates<'_>),
    ) -> Result<Image<i32>, DeviceError> {
        let found = gates.surfaces.len();
        assert!(found >= least(surfaces), "{found} gates of {} surfaces", least(surfaces));
        match compute {
            Compute::Cpu => {
                let seen = visible.host();
                let normals = gates.normals.host().values();
                let gated = GatedCount { surfaces: gates.surfaces, normals, seen: seen.values() };
                Ok(self.crossings.sum(&gated, surfaces, camera, seen).into())
            }
            Compute::Gpu(gpu) => {
                let plane = visible.plane();
                let target = self.target(gpu, plane.size())?;
                let counts = on_device::gated(gpu, plane, camera, (surfaces, gates), &target);
                counts.map(Image::from)
            }
        }
    }

    /// The stencil of the last picture if it has this size, else a new one.
    fn target(
        &mut self,
        gpu: &GpuCompute,
        (width, height): (usize, usize),
    ) -> Result<StencilTarget, DeviceError> {
        let target = match self.target.take() {
            Some(target) if target.size() == (width, height) => target,
            _ => gpu.device.stencil_target(width, height)?,
        };
        self.target = Some(target.clone());
        Ok(target)
    }
}

/// The least number of weights or gates for all surfaces.
fn least(surfaces: ClosedSurfaces<'_, impl Positioned>) -> usize {
    let last = surfaces.triangles.iter().map(|triangle| triangle.material as usize).max();
    last.map_or(0, |last| last + 1)
}
