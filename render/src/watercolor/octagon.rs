//! The round brush of morphology, and its passes on the processor.

use pulp::Simd;
use rayon::prelude::*;

use graphics::field::Field;

/// Which of the pixels under a brush counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extreme {
    /// The least: an erosion.
    Least,
    /// The greatest: a dilation.
    Greatest,
}

/// A brush: all pixels (x, y) with max(|x| - square, 0) + max(|y| - square, 0) up to
/// diamond.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Brush {
    square: u32,
    diamond: u32,
}

/// Segments through a pixel, which cross there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Crossing {
    /// From a pixel to the next, along the first.
    pub(super) along: [i32; 2],
    /// Along the second.
    pub(super) across: [i32; 2],
    /// Pixels on either side of the middle, of the first.
    pub(super) reach_along: u32,
    /// Of the second.
    pub(super) reach_across: u32,
}

impl Brush {
    /// The octagon nearest to regular that reaches `radius_px` along rows and columns. A
    /// regular one holds the disc of that radius, and reaches 8 % beyond it.
    #[must_use]
    pub fn round(radius_px: u32) -> Self {
        // The share of the diamond in a regular octagon: 2 - sqrt(2).
        let diamond = (f64::from(radius_px) * (2.0 - std::f64::consts::SQRT_2)).round() as u32;
        Self { square: radius_px - diamond, diamond }
    }

    /// What two passes with this brush make together.
    #[must_use]
    pub fn twice(self) -> Self {
        Self { square: 2 * self.square, diamond: 2 * self.diamond }
    }

    /// How far it reaches along rows and columns, in pixels.
    #[must_use]
    pub fn reach(self) -> u32 {
        self.square + self.diamond
    }

    /// Whether it has the pixel that is `x` and `y` from the middle.
    #[must_use]
    pub fn covers(self, x: i32, y: i32) -> bool {
        let beyond = |distance: i32| distance.unsigned_abs().saturating_sub(self.square);
        beyond(x) + beyond(y) <= self.diamond
    }

    /// How many crosses of 5 pixels it has. Two diagonals make every other pixel of a
    /// diamond only: a square fills the rest, or else crosses do.
    fn crosses(self) -> u32 {
        match (self.diamond % 2, self.square, self.diamond) {
            (1, _, _) => 1,
            (_, 0, 2..) => 2,
            _ => 0,
        }
    }

    /// The brush as a sum; at least one.
    pub(super) fn crossings(self) -> Vec<Crossing> {
        let segment =
            |along, reach_along| Crossing { along, across: [0, 0], reach_along, reach_across: 0 };
        let cross = Crossing { along: [1, 0], across: [0, 1], reach_along: 1, reach_across: 1 };
        let mut all = vec![cross; self.crosses() as usize];
        let diagonal = (self.diamond - self.crosses()) / 2;
        if diagonal > 0 {
            all.extend([segment([1, 1], diagonal), segment([-1, 1], diagonal)]);
        }
        if self.square > 0 || all.is_empty() {
            all.extend([segment([1, 0], self.square), segment([0, 1], self.square)]);
        }
        all
    }
}

/// Pixels of a tile's side, without what the brush reaches beyond.
const TILE: (usize, usize) = (192, 96);

/// Numbers of a pixel.
const CHANNELS: usize = 4;

/// The least or greatest under the brush, into `result` of the same size.
///
/// Tile by tile, in place: a segment's pixels are put together from its end, so that
/// nothing is read after it was written.
pub(super) fn extreme(
    field: &Field<[f32; 4]>,
    brush: Brush,
    which: Extreme,
    result: &mut Field<[f32; 4]>,
) {
    let (width, height) = (field.width(), field.height());
    let found = (result.width(), result.height());
    assert_eq!(found, (width, height), "a result of the same size, found {found:?}");
    if width == 0 {
        return;
    }
    if brush.reach() == 0 {
        result.values_mut().copy_from_slice(field.values());
        return;
    }
    let tile = Tile::new(brush, width.min(TILE.0), height.min(TILE.1));
    let bands = result.values_mut().par_chunks_mut(width * tile.height).enumerate();
    bands.for_each_init(Vec::new, |cells, (band, rows)| {
        for left in (0..width).step_by(tile.width) {
            tile.load(field, (left, band * tile.height), which, cells);
            match which {
                Extreme::Least => run::<false>(&tile, cells),
                Extreme::Greatest => run::<true>(&tile, cells),
            }
            tile.store(cells, left, width, rows);
        }
    });
}

