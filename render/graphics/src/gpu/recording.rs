//! Commands recorded for the device: dispatches, draws and copies, with the parameters and
//! data that they read.

use super::device::Buffer;
use super::kernel::Kernel;
use super::raster::RasterShader;
use super::target::Target;

/// Alignment of the parameters of each dispatch, in bytes: the largest that WebGPU adapters
/// require.
const ALIGNMENT: usize = 256;

/// A command for the device.
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
}

/// A draw of triangles.
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

/// Number of triangles of a draw, and how they are drawn.
#[derive(Debug, Clone, Copy)]
pub struct Triangles {
    /// Number of triangles.
    pub count: usize,
    /// Culls triangles whose corners run clockwise in the picture.
    pub front_only: bool,
    /// The four numbers of a pixel without a triangle.
    pub background: [u32; 4],
}

/// Commands for one submission, with the parameters and batch data that they read.
#[derive(Debug, Default)]
pub struct Recording {
    pub(super) commands: Vec<Command>,
    pub(super) parameters: Vec<u8>,
    pub(super) batch: Vec<u8>,
}

impl Recording {
    /// Appends `items` to the data that [`super::Storage::Batch`] binds. Returns the index of
    /// the first, counted in items.
    pub fn batch<T: bytemuck::Pod>(&mut self, items: &[T]) -> u32 {
        let first = self.batch.len().div_ceil(size_of::<T>());
        self.batch.resize(first * size_of::<T>(), 0);
        self.batch.extend_from_slice(bytemuck::cast_slice(items));
        first as u32
    }

    /// Records a dispatch of `kernel` on `buffers` over `groups` workgroups (x, y, z); 0 in any
    /// direction records nothing.
    ///
    /// # Panics
    /// If the size of `parameters` is not that of the kernel's parameters.
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

    /// Records a draw of triangles over the whole `target`; of equal depths the first triangle
    /// wins. Then copies the four numbers of every pixel to `into`, row by row without gaps.
    ///
    /// # Panics
    /// If the size of `parameters` or the number of buffers is not that of the shader, or
    /// there are more than 2^32 corners.
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
