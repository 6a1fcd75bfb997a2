//! Where all paint is.

use paint::layer::SLOTS;

/// Amounts of paint in quanta, of eight slots and at last of vehicle. At every time `poured` is
/// the sum of `on_scene` and `lifted`, to the quantum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Tally {
    /// Paint that has come out of tubes, or with single volumes.
    pub poured: [u64; SLOTS + 1],
    /// Paint of all volumes, dry or not.
    pub on_scene: [u64; SLOTS + 1],
    /// Paint in sponges.
    pub lifted: [u64; SLOTS + 1],
    /// Paint that stayed in the tube, as there was no room for it.
    pub in_tube: [u64; SLOTS + 1],
}

/// Adds amounts.
pub(super) fn add(sums: &mut [u64; SLOTS + 1], amounts: [u64; SLOTS + 1]) {
    for (sum, amount) in sums.iter_mut().zip(amounts) {
        *sum += amount;
    }
}
