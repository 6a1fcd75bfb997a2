//! Meshes in the memory of a compute. They draw themselves into visibility buffers.

use std::sync::Arc;

use super::raster::{RASTER, RasterParams, Rasteriser, Sides};
use super::{Fragment, PackedMesh, VisibilityBuffer};
use crate::camera::Camera;
use crate::compute::{Compute, GpuCompute, Image, Plane};
use crate::field::Field;
use crate::gpu::{Buffer, DeviceError, Target, Triangles};

/// A mesh in the memory of the [`Compute`] that made it, ready to be drawn from any camera. You
/// can use it with this compute only, like an [`Image`].
#[derive(Debug)]
pub enum Model {
    /// In the processor's memory.
    Host(Box<HostModel>),
    /// In the memory of a graphics device.
    Device(Box<DeviceModel>),
}

impl Model {
    /// Copies a mesh into the memory of `compute`.
    ///
    /// # Errors
    /// [`DeviceError`] if a device has no memory left or was lost, never on the processor.
    pub fn new(compute: &mut Compute, mesh: PackedMesh) -> Result<Self, DeviceError> {
        match compute {
            Compute::Cpu => Ok(Self::Host(Box::new(HostModel::new(mesh)))),
            Compute::Gpu(gpu) => Ok(Self::Device(Box::new(DeviceModel::new(gpu, &mesh)?))),
        }
    }

    /// The fragment that `camera` sees at the centre of each of `width` x `height` pixels, of front
    /// and back faces.
    ///
    /// # Errors
    /// [`DeviceError`] if a device has no memory left or was lost. A device also refuses pictures
    /// without a pixel, and those larger than it can draw (at least 2048 pixels a side, usually
    /// 16384). Never on the processor.
    ///
    /// # Panics
    /// If another form of [`Compute`] made the model.
    pub fn visible(
        &mut self,
        compute: &mut Compute,
        camera: &Camera,
        width: usize,
        height: usize,
    ) -> Result<Image<Fragment>, DeviceError> {
        match compute {
            Compute::Cpu => Ok(Image::Host(self.host_mut().visible(camera, width, height))),
            Compute::Gpu(gpu) => {
                self.device_mut().visible(gpu, camera, width, height).map(Image::from)
            }
        }
    }

    /// The model in the processor's memory. Use this in an operation on the processor.
    ///
    /// # Panics
    /// If the model lives on a graphics device.
    #[must_use]
    pub fn host(&self) -> &HostModel {
        match self {
            Self::Host(model) => model,
            Self::Device(_) => panic!("{MADE_BY_DEVICE}"),
        }
    }

    /// The model in device memory. Use this in an operation on a graphics device.
    ///
    /// # Panics
    /// If the model lives in the processor's memory.
    #[must_use]
    pub fn device(&self) -> &DeviceModel {
        match self {
            Self::Host(_) => panic!("{MADE_BY_HOST}"),
            Self::Device(model) => model,
        }
    }

    fn host_mut(&mut self) -> &mut HostModel {
        match self {
            Self::Host(model) => model,
            Self::Device(_) => panic!("{MADE_BY_DEVICE}"),
        }
    }

    fn device_mut(&mut self) -> &mut DeviceModel {
        match self {
            Self::Host(_) => panic!("{MADE_BY_HOST}"),
            Self::Device(model) => model,
        }
    }
}

const MADE_BY_DEVICE: &str = "the processor was handed a model of a graphics device";

const MADE_BY_HOST: &str = "a graphics device was handed a model in the processor's memory";

/// Which faces to draw. Only front faces are enough if the mesh is closed and seen from outside.
fn visible_sides(closed: bool, bounds: [glam::Vec3; 2], camera: &Camera) -> Sides {
    let [low, high] = bounds;
    // The near plane may cut the surface open for a camera just outside the bounds.
    let low = low - camera.near;
    let high = high + camera.near;
    let inside = camera.eye.cmpge(low).all() && camera.eye.cmple(high).all();
    if closed && !inside { Sides::Front } else { Sides::Both }
}

/// A mesh in the processor's memory.
#[derive(Debug)]
pub struct HostModel {
    mesh: PackedMesh,
    rasteriser: Rasteriser,
    /// The last picture. We reuse its memory once no image shares it.
    last: Arc<VisibilityBuffer>,
}

impl HostModel {
    fn new(mesh: PackedMesh) -> Self {
        let last = Arc::new(Field::filled(0, 0, Fragment::EMPTY));
        Self { mesh, rasteriser: Rasteriser::default(), last }
    }

    /// The mesh in the layout for drawing.
    #[must_use]
    pub fn mesh(&self) -> &PackedMesh {
        &self.mesh
    }

    fn visible(&mut self, camera: &Camera, width: usize, height: usize) -> Arc<VisibilityBuffer> {
        let Self { mesh, rasteriser, last } = self;
        let fits = (last.width(), last.height()) == (width, height);
        if !fits || Arc::get_mut(last).is_none() {
            *last = Arc::new(Field::filled(width, height, Fragment::EMPTY));
        }
        if let Some(visible) = Arc::get_mut(last) {
            let clip_from_model = camera.clip_from_model(width as f32 / height.max(1) as f32);
            let sides = visible_sides(mesh.closed, mesh.bounds, camera);
            rasteriser.draw(clip_from_model, &mesh.vertices, &mesh.triangles, sides, visible);
        }
        Arc::clone(last)
    }
}

/// A mesh in the memory of a graphics device, with the target it is drawn into.
#[derive(Debug)]
pub struct DeviceModel {
    /// One [`super::Vertex`] for each vertex.
    pub vertices: Buffer,
    /// One [`crate::mesh::Triangle`] for each triangle.
    pub triangles: Buffer,
    /// One [`super::PackedMaterial`] for each material.
    pub materials: Buffer,
    /// Texels of all textures, one after the other.
    pub texels: Buffer,
    pub(super) count: usize,
    closed: bool,
    bounds: [glam::Vec3; 2],
    target: Option<Target>,
}

impl DeviceModel {
    fn new(gpu: &mut GpuCompute, mesh: &PackedMesh) -> Result<Self, DeviceError> {
        let device = &mut gpu.device;
        Ok(Self {
            vertices: device.buffer_of("vertices", &mesh.vertices)?,
            triangles: device.buffer_of("triangles", &mesh.triangles)?,
            materials: device.buffer_of("materials", &mesh.materials)?,
            texels: device.buffer_of("texels", &mesh.texels)?,
            count: mesh.triangles.len(),
            closed: mesh.closed,
            bounds: mesh.bounds,
            target: None,
        })
    }

    fn visible(
        &mut self,
        gpu: &mut GpuCompute,
        camera: &Camera,
        width: usize,
        height: usize,
    ) -> Result<Plane<Fragment>, DeviceError> {
        let target = match self.target.take() {
            Some(target) if target.size() == (width, height) => target,
            _ => gpu.device.target(width, height)?,
        };
        let plane = gpu.plane::<Fragment>(width, height)?;
        let clip_from_model = camera.clip_from_model(width as f32 / height as f32);
        let params = RasterParams { clip_from_model: clip_from_model.to_cols_array_2d() };
        let triangles = Triangles {
            count: self.count,
            front_only: visible_sides(self.closed, self.bounds, camera) == Sides::Front,
            background: bytemuck::cast(Fragment::EMPTY),
        };
        let buffers = [&self.vertices, &self.triangles];
        gpu.recording.draw(&RASTER, &params, &buffers, triangles, (&target, plane.buffer()));
        self.target = Some(target);
        Ok(plane)
    }
}
