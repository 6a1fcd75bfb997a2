//! Progress and cancellation of a search that runs on other threads.

use std::sync::atomic::{AtomicUsize, Ordering};

use documents::Cancellation;

/// Progress of a running search for recipes, and the request to cancel it. Shared between threads.
#[derive(Debug, Default)]
pub struct SearchControl {
    done: AtomicUsize,
    total: AtomicUsize,
    cancellation: Cancellation,
}

impl SearchControl {
    /// The control of a search that `cancellation` may end.
    #[must_use]
    pub fn until(cancellation: Cancellation) -> Self {
        Self { cancellation, ..Self::default() }
    }

    /// Asks the search to end soon: each thread finishes its current recipe.
    pub fn cancel(&self) {
        self.cancellation.cancel();
    }

    /// Whether the search was asked to end.
    #[must_use]
    pub fn cancelled(&self) -> bool {
        self.cancellation.is_cancelled()
    }

    /// Fraction of the sets of pigments that have been tried, 0 to 1.
    #[must_use]
    pub fn progress(&self) -> f64 {
        let total = self.total.load(Ordering::Relaxed);
        if total == 0 {
            0.0
        } else {
            (self.done.load(Ordering::Relaxed) as f64 / total as f64).min(1.0)
        }
    }

    /// Sets the number of steps of the whole search.
    pub(super) fn set_total(&self, steps: usize) {
        self.total.store(steps, Ordering::Relaxed);
    }

    /// Counts one step as done.
    pub(super) fn step(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }
}
