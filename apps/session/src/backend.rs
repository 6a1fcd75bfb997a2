//! Choice of the backend: the processor or a graphics device.

use graphics::field::Field;
use graphics::gpu::BackendChoice;
use paint::engine::{OpenedEngine, PaintEngine};

/// Backend for new paintings.
#[derive(Debug)]
pub(super) struct Backend {
    choice: BackendChoice,
}

impl Backend {
    /// The backend that the painter chose.
    pub(super) fn new(choice: BackendChoice) -> Self {
        // The main thread of a page cannot wait for a device.
        Self { choice: if cfg!(target_arch = "wasm32") { BackendChoice::Cpu } else { choice } }
    }

    /// Whether a graphics device may be used.
    pub(super) fn is_device(&self) -> bool {
        self.choice != BackendChoice::Cpu
    }

    /// Uses the processor from now on.
    pub(super) fn fall_back(&mut self) {
        self.choice = BackendChoice::Cpu;
    }

    /// An engine without paint on a ground with the heights `floor`. Each engine has a device
    /// of its own. If there is no device whose memory holds the canvas, the processor is used
    /// from now on; the reason is returned if a device was chosen or present.
    pub(super) fn engine(&mut self, floor: &Field<i32>) -> (PaintEngine, Option<String>) {
        let opened = PaintEngine::open(self.choice, floor).unwrap_or_else(|error| OpenedEngine {
            engine: PaintEngine::on_cpu(floor.clone()),
            device_error: Some(error),
        });
        if opened.engine.device().is_none() {
            self.fall_back();
        }
        (opened.engine, opened.device_error.map(|error| error.to_string()))
    }
}
