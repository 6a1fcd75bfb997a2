//! The bed of a stroke: the surface of the paint before it, on which loaded hair rides.
//!
//! Hair lies over some mm of paint, so the bed is smooth: one height for each block of
//! [`BLOCK`] x [`BLOCK`] cells, the mean of their tops, and between the middles of four blocks the
//! bilinear mean of their heights.

/// Width and height of a block in cells; those of a tile are a multiple.
pub const BLOCK: usize = 8;

/// Height, in units of 256 quanta, of a block that was never noted: below all paint.
pub const NO_BED: i32 = -(1 << 22);

/// Height of a block in units of 256 quanta, from the sum of the tops of its `count` cells, each
/// in units of 256 quanta and rounded down.
#[inline(always)]
#[must_use]
pub fn block_height(sum: i32, count: i32) -> i32 {
    sum / count
}

/// The blocks between whose middles the cell at `place` along an axis lies, out of `blocks`, and
/// the share of the second one, in parts of 16.
#[inline(always)]
#[must_use]
pub fn between(place: usize, blocks: usize) -> (usize, usize, i32) {
    let shifted = place + BLOCK / 2;
    let (second, cell) = (shifted / BLOCK, shifted % BLOCK);
    (second.saturating_sub(1), second.min(blocks - 1), 2 * cell as i32 + 1)
}

/// Height of the bed in quanta between four blocks: the upper and the lower pair, and the shares of
/// the right and of the lower ones in parts of 16.
#[inline(always)]
#[must_use]
pub fn height(upper: (i32, i32), lower: (i32, i32), right: i32, down: i32) -> i32 {
    let along = |(first, second): (i32, i32)| first * (16 - right) + second * right;
    along(upper) * (16 - down) + along(lower) * down
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
            height(pair, pair, share, 7)
        });
        let wanted = (0..24).map(|place: i32| (16 * (2 * place - 7)).clamp(0, 256) * 100);
        assert!(found.eq(wanted));
    }

    #[test]
    fn heights_of_the_highest_paint_fit() {
        let highest = (crate::amount::MAX_COLUMN / 256) as i32;
        for share in [1, 15] {
            let found = height((highest, NO_BED), (NO_BED, highest), share, share);
            assert!(found.abs() <= 1 << 30, "{found}");
        }
    }
}
