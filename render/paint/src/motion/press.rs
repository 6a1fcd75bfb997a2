//! How deep the head is pressed into the paint, and the velocity that the head, the weight of the
//! paint and its surface tension give to it.
//!
//! In Baxter, Wendt and Lin 2004, section 4.2, paint moves with a share of the velocity of the
//! brush. Here we move only the part of a column that the head has penetrated. Paint flows from
//! high pressure to low. The pressure is the height of the surface plus the pressure of the head.
//! Away from the head, we treat paint as a Bingham fluid: it flows only where its slope exceeds its
//! yield.

use super::MotionConstants;
use crate::amount::{MAX_COLUMN, ratio_of_65536, share_of_65536};
use crate::contact::{ExchangeRates, Touch};

/// Value that stands for "no contact" among penetrations.
pub const NO_CONTACT: i32 = i32::MIN;

/// Columns higher than this, in quanta (some fifty cell widths), do not move and do not receive
/// inflow. Eight columns may flow into one at once, so this keeps every column below
/// [`MAX_COLUMN`].
pub const CROWDED_VOLUME: u32 = MAX_COLUMN / 10;

/// Velocity of one cell a sub-step.
pub const CELL_A_SUB_STEP: i32 = 1 << 14;

/// Largest velocity of flow: half a column in a sub-step.
const FASTEST_FLOW: u32 = 1 << 13;

/// Maximum thickness of the paint that bears hair, relative to the coat of the head.
const BORNE: u32 = 2;

/// Thickness in quanta of the film that a head leaves when you press it down on the ground: the
/// coat that stands out beyond its hair. `mean` is the mean volume in quanta of the cells of that
/// hair. Hair lays nothing of the paint that it keeps ([`ExchangeRates::held`]). From one and a half times that
/// on it lays its usual coat. Locks with a thick coat keep less.
#[inline(always)]
#[must_use]
pub fn coat(rates: &ExchangeRates, touch: Touch, mean: u32) -> u32 {
    let kept = (rates.held >> 5) * 64_u32.saturating_sub(touch.release()).max(12);
    let free = mean.min(3 * mean.saturating_sub(kept).min(MAX_COLUMN / 3));
    let usual = rates.film + share_of_65536(free, rates.release).min(CROWDED_VOLUME);
    (usual >> 5) * touch.release()
}

/// Penetration of the head in quanta: how far its hair is below the top of the paint, but
/// never below the floor. Negative if it is above. [`NO_CONTACT`] if not even its `coat`
/// reaches the paint. `floor` is the height of ground and dry paint, `volume` the height of
/// the wet paint on it, both in quanta. Pressed hair sinks between the crests of the ground unless
/// its coat is thick enough to bear it, so a thick film hides a weave.
///
/// A loaded head rides on a share of the paint that was there before the stroke, and lays its coat
/// on that. This paint reaches from the ground under the hair up to the height `bed` in quanta. We
/// count at most twice the thickness of the coat, or [`ExchangeRates::carried`]. A clean head has
/// neither, so it digs in. Hair is never borne higher than its coat above the paint that is there now.
#[inline(always)]
#[must_use]
pub fn penetration(
    rates: &ExchangeRates,
    touch: Touch,
    (floor, volume): (i32, u32),
    bed: i32,
    coat: u32,
) -> i32 {
    let top = floor + volume as i32;
    let sunk = lowered(touch.height, rates.sink.saturating_sub(coat));
    let ground = sunk.max(floor);
    let bearing = bed.min(raised(top, coat));
    let above = if bearing > ground { bearing.wrapping_sub(ground) as u32 } else { 0 };
    let borne = share_of_65536(above.min((BORNE * coat).max(rates.carried)), rates.bearing);
    let hair = raised(ground, borne);
    let reached = (touch.height != Touch::NONE.height) & (hair - coat as i32 <= top);
    if reached { top.wrapping_sub(hair) } else { NO_CONTACT }
}

/// `height + by`, at most the highest number, for a `by` below 2^31. Unlike the method of `i32`, it
/// is compiled to vector instructions.
#[inline(always)]
fn raised(height: i32, by: u32) -> i32 {
    let sum = height.wrapping_add(by as i32);
    if sum < height { i32::MAX } else { sum }
}

/// `height - by`, at least the lowest number, for a `by` below 2^31.
#[inline(always)]
fn lowered(height: i32, by: u32) -> i32 {
    let difference = height.wrapping_sub(by as i32);
    if difference > height { i32::MIN } else { difference }
}

/// One column of paint in the field of pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    /// Height of its surface over the plane of the canvas, in quanta.
    pub top: i32,
    /// Pressure of the head in quanta of paint, or [`NO_CONTACT`]. See [`pressure`].
    pub pressure: i32,
}

/// Pressure under a head that has penetrated `penetration` quanta, in quanta of paint: 0 where it
/// does not reach into the paint, [`NO_CONTACT`] where there is no contact.
#[inline(always)]
#[must_use]
pub fn pressure(motion: &MotionConstants, penetration: i32) -> i32 {
    let pressed = share_of_65536(penetration.max(0) as u32, motion.squeeze_share) as i32;
    if penetration == NO_CONTACT { NO_CONTACT } else { pressed }
}

