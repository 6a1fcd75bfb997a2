//! Looking at a search while it runs, and stopping it.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// How far a search for recipes is, told to other threads, and their wish that it
/// should stop.
#[derive(Debug, Default)]
pub struct Watch {
    done: AtomicUsize,
    of: AtomicUsize,
    stopped: AtomicBool,
}

impl Watch {
    /// Ends the search soon: each thread finishes the recipe that it is at.
    pub fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
    }

    /// Whether the search was told to stop.
    #[must_use]
    pub fn stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    /// The share of the sets of pigments that have been tried, 0..1.
    #[must_use]
    pub fn share(&self) -> f64 {
        let of = self.of.load(Ordering::Relaxed);
        if of == 0 { 0.0 } else { (self.done.load(Ordering::Relaxed) as f64 / of as f64).min(1.0) }
    }

    /// So many things are to be done in all.
    pub(super) fn expect(&self, things: usize) {
        self.of.store(things, Ordering::Relaxed);
    }

    /// One of them is done.
    pub(super) fn step(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }
}
