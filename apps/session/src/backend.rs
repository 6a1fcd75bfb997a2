//! Choice of the backend: the processor or a graphics device.

use graphics::field::Field;
use graphics::gpu::BackendChoice;
use paint::engine::{OpenedEngine, PaintEngine};

#[derive(Debug)]
pub(super) struct Backend {
    choice: BackendChoice,
}

impl Backend {
    pub(super) fn new(choice: BackendChoice) -> Self {
        // The main thread of a page must not block, so it cannot wait for a device.
        Self { choice: if cfg!(target_arch = "wasm32") { BackendChoice::Cpu } else { choice } }
    }

    /// Whether a graphics device may be used.
    pub(super) fn is_device(&self) -> bool {
        self.choice != BackendChoice::Cpu
    }

    pub(super) fn fall_back(&mut self) {
        self.choice = BackendChoice::Cpu;
    }

    /// An engine without paint on a ground with the heights `floor`. Each engine has a device of
    /// its own. If no device has enough memory for the canvas, this uses the processor from now on.
    /// If a device was chosen or is present, but this uses the processor, you also get the reason.
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
