//! How deep the head is pressed into the paint, and the velocity that it gives to the
//! paint.
//!
//! Baxter, Wendt and Lin 2004, section 4.2: paint moves with half the velocity of the
//! brush, and down the gradient of the penetration.

use super::constants::MotionConstants;
use crate::amount::MAX_COLUMN;
use crate::contact::Touch;

/// Value that stands for "no contact" among penetrations, which are 0 and up.
pub const NO_CONTACT: i32 = -1;

/// Columns higher than this, in quanta (some fifty cell widths), do not move and receive
/// no inflow. Eight columns may flow into one at once, so this keeps every column below
/// [`MAX_COLUMN`].
pub const CROWDED_VOLUME: u32 = MAX_COLUMN / 10;

/// Penetration of the head: how far it is below the top of the paint, in quanta, or
/// [`NO_CONTACT`]. `floor` is the height of ground and dry paint, `volume` that of the
/// wet paint on it, both in quanta.
#[inline(always)]
#[must_use]
pub fn penetration(touch: Touch, floor: i32, volume: u32) -> i32 {
    let top = floor + volume as i32;
    if touch.height <= top { top - touch.height } else { NO_CONTACT }
}

/// Velocity of a cell's paint along x and y in 1/256 cell a sub-step, each component from
/// -256 to 256.
///
/// `penetration` is that of the cell; `slopes` are the differences of penetration between
/// the right and left and the lower and upper neighbours, where no contact counts as 0.
#[inline(always)]
#[must_use]
pub fn velocity(
    motion: &MotionConstants,
    touch: Touch,
    penetration: i32,
    slopes: (i32, i32),
) -> (i32, i32) {
    let (x, y) = if penetration == NO_CONTACT { (0, 0) } else { touch.velocity() };
    let along = |brush: i32, slope: i32| (brush / 2 - slope / motion.push_quanta).clamp(-256, 256);
    (along(x, slopes.0), along(y, slopes.1))
}

/// Removes the components of `velocity` that would move a column above
/// [`CROWDED_VOLUME`] or move paint into one. `crowded(dx, dy)` says whether the column
/// `dx` cells to the right and `dy` cells down is such a column.
#[inline(always)]
#[must_use]
pub fn avoid_crowded_columns(
    velocity: (i32, i32),
    crowded: impl Fn(i32, i32) -> bool,
) -> (i32, i32) {
    let (mut x, mut y) = velocity;
    if crowded(0, 0) {
        return (0, 0);
    }
    if x != 0 && crowded(x.signum(), 0) {
        x = 0;
    }
    if y != 0 && crowded(0, y.signum()) {
        y = 0;
    }
    if x != 0 && y != 0 && crowded(x.signum(), y.signum()) {
        y = 0;
    }
    (x, y)
}
