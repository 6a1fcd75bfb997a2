//! A small picture of the canvas that follows its changes.

use graphics::field::Field;
use graphics::tile::{Rect, TILE, TileSet};

use super::srgb::SrgbBytes;
use super::state::Thumbnail;
use super::tiles::runs;

/// Longer side of the small picture in pixels, for canvases of up to `LONGEST * TILE` cells.
const LONGEST: usize = 240;

/// A small picture whose pixels are means of squares of cells, and the tiles that changed since.
#[derive(Debug, Clone)]
pub(super) struct Miniature {
    bounds: Rect,
    /// Side of a pixel in cells, a power of two that divides a tile.
    step: usize,
    picture: Thumbnail,
    stale: TileSet,
}

impl Miniature {
    /// A picture of a canvas of `bounds`, all of which is still to be read.
    pub(super) fn new(bounds: Rect) -> Self {
        let longer = bounds.width.max(bounds.height);
        let mut step = 1;
        while step < TILE && longer.div_ceil(step) > LONGEST {
            step *= 2;
        }
        let width = bounds.width.div_ceil(step);
        let height = bounds.height.div_ceil(step);
        let picture = Thumbnail { width, height, pixels: vec![[0, 0, 0, 255]; width * height] };
        Self { bounds, step, picture, stale: TileSet::all(bounds) }
    }

    /// Canvas of the picture.
    pub(super) fn bounds(&self) -> Rect {
        self.bounds
    }

    /// Marks tiles of the canvas as changed.
    pub(super) fn change(&mut self, tiles: &TileSet) {
        for tile in tiles.iter() {
            self.stale.insert_tile(tile);
        }
    }

    /// The picture with all changes. `read` returns a rectangle of the canvas in linear sRGB; it is
    /// called once for each run of changed tiles in a row, as each call may be a transfer from the
    /// device.
    ///
    /// # Errors
    /// The errors of `read`.
    pub(super) fn picture<E>(
        &mut self,
        bytes: &SrgbBytes,
        mut read: impl FnMut(Rect) -> Result<Field<[f32; 4]>, E>,
    ) -> Result<&Thumbnail, E> {
        for (run, _) in runs(&self.stale.take(), self.bounds) {
            let cells = read(run)?;
            self.reduce(run, &cells, bytes);
        }
        Ok(&self.picture)
    }

    /// Sets the pixels of the tiles in `rect` from their `cells`.
    fn reduce(&mut self, rect: Rect, cells: &Field<[f32; 4]>, bytes: &SrgbBytes) {
        let step = self.step;
        for top in (0..rect.height).step_by(step) {
            let height = step.min(rect.height - top);
            for left in (0..rect.width).step_by(step) {
                let width = step.min(rect.width - left);
                let mut sum = [0.0_f32; 3];
                for y in top..top + height {
                    for color in cells.row(y, left, width) {
                        for (sum, value) in sum.iter_mut().zip(color) {
                            *sum += value;
                        }
                    }
                }
                let [r, g, b] = sum.map(|sum| sum / (width * height) as f32);
                let x = (rect.x + left) / step;
                let y = (rect.y + top) / step;
                self.picture.pixels[y * self.picture.width + x] = bytes.pixel([r, g, b, 1.0]);
            }
        }
    }
}

/// The pixels in which two pictures of one size differ, as left, top, width and height; `None` if
/// they are equal.
pub(super) fn difference(before: &Thumbnail, after: &Thumbnail) -> Option<[usize; 4]> {
    let pairs = before.pixels.iter().zip(&after.pixels).enumerate();
    let places = pairs.filter(|(_, (a, b))| a != b);
    let places = places.map(|(index, _)| (index % after.width, index / after.width));
    let extent = places.fold(None, |extent: Option<[usize; 4]>, (x, y)| {
        let [x0, y0, x1, y1] = extent.unwrap_or([x, y, x, y]);
        Some([x0.min(x), y0.min(y), x1.max(x), y1.max(y)])
    });
    extent.map(|[x0, y0, x1, y1]| [x0, y0, x1 - x0 + 1, y1 - y0 + 1])
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    fn canvas(width: usize, height: usize, color: impl Fn(usize, usize) -> f32) -> Field<[f32; 4]> {
        Field::from_values(
            width,
            height,
            (0..width * height)
                .map(|index: usize| [color(index % width, index / width); 4])
                .collect(),
        )
    }

    fn read(canvas: &Field<[f32; 4]>) -> impl FnMut(Rect) -> Result<Field<[f32; 4]>, Infallible> {
        |rect| Ok(canvas.part(rect))
    }

    #[test]
    fn pixels_are_the_means_of_linear_light_also_at_the_rim() {
        let bytes = SrgbBytes::new();
        // 500 cells need squares of 4; the last column of pixels has 2 cells.
        let checks = canvas(498, 70, |x, y| ((x + y) % 2) as f32);
        let mut small = Miniature::new(checks.bounds());
        let picture = small.picture(&bytes, read(&checks)).unwrap().clone();
        assert_eq!((picture.width, picture.height), (125, 18));
        let grey = bytes.pixel([0.5, 0.5, 0.5, 1.0]);
        assert!(picture.pixels.iter().all(|pixel| *pixel == grey), "{:?}", picture.pixels[0]);
    }

    #[test]
    fn only_changed_tiles_are_read_again() {
        let bytes = SrgbBytes::new();
        let before = canvas(300, 200, |x, _| x as f32 / 300.0);
        let after = canvas(300, 200, |x, y| if x < 70 && y < 10 { 1.0 } else { x as f32 / 300.0 });
        let mut small = Miniature::new(before.bounds());
        let first = small.picture(&bytes, read(&before)).unwrap().clone();
        let mut changed = TileSet::default();
        changed.insert(Rect { x: 0, y: 0, width: 70, height: 10 });
        small.change(&changed);
        let mut rects = Vec::new();
        let second = small.picture(&bytes, |rect| {
            rects.push(rect);
            Ok::<_, Infallible>(after.part(rect))
        });
        let second = second.unwrap().clone();
        assert_eq!(rects, [Rect { x: 0, y: 0, width: 128, height: 64 }], "two tiles at once");
        let whole = Miniature::new(after.bounds()).picture(&bytes, read(&after)).unwrap().clone();
        assert_eq!(second, whole);
        assert_eq!(difference(&first, &second), Some([0, 0, 35, 5]), "two cells a pixel");
        assert_eq!(difference(&first, &first), None);
    }
}
