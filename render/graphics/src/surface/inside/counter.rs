//! Counts closed surfaces on the processor or on a graphics device. The device counts in its
//! stencil. If surfaces have weights, it adds at every fragment.

use std::ops::Range;

use super::{ClosedSurfaces, Count, Crossings, GatedCount, Gates, WeighedCount};
use crate::camera::Camera;
use crate::compute::{Compute, GpuCompute, Image, Plane};
use crate::field::Field;
use crate::gpu::{
    Buffer, DeviceError, Kernel, ScatterShader, StencilShader, StencilTarget, Storage,
    TriangleList, layout,
};
use crate::mesh::Triangle;
use crate::surface::model::{DeviceModel, Model};
use crate::surface::{Fragment, Positioned, Vertex};

/// Counts the closed surfaces that hold what each pixel shows. It keeps its memory between
/// pictures, so use it with one [`Compute`] only.
#[derive(Debug, Default)]
pub struct InsideCounter {
    crossings: Crossings,
    target: Option<StencilTarget>,
}

impl InsideCounter {
    /// Counts the `surfaces` that hold the point which each pixel of `visible` shows. `visible` is
    /// `model` as `camera` sees it. The count is 0 where nothing is seen.
    ///
    /// A device draws the model again for its depth and counts in the stencil, in passes of at
    /// most 255 surfaces. This may differ from the processor where the outline of a surface passes
    /// within a pixel, or where the point lies on a surface except for rounding.
    ///
    /// # Errors
    /// [`DeviceError`] if a device has no memory left, was lost or has no stencil that can be read
    /// back. A device also refuses pictures without a pixel and those larger than it can draw.
    /// Never on the processor.
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
                device_counts(gpu, scene, plane, camera, surfaces, &target).map(Image::from)
            }
        }
    }

    /// Sums the `weights` of the surfaces that hold the point which each pixel of `visible` shows.
    /// The sum is 0 where nothing is seen. Pass one weight for each surface. Sums beyond the range
    /// of `i32` wrap.
    ///
    /// A device adds at every pixel of every face. Not all devices can do this
    /// ([`crate::gpu::Device::scatters`]).
    ///
    /// # Errors
    /// This fails like [`Self::counts`]. On a device that cannot write to buffers from fragments you
    /// get [`DeviceError::Refused`].
    ///
    /// # Panics
    /// This panics like [`Self::counts`], and if a surface has no weight.
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
                let sums = device_weighed(gpu, plane, camera, (surfaces, weights), &target);
                sums.map(Image::from)
            }
        }
    }

    /// Counts the `surfaces` that hold the point which each pixel of `visible` shows, if the gate
    /// of the surface lets the triangle there pass. The count is 0 where nothing is seen.
    ///
    /// # Errors
    /// This fails like [`Self::weighed`].
    ///
    /// # Panics
    /// This panics like [`Self::counts`], if a surface has no gate, and on the processor if a
    /// visible triangle has no normal.
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
                let counts = device_gated(gpu, plane, camera, (surfaces, gates), &target);
                counts.map(Image::from)
            }
        }
    }

    /// The stencil of the last picture, or a new one if the size differs.
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

/// You need at least this many weights or gates.
fn least(surfaces: ClosedSurfaces<'_, impl Positioned>) -> usize {
    let last = surfaces.triangles.iter().map(|triangle| triangle.material as usize).max();
    last.map_or(0, |last| last + 1)
}

/// A stencil of 8 bits counts at most this many closed surfaces.
const MOST_IN_STENCIL: usize = 255;

/// This shader draws the depth of the scene and counts faces behind it in the stencil. It reads
/// the words of vertices, and [`Triangle`]s.
pub static STENCIL_FACES: StencilShader = StencilShader {
    name: "stencil_faces",
    source: include_str!("corner.wgsl"),
    parameters: FacesParams::LAYOUT,
    buffers: 2,
};

/// This shader adds weights of closed surfaces. It reads the words of vertices, [`Triangle`]s,
/// [`Fragment`]s and weights, and adds to the sums of pixels.
pub static WEIGHED_FACES: ScatterShader = ScatterShader {
    name: "weighed_faces",
    source: concat!(include_str!("corner.wgsl"), include_str!("weigh.wgsl")),
    parameters: FacesParams::LAYOUT,
    structs: &[Fragment::LAYOUT],
    buffers: 5,
};

