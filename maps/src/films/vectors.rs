//! Arithmetic by the widest vectors of the processor.

use pulp::{Arch, Simd, WithSimd};

/// Arithmetic that is inlined as a whole, so that it is compiled for each kind of processor.
pub(crate) trait Task {
    type Result;

    /// Does it; always inlined.
    fn run(self) -> Self::Result;
}

struct Dispatched<T>(T);

impl<T: Task> WithSimd for Dispatched<T> {
    type Output = T::Result;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> T::Result {
        self.0.run()
    }
}

/// Runs `task` with the vectors of this processor. Nothing is fused, so that all processors give the same
/// bits.
#[inline(always)]
pub(crate) fn by_vectors<T: Task>(task: T) -> T::Result {
    Arch::new().dispatch(Dispatched(task))
}
