//! Commands recorded for the device: dispatches, draws and copies, with their parameters and data.

use std::ops::Range;

use super::device::Buffer;
use super::pipelines::{Kernel, RasterShader, ScatterShader, StencilShader};
use super::target::{StencilTarget, Target};

/// Alignment of the parameters of each dispatch, in bytes. No WebGPU adapter requires more than
/// this.
const ALIGNMENT: usize = 256;

#[derive(Debug)]
pub(super) enum Command {
    /// Runs a kernel over workgroups.
    Dispatch {
        kernel: &'static Kernel,
        /// Storage buffers other than [`super::Storage::Batch`], in order.
        buffers: Vec<Buffer>,
        /// Offset of its parameters in [`Recording::parameters`], in bytes.
        parameters: u32,
        groups: [u32; 3],
    },
    /// Copies the first `bytes` of one buffer to another.
    Copy { from: Buffer, to: Buffer, bytes: u64 },
    /// Draws triangles into a target and copies it to a buffer.
    Draw(Box<Draw>),
    /// Counts faces in a stencil and copies it to a buffer.
    Stencil(Box<StencilDraw>),
    /// Draws faces that add to a buffer.
    Scatter(Box<ScatterDraw>),
}

#[derive(Debug)]
pub(super) struct Draw {
    pub(super) shader: &'static RasterShader,
    pub(super) buffers: Vec<Buffer>,
    /// Offset of its parameters in [`Recording::parameters`], in bytes.
    pub(super) parameters: u32,
    pub(super) triangles: u32,
    pub(super) front_only: bool,
    pub(super) background: [u32; 4],
    pub(super) target: Target,
    pub(super) into: Buffer,
}

#[derive(Debug)]
pub(super) struct List {
    pub(super) buffers: Vec<Buffer>,
    /// Offset of the parameters in [`Recording::parameters`], in bytes.
    pub(super) parameters: u32,
    pub(super) triangles: Range<u32>,
}

#[derive(Debug)]
pub(super) struct StencilDraw {
    pub(super) shader: &'static StencilShader,
    /// The scene that gives the depth. We draw it first. `None` keeps the depth of the target.
    pub(super) scene: Option<List>,
    pub(super) faces: List,
    pub(super) target: StencilTarget,
}

#[derive(Debug)]
pub(super) struct ScatterDraw {
    pub(super) shader: &'static ScatterShader,
    pub(super) faces: List,
    pub(super) target: StencilTarget,
}

/// Triangles of a draw, with the parameters and buffers of its shader.
#[derive(Debug, Clone)]
pub struct TriangleList<'a, P> {
    /// Parameters of the shader.
    pub parameters: &'a P,
    /// Buffers of the shader, in the order of their bindings.
    pub buffers: &'a [&'a Buffer],
    /// Indices of the triangles.
    pub triangles: Range<usize>,
}

/// How many triangles you draw, and how.
#[derive(Debug, Clone, Copy)]
pub struct Triangles {
    /// Number of triangles.
    pub count: usize,
    /// Whether to leave out triangles with corners that run clockwise in the picture.
    pub front_only: bool,
    /// The four numbers of a pixel that shows no triangle.
    pub background: [u32; 4],
}

/// Commands for one submission, with the parameters and batch data that they read. You fill this,
/// then pass it to [`super::Device::submit`].
#[derive(Debug, Default)]
pub struct Recording {
    pub(super) commands: Vec<Command>,
    pub(super) parameters: Vec<u8>,
    pub(super) batch: Vec<u8>,
}

impl Recording {
    /// Removes everything, but keeps the memory for what you record next.
    pub(super) fn clear(&mut self) {
        self.commands.clear();
        self.parameters.clear();
        self.batch.clear();
    }

    /// Appends `items` to the data that [`super::Storage::Batch`] binds. Returns the index of the
    /// first one, counted in items.
    pub fn batch<T: bytemuck::Pod>(&mut self, items: &[T]) -> u32 {
        let first = self.batch.len().div_ceil(size_of::<T>());
        self.batch.resize(first * size_of::<T>(), 0);
        self.batch.extend_from_slice(bytemuck::cast_slice(items));
        first as u32
    }

    /// Records a dispatch of `kernel` on `buffers` over `groups` workgroups (x, y, z). If you pass
    /// 0 for a direction, this records nothing.
    ///
    /// # Panics
    /// If `parameters` does not have the size of the kernel's parameters.
    pub fn dispatch<P: bytemuck::Pod>(
        &mut self,
        kernel: &'static Kernel,
        parameters: &P,
        buffers: &[&Buffer],
        groups: [u32; 3],
    ) {
        assert_eq!(size_of::<P>(), kernel.parameters.bytes, "parameters of {}", kernel.name);
        if groups.contains(&0) {
            return;
        }
        let parameters = self.push_parameters(bytemuck::bytes_of(parameters));
        let buffers = buffers.iter().map(|&buffer| buffer.clone()).collect();
        self.commands.push(Command::Dispatch { kernel, buffers, parameters, groups });
    }

