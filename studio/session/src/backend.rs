//! What computes the paintings: the processor or a graphics device.

use render::field::Field;
use render::gpu::BackendChoice;
use render::paint::engine::{OpenedEngine, PaintEngine};

/// Where to compute.
#[derive(Debug)]
pub(super) struct Backend {
    choice: BackendChoice,
}

impl Backend {
    /// As the painter asks.
    pub(super) fn new(choice: BackendChoice) -> Self {
        Self { choice }
    }

    /// Whether a device may compute.
    pub(super) fn is_device(&self) -> bool {
        self.choice != BackendChoice::Cpu
    }

    /// Computes on the processor from now on.
    pub(super) fn fall_back(&mut self) {
        self.choice = BackendChoice::Cpu;
    }

    /// An engine over the ground `floor`, without paint. Each has a device of its
    /// own. Where there is none, or none that holds the canvas, the processor
    /// paints from now on, and why comes with it if a device was asked for or
    /// there.
    pub(super) fn engine(&mut self, floor: &Field<i32>) -> (PaintEngine, Option<String>) {
        let opened = PaintEngine::open(self.choice, floor).unwrap_or_else(|error| OpenedEngine {
            engine: PaintEngine::on_cpu(floor.clone()),
            gave_way: Some(error),
        });
        if opened.engine.device().is_none() {
            self.fall_back();
        }
        (opened.engine, opened.gave_way.map(|error| error.to_string()))
    }
}