/// Paint that flows from the column `here` to `next` in one sub-step, in quanta. Negative if it
/// flows back. `before` is the top of the column on the other side of `here`, `beyond` the top of
/// the column after `next`.
///
/// Three flows add up. Under the head, paint flows from high pressure to low. Where the slope
/// exceeds the yield, it flows downhill. It also flows from crests to pits that are one cell wide.
#[inline(always)]
#[must_use]
pub fn flow(motion: &MotionConstants, before: i32, here: Column, next: Column, beyond: i32) -> i32 {
    let drop = here.top - next.top;
    let pressed = here.pressure.max(next.pressure) != NO_CONTACT;
    let head = here.pressure.max(0) - next.pressure.max(0);
    // Halves, as the sum may exceed 31 bits.
    let driven = if pressed { (drop >> 1) + (head >> 1) } else { 0 };
    let driven_flow = share_of_65536(driven.unsigned_abs(), motion.push_share) as i32;
    let slides = (drop.unsigned_abs().saturating_sub(motion.yield_quanta) / 8) as i32;
    let crest = ((here.top - before) >> 1) + (drop >> 1);
    let pit = (drop >> 1) + ((beyond - next.top) >> 1);
    let kink = if (crest ^ pit) < 0 { 0 } else { crest.unsigned_abs().min(pit.unsigned_abs()) };
    let level = share_of_65536(kink, motion.levelling_share) as i32;
    with_sign_of(driven, driven_flow) + with_sign_of(drop, slides) + with_sign_of(crest, level)
}

#[inline(always)]
fn with_sign_of(sign: i32, size: i32) -> i32 {
    if sign < 0 { -size } else { size }
}

/// Velocity of a column of `volume` quanta along one axis, in 1/16384 cell a sub-step, at most a
/// cell. This is the velocity `head` that the head gives to the column (0 without contact) plus the
/// velocity of its larger outflow. `before` is the flow from the neighbour before it, `after` the
/// flow to the neighbour after it, in quanta.
#[inline(always)]
#[must_use]
pub fn velocity(head: i32, volume: u32, before: i32, after: i32) -> i32 {
    let forward = after.max(0);
    let back = (-before).max(0);
    let flow = (forward.max(back) as u32).min(volume);
    let cells = (ratio_of_65536(flow, volume) / 4).min(FASTEST_FLOW) as i32;
    let flowing = if forward >= back { cells } else { -cells };
    (head + flowing).clamp(-CELL_A_SUB_STEP, CELL_A_SUB_STEP)
}

/// Velocity in 1/16384 cell a sub-step, along x and y, that a head gives to a column of `volume`
/// quanta. The deeper the head has penetrated the column, the larger the share of its own velocity
/// that it gives.
#[inline(always)]
#[must_use]
pub fn dragged(rates: &ExchangeRates, touch: Touch, penetration: i32, volume: u32) -> (i32, i32) {
    let depth = (penetration.max(0) as u32).saturating_sub(rates.film);
    let part = ratio_of_65536(depth.min(volume), volume) >> 8;
    let immersed = if depth < volume { part } else { 256 };
    let share = (immersed * rates.drag) as i32;
    let (x, y) = touch.velocity();
    (x * share / 1024, y * share / 1024)
}

