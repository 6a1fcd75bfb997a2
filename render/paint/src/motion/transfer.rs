//! Transfer of paint between a cell of the canvas and the cell of the head above it.
//!
//! The head lays paint until the film under it is as thick as its coat, and takes paint up where
//! the film is thicker. Besides, both sides exchange equal amounts in proportion to the part that
//! touches. So colours blend, and a brush gets dirty (Chu, Baxter, Wei and Govindaraju 2010,
//! section 4). Of the paint on the canvas, only the height that the head has penetrated counts.
//! Where several cells of the canvas lie under one cell of the head, each may take an equal share
//! of the head's paint, or of the room that it has below [`MAX_COLUMN`].
//!
//! In a sub-step a head takes at most half of the paint that it has penetrated. If it does not mix,
//! for example a blade that only scrapes, it may take all of it.

use crate::amount::{MAX_COLUMN, quotient, ratio_of_65536, share_of_256, share_of_65536};
use crate::contact::{ExchangeRates, Touch};
use graphics::tile::Rect;

/// The transfer between one cell of the canvas and the head's cell above it, as shares of the
/// whole cells in parts of 65536.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Exchange {
    /// Share of the head's cell that goes to the canvas.
    pub down: u32,
    /// Shares of the canvas's body and of its skin that go to the head.
    pub up: [u32; 2],
}

/// Computes the transfer of one sub-step.
///
/// `penetration` (nothing moves at [`NO_CONTACT`](super::press::NO_CONTACT)) and `coat` are the
/// values at the start of the sub-step, in quanta. `body`, `skin` and `brush_volume` are the heights in
/// quanta of the two films of the canvas's cell and of the paint in the head's cell, as they are now.
/// The head takes paint from the skin first. `leaving` is the velocity of the head over the edge of the
/// canvas, in 1/256 cell a sub-step. Paint that would leave the canvas at half of this velocity goes
/// onto the head.
#[inline(always)]
#[must_use]
pub fn exchange(
    rates: &ExchangeRates,
    touch: Touch,
    penetration: i32,
    coat: u32,
    [body, skin]: [u32; 2],
    brush_volume: u32,
    leaving: u32,
) -> Exchange {
    let canvas_volume = body + skin;
    // Where there is no contact, no part of the coat touches.
    let penetration = penetration.max(-(coat as i32));
    let canvas = canvas_volume.min(penetration.max(0) as u32);
    let sharers = touch.sharers().max(1);
    let brush = quotient(brush_volume, sharers);
    let room = quotient(MAX_COLUMN.saturating_sub(brush_volume), sharers);
    let missing = coat as i32 - penetration;
    let laid = share_of_65536(missing.max(0) as u32, rates.deposit);
    let taken = share_of_65536((-missing).max(0) as u32, rates.pick_up);
    let mixed = share_of_65536(canvas.min(brush), rates.mixing);
    // Where the hair is above the paint, only a part of the coat touches.
    let near = quotient((coat as i32 + penetration.min(0)) as u32, (coat >> 8).max(1));
    let touching = if penetration < 0 { near.min(256) } else { 256 };
    let weight = share_of_256(touch.transfer_weight(), touching);
    let down = share_of_256(laid + mixed, weight).min(brush / 2);
    let up = share_of_256(taken + mixed, weight) + share_of_256(canvas, leaving / 2);
    let most = if rates.mixing == 0 { canvas } else { canvas / 2 };
    let up = up.min(most).min(room);
    let from_skin = up.min(skin);
    Exchange {
        down: ratio_of_65536(down, brush_volume),
        up: [ratio_of_65536(up - from_skin, body), ratio_of_65536(from_skin, skin)],
    }
}