/// A part of the picture with what is around it, and what is done to it.
struct Tile {
    width: usize,
    height: usize,
    reach: usize,
    /// From a row to the next, in pixels.
    stride: usize,
    /// In pixels: where the first result ends up.
    first: usize,
    /// In order.
    gathers: Vec<Gather>,
}

/// Each pixel becomes the extreme of several that come after it.
#[derive(Debug, Clone, Copy)]
struct Gather {
    /// How far after it, in pixels; rising, the first is 0.
    offsets: [usize; Self::MOST],
    count: usize,
}

impl Gather {
    const MOST: usize = 5;

    fn new(offsets: &[usize]) -> Self {
        let mut all = [0; Self::MOST];
        all[..offsets.len()].copy_from_slice(offsets);
        Self { offsets: all, count: offsets.len() }
    }

    /// A segment of `pixels`, `step` apart: of few, then of those.
    fn segment(step: usize, pixels: usize, gathers: &mut Vec<Self>) {
        let mut done = 1;
        while done < pixels {
            let next = (done * Self::MOST).min(pixels);
            let count = next.div_ceil(done);
            let offsets: Vec<usize> =
                (0..count).map(|i| step * (i * done).min(next - done)).collect();
            gathers.push(Self::new(&offsets));
            done = next;
        }
    }
}

impl Tile {
    fn new(brush: Brush, width: usize, height: usize) -> Self {
        let reach = brush.reach() as usize;
        let stride = width + 2 * reach;
        let mut gathers = Vec::new();
        for _ in 0..brush.crosses() {
            gathers.push(Gather::new(&[0, stride - 1, stride, stride + 1, 2 * stride]));
        }
        let diagonal = (brush.diamond - brush.crosses()) as usize / 2;
        let square = brush.square as usize;
        Gather::segment(stride + 1, 2 * diagonal + 1, &mut gathers);
        Gather::segment(stride - 1, 2 * diagonal + 1, &mut gathers);
        Gather::segment(1, 2 * square + 1, &mut gathers);
        Gather::segment(stride, 2 * square + 1, &mut gathers);
        Self { width, height, reach, stride, first: reach - square, gathers }
    }

    /// Takes in what begins at `(left, top)`; what is outside of the field never counts.
    fn load(
        &self,
        field: &Field<[f32; 4]>,
        (left, top): (usize, usize),
        which: Extreme,
        cells: &mut Vec<f32>,
    ) {
        let nothing = match which {
            Extreme::Least => f32::INFINITY,
            Extreme::Greatest => f32::NEG_INFINITY,
        };
        let rows = self.height + 2 * self.reach;
        // Vectors read a little beyond the last row.
        cells.resize((self.stride * rows + Gather::MOST) * CHANNELS, nothing);
        let from = left.saturating_sub(self.reach);
        let to = (left + self.width + self.reach).min(field.width());
        let skipped = (from + self.reach - left) * CHANNELS;
        for (row, cells) in cells.chunks_mut(self.stride * CHANNELS).take(rows).enumerate() {
            let inside = (top + row).checked_sub(self.reach).filter(|y| *y < field.height());
            let Some(y) = inside else {
                cells.fill(nothing);
                continue;
            };
            let source: &[f32] = bytemuck::cast_slice(field.row(y, from, to - from));
            cells[..skipped].fill(nothing);
            cells[skipped..][..source.len()].copy_from_slice(source);
            cells[skipped + source.len()..].fill(nothing);
        }
    }

    /// Puts the results from column `left` on into rows of `width`.
    fn store(&self, cells: &[f32], left: usize, width: usize, rows: &mut [[f32; 4]]) {
        let count = self.width.min(width - left);
        for (row, cells) in rows.chunks_mut(width).zip(cells.chunks(self.stride * CHANNELS)) {
            let found = &cells[self.first * CHANNELS..][..count * CHANNELS];
            row[left..left + count].copy_from_slice(bytemuck::cast_slice(found));
        }
    }
}

