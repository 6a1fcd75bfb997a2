//! What computes the paintings: the processor or a graphics device.

use render::field::Field;
use render::gpu::{BackendChoice, choose};
use render::paint::Engine;
use render::paint::on_cpu::OnCpu;
use render::paint::on_gpu::OnGpu;

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
    pub(super) fn engine(&mut self, floor: &Field<i32>) -> (Box<dyn Engine>, Option<String>) {
        let reason = match choose(self.choice) {
            Ok(Some(device)) => match OnGpu::new(device, floor) {
                Ok(engine) => return (Box::new(engine), None),
                Err(error) => Some(error.to_string()),
            },
            Ok(None) => None,
            Err(error) => Some(error.to_string()),
        };
        self.fall_back();
        (Box::new(OnCpu::new(floor.clone())), reason)
    }
}