    /// Records a draw of triangles over the whole `target`. Where depths are equal, you see the
    /// first triangle. Then this copies the four numbers of every pixel to `into`, row by row
    /// without gaps.
    ///
    /// # Panics
    /// If the shader needs another size of `parameters` or another number of buffers, or there are
    /// more than 2^32 corners.
    pub fn draw<P: bytemuck::Pod>(
        &mut self,
        shader: &'static RasterShader,
        parameters: &P,
        buffers: &[&Buffer],
        triangles: Triangles,
        (target, into): (&Target, &Buffer),
    ) {
        assert_eq!(size_of::<P>(), shader.parameters.bytes, "parameters of {}", shader.name);
        assert_eq!(buffers.len(), shader.buffers, "buffers of {}", shader.name);
        let Triangles { count, front_only, background } = triangles;
        assert!(count <= u32::MAX as usize / 3, "{count} triangles");
        let parameters = self.push_parameters(bytemuck::bytes_of(parameters));
        self.commands.push(Command::Draw(Box::new(Draw {
            shader,
            buffers: buffers.iter().map(|&buffer| buffer.clone()).collect(),
            parameters,
            triangles: count as u32,
            front_only,
            background,
            target: target.clone(),
            into: into.clone(),
        })));
    }

    /// Records the counting of faces in the stencil of `target`.
    ///
    /// The stencil starts at 0. Faces that are not before the depth of the target change it: a
    /// back face adds 1, a front face subtracts 1, and it wraps at 256. If you give a `scene`,
    /// this draws its depth first. Otherwise the target keeps the depth of the last one. Then this
    /// copies the stencil to [`StencilTarget::rows`].
    ///
    /// # Panics
    /// If the shader needs another size of the parameters or another number of buffers, or there
    /// are more than 2^32 corners.
    pub fn count_faces<P: bytemuck::Pod>(
        &mut self,
        shader: &'static StencilShader,
        scene: Option<TriangleList<'_, P>>,
        faces: TriangleList<'_, P>,
        target: &StencilTarget,
    ) {
        let counts = (shader.name, shader.parameters.bytes, shader.buffers);
        let scene = scene.map(|scene| self.list(counts, &scene));
        let faces = self.list(counts, &faces);
        let target = target.clone();
        self.commands.push(Command::Stencil(Box::new(StencilDraw {
            shader,
            scene,
            faces,
            target,
        })));
    }

    /// Records a draw of both sides of faces in a picture of the size of `target`. The shader adds
    /// to its last buffer at the pixels of the faces. This leaves the target itself as it is.
    ///
    /// # Panics
    /// If the shader needs another size of the parameters or another number of buffers, or there
    /// are more than 2^32 corners.
    pub fn scatter<P: bytemuck::Pod>(
        &mut self,
        shader: &'static ScatterShader,
        faces: &TriangleList<'_, P>,
        target: &StencilTarget,
    ) {
        let faces = self.list((shader.name, shader.parameters.bytes, shader.buffers), faces);
        let target = target.clone();
        self.commands.push(Command::Scatter(Box::new(ScatterDraw { shader, faces, target })));
    }

    /// Checks a list of triangles and appends its parameters. The shader has this name, size of
    /// parameters and number of buffers.
    fn list<P: bytemuck::Pod>(
        &mut self,
        (name, bytes, buffers): (&str, usize, usize),
        list: &TriangleList<'_, P>,
    ) -> List {
        assert_eq!(size_of::<P>(), bytes, "parameters of {name}");
        assert_eq!(list.buffers.len(), buffers, "buffers of {name}");
        let Range { start, end } = list.triangles;
        assert!(end <= u32::MAX as usize / 3, "{end} triangles");
        List {
            buffers: list.buffers.iter().map(|&buffer| buffer.clone()).collect(),
            parameters: self.push_parameters(bytemuck::bytes_of(list.parameters)),
            triangles: start as u32..end as u32,
        }
    }

    /// Appends the parameters of a command. Returns their offset in bytes.
    fn push_parameters(&mut self, parameters: &[u8]) -> u32 {
        let start = self.parameters.len().next_multiple_of(ALIGNMENT);
        self.parameters.resize(start, 0);
        self.parameters.extend_from_slice(parameters);
        start as u32
    }

    /// Records a copy of the first `bytes` of one buffer to another.
    pub fn copy(&mut self, from: &Buffer, to: &Buffer, bytes: u64) {
        self.commands.push(Command::Copy { from: from.clone(), to: to.clone(), bytes });
    }

    /// Number of recorded commands.
    #[must_use]
    pub fn len(&self) -> usize {
        self.commands.len()
    }

    /// Whether no command is recorded.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.commands.is_empty()
    }

    /// Size of the parameters and batch data, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.parameters.len() + self.batch.len()
    }
}
