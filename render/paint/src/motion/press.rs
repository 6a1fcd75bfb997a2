//! How deep the head is in the paint, and which way it pushes it.
//!
//! Baxter, Wendt and Lin 2004, section 4.2: paint moves with half the velocity
//! of the brush, and down the slope of the penetration.

use super::Motion;
use crate::amount::FULL;
use crate::contact::Touch;

/// Cells in contact have a penetration of 0 and up; others this.
pub const APART: i32 = -1;

/// A column higher than this, some fifty cells, stays where it is, and nothing
/// flows into it: so that no column, which eight others may flow into at once,
/// ever passes [`FULL`].
pub const CROWDED: u32 = FULL / 10;

/// How far the head is below the top of the paint, in quanta; [`APART`] where
/// it does not touch. `floor` is the height of what is dry, `volume` that of
/// the wet paint upon it.
#[inline(always)]
#[must_use]
pub fn penetration(touch: Touch, floor: i32, volume: u32) -> i32 {
    let top = floor + volume as i32;
    if touch.height <= top { top - touch.height } else { APART }
}

/// The velocity of a cell's paint in 1/256 cell a sub-step, each component from
/// -256 to 256.
///
/// `here` is the cell's penetration, `slopes` the differences of penetration
/// right - left and below - above, where apart counts as 0.
#[inline(always)]
#[must_use]
pub fn velocity(motion: &Motion, touch: Touch, here: i32, slopes: (i32, i32)) -> (i32, i32) {
    let (x, y) = if here == APART { (0, 0) } else { touch.velocity() };
    let along = |brush: i32, slope: i32| (brush / 2 - slope / motion.push).clamp(-256, 256);
    (along(x, slopes.0), along(y, slopes.1))
}

/// What is left of a `velocity` near columns above [`CROWDED`]; `crowded` tells
/// of the cell so many columns to the right and rows down.
#[inline(always)]
#[must_use]
pub fn yielding(velocity: (i32, i32), crowded: impl Fn(i32, i32) -> bool) -> (i32, i32) {
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