/// Removes the components of `velocity` that would move a column above [`CROWDED_VOLUME`] or move
/// paint into one. `crowded(dx, dy)` tells us whether the column `dx` cells to the right and `dy`
/// cells down is such a column.
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

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::amount::QUANTA_PER_CELL;

    const CELL: i32 = QUANTA_PER_CELL as i32;

    /// Flow between the middle two of four tops, away from the head.
    fn alone([before, here, next, beyond]: [i32; 4], motion: &MotionConstants) -> i32 {
        flow(motion, before, free_column(here), free_column(next), beyond)
    }

    #[test]
    fn what_flows_to_the_next_column_comes_from_the_one_before() {
        let random = &mut ChaCha8Rng::seed_from_u64(1);
        let motion = MotionConstants::new(0.1, 0.3);
        for _ in 0..10_000 {
            let tops: [i32; 4] = std::array::from_fn(|_| random.random_range(0..8 * CELL));
            let [here, next] = [tops[1], tops[2]].map(|top| {
                let penetration = random.random_range(-CELL..top.max(1));
                let penetration = [penetration, NO_CONTACT][random.random_range(0..2)];
                Column { top, pressure: pressure(&motion, penetration) }
            });
            let there = flow(&motion, tops[0], here, next, tops[3]);
            let back = flow(&motion, tops[3], next, here, tops[0]);
            // Halves and shares are rounded.
            assert!((there + back).abs() <= 2, "{there}, {back}: {tops:?}");
        }
    }

    fn free_column(top: i32) -> Column {
        Column { top, pressure: NO_CONTACT }
    }

    #[test]
    fn teeth_of_a_cell_are_levelled_and_a_straight_slope_stays() {
        let motion = MotionConstants { levelling_share: 4096, ..MotionConstants::new(0.1, 1.0) };
        assert_eq!(alone([0, CELL, 0, CELL], &motion), CELL / 16);
        assert_eq!(alone([CELL, 0, CELL, 0], &motion), -CELL / 16);
        assert_eq!(alone([3 * CELL, 2 * CELL, CELL, 0], &motion), 0);
        assert_eq!(alone([CELL, CELL, 0, 0], &motion), CELL / 32, "the rim of a step");
    }

    #[test]
    fn paint_bears_slopes_up_to_its_yield() {
        let motion = MotionConstants::new(0.1, 0.5);
        let bears = motion.yield_quanta as i32;
        for (drop, flows) in [(bears / 2, 0), (bears, 0), (bears + 800, 100)] {
            assert_eq!(alone([3 * drop, 2 * drop, drop, 0], &motion), flows, "{drop}");
            assert_eq!(alone([0, drop, 2 * drop, 3 * drop], &motion), -flows, "{drop}");
        }
    }

    #[test]
    fn under_the_head_paint_flows_below_its_yield_to_where_the_head_is_less_deep() {
        let motion = MotionConstants::new(0.1, 1.0);
        let out = flow(&motion, CELL, pressed_column(CELL / 2), pressed_column(0), CELL);
        assert!(out > 0, "{out}");
        assert_eq!(
            flow(&motion, CELL, pressed_column(CELL / 2), pressed_column(CELL / 2), CELL),
            0
        );
    }

    #[test]
    fn sums_stop_at_the_highest_and_the_lowest_number() {
        for height in [i32::MIN, i32::MIN + 5, -1, 0, 7, i32::MAX - 5, i32::MAX] {
            for by in [0, 1, 5, 6, 1 << 30, i32::MAX as u32] {
                assert_eq!(raised(height, by), height.saturating_add_unsigned(by));
                assert_eq!(lowered(height, by), height.saturating_sub_unsigned(by));
            }
        }
    }

    fn pressed_column(pressure: i32) -> Column {
        Column { top: CELL, pressure }
    }

    /// Coat of hair with the release `release` and a mean of `mean` quanta, of which it keeps about 3200.
    fn coat_of(release: u32, mean: u32) -> u32 {
        let rates = ExchangeRates { release: 32768, held: 3200, ..ExchangeRates::default() };
        let mut touch = Touch::new(0, 0, (0, 0), 0, 1);
        touch.set_release(release);
        coat(&rates, touch, mean)
    }

    #[test]
    fn hair_with_little_paint_keeps_it() {
        assert_eq!(coat_of(32, 3200), 0, "all of it is kept");
        assert_eq!(coat_of(32, 3840), 960, "half of three times what is free");
        assert_eq!(coat_of(32, 12_800), 6400, "plenty");
        assert!(coat_of(48, 3200) > 0, "a lock with a thick coat keeps less");
        assert_eq!(coat_of(16, 4700), 0, "a lock with a thin coat keeps more");
    }

    #[test]
    fn a_loaded_blade_rides_higher_than_its_coat() {
        let rates = ExchangeRates { bearing: 65536, carried: 1500, ..ExchangeRates::default() };
        let touch = Touch::new(0, 0, (0, 0), 0, 1);
        // On the paint that was there, and no higher than its bank carries it.
        for (bed, wanted) in [(900, 1200), (2100, 500)] {
            assert_eq!(penetration(&rates, touch, (100, 2000), bed, 200), wanted, "{bed}");
        }
    }

    #[test]
    fn a_loaded_head_rides_on_paint_from_before_the_stroke() {
        let rates = ExchangeRates { bearing: 32768, ..ExchangeRates::default() };
        let touch = Touch::new(0, 0, (0, 0), 0, 1);
        let found =
            |volume: u32, bed: i32, coat: u32| penetration(&rates, touch, (100, volume), bed, coat);
        assert_eq!(found(300, 100, 200), 300, "none was there");
        assert_eq!(found(300, 300, 200), 200, "half of it bears");
        assert_eq!(found(0, 500, 200), -100, "all of it was taken up");
        assert_eq!(found(2000, 2100, 200), 1800, "no more than the coat can ride on");
        assert_eq!(found(300, 300, 0), 300, "clean hair digs in");
    }

    #[test]
    fn hair_sinks_to_the_floor_unless_its_coat_bears_it() {
        let rates = ExchangeRates { sink: 1000, ..ExchangeRates::default() };
        let touch = Touch::new(5000, 0, (0, 0), 0, 1);
        let found = |floor: i32, volume: u32, coat: u32| {
            penetration(&rates, touch, (floor, volume), floor, coat)
        };
        assert_eq!(found(4000, 0, 0), 0, "on a floor that it just reaches");
        assert_eq!(found(3900, 300, 0), 200, "above a floor that it does not reach");
        assert_eq!(found(4500, 300, 0), 300, "never below the floor");
        assert_eq!(found(3900, 300, 600), -400, "on a coat that bears it");
        assert_eq!(found(3900, 0, 0), NO_CONTACT, "above the paint");
        assert_eq!(
            penetration(&rates, Touch::NONE, (4000, 300), 4000, 600),
            NO_CONTACT,
            "where the head is not"
        );
    }
}
