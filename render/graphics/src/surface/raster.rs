//! Rasterises triangles on the processor.
//!
//! Follows the rules of graphics devices, so that both agree up to rounding. Vertices are
//! rounded to the 256th of a pixel. A pixel belongs to the triangle that contains its
//! centre; a centre on an edge belongs to the triangle below or to the right of the edge.
//! The nearest triangle is seen; at equal depth, the one with the lowest index. Triangles
//! are clipped at the near and far plane.

use glam::Mat4;
use rayon::prelude::*;

use super::bands::{BAND, Bands, Sides};
use super::fill::{Shape, fill};
use super::packed::{Positioned, Vertex};
use super::screen::Screen;
use super::visibility::{Fragment, VisibilityBuffer};
use crate::camera::Camera;
use crate::gpu::{RasterShader, layout};
use crate::mesh::{Mesh, Triangle};

/// The shader that draws a visibility buffer on a graphics device. It reads buffers of
/// [`Vertex`] and [`Triangle`]; a pixel is a [`Fragment`].
pub static RASTER: RasterShader = RasterShader {
    name: "raster",
    source: include_str!("raster.wgsl"),
    parameters: layout!(RasterParams { clip_from_model }),
    structs: &[Vertex::LAYOUT],
    buffers: 2,
};

/// Parameters of [`RASTER`].
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct RasterParams {
    /// The 4 x 4 matrix from model to clip coordinates, column by column.
    pub clip_from_model: [[f32; 4]; 4],
}

/// Draws both sides of all triangles of a mesh as `camera` sees them.
///
/// # Panics
/// If a triangle has a corner that the mesh does not have.
#[must_use]
pub fn visible(mesh: &Mesh, camera: &Camera, width: usize, height: usize) -> VisibilityBuffer {
    let mut visible = VisibilityBuffer::filled(width, height, Fragment::EMPTY);
    let clip_from_model = camera.clip_from_model(width as f32 / height.max(1) as f32);
    Rasteriser::default().draw(
        clip_from_model,
        &mesh.positions,
        &mesh.triangles,
        Sides::Both,
        &mut visible,
    );
    visible
}

/// Draws triangles on the processor. Keeps its memory between pictures.
#[derive(Debug, Clone, Default)]
pub struct Rasteriser {
    bands: Bands,
}

impl Rasteriser {
    /// Draws triangles over all of `visible`, which is cleared first.
    ///
    /// # Panics
    /// If a triangle has a corner that `vertices` does not have, or there are 2^31
    /// triangles or more.
    pub fn draw(
        &mut self,
        clip_from_model: Mat4,
        vertices: &[impl Positioned],
        triangles: &[Triangle],
        sides: Sides,
        visible: &mut VisibilityBuffer,
    ) {
        let width = visible.width();
        let height = visible.height();
        if width * height == 0 {
            return;
        }
        let screen = Screen::new(clip_from_model, width, height);
        self.bands.sort(screen, (width, height), vertices, triangles, sides);
        let bands = visible.values_mut().par_chunks_mut(width * BAND).enumerate();
        bands.for_each(|(band, pixels)| {
            pixels.fill(Fragment::EMPTY);
            self.bands.for_each_shape(band, triangles, |shape: &Shape| {
                fill(shape, band * BAND, width, pixels)
            });
        });
    }
}
