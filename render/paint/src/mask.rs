//! Masks cover cells of a canvas, as masking film does.

use graphics::tile::Rect;

/// Number of cells in a word.
const WORD: usize = 32;

/// Covered and open cells of a canvas, a bit per cell. Paint neither reaches nor leaves a covered
/// cell: heads do not touch it, and nothing flows over its sides.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mask {
    bounds: Rect,
    /// Bits of the cells row by row, the first in the lowest bit. 1 is covered. Those after the
    /// last cell are 0.
    words: Vec<u32>,
}

impl Mask {
    /// A mask of the canvas `bounds`. A cell stays open if `open` accepts its index, counted row by
    /// row.
    #[must_use]
    pub fn with_open(bounds: Rect, open: impl Fn(usize) -> bool) -> Self {
        let cells = bounds.width * bounds.height;
        let words = (0..cells.div_ceil(WORD)).map(|word| {
            let bits = (word * WORD..cells.min((word + 1) * WORD)).enumerate();
            bits.fold(0, |bits, (bit, cell)| bits | u32::from(!open(cell)) << bit)
        });
        Self { bounds, words: words.collect() }
    }

    /// A mask that leaves the cells inside a polygon open. We test the centre of each cell by the
    /// even-odd rule. You give the points in cells, and we close the polygon from the last to the
    /// first.
    #[must_use]
    pub fn with_open_polygon(bounds: Rect, points: &[(f64, f64)]) -> Self {
        let mut open = vec![false; bounds.width * bounds.height];
        let mut crossings = Vec::new();
        for (row, cells) in open.chunks_exact_mut(bounds.width.max(1)).enumerate() {
            let y = row as f64 + 0.5;
            crossings.clear();
            let next = points.iter().cycle().skip(1);
            for (&(x, from), &(next_x, to)) in points.iter().zip(next) {
                if (from <= y) != (to <= y) {
                    crossings.push(x + (y - from) / (to - from) * (next_x - x));
                }
            }
            crossings.sort_by(f64::total_cmp);
            for pair in crossings.chunks_exact(2) {
                cells[first_cell(pair[0], bounds.width)..first_cell(pair[1], bounds.width)]
                    .fill(true);
            }
        }
        Self::with_open(bounds, |cell| open[cell])
    }

    /// The canvas that it was made for.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        self.bounds
    }

    /// This mask with covered and open cells exchanged.
    #[must_use]
    pub fn inverse(&self) -> Self {
        Self::with_open(self.bounds, |cell| self.covers(cell))
    }

    /// Whether the cell with this index, row by row, is covered.
    ///
    /// # Panics
    /// If there is no such cell.
    #[inline(always)]
    #[must_use]
    pub fn covers(&self, cell: usize) -> bool {
        self.words[cell / WORD] >> (cell % WORD) & 1 == 1
    }

    /// Number of covered cells.
    #[must_use]
    pub fn covered(&self) -> usize {
        self.words.iter().map(|word| word.count_ones() as usize).sum()
    }

    pub(crate) fn words(&self) -> &[u32] {
        &self.words
    }

    /// Lines between covered and open blocks of `step` x `step` cells, from corner to corner in
    /// cells. Each line runs to the next bend of the border. You get the lines along x first. The
    /// middle cell of a block decides whether it counts as covered. The edge of the canvas does not
    /// count as such a line.
    #[must_use]
    pub fn outline(&self, step: usize) -> Vec<[(u32, u32); 2]> {
        let step = step.max(1);
        let Rect { width, height, .. } = self.bounds;
        let columns = width.div_ceil(step);
        let rows = height.div_ceil(step);
        let covers = |x: usize, y: usize| {
            self.covers(block_middle(y, height, step) * width + block_middle(x, width, step))
        };
        let at_x = |x: usize| (x * step).min(width) as u32;
        let at_y = |y: usize| (y * step).min(height) as u32;
        let mut lines = Vec::new();
        for y in 1..rows {
            runs(
                columns,
                |x: usize| covers(x, y) != covers(x, y - 1),
                |from, to| {
                    lines.push([(at_x(from), at_y(y)), (at_x(to), at_y(y))]);
                },
            );
        }
        for x in 1..columns {
            runs(
                rows,
                |y: usize| covers(x, y) != covers(x - 1, y),
                |from, to| {
                    lines.push([(at_x(x), at_y(from)), (at_x(x), at_y(to))]);
                },
            );
        }
        lines
    }
}

