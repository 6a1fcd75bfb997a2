//! Work that would be shared by threads: done here, at once.

use std::marker::PhantomData;

/// The number of threads: 1.
#[must_use]
pub fn current_num_threads() -> usize {
    1
}

/// Calls both, the first one first.
pub fn join<A, B>(first: impl FnOnce() -> A, second: impl FnOnce() -> B) -> (A, B) {
    (first(), second())
}

/// Calls `work` with a scope whose tasks run when they are given.
pub fn scope<'scope, R>(work: impl FnOnce(&Scope<'scope>) -> R) -> R {
    work(&Scope { tasks: PhantomData })
}

/// Calls `work` as [`scope`] does.
pub fn in_place_scope<'scope, R>(work: impl FnOnce(&Scope<'scope>) -> R) -> R {
    scope(work)
}

/// Runs tasks when they are given.
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
