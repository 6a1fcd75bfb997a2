//! Flow of paint along the hair of a head, from cells with more to cells with less.
//!
//! A hair is a column of cells and the column opposite to it, on the other side of the head. Hairs
//! level alone or in groups of neighbours. If a cell has more than its group's mean, it gives a
//! share of the surplus to a pot. We divide this pot among the cells below the mean in proportion
//! to their lack. So a head feeds its tip from its belly, and a level hair does not mix. The coat
//! follows the mean of each group, not the cell that touches: this cell empties between two flows,
//! and you would see that in the film.

use crate::amount::{ratio_of_65536, share_of_65536};

/// We sum volumes in units of 2^10 quanta, so that sums fit into 32 bits. This is the exponent.
pub const UNIT_BITS: u32 = 10;

/// Mean volume in units of a column of `count` cells whose volumes sum to `sum` units.
#[inline(always)]
#[must_use]
pub fn mean(sum: u32, count: u32) -> u32 {
    sum / count.max(1)
}

/// Most units that a pot holds, so that its quanta fit into 32 bits.
const POT_UNITS: u32 = 1 << 21;

/// Share of each surplus that goes to the pot of a group whose cells lack `lacks` units, in parts
/// of 65536: `wicking`, or less if the pot could not hold it.
#[inline(always)]
#[must_use]
pub fn flowing(wicking: u32, lacks: u32) -> u32 {
    // A group has about as much surplus as it lacks.
    wicking.min(ratio_of_65536(POT_UNITS, lacks.max(POT_UNITS)))
}

/// Share of a cell of `volume` quanta that goes to the pot, in parts of 65536. `mean` is in
/// units, `flowing` the share of the surplus in parts of 65536.
#[inline(always)]
#[must_use]
pub fn given_share(volume: u32, mean: u32, flowing: u32) -> u32 {
    let surplus = volume.saturating_sub(mean << UNIT_BITS);
    ratio_of_65536(share_of_65536(surplus, flowing), volume)
}

/// Units that a cell of `volume` quanta lacks of `mean` units.
#[inline(always)]
#[must_use]
pub fn lack(volume: u32, mean: u32) -> u32 {
    mean.saturating_sub(volume >> UNIT_BITS)
}

/// Share of the pot, in parts of 65536, for a cell that lacks `lack` of the `lacks` units that all
/// cells of its group lack. The last of these cells gets the rest of the pot instead.
#[inline(always)]
#[must_use]
pub fn dealt_share(lack: u32, lacks: u32) -> u32 {
    ratio_of_65536(lack, lacks)
}
