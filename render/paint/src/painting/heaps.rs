//! Heaps of paint from a tube, and scraping paint away.

use super::failure::PaintingError;
use super::state::{HIGHEST, Painting};
use crate::amount::QUANTA_PER_CELL;
use crate::layer::{Cell, Layer, SLOTS};
use crate::motion::press::CROWDED_VOLUME;
use graphics::tile::Rect;

/// Maximum volume of a heap, in mm3: a litre.
const MOST_MM3: f64 = 1e6;

/// Ratio of the height of a heap to its radius (chosen by eye).
const STEEPNESS: f64 = 2.0 / 3.0;

/// Maximum height of a heap, in quanta: half of what a brush can still move. Where cells
/// are small, large heaps are flatter.
const HIGHEST_HEAP: f64 = CROWDED_VOLUME as f64 / 2.0;

/// Volume of a heap divided by its height and the square of its radius.
const FULLNESS: f64 = std::f64::consts::PI / 1.75;

/// Relative height of a heap (1 at the top) at the squared relative distance `square` from
/// its middle (1 at the edge). The shape lies between an ellipsoid, whose edge would be
/// vertical, and a paraboloid.
fn profile(square: f64) -> f64 {
    let root = (1.0 - square).max(0.0).sqrt();
    root * root.sqrt()
}

/// A heap of paint, in cells.
#[derive(Debug, Clone, Copy)]
struct Heap {
    middle: (f64, f64),
    radius: f64,
}

impl Heap {
    /// A heap of `volume` quanta, at most `most` quanta high.
    fn new(middle: (f64, f64), volume: f64, most: f64) -> Self {
        let quanta = f64::from(QUANTA_PER_CELL);
        let natural = libm::cbrt(volume / quanta / (FULLNESS * STEEPNESS));
        let radius = if natural * STEEPNESS * quanta > most {
            (volume / (FULLNESS * most)).sqrt()
        } else {
            natural
        };
        // A smaller heap could lie between the centres of cells.
        Self { middle, radius: radius.max(1.0) }
    }

    /// Relative height at the centre of a cell, 1 at the top.
    fn height(&self, x: i64, y: i64) -> f64 {
        let right = x as f64 + 0.5 - self.middle.0;
        let down = y as f64 + 0.5 - self.middle.1;
        profile((right * right + down * down) / (self.radius * self.radius))
    }

    /// Ranges of columns and rows that it covers, also outside the canvas.
    fn reach(&self) -> [std::ops::Range<i64>; 2] {
        let (x, y) = self.middle;
        [x, y].map(|at| (at - self.radius).floor() as i64..(at + self.radius).ceil() as i64)
    }

    /// Rectangle that it covers within `bounds`.
    fn rect(&self, bounds: Rect) -> Rect {
        let [columns, rows] = self.reach();
        let cut = |range: std::ops::Range<i64>, end: usize| {
            let end = end as i64;
            (range.start.clamp(0, end) as usize, range.end.clamp(0, end) as usize)
        };
        let (x, right) = cut(columns, bounds.width);
        let (y, bottom) = cut(rows, bounds.height);
        Rect { x, y, width: right - x, height: bottom - y }
    }

    /// Distributes `totals` quanta of each paint over the cells of the heap, also outside the
    /// canvas, and passes each column, row and amount to `add`. Rounding errors are carried
    /// to the next cell, so that the totals are exact.
    fn spread(&self, totals: [f64; SLOTS + 1], mut add: impl FnMut(i64, i64, Cell)) {
        let [columns, rows] = self.reach();
        let cells = || rows.clone().flat_map(|y| columns.clone().map(move |x| (x, y)));
        let whole: f64 = cells().map(|(x, y)| self.height(x, y)).sum();
        let mut so_far = 0.0;
        let mut spent = [0_u64; SLOTS + 1];
        for (x, y) in cells() {
            let height = self.height(x, y);
            if height == 0.0 {
                continue;
            }
            so_far += height;
            let mut cell = [0; SLOTS + 1];
            for ((cell, spent), total) in cell.iter_mut().zip(&mut spent).zip(totals) {
                let due = (total * (so_far / whole)).round() as u64;
                *cell = due.saturating_sub(*spent) as u32;
                *spent = due.max(*spent);
            }
            let [pigments @ .., vehicle] = cell;
            add(x, y, Cell { pigments, vehicle });
        }
    }
}

