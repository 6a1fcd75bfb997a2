//! The tones of a map in the memory of a graphics device.

use graphics::compute::{Compute, GpuCompute, Plane};
use graphics::gpu::{Buffer, DeviceError};

use super::coloring::Coloring;
use super::tones::{Texels, Tones};

/// Tones in the memory of whatever computes. The processor reads [`Tones`] themselves.
#[derive(Debug, Clone)]
pub(super) enum ToneMemory {
    /// The processor's memory.
    Host,
    /// That of a graphics device.
    Device(DeviceTones),
}

/// Texels of all tones and the table of encoded light, copied once.
#[derive(Debug, Clone)]
pub(super) struct DeviceTones {
    texels: Plane<u32>,
    encoded: Plane<f32>,
    /// First texel of each size of each slice, and its width.
    tiles: Vec<Vec<[u32; 2]>>,
}

impl ToneMemory {
    /// Copies the tones to where `compute` reads them.
    ///
    /// # Errors
    /// [`DeviceError::TooLarge`] for tones beyond the device's buffer limit, and other errors of a
    /// device; never on the processor.
    pub(super) fn new(
        compute: &mut Compute,
        tones: &Tones,
        coloring: &Coloring,
    ) -> Result<Self, DeviceError> {
        match compute {
            Compute::Cpu => Ok(Self::Host),
            Compute::Gpu(gpu) => DeviceTones::new(gpu, tones, coloring).map(Self::Device),
        }
    }

    /// The tones on a device.
    ///
    /// # Panics
    /// If they are in the processor's memory.
    pub(super) fn device(&self) -> &DeviceTones {
        match self {
            Self::Device(tones) => tones,
            Self::Host => panic!("a graphics device was handed tones in the processor's memory"),
        }
    }
}

impl DeviceTones {
    fn new(gpu: &mut GpuCompute, tones: &Tones, coloring: &Coloring) -> Result<Self, DeviceError> {
        let count: usize = tones.sizes().flatten().map(|texels| texels.packed().len()).sum();
        gpu.device().check_size("the art map", (count * size_of::<u32>()) as u64)?;
        let mut packed = Vec::with_capacity(count);
        let mut tile = |texels: &Texels| {
            let first = packed.len() as u32;
            packed.extend_from_slice(texels.packed());
            [first, texels.size as u32]
        };
        let tiles = tones.sizes().map(|sizes| sizes.iter().map(&mut tile).collect()).collect();
        let texels = gpu.plane(packed.len(), 1)?;
        gpu.write(&texels, &packed)?;
        let encoded = gpu.plane(coloring.encoded.len(), 1)?;
        gpu.write(&encoded, &coloring.encoded)?;
        Ok(Self { texels, encoded, tiles })
    }

    /// First texel of a tone at a size, and the width of its tile.
    pub(super) fn tile(&self, slice: usize, halvings: usize) -> [u32; 2] {
        self.tiles[slice][halvings]
    }

    /// Bytes of all texels, as [`Texels::packed`] has them.
    pub(super) fn texels(&self) -> &Buffer {
        self.texels.buffer()
    }

    /// Encoded values of linear ones.
    pub(super) fn encoded(&self) -> &Buffer {
        self.encoded.buffer()
    }
}