fn block_middle(block: usize, count: usize, step: usize) -> usize {
    (block * step + step / 2).min(count - 1)
}

fn first_cell(x: f64, width: usize) -> usize {
    (x - 0.5).ceil().clamp(0.0, width as f64) as usize
}

/// Calls `found` with start and end of each run of places, below `count`, that `within` accepts.
fn runs(count: usize, within: impl Fn(usize) -> bool, mut found: impl FnMut(usize, usize)) {
    let mut from = None;
    for place in 0..=count {
        match (place < count && within(place), from) {
            (true, None) => from = Some(place),
            (false, Some(start)) => {
                found(start, place);
                from = None;
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Rect = Rect { x: 0, y: 0, width: 37, height: 11 };

    fn open(mask: &Mask) -> Vec<(usize, usize)> {
        let cells = 0..BOUNDS.width * BOUNDS.height;
        let open = cells.filter(|&cell| !mask.covers(cell));
        open.map(|cell| (cell % BOUNDS.width, cell / BOUNDS.width)).collect()
    }

    #[test]
    fn a_polygon_leaves_the_cells_open_whose_centres_it_holds() {
        let square = [(3.4, 2.0), (6.6, 2.0), (6.6, 4.0), (3.4, 4.0)];
        let mask = Mask::with_open_polygon(BOUNDS, &square);
        assert_eq!(open(&mask), [(3, 2), (4, 2), (5, 2), (6, 2), (3, 3), (4, 3), (5, 3), (6, 3)]);
        let all = [(-50.0, -50.0), (90.0, -50.0), (90.0, 90.0), (-50.0, 90.0)];
        assert_eq!(Mask::with_open_polygon(BOUNDS, &all).covered(), 0);
        // The middle of a five-pointed star, drawn in one line, is outside by the even-odd rule.
        let star = [0.0, 1.0, 2.0, 3.0, 4.0].map(|i: f64| {
            let (sin, cos) = (i * 4.0 * std::f64::consts::PI / 5.0).sin_cos();
            (15.0 + 5.4 * sin, 5.5 - 5.4 * cos)
        });
        let star = open(&Mask::with_open_polygon(BOUNDS, &star));
        assert!(!star.contains(&(15, 5)) && star.contains(&(14, 2)), "{star:?}");
    }

    #[test]
    fn the_inverse_covers_what_was_open_and_nothing_beyond_the_canvas() {
        let mask = Mask::with_open(BOUNDS, |cell| cell % 3 == 0);
        let inverse = mask.inverse();
        assert!((0..37 * 11).all(|cell| inverse.covers(cell) != mask.covers(cell)));
        assert_eq!(mask.covered() + inverse.covered(), 37 * 11);
        assert_eq!(inverse.inverse(), mask);
    }

    #[test]
    fn an_outline_follows_the_border_in_straight_lines() {
        let square = [(3.0, 2.0), (7.0, 2.0), (7.0, 4.0), (3.0, 4.0)];
        let lines = Mask::with_open_polygon(BOUNDS, &square).outline(1);
        let wanted = [[(3, 2), (7, 2)], [(3, 4), (7, 4)], [(3, 2), (3, 4)], [(7, 2), (7, 4)]];
        assert_eq!(lines, wanted);
        // The rows 2 and 3 are one block, whose middle is open from column 3 on.
        let coarse = Mask::with_open_polygon(BOUNDS, &square).outline(2);
        let wanted = [[(2, 2), (6, 2)], [(2, 4), (6, 4)], [(2, 2), (2, 4)], [(6, 2), (6, 4)]];
        assert_eq!(coarse, wanted);
        assert!(Mask::with_open(BOUNDS, |_| false).outline(1).is_empty());
    }
}
