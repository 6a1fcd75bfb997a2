//! The choice between the processor and a graphics device.

use std::path::Path;

use super::adapter::{BackendChoice, adapters, best};
use super::device::Device;
use super::error::DeviceError;

/// Whether the system may have graphics hardware. Linux has a device node for it; without
/// one no driver is loaded, since some drivers print to the terminal.
fn hardware_is_possible() -> bool {
    const NODES: [&str; 5] = ["/dev/dri", "/dev/nvidiactl", "/dev/dxg", "/dev/kfd", "/dev/mali0"];
    !cfg!(target_os = "linux") || NODES.iter().any(|node| Path::new(node).exists())
}

/// Opens the device that `choice` selects. `None` means the processor.
///
/// # Errors
/// Only for [`BackendChoice::Gpu`]: [`DeviceError::NoAdapter`] if there is no usable adapter,
/// or the driver's error if it cannot be opened. `Auto` then selects the processor.
pub fn choose(choice: BackendChoice) -> Result<Option<Device>, DeviceError> {
    let skipped = match choice {
        BackendChoice::Auto => !hardware_is_possible(),
        BackendChoice::Cpu => true,
        BackendChoice::Gpu => false,
    };
    if skipped {
        return Ok(None);
    }
    let adapters = adapters();
    let opened = best(&adapters, choice).map(Device::open).transpose();
    match (choice, opened) {
        (BackendChoice::Gpu, Ok(None)) => {
            let unfit = adapters.first().and_then(|adapter| adapter.unfit.clone());
            let reason = unfit.unwrap_or_else(|| "no driver offers one".to_owned());
            Err(DeviceError::NoAdapter { reason })
        }
        (BackendChoice::Gpu, opened) => opened,
        (_, opened) => Ok(opened.ok().flatten()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_processor_needs_no_adapter() {
        assert!(matches!(choose(BackendChoice::Cpu), Ok(None)));
    }
}