impl Painting {
    /// Squeezes a heap of `volume_mm3` mm3 out of a tube at the position `x_mm`, `y_mm`. The
    /// paint is the mixture of `recipe` (parts by slot), of which the fraction `vehicle` (0
    /// to 1) is clear medium.
    ///
    /// The heap has a round top and is a third as high as wide, or flatter where the columns
    /// of cells cannot hold more. The volume is exact to the quantum, except for paint that
    /// falls outside the canvas or on its mask.
    ///
    /// # Errors
    /// [`PaintingError`] for an invalid recipe (see [`Painting::load`]), a volume that is not
    /// above 0 and at most a litre, a position outside the canvas, and where the paint is too
    /// high already.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn squeeze(
        &mut self,
        recipe: &[f64; SLOTS],
        vehicle: f64,
        x_mm: f64,
        y_mm: f64,
        volume_mm3: f64,
    ) -> Result<(), PaintingError> {
        let shares = self.shares(recipe, vehicle)?;
        if !(volume_mm3 > 0.0 && volume_mm3 <= MOST_MM3) {
            return Err(PaintingError::Volume { value: volume_mm3 });
        }
        let bounds = self.engine.bounds();
        let off_canvas = || PaintingError::OffCanvas { x_mm, y_mm };
        let middle = (x_mm / self.cell_mm, y_mm / self.cell_mm);
        let inside = (0.0..=bounds.width as f64).contains(&middle.0)
            && (0.0..=bounds.height as f64).contains(&middle.1);
        if !inside {
            return Err(off_canvas());
        }
        let quanta = volume_mm3 / self.cell_mm.powi(3) * f64::from(QUANTA_PER_CELL);
        let natural = Heap::new(middle, quanta, HIGHEST_HEAP);
        let free = f64::from(CROWDED_VOLUME) - f64::from(self.fullest(natural.rect(bounds))?);
        let heap = Heap::new(middle, quanta, free.clamp(f64::from(QUANTA_PER_CELL), HIGHEST_HEAP));
        let rect = heap.rect(bounds);
        let mut paint = self.engine.wet_in(rect)?;
        let mut too_high = false;
        heap.spread(shares.map(|share| (share * quanta).round()), |x, y, more| {
            let x = x - rect.x as i64;
            let y = y - rect.y as i64;
            let width = rect.width as i64;
            let height = rect.height as i64;
            if !((0..width).contains(&x) && (0..height).contains(&y)) {
                return;
            }
            let index = (y * width + x) as usize;
            let cell = (rect.y + y as usize) * bounds.width + rect.x + x as usize;
            if self.mask.as_ref().is_some_and(|mask| mask.covers(cell)) {
                return;
            }
            let there = paint.cell(index);
            let volume = |cell: &Cell| {
                u64::from(cell.vehicle)
                    + cell.pigments.iter().map(|&amount| u64::from(amount)).sum::<u64>()
            };
            if volume(&there) + volume(&more) > u64::from(HIGHEST) {
                too_high = true;
            } else {
                paint.set_cell(index, there.plus(&more));
            }
        });
        if too_high {
            return Err(PaintingError::NoRoom { x_mm, y_mm });
        }
        self.apply_action(|painting| {
            painting.history.save_tiles(&mut painting.engine, rect)?;
            painting.views.mark_wet(rect);
            Ok(painting.engine.set_wet_in(rect, &paint)?)
        })
    }

    /// Maximum height of wet paint in `rect`, in quanta.
    fn fullest(&mut self, rect: Rect) -> Result<u32, PaintingError> {
        let paint = self.engine.wet_in(rect)?;
        let cells = 0..rect.width * rect.height;
        Ok(cells.map(|index| paint.cell(index).volume()).max().unwrap_or(0))
    }

    /// Scrapes all wet paint off the canvas, but not off covered cells. Returns whether there was any.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn scrape(&mut self) -> Result<bool, PaintingError> {
        let bounds = self.engine.bounds();
        let painted = self.engine.wet_tiles()?;
        if painted.is_empty() {
            return Ok(false);
        }
        self.apply_action(|painting| {
            for tile in painted.iter() {
                painting.history.save_tiles(&mut painting.engine, tile.rect(bounds))?;
                painting.views.mark_wet_tile(tile);
            }
            let rect = painted.extent(bounds);
            let mut left = Layer::empty(rect.width, rect.height);
            if let Some(mask) = &painting.mask {
                let before = painting.engine.wet_in(rect)?;
                for index in 0..rect.width * rect.height {
                    let x = rect.x + index % rect.width;
                    let y = rect.y + index / rect.width;
                    if mask.covers(y * bounds.width + x) {
                        left.set_cell(index, before.cell(index));
                    }
                }
            }
            painting.engine.set_wet_in(rect, &left)?;
            Ok(true)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heap_is_a_third_as_high_as_wide_unless_that_is_too_high() {
        let quanta = f64::from(QUANTA_PER_CELL);
        for (volume, flat) in [(4e3, false), (3.2e4, false), (1e6, true)] {
            let heap = Heap::new((300.0, 300.0), volume * quanta, HIGHEST_HEAP);
            let mut totals = [0.0; SLOTS + 1];
            totals[3] = (volume * quanta).round();
            let mut highest = 0;
            let mut sum = 0;
            heap.spread(totals, |_, _, cell| {
                highest = highest.max(cell.volume());
                sum += u64::from(cell.volume());
            });
            assert_eq!(sum, totals[3] as u64, "{volume}");
            let wanted = if flat { HIGHEST_HEAP } else { heap.radius * STEEPNESS * quanta };
            assert!((f64::from(highest) / wanted - 1.0).abs() < 0.01, "{volume}: {highest}");
        }
        // Eight times the paint, twice the width.
        let radius = |volume: f64| Heap::new((0.0, 0.0), volume * quanta, HIGHEST_HEAP).radius;
        assert!((radius(8e3) / radius(1e3) - 2.0).abs() < 1e-9);
    }
}
