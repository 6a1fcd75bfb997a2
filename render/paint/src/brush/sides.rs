//! The sides of a stroke: lips, and cells that are under the head in part.
//!
//! A pressed head squeezes paint to its sides, where it stands up as a lip. The flow takes place
//! between the hairs, below the size of a cell, so it is not computed: the coat is thicker near
//! the sides of the contact.
//!
//! A side that crosses the rows of cells at a small angle takes one cell after another. Over the
//! last cell, the velocity therefore falls to 0; else the paint that is dragged along would be left
//! as a bead in each cell that the side leaves.

use std::ops::Range;

use crate::contact::{Contact, Touch};
use graphics::lanes::{greater, lesser};

/// Increase of the coat at the sides (chosen by measured lips).
const THICKER: f32 = 1.1;

/// Distance from a side in mm over which the coat falls to its usual thickness.
const REACH_MM: f32 = 0.7;

/// Share of a change of the sides that is followed in a sub-step, so that the sides do not
/// jump from cell to cell.
const FOLLOWED: f32 = 0.2;

/// Where the sides of the contact are, seen from the pen.
#[derive(Debug, Clone, Default)]
pub(super) struct Sides {
    /// Lowest and highest distance in cells across the stroke; `None` before its first contact.
    extent: Option<(f32, f32)>,
}

/// Extent of a contact across the stroke, in cells from the pen.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    pen: (f32, f32),
    across: (f32, f32),
    low: f32,
    high: f32,
}

impl Extent {
    /// An empty extent around `pen`, which moved by `moved` cells; `None` if it hardly moved.
    pub(super) fn new(pen: (f32, f32), (x, y): (f32, f32)) -> Option<Self> {
        let length = libm::hypotf(x, y);
        let across = (-y / length, x / length);
        (length >= 0.2).then_some(Self { pen, across, low: f32::INFINITY, high: f32::NEG_INFINITY })
    }

    #[inline(always)]
    fn at(&self, x: f32, y: f32) -> f32 {
        (x - self.pen.0) * self.across.0 + (y - self.pen.1) * self.across.1
    }

    /// Extends it to a point of the head that touches.
    #[inline(always)]
    pub(super) fn include(&mut self, x: f32, y: f32) {
        let at = self.at(x, y);
        self.low = lesser(at, self.low);
        self.high = greater(at, self.high);
    }
}

impl Sides {
    /// Ends a stroke.
    pub(super) fn lift(&mut self) {
        self.extent = None;
    }

    /// Follows the extent `now` of a contact. Returns where its sides are; `None` if the head hardly
    /// moved or does not touch.
    pub(super) fn follow(&mut self, now: Option<Extent>) -> Option<Border> {
        let now = now.filter(|now| now.low <= now.high)?;
        let (before_low, before_high) = self.extent.unwrap_or((now.low, now.high));
        let low = before_low + (now.low - before_low) * FOLLOWED;
        let high = before_high + (now.high - before_high) * FOLLOWED;
        self.extent = Some((low, high));
        Some(Border { across: Extent { low, high, ..now } })
    }
}

/// The sides of one contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Border {
    across: Extent,
}

impl Border {
    /// Thickens the coat near the sides of `contact`, and slows the cells at the very sides.
    /// Positions in it count from the cell `origin`. `spans` are the columns of its rows that may
    /// have touches.
    #[inline(always)]
    pub(super) fn shape(
        &self,
        (contact, spans): (&mut Contact, &[Range<usize>]),
        origin: (i64, i64),
        cell_mm: f32,
    ) {
        let across = &self.across;
        let low = across.low;
        let high = across.high;
        let reach = (REACH_MM / cell_mm).min(0.25 * (high - low)).max(1.0);
        let left = (contact.rect.x as i64 - origin.0) as f32 + 0.5;
        let top = (contact.rect.y as i64 - origin.1) as f32 + 0.5;
        let width = contact.rect.width.max(1);
        let rows = contact.touches.chunks_exact_mut(width).zip(spans);
        for (row, (touches, span)) in rows.enumerate() {
            let start = across.at(left, top + row as f32);
            for (column, touch) in
                span.clone().zip(touches.get_mut(span.clone()).unwrap_or_default())
            {
                let at = start + column as f32 * across.across.0;
                let inside = lesser(at - low, high - at);
                if inside >= reach || touch.height == Touch::NONE.height {
                    continue;
                }
                let near = 1.0 - greater(inside / reach, 0.0);
                let release = touch.release() as f32 * (1.0 + THICKER * near * near);
                touch.set_release(lesser(release, 127.0) as u32);
                if inside < 1.0 {
                    touch.slow(greater(inside, 0.0));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use graphics::tile::Rect;

    /// Coats across a contact of 40 x 3 cells after a head moved by `moved` cells over it.
    fn coats(moved: (f32, f32)) -> Vec<u32> {
        touches(moved, 10.0).iter().map(Touch::release).collect()
    }

    /// Touches of the middle row of such a contact. The head reaches from `side` to 50 cells along
    /// x.
    fn touches(moved: (f32, f32), side: f32) -> Vec<Touch> {
        let rect = Rect { x: 10, y: 20, width: 40, height: 3 };
        let touch = Touch::new(0, 0, (200, -100), 256, 1);
        let mut contact = Contact { rect, touches: vec![touch; 120], ..Contact::default() };
        let mut extent = Extent::new((30.0, 21.5), moved);
        for x in [side, 50.0] {
            extent.iter_mut().for_each(|extent| extent.include(x, 21.5));
        }
        let whole = [0..40, 0..40, 0..40];
        if let Some(border) = Sides::default().follow(extent) {
            border.shape((&mut contact, &whole), (0, 0), 0.1);
        }
        contact.touches[40..80].to_vec()
    }

    #[test]
    fn the_coat_is_thicker_at_both_sides_of_the_way_only() {
        for moved in [(0.0, 0.9), (0.0, -0.9)] {
            let across = coats(moved);
            let mirrored: Vec<u32> = across.iter().rev().copied().collect();
            assert_eq!(across, mirrored);
            assert!(across[0] > 48 && across[0] > across[3] && across[3] > 32, "{across:?}");
            assert!(across[10..30].iter().all(|&coat| coat == 32), "{across:?}");
        }
        assert_eq!(coats((0.0, 0.1)), [32; 40], "a head that hardly moves has no sides");
    }

    #[test]
    fn the_velocity_falls_to_nothing_over_the_last_cell() {
        for (side, shares) in [(10.0, [0.5, 1.0]), (10.4, [0.1, 1.0]), (10.6, [0.0, 0.9])] {
            let across = touches((0.0, 0.9), side);
            for (touch, share) in across.iter().zip(shares) {
                let (right, down) = touch.velocity();
                let far = (f64::from(right) - share * 200.0).abs();
                assert!(far.max((f64::from(down) + share * 100.0).abs()) <= 1.0, "{across:?}");
            }
            assert!(across[2..38].iter().all(|touch| touch.velocity() == (200, -100)));
        }
    }

    #[test]
    fn the_sides_follow_a_change_slowly_within_a_stroke() {
        let mut sides = Sides::default();
        let mut reach = |half: f32| {
            let mut extent = Extent::new((0.0, 0.0), (1.0, 0.0)).unwrap();
            extent.include(0.0, -half);
            extent.include(0.0, half);
            sides.follow(Some(extent));
            sides.extent.unwrap().1
        };
        assert_eq!(reach(10.0), 10.0);
        let second = reach(20.0);
        assert!(second > 10.5 && second < 19.0, "{second}");
        sides.lift();
        assert_eq!(sides.extent, None);
    }
}