/// Velocity in 1/256 cell of the head above the cell `(x, y)` over an edge of the canvas `bounds`.
/// 0 away from the edges.
#[inline(always)]
#[must_use]
pub fn leaving(touch: Touch, (x, y): (usize, usize), bounds: Rect) -> u32 {
    let (right, down) = touch.velocity();
    let mut leaving = 0;
    leaving = if x == 0 { leaving.max(-right) } else { leaving };
    leaving = if x + 1 == bounds.width { leaving.max(right) } else { leaving };
    leaving = if y == 0 { leaving.max(-down) } else { leaving };
    leaving = if y + 1 == bounds.height { leaving.max(down) } else { leaving };
    leaving.min(256) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOUCH: Touch = Touch { height: 0, brush_cell: 0, velocity: 0, weights: 256 | 1 << 16 };

    /// Film on a flat ground after 60 sub-steps that start with `film`, and the paint that the head
    /// has gained. All in quanta. The head's coat is `coat` quanta thick and does not change.
    fn painted(rates: &ExchangeRates, coat: u32, film: u32) -> (u32, i64) {
        let mut canvas = film;
        let mut brush = 50_000_000_u32;
        for _ in 0..60 {
            let Exchange { down, up } =
                exchange(rates, TOUCH, canvas as i32, coat, [canvas, 0], brush, 0);
            let laid = share_of_65536(brush, down);
            let taken = share_of_65536(canvas, up[0]);
            (canvas, brush) = (canvas - taken + laid, brush - laid + taken);
        }
        (canvas, i64::from(brush) - 50_000_000)
    }

    #[test]
    fn a_film_becomes_as_thick_as_the_coat() {
        let rates = ExchangeRates { deposit: 20_000, pick_up: 9000, ..ExchangeRates::default() };
        for film in [0, 70_000, 300_000, 2_000_000] {
            let (after, won) = painted(&rates, 300_000, film);
            assert!(after.abs_diff(300_000) < 3000, "{film}: {after}");
            assert_eq!(i64::from(after) + won, i64::from(film));
        }
    }

    #[test]
    fn a_head_without_a_coat_takes_all_and_lays_nothing() {
        let rates = ExchangeRates { deposit: 65536, pick_up: 20_000, ..ExchangeRates::default() };
        let (after, won) = painted(&rates, 0, 1_000_000);
        assert!(after < 100, "{after}");
        assert_eq!(i64::from(after) + won, 1_000_000);
    }

    #[test]
    fn both_sides_mix_in_equal_amounts() {
        let rates = ExchangeRates { mixing: 6000, ..ExchangeRates::default() };
        for (canvas, brush) in [(400_000, 3_000_000), (400_000, 500_000), (900_000, 70_000)] {
            let found = exchange(&rates, TOUCH, canvas as i32, canvas, [canvas, 0], brush, 0);
            let moved = share_of_65536(canvas.min(brush), 6000);
            for (whole, share) in [(brush, found.down), (canvas, found.up[0])] {
                let part = share_of_65536(whole, share);
                // A share is rounded down to 1/65536 of the whole.
                let near = moved.abs_diff(part) <= whole / 65536 + moved / 32768 + 1;
                assert!(near && part > 0, "{part} of {whole}, not {moved}");
            }
        }
    }

    #[test]
    fn a_head_takes_the_skin_first() {
        let rates = ExchangeRates { pick_up: 65536, ..ExchangeRates::default() };
        let taken = |body: u32, skin: u32| {
            let found = exchange(&rates, TOUCH, 500_000, 0, [body, skin], 0, 0);
            [share_of_65536(body, found.up[0]), share_of_65536(skin, found.up[1])]
        };
        let [below, above] = taken(900_000, 700_000);
        assert!(below == 0 && above.abs_diff(500_000) < 100, "{below} {above}");
        let [below, above] = taken(900_000, 200_000);
        assert!(below.abs_diff(300_000) < 100, "{below}");
        assert!(above.abs_diff(200_000) < 100, "{above}");
    }

    #[test]
    fn a_full_head_takes_no_more() {
        let rates = ExchangeRates { pick_up: 65536, ..ExchangeRates::default() };
        let shared = Touch { weights: 256 | 3 << 16, ..TOUCH };
        let canvas = 80_000_000;
        let room = 30_000_000;
        assert_eq!(
            exchange(&rates, shared, canvas as i32, 0, [canvas, 0], MAX_COLUMN, 256).up,
            [0; 2]
        );
        let taken = share_of_65536(
            canvas,
            exchange(&rates, shared, canvas as i32, 0, [canvas, 0], MAX_COLUMN - room, 256).up[0],
        );
        assert!(taken <= room / 3 && taken + 10_000 > room / 3, "{taken} of a third of {room}");
    }

    #[test]
    fn paint_leaves_only_over_the_edge_that_the_head_drags_it_to() {
        let bounds = Rect { x: 0, y: 0, width: 5, height: 4 };
        let at = |velocity: (i16, i16), place: (usize, usize)| {
            leaving(Touch::new(0, 0, velocity, 0, 1), place, bounds)
        };
        for (velocity, edge, opposite) in [
            ((-90, 0), (0, 2), (4, 2)),
            ((90, 0), (4, 2), (0, 2)),
            ((0, -90), (2, 0), (2, 3)),
            ((0, 90), (2, 3), (2, 0)),
        ] {
            assert_eq!(at(velocity, edge), 90, "{velocity:?}");
            assert_eq!(at(velocity, opposite), 0, "{velocity:?}");
            assert_eq!(at(velocity, (2, 2)), 0, "{velocity:?}");
        }
        assert_eq!(at((300, -120), (4, 0)), 256, "at a corner");
    }
}
