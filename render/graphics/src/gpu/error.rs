//! Why a graphics device failed.

use spectra::hint::{Explain, Fault, Hint};

/// Why a graphics device failed. The processor never fails so.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DeviceError {
    /// None that computes.
    #[error("no graphics adapter: {reason}")]
    NoAdapter {
        /// Why not.
        reason: String,
    },
    /// The device went away, with all that was on it.
    #[error("the graphics device was lost: {reason}")]
    Lost {
        /// As the driver tells it.
        reason: String,
    },
    /// One buffer beyond the adapter's limit.
    #[error("{what} takes {bytes} bytes, the device lends {limit}")]
    TooLarge {
        /// What was to be kept.
        what: &'static str,
        /// What it takes.
        bytes: u64,
        /// What one buffer may take.
        limit: u64,
    },
    /// Within the limits, but there is no such memory left.
    #[error("{what} takes {bytes} bytes, more than the device has left")]
    OutOfMemory {
        /// What was to be kept.
        what: &'static str,
        /// What it takes.
        bytes: u64,
    },
    /// The driver does not take what we gave it.
    #[error("the graphics driver refuses {what}: {reason}")]
    Refused {
        /// A kernel, a buffer or a submission.
        what: String,
        /// As the driver tells it.
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
