//! Counting on a graphics device: in its stencil, or weighed by adding at every fragment.

use std::ops::Range;

use super::gates::Gates;
use super::surfaces::ClosedSurfaces;
use crate::camera::Camera;
use crate::compute::{GpuCompute, Plane};
use crate::field::Field;
use crate::gpu::{
    Buffer, DeviceError, Kernel, ScatterShader, StencilShader, StencilTarget, Storage,
    TriangleList, layout,
};
use crate::mesh::Triangle;
use crate::surface::model::DeviceModel;
use crate::surface::packed::{Positioned, Vertex};
use crate::surface::visibility::Fragment;

/// The most closed surfaces that a stencil of 8 bits counts.
const MOST_IN_STENCIL: usize = 255;

/// The shader that draws the depth of the scene and counts faces behind it in the stencil. It
/// reads the words of vertices, and [`Triangle`]s.
pub static STENCIL_FACES: StencilShader = StencilShader {
    name: "stencil_faces",
    source: include_str!("corner.wgsl"),
    parameters: FacesParams::LAYOUT,
    buffers: 2,
};

/// The shader that adds weights of closed surfaces. It reads the words of vertices,
/// [`Triangle`]s, [`Fragment`]s and weights, and adds to the sums of pixels.
pub static WEIGHED_FACES: ScatterShader = ScatterShader {
    name: "weighed_faces",
    source: concat!(include_str!("corner.wgsl"), include_str!("weigh.wgsl")),
    parameters: FacesParams::LAYOUT,
    structs: &[Fragment::LAYOUT],
    buffers: 5,
};

/// The shader that counts closed surfaces with a gate. It reads the words of vertices,
/// [`Triangle`]s, [`Fragment`]s, gates of surfaces and normals of triangles, and adds to the counts
/// of pixels.
pub static GATED_FACES: ScatterShader = ScatterShader {
    name: "gated_faces",
    source: concat!(include_str!("corner.wgsl"), include_str!("gate.wgsl")),
    parameters: FacesParams::LAYOUT,
    structs: &[Fragment::LAYOUT],
    buffers: 6,
};

/// The kernel that adds the bytes of a stencil to counts.
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

    /// For vertices of type `V`. There is no far plane, as faces beyond it count too.
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

/// Closed surfaces in device memory.
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

/// Counts the surfaces that hold what each pixel shows in the stencil of `target`.
pub(super) fn counts(
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

/// Sorted triangles in runs of at most [`MOST_IN_STENCIL`] surfaces, at least one run.
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

/// Sums the weights of the surfaces that hold what each pixel shows.
pub(super) fn weighed(
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

/// Counts the surfaces that hold what each pixel shows and let its triangle pass.
pub(super) fn gated(
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

/// Sums of `shader` over every pixel of every face. Its buffers are those of the surfaces, then
/// `buffers`, then the sums.
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
        let triangles = |counts: &[u32]| -> Vec<Triangle> {
            let faces = counts.iter().zip(0..).flat_map(|(&count, material)| {
                (0..count).map(move |_| Triangle { corners: [0; 3], material: 7 * material })
            });
            faces.collect()
        };
        let ends = |counts: &[u32]| -> Vec<[usize; 2]> {
            let batches = batches(&triangles(counts)).into_iter();
            batches.map(|batch| [batch.start, batch.end]).collect()
        };
        assert_eq!(ends(&[]), [[0, 0]]);
        assert_eq!(ends(&[2; 255]), [[0, 510]]);
        assert_eq!(ends(&[2; 256]), [[0, 510], [510, 512]]);
        assert_eq!(ends(&[1; 600]), [[0, 255], [255, 510], [510, 600]]);
    }
}
