//! Options that choose between the processor and a graphics device.

use clap::{Args, ValueEnum};
use render::compute::Compute;
use render::field::Field;
use render::gpu::{BackendChoice, DeviceError};
use render::paint::engine::PaintEngine;
use render::paint::painting::UNDO_BYTES;

use crate::console::Console;
use crate::failure::Result;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum BackendName {
    /// Hardware where there is some (see `impasto gpu`), else the processor
    Auto,
    /// The processor
    Cpu,
    /// A graphics adapter, even one in software
    Gpu,
}

/// Where to compute.
#[derive(Debug, Clone, Args)]
pub(crate) struct BackendOption {
    /// Where to compute
    #[arg(long, value_enum, default_value = "auto")]
    backend: BackendName,
}

impl BackendOption {
    /// Opens the processor or the graphics device for computing images.
    pub(crate) fn compute(&self) -> Result<Compute, DeviceError> {
        Compute::choose(self.choice())
    }

    fn choice(&self) -> BackendChoice {
        match self.backend {
            BackendName::Auto => BackendChoice::Auto,
            BackendName::Cpu => BackendChoice::Cpu,
            BackendName::Gpu => BackendChoice::Gpu,
        }
    }
}

/// Where to compute, and how much undo may keep.
#[derive(Debug, Clone, Args)]
pub(crate) struct EngineOptions {
    #[command(flatten)]
    backend: BackendOption,
    /// Memory that undo may keep, in MiB; what does not fit is forgotten, oldest first
    #[arg(long, value_name = "MIB", default_value_t = UNDO_BYTES >> 20, value_parser = clap::value_parser!(u64).range(0..=1 << 20))]
    undo_memory: u64,
}

impl EngineOptions {
    /// A backend for a canvas over the ground `floor`. With `auto`, a device that
    /// cannot hold the canvas gives way to the processor, and that is said.
    pub(crate) fn engine(
        &self,
        floor: &Field<i32>,
        console: &mut Console<'_>,
    ) -> Result<PaintEngine> {
        let opened = PaintEngine::open(self.backend.choice(), floor)?;
        if let Some(error) = opened.gave_way {
            console.warnings(&[format!("{error}; painting on the processor")])?;
        }
        Ok(opened.engine)
    }

    /// Bytes for undo.
    pub(crate) fn undo_bytes(&self) -> u64 {
        self.undo_memory << 20
    }
}