/// All gathers of a tile, on its cells.
fn run<const GREATEST: bool>(tile: &Tile, cells: &mut [f32]) {
    struct Run<'a, const GREATEST: bool>(&'a Tile, &'a mut [f32]);

    impl<const GREATEST: bool> pulp::WithSimd for Run<'_, GREATEST> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            let Self(tile, cells) = self;
            let mut last = tile.stride * (tile.height + 2 * tile.reach) * CHANNELS;
            for gather in &tile.gathers {
                let offsets = gather.offsets.map(|offset| offset * CHANNELS);
                last -= offsets[gather.count - 1];
                match gather.count {
                    2 => gathered::<S, GREATEST, 2>(simd, cells, last, offsets),
                    3 => gathered::<S, GREATEST, 3>(simd, cells, last, offsets),
                    4 => gathered::<S, GREATEST, 4>(simd, cells, last, offsets),
                    _ => gathered::<S, GREATEST, 5>(simd, cells, last, offsets),
                }
            }
        }
    }

    pulp::Arch::new().dispatch(Run::<GREATEST>(tile, cells));
}

/// One gather of `COUNT` pixels over the first `last` numbers.
#[inline(always)]
fn gathered<S: Simd, const GREATEST: bool, const COUNT: usize>(
    simd: S,
    cells: &mut [f32],
    last: usize,
    offsets: [usize; Gather::MOST],
) {
    for at in (0..last).step_by(S::F32_LANES) {
        let mut found = S::as_simd_f32s(&cells[at..at + S::F32_LANES]).0[0];
        for offset in &offsets[1..COUNT] {
            let other = S::as_simd_f32s(&cells[at + offset..][..S::F32_LANES]).0[0];
            found = match GREATEST {
                true => simd.max_f32s(found, other),
                false => simd.min_f32s(found, other),
            };
        }
        S::as_mut_simd_f32s(&mut cells[at..at + S::F32_LANES]).0[0] = found;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brushes_are_round() {
        for radius in 1..=40u32 {
            let brush = Brush::round(radius);
            assert_eq!(brush.reach(), radius);
            let (reach, square) = (radius as i32, f64::from(radius).powi(2));
            let (mut pixels, mut inside) = (0, 0);
            for y in -reach..=reach {
                for x in -reach..=reach {
                    pixels += i32::from(brush.covers(x, y));
                    let distance = f64::from(x * x + y * y);
                    inside += i32::from(distance <= square);
                    // The disc up to half a pixel inside, and to 9 % and one beyond.
                    let core = distance.sqrt() <= f64::from(radius) - 0.5;
                    assert!(!core || brush.covers(x, y), "{radius}: {x} {y}");
                    let far = distance.sqrt() > 1.09 * f64::from(radius) + 1.0;
                    assert!(!far || !brush.covers(x, y), "{radius}: {x} {y}");
                }
            }
            assert!(pixels >= inside, "{radius}: {pixels} of {inside}");
        }
    }

    #[test]
    fn crossings_add_up_to_the_brush() {
        for radius in 0..=20 {
            for brush in [Brush::round(radius), Brush::round(radius).twice()] {
                let reach = brush.reach() as i32;
                let mut points = std::collections::BTreeSet::from([(0, 0)]);
                for crossing in brush.crossings() {
                    let segment = |step: [i32; 2], reach: u32| {
                        let reach = reach as i32;
                        (-reach..=reach).map(move |i| (i * step[0], i * step[1]))
                    };
                    let own: Vec<_> = segment(crossing.along, crossing.reach_along)
                        .chain(segment(crossing.across, crossing.reach_across))
                        .collect();
                    let moved = |&(x, y): &(i32, i32)| {
                        own.clone().into_iter().map(move |(dx, dy)| (x + dx, y + dy))
                    };
                    points = points.iter().flat_map(moved).collect();
                }
                let area = (-reach..=reach).flat_map(|y| (-reach..=reach).map(move |x| (x, y)));
                let wanted = area.filter(|&(x, y)| brush.covers(x, y)).collect();
                assert_eq!(points, wanted, "{brush:?}");
            }
        }
    }
}
