//! The bed of a stroke is the surface of the paint before it. Loaded hair rides on this.
//!
//! Hair lies over some mm of paint, so the bed is smooth. We keep one height for each block of
//! [`BLOCK`] x [`BLOCK`] cells, the mean of their tops. Between the middles of four blocks we take
//! the bilinear mean of their heights.

/// Width and height of a block in cells. The sides of a tile are a multiple.
pub const BLOCK: usize = 8;

/// Height, in units of 256 quanta, of a block that you never recorded: below all paint.
pub const NO_BED: i32 = -(1 << 22);

/// Height of a block in units of 256 quanta, from the sum of the tops of its `count` cells, each
/// in units of 256 quanta and rounded down.
#[inline(always)]
#[must_use]
pub fn block_height(sum: i32, count: i32) -> i32 {
    sum / count
}

/// The two blocks out of `blocks` with middles around the cell at `place` along an axis, and the
/// share of the second one, in parts of 16.
#[inline(always)]
#[must_use]
pub fn between(place: usize, blocks: usize) -> (usize, usize, i32) {
    let shifted = place + BLOCK / 2;
    let second = shifted / BLOCK;
    let cell = shifted % BLOCK;
    (second.saturating_sub(1), second.min(blocks - 1), 2 * cell as i32 + 1)
}

/// Mean of two heights, times 16. `share` is the weight of the second one in parts of 16. To get
/// the height of the bed in quanta, apply this along one axis and then to the two results along the
/// other.
#[inline(always)]
#[must_use]
pub fn weighted((first, second): (i32, i32), share: i32) -> i32 {
    first * (16 - share) + second * share
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_the_middles_of_blocks_heights_change_evenly() {
        // Blocks of heights 0, 100 and 100 units along one axis.
        let blocks = [0, 100, 100];
        let found = (0..24).map(|place| {
            let (first, second, share) = between(place, blocks.len());
            let pair = (blocks[first], blocks[second]);
            weighted((weighted((pair.0, pair.0), 7), weighted((pair.1, pair.1), 7)), share)
        });
        let wanted = (0..24).map(|place: i32| (16 * (2 * place - 7)).clamp(0, 256) * 100);
        assert!(found.eq(wanted));
    }

    #[test]
    fn heights_of_the_highest_paint_fit() {
        let highest = (crate::amount::MAX_COLUMN / 256) as i32;
        for share in [1, 15] {
            let left = weighted((highest, NO_BED), share);
            let found = weighted((left, weighted((NO_BED, highest), share)), share);
            assert!(found.abs() <= 1 << 30, "{found}");
        }
    }
}
