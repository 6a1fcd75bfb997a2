//! The request to end long work before its time.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::hint::{Explain, Fault, Hint};

/// A request to end long work, which that work looks for. Clones share one request, which any thread may
/// make and which stays made.
///
/// ```
/// use documents::Cancellation;
///
/// let cancellation = Cancellation::default();
/// let work = cancellation.clone();
/// assert!(work.check().is_ok());
/// cancellation.cancel();
/// assert!(work.check().is_err());
/// ```
#[derive(Debug, Clone, Default)]
pub struct Cancellation(Arc<AtomicBool>);

impl Cancellation {
    /// Asks the work to end soon.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the work was asked to end.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Ends a function by `?` once the work was asked to end.
    ///
    /// # Errors
    /// [`Cancelled`] from the first [`Self::cancel`] on.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }
}

/// The end of work that was asked to end before its time. It has no result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the work was cancelled before its end")]
pub struct Cancelled;

impl Explain for Cancelled {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new("start it again: nothing of it was kept"))
    }

    fn fault(&self) -> Fault {
        Fault::Environment
    }
}
