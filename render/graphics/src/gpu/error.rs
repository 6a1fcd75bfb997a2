//! Why a graphics device failed.

use documents::hint::{Explain, Fault, Hint};

/// A graphics device failed. Computation on the processor never returns this.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DeviceError {
    /// No adapter can be used.
    #[error("no graphics adapter: {reason}")]
    NoAdapter {
        /// The reason, one line.
        reason: String,
    },
    /// The device was lost, with all its memory.
    #[error("the graphics device was lost: {reason}")]
    Lost {
        /// Message of the driver.
        reason: String,
    },
    /// A buffer is larger than the adapter allows.
    #[error("{what} takes {bytes} bytes, the device lends {limit}")]
    TooLarge {
        /// Description of the content.
        what: &'static str,
        /// Size of the content in bytes.
        bytes: u64,
        /// Largest size of a buffer in bytes.
        limit: u64,
    },
    /// The device has too little free memory.
    #[error("{what} takes {bytes} bytes, more than the device has left")]
    OutOfMemory {
        /// Description of the content.
        what: &'static str,
        /// Size of the content in bytes.
        bytes: u64,
    },
    /// The driver rejected a shader, a buffer or a command.
    #[error("the graphics driver refuses {what}: {reason}")]
    Refused {
        /// Description of what was rejected.
        what: String,
        /// Message of the driver.
        reason: String,
    },
}

impl Explain for DeviceError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new("paint on the processor: [backend=cpu]"))
    }

    fn fault(&self) -> Fault {
        Fault::Environment
    }
}
