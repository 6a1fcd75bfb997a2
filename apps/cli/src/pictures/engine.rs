//! Options that choose between the processor and a graphics device.

use clap::{Args, ValueEnum};
use graphics::field::Field;
use graphics::gpu::BackendChoice;
use paint::engine::PaintEngine;
use paint::painting::UNDO_BYTES;
use pictures::Device;

use crate::console::{Console, without_noise};
use crate::failure::Result;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum BackendName {
    /// A hardware graphics adapter if there is one (see `impasto gpu`), else the processor
    Auto,
    /// The processor (CPU)
    Cpu,
    /// A graphics adapter, in hardware or software
    Gpu,
}

/// Option that selects the processor or a graphics device.
#[derive(Debug, Clone, Args)]
pub(crate) struct BackendOption {
    /// Device to compute on
    #[arg(long, value_enum, default_value = "auto")]
    backend: BackendName,
}

impl BackendOption {
    fn choice(&self) -> BackendChoice {
        self.device().into()
    }

    /// The device of a request.
    pub(crate) fn device(&self) -> Device {
        match self.backend {
            BackendName::Auto => Device::Auto,
            BackendName::Cpu => Device::Cpu,
            BackendName::Gpu => Device::Gpu,
        }
    }
}

/// Options for the paint engine: the device, and the memory for undo.
#[derive(Debug, Clone, Args)]
pub(crate) struct EngineOptions {
    #[command(flatten)]
    backend: BackendOption,
    /// Memory for undo in MiB; when it is full, the oldest steps are dropped
    #[arg(long, value_name = "MIB", default_value_t = UNDO_BYTES >> 20, value_parser = clap::value_parser!(u64).range(0..=1 << 20))]
    undo_memory: u64,
}

impl EngineOptions {
    /// Opens a paint engine for a canvas over the ground heights `floor`. With `auto`, a device that
    /// cannot hold the canvas is replaced by the processor, with a warning.
    pub(crate) fn engine(
        &self,
        floor: &Field<i32>,
        console: &mut Console<'_>,
    ) -> Result<PaintEngine> {
        let opened = without_noise(console, || PaintEngine::open(self.backend.choice(), floor))??;
        if let Some(error) = opened.device_error {
            console.warnings(&[format!("{error}; painting on the processor")])?;
        }
        Ok(opened.engine)
    }

    /// The device of a request.
    pub(crate) fn device(&self) -> Device {
        self.backend.device()
    }

    /// Memory for undo in MiB.
    pub(crate) fn undo_memory(&self) -> u64 {
        self.undo_memory
    }
}