/// This shader counts closed surfaces with a gate. It reads the words of vertices, [`Triangle`]s,
/// [`Fragment`]s, gates of surfaces and normals of triangles, and adds to the counts of pixels.
pub static GATED_FACES: ScatterShader = ScatterShader {
    name: "gated_faces",
    source: concat!(include_str!("corner.wgsl"), include_str!("gate.wgsl")),
    parameters: FacesParams::LAYOUT,
    structs: &[Fragment::LAYOUT],
    buffers: 6,
};

/// This kernel adds the bytes of a stencil to counts.
pub static ADD_STENCIL: Kernel = Kernel {
    name: "add_stencil",
    source: include_str!("add_stencil.wgsl"),
    parameters: layout!(AddStencilParams { size, row_words, first }),
    structs: &[Fragment::LAYOUT],
    storage: &[Storage::Read, Storage::Read, Storage::Write],
};

/// Parameters of [`STENCIL_FACES`], [`WEIGHED_FACES`] and [`GATED_FACES`].
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct FacesParams {
    clip_from_model: [[f32; 4]; 4],
    vertex_words: u32,
    width: u32,
    depth_scale: f32,
    spare: u32,
}

/// Parameters of [`ADD_STENCIL`].
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct AddStencilParams {
    size: [u32; 2],
    row_words: u32,
    first: u32,
}

impl FacesParams {
    const LAYOUT: crate::gpu::Layout =
        layout!(FacesParams { clip_from_model, vertex_words, width, depth_scale, spare });

    /// Sets up vertices of type `V`. There is no far plane, as faces beyond it count too.
    fn new<V>(camera: &Camera, (width, height): (usize, usize)) -> Self {
        let clip_from_model = camera.endless_clip_from_model(width as f32 / height as f32);
        Self {
            clip_from_model: clip_from_model.to_cols_array_2d(),
            vertex_words: (size_of::<V>() / size_of::<f32>()) as u32,
            width: width as u32,
            depth_scale: camera.depth_scale(),
            spare: 0,
        }
    }
}

struct DeviceSurfaces {
    vertices: Plane<f32>,
    triangles: Plane<Triangle>,
}

impl DeviceSurfaces {
    fn new(
        gpu: &mut GpuCompute,
        vertices: &[impl Positioned],
        triangles: &[Triangle],
    ) -> Result<Self, DeviceError> {
        let words: Vec<f32> = vertices.iter().flat_map(Positioned::position).collect();
        let words = Field::from_values(words.len(), 1, words);
        let vertices = gpu.upload(&words)?;
        let triangles = Field::from_values(triangles.len(), 1, triangles.to_vec());
        Ok(Self { vertices, triangles: gpu.upload(&triangles)? })
    }
}

fn device_counts(
    gpu: &mut GpuCompute,
    scene: &DeviceModel,
    visible: &Plane<Fragment>,
    camera: &Camera,
    surfaces: ClosedSurfaces<'_, impl Positioned>,
    target: &StencilTarget,
) -> Result<Plane<i32>, DeviceError> {
    let (width, height) = visible.size();
    let counts = gpu.plane(width, height)?;
    let mut triangles = surfaces.triangles.to_vec();
    triangles.sort_by_key(|triangle| triangle.material);
    let own = DeviceSurfaces::new(gpu, surfaces.vertices, &triangles)?;
    let scene = TriangleList {
        parameters: &FacesParams::new::<Vertex>(camera, (width, height)),
        buffers: &[&scene.vertices, &scene.triangles],
        triangles: 0..scene.count,
    };
    let mut scene = Some(scene);
    let parameters = FacesParams::new::<[f32; 3]>(camera, (width, height));
    for (batch, number) in batches(&triangles).into_iter().zip(0..) {
        let faces = TriangleList {
            parameters: &parameters,
            buffers: &[own.vertices.buffer(), own.triangles.buffer()],
            triangles: batch,
        };
        gpu.recording.count_faces(&STENCIL_FACES, scene.take(), faces, target);
        let params = AddStencilParams {
            size: [width as u32, height as u32],
            row_words: target.row_bytes() / 4,
            first: u32::from(number == 0),
        };
        let buffers = [target.rows(), visible.buffer(), counts.buffer()];
        gpu.dispatch(&ADD_STENCIL, &params, &buffers, (width, height));
    }
    Ok(counts)
}

