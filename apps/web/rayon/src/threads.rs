//! Work that threads would share. Here it is done immediately.

use std::marker::PhantomData;

/// The number of threads: 1.
#[must_use]
pub fn current_num_threads() -> usize {
    1
}

/// Calls both functions, first `first`.
pub fn join<A, B>(first: impl FnOnce() -> A, second: impl FnOnce() -> B) -> (A, B) {
    (first(), second())
}

/// Calls `work` with a scope. The scope runs tasks immediately.
pub fn scope<'scope, R>(work: impl FnOnce(&Scope<'scope>) -> R) -> R {
    work(&Scope { tasks: PhantomData })
}

/// Calls `work` as [`scope`] does.
pub fn in_place_scope<'scope, R>(work: impl FnOnce(&Scope<'scope>) -> R) -> R {
    scope(work)
}

/// Runs tasks immediately.
#[derive(Debug)]
pub struct Scope<'scope> {
    tasks: PhantomData<&'scope ()>,
}

impl<'scope> Scope<'scope> {
    /// Runs `task` at once.
    pub fn spawn(&self, task: impl FnOnce(&Scope<'scope>) + 'scope) {
        task(self);
    }
}
