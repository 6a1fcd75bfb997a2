//! What a graphics device can refuse.

/// Why the device could not.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GpuError {
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
