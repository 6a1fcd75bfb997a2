//! Meshes where they are drawn, and what is seen of them.

use std::sync::Arc;

use super::backend::Backend;
use super::on_cpu::OnCpu;
use super::on_gpu::{OnGpu, Plane};
use crate::camera::Camera;
use crate::field::Field;
use crate::gpu::{Buffer, DeviceError, Target, Triangles};
use crate::surface::{PackedMesh, RASTER, Rasteriser, Seen, Sides, View, Visible};

/// Keeps meshes, and tells what a camera sees of them.
pub trait Models: Backend {
    /// A mesh, ready to be drawn again and again.
    type Model: std::fmt::Debug;
    /// What every pixel shows, as [`Seen`].
    type Visible: std::fmt::Debug;

    /// Takes a mesh in.
    ///
    /// # Errors
    /// As [`Backend::color_of`].
    fn model(&mut self, mesh: PackedMesh) -> Result<Self::Model, DeviceError>;

    /// What `camera` sees at the middle of every pixel: both sides of all triangles.
    ///
    /// # Errors
    /// As [`Backend::color_of`]; a device also refuses pictures without a pixel, and
    /// those larger than it draws (at least 2048 pixels, as a rule 16384).
    fn seen(
        &mut self,
        model: &mut Self::Model,
        camera: &Camera,
        width: usize,
        height: usize,
    ) -> Result<Self::Visible, DeviceError>;

    /// The same with the processor.
    ///
    /// # Errors
    /// As [`Backend::color_of`].
    fn visible_field(&mut self, visible: &Self::Visible) -> Result<Visible, DeviceError>;
}

/// From outside a closed mesh only fronts are seen.
fn sides(closed: bool, bounds: [glam::Vec3; 2], camera: &Camera) -> Sides {
    let [low, high] = bounds;
    // Nothing nearer than the near plane is drawn, so that a wall may be open.
    let (low, high) = (low - camera.near, high + camera.near);
    let inside = camera.eye.cmpge(low).all() && camera.eye.cmple(high).all();
    if closed && !inside { Sides::Front } else { Sides::Both }
}

/// A mesh with the processor, and memory for drawing it.
#[derive(Debug)]
pub struct CpuModel {
    /// The mesh in the layout that shaders read.
    pub mesh: PackedMesh,
    rasteriser: Rasteriser,
    /// The last picture, drawn over once nobody holds it.
    last: Arc<Visible>,
}

impl Models for OnCpu {
    type Model = CpuModel;
    type Visible = Arc<Visible>;

    fn model(&mut self, mesh: PackedMesh) -> Result<CpuModel, DeviceError> {
        let last = Arc::new(Field::filled(0, 0, Seen::EMPTY));
        Ok(CpuModel { mesh, rasteriser: Rasteriser::default(), last })
    }

    fn seen(
        &mut self,
        model: &mut CpuModel,
        camera: &Camera,
        width: usize,
        height: usize,
    ) -> Result<Arc<Visible>, DeviceError> {
        let CpuModel { mesh, rasteriser, last } = model;
        let fits = (last.width(), last.height()) == (width, height);
        if !fits || Arc::get_mut(last).is_none() {
            *last = Arc::new(Field::filled(width, height, Seen::EMPTY));
        }
        if let Some(visible) = Arc::get_mut(last) {
            let clip_from_model = camera.clip_from_model(width as f32 / height.max(1) as f32);
            let sides = sides(mesh.closed, mesh.bounds, camera);
            rasteriser.draw(clip_from_model, &mesh.vertices, &mesh.triangles, sides, visible);
        }
        Ok(Arc::clone(last))
    }

    fn visible_field(&mut self, visible: &Arc<Visible>) -> Result<Visible, DeviceError> {
        Ok(Visible::clone(visible))
    }
}

/// A mesh on the device, and what it is drawn into.
#[derive(Debug)]
pub struct GpuModel {
    /// Vertices, one `Vertex` each.
    pub vertices: Buffer,
    /// Triangles, one `Triangle` each.
    pub triangles: Buffer,
    /// Materials, one `Coating` each.
    pub coatings: Buffer,
    /// Texels of all textures, one after the other.
    pub texels: Buffer,
    count: usize,
    closed: bool,
    bounds: [glam::Vec3; 2],
    target: Option<Target>,
}

impl Models for OnGpu {
    type Model = GpuModel;
    type Visible = Plane;

    fn model(&mut self, mesh: PackedMesh) -> Result<GpuModel, DeviceError> {
        let device = &mut self.device;
        Ok(GpuModel {
            vertices: device.buffer_of("vertices", &mesh.vertices)?,
            triangles: device.buffer_of("triangles", &mesh.triangles)?,
            coatings: device.buffer_of("coatings", &mesh.coatings)?,
            texels: device.buffer_of("texels", &mesh.texels)?,
            count: mesh.triangles.len(),
            closed: mesh.closed,
            bounds: mesh.bounds,
            target: None,
        })
    }

    fn seen(
        &mut self,
        model: &mut GpuModel,
        camera: &Camera,
        width: usize,
        height: usize,
    ) -> Result<Plane, DeviceError> {
        let target = match model.target.take() {
            Some(target) if target.size() == (width, height) => target,
            _ => self.device.target(width, height)?,
        };
        let plane = self.plane(width, height, size_of::<Seen>())?;
        let clip_from_model = camera.clip_from_model(width as f32 / height as f32);
        let view = View { clip_from_model: clip_from_model.to_cols_array_2d() };
        let triangles = Triangles {
            count: model.count,
            front_only: sides(model.closed, model.bounds, camera) == Sides::Front,
            background: bytemuck::cast(Seen::EMPTY),
        };
        let buffers = [&model.vertices, &model.triangles];
        self.recording.draw(&RASTER, &view, &buffers, triangles, (&target, plane.buffer()));
        model.target = Some(target);
        Ok(plane)
    }

    fn visible_field(&mut self, visible: &Plane) -> Result<Visible, DeviceError> {
        self.given(visible)
    }
}