/// Cuts sorted triangles into runs of at most [`MOST_IN_STENCIL`] surfaces. There is at least one
/// run.
fn batches(triangles: &[Triangle]) -> Vec<Range<usize>> {
    let mut batches = Vec::new();
    let mut start = 0;
    let mut surfaces = 0;
    let mut last = None;
    for (i, triangle) in triangles.iter().enumerate() {
        if last != Some(triangle.material) {
            last = Some(triangle.material);
            if surfaces == MOST_IN_STENCIL {
                batches.push(start..i);
                (start, surfaces) = (i, 0);
            }
            surfaces += 1;
        }
    }
    batches.push(start..triangles.len());
    batches
}

fn device_weighed(
    gpu: &mut GpuCompute,
    visible: &Plane<Fragment>,
    camera: &Camera,
    (surfaces, weights): (ClosedSurfaces<'_, impl Positioned>, &[i32]),
    target: &StencilTarget,
) -> Result<Plane<i32>, DeviceError> {
    let weights = gpu.upload(&Field::from_values(weights.len(), 1, weights.to_vec()))?;
    let buffers = [visible.buffer(), weights.buffer()];
    scattered(gpu, &WEIGHED_FACES, (visible.size(), &buffers), camera, surfaces, target)
}

fn device_gated(
    gpu: &mut GpuCompute,
    visible: &Plane<Fragment>,
    camera: &Camera,
    (surfaces, gates): (ClosedSurfaces<'_, impl Positioned>, Gates<'_>),
    target: &StencilTarget,
) -> Result<Plane<i32>, DeviceError> {
    let normals = gates.normals.plane();
    let gates = gates.surfaces.to_vec();
    let gates = gpu.upload(&Field::from_values(gates.len(), 1, gates))?;
    let buffers = [visible.buffer(), gates.buffer(), normals.buffer()];
    scattered(gpu, &GATED_FACES, (visible.size(), &buffers), camera, surfaces, target)
}

/// Sums `shader` over every pixel of every face. It gets the surfaces' buffers, then `buffers`,
/// then the sums.
fn scattered(
    gpu: &mut GpuCompute,
    shader: &'static ScatterShader,
    ((width, height), buffers): ((usize, usize), &[&Buffer]),
    camera: &Camera,
    surfaces: ClosedSurfaces<'_, impl Positioned>,
    target: &StencilTarget,
) -> Result<Plane<i32>, DeviceError> {
    if !gpu.device.scatters() {
        let what = "weighed counting".to_owned();
        let reason = "fragments of this adapter write no buffers".to_owned();
        return Err(DeviceError::Refused { what, reason });
    }
    let sums = gpu.upload(&Field::filled(width, height, 0_i32))?;
    let own = DeviceSurfaces::new(gpu, surfaces.vertices, surfaces.triangles)?;
    let mut all = vec![own.vertices.buffer(), own.triangles.buffer()];
    all.extend(buffers);
    all.push(sums.buffer());
    let faces = TriangleList {
        parameters: &FacesParams::new::<[f32; 3]>(camera, (width, height)),
        buffers: &all,
        triangles: 0..surfaces.triangles.len(),
    };
    gpu.recording.scatter(shader, &faces, target);
    Ok(sums)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_batch_has_as_many_surfaces_as_a_stencil_counts() {
        fn triangles(counts: &[u32]) -> Vec<Triangle> {
            let faces = counts.iter().zip(0..).flat_map(|(&count, material)| {
                (0..count).map(move |_| Triangle { corners: [0; 3], material: 7 * material })
            });
            faces.collect()
        }
        fn ends(counts: &[u32]) -> Vec<[usize; 2]> {
            let batches = batches(&triangles(counts)).into_iter();
            batches.map(|batch| [batch.start, batch.end]).collect()
        }
        assert_eq!(ends(&[]), [[0, 0]]);
        assert_eq!(ends(&[2; 255]), [[0, 510]]);
        assert_eq!(ends(&[2; 256]), [[0, 510], [510, 512]]);
        assert_eq!(ends(&[1; 600]), [[0, 255], [255, 510], [510, 600]]);
    }
}
