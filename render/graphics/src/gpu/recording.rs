//! What is to be done on the device, written down first: dispatches, what they
//! read beside their buffers, triangles, copies.

use super::device::Buffer;
use super::kernel::Kernel;
use super::raster::RasterShader;
use super::target::Target;

/// Parameters of every dispatch start at a multiple of this: no adapter wants more.
const ALIGNMENT: usize = 256;

/// One command.
#[derive(Debug)]
pub(super) enum Command {
    /// A kernel over groups of invocations.
    Dispatch {
        kernel: &'static Kernel,
        /// Those that are not [`super::Storage::Batch`], in order.
        buffers: Vec<Buffer>,
        /// Where in [`Recording::parameters`] its own start.
        parameters: u32,
        groups: [u32; 3],
    },
    /// Bytes from one buffer into another.
    Copy { from: Buffer, to: Buffer, bytes: u64 },
    /// Triangles over a whole target, and that into a buffer.
    Draw(Box<Draw>),
}

/// Triangles to be drawn.
#[derive(Debug)]
pub(super) struct Draw {
    pub(super) shader: &'static RasterShader,
    pub(super) buffers: Vec<Buffer>,
    /// As of a dispatch.
    pub(super) parameters: u32,
    pub(super) triangles: u32,
    pub(super) front_only: bool,
    pub(super) background: [u32; 4],
    pub(super) target: Target,
    pub(super) into: Buffer,
}

/// What is drawn, and how.
#[derive(Debug, Clone, Copy)]
pub struct Triangles {
    /// How many.
    pub count: usize,
    /// Only those that run counter-clockwise in the picture.
    pub front_only: bool,
    /// The four numbers of a pixel that shows none.
    pub background: [u32; 4],
}

/// Commands that go to the device in one submission, with all they read.
#[derive(Debug, Default)]
pub struct Recording {
    pub(super) commands: Vec<Command>,
    pub(super) parameters: Vec<u8>,
    pub(super) batch: Vec<u8>,
}

impl Recording {
    /// Puts `items` beside the dispatches, for kernels that read the batch;
    /// the index of the first, counted in items.
    pub fn batch<T: bytemuck::Pod>(&mut self, items: &[T]) -> u32 {
        let first = self.batch.len().div_ceil(size_of::<T>());
        self.batch.resize(first * size_of::<T>(), 0);
        self.batch.extend_from_slice(bytemuck::cast_slice(items));
        first as u32
    }

    /// Runs `kernel` with `parameters` on `buffers`, over `groups`.
    ///
    /// # Panics
    /// If the parameters are not the kernel's.
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
        let parameters = self.keep(bytemuck::bytes_of(parameters));
        let buffers = buffers.iter().map(|&buffer| buffer.clone()).collect();
        self.commands.push(Command::Dispatch { kernel, buffers, parameters, groups });
    }

    /// Draws triangles with `shader` over all of `target`, the first of equal depth
    /// before the later ones, and puts the four numbers of every pixel into `into`,
    /// row by row without gaps.
    ///
    /// # Panics
    /// If the parameters or the number of buffers are not the shader's, or there
    /// are more than 2^32 corners.
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
        let parameters = self.keep(bytemuck::bytes_of(parameters));
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

    /// Where the parameters of a command stand.
    fn keep(&mut self, parameters: &[u8]) -> u32 {
        let start = self.parameters.len().next_multiple_of(ALIGNMENT);
        self.parameters.resize(start, 0);
        self.parameters.extend_from_slice(parameters);
        start as u32
    }

    /// Copies the first `bytes` of one buffer into another.
    pub fn copy(&mut self, from: &Buffer, to: &Buffer, bytes: u64) {
        self.commands.push(Command::Copy { from: from.clone(), to: to.clone(), bytes });
    }

    /// How many commands wait.
    #[must_use]
    pub fn len(&self) -> usize {
        self.commands.len()
    }

    /// Whether nothing waits.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.commands.is_empty()
    }

    /// Bytes that go to the device with it.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.parameters.len() + self.batch.len()
    }
}
