//! Looks up in constant time which sample of the surface is nearest.

use std::ops::Range;

use glam::Vec3;
use rayon::prelude::*;

use super::settings::{MotionError, in_range};

pub(super) const BOXES: usize = 4;

const BOXES_OF_CELL: usize = BOXES * BOXES * BOXES;

/// The box around the surface may have at most this many cells.
const MOST_CELLS: usize = 1 << 24;

/// Marks a cell outside the look-up, or a box without a sample near it.
const NONE: u32 = u32::MAX;

/// Samples of the scene's surface. Every box of a quarter of a cell that is less than a cell from
/// the surface knows its nearest sample.
///
/// For a place you get the sample nearest to the middle of its box. It is farther from the place
/// than the nearest of all by at most the diagonal of a box, 0.43 cells.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceLattice {
    pub(super) cell: f32,
    pub(super) low: Vec3,
    pub(super) counts: [usize; 3],
    /// For every cell, the index of its boxes, or [`NONE`].
    pub(super) tables: Vec<u32>,
    /// For every box, the index of its sample, or [`NONE`].
    pub(super) boxes: Vec<u32>,
    pub(super) places: Vec<Vec3>,
    fingerprint: [u32; 2],
}

impl SurfaceLattice {
    /// Builds the look-up of samples at `places`, for cells of size `cell`.
    ///
    /// # Errors
    /// [`MotionError::OutOfRange`] for a cell size that is not finite and above 0,
    /// [`MotionError::Place`] for a place that is not finite, [`MotionError::TooFine`] if the box
    /// around the places holds more than 2^24 cells.
    pub fn of(places: &[Vec3], cell: f32) -> Result<Self, MotionError> {
        in_range("cell", cell, f32::MIN_POSITIVE, f32::MAX)?;
        if let Some(index) = places.iter().position(|place| !place.is_finite()) {
            return Err(MotionError::Place(index));
        }
        let low = places.iter().copied().reduce(Vec3::min).unwrap_or_default();
        let high = places.iter().copied().reduce(Vec3::max).unwrap_or_default();
        // We add a layer of cells all around, because places outside of the box are pulled too.
        let sides = ((high - low) / cell).floor() + 3.0;
        let blocks = sides.x * sides.y * sides.z;
        if blocks > MOST_CELLS as f32 || !blocks.is_finite() {
            let extent = (high - low).max_element();
            let most = MOST_CELLS;
            let fitting_cell = extent / ((most as f32).cbrt() - 3.0).floor();
            return Err(MotionError::TooFine { cell, blocks, most, fitting_cell });
        }
        let counts = sides.to_array().map(|side| side as usize);
        let low = low - cell;
        let places = places.to_vec();
        let fingerprint = fingerprint_of(&places);
        let tables = Vec::new();
        let boxes = Vec::new();
        let mut lattice = Self { cell, low, counts, tables, boxes, places, fingerprint };
        lattice.fill();
        Ok(lattice)
    }

    /// The sample for `place`. `None` if the surface is farther away than about a cell.
    #[inline]
    #[must_use]
    pub fn nearest(&self, place: Vec3) -> Option<Vec3> {
        self.places.get(self.sample_of(place) as usize).copied()
    }

    /// The sample that pulls a particle at `place`: its index and its place. `last` is the index of
    /// the sample that pulled the particle before. [`u32::MAX`] means none. A particle changes to
    /// the sample of its place only if this is nearer. So it cannot swing between two samples for
    /// ever: the energy of the pull falls.
    #[inline]
    #[must_use]
    pub fn pulling(&self, place: Vec3, last: u32) -> (u32, Option<Vec3>) {
        let found = self.sample_of(place);
        let [sample, before] = [found, last].map(|index| self.places.get(index as usize));
        let (Some(&sample), Some(&before)) = (sample, before) else {
            return if before.is_some() {
                (last, before.copied())
            } else {
                (found, sample.copied())
            };
        };
        match sample.distance_squared(place) < before.distance_squared(place) {
            true => (found, Some(sample)),
            false => (last, Some(before)),
        }
    }

    #[inline]
    fn sample_of(&self, place: Vec3) -> u32 {
        let at = (place - self.low) * (BOXES as f32 / self.cell);
        if !at.cmpge(Vec3::ZERO).all() {
            return NONE;
        }
        let [x, y, z] = at.to_array().map(|along| along as usize);
        let [columns, rows, layers] = self.counts;
        if x >= columns * BOXES || y >= rows * BOXES || z >= layers * BOXES {
            return NONE;
        }
        let cell = ((z / BOXES) * rows + y / BOXES) * columns + x / BOXES;
        let table = self.tables[cell];
        if table == NONE {
            return NONE;
        }
        let inside = ((z % BOXES) * BOXES + y % BOXES) * BOXES + x % BOXES;
        self.boxes[table as usize * BOXES_OF_CELL + inside]
    }

    /// Size of a cell, in the unit of the scene.
    #[must_use]
    pub fn cell(&self) -> f32 {
        self.cell
    }

    /// A checksum of the samples.
    pub(super) fn fingerprint(&self) -> [u32; 2] {
        self.fingerprint
    }

    fn fill(&mut self) {
        let cells = self.counts.iter().product();
        // Samples by cell, in each by index.
        let of_samples: Vec<usize> = self
            .places
            .iter()
            .map(|&place: &Vec3| {
                let at = ((place - self.low) / self.cell).to_array().map(|along| along as usize);
                (at[2] * self.counts[1] + at[1]) * self.counts[0] + at[0]
            })
            .collect();
        let mut first = vec![0_u32; cells + 1];
        for &cell in &of_samples {
            first[cell + 1] += 1;
        }
        for cell in 0..cells {
            first[cell + 1] += first[cell];
        }
        let mut next = first.clone();
        let mut sorted = vec![0_u32; self.places.len()];
        for (sample, &cell) in of_samples.iter().enumerate() {
            sorted[next[cell] as usize] = sample as u32;
            next[cell] += 1;
        }
        let near: Vec<usize> = (0..cells)
            .filter(|cell: &usize| {
                self.rows_around(*cell).any(|row| first[row.start] < first[row.end])
            })
            .collect();
        self.tables = vec![NONE; cells];
        for (&cell, table) in near.iter().zip(0..) {
            self.tables[cell] = table;
        }
        let boxes = near.par_iter().flat_map_iter(|&cell| {
            let ranges = self.rows_around(cell).map(|row| first[row.start]..first[row.end]);
            let samples =
                ranges.flat_map(|range| &sorted[range.start as usize..range.end as usize]);
            let samples: Vec<_> = samples.map(|&s| (s, self.places[s as usize])).collect();
            self.boxes_of(cell, &samples)
        });
        self.boxes = boxes.collect();
    }

    /// A cell and the 26 around it, as up to nine rows of cells that lie one after another.
    fn rows_around(&self, cell: usize) -> impl Iterator<Item = Range<usize>> + use<> {
        let [columns, rows, layers] = self.counts;
        let [x, y, z] = [cell % columns, cell / columns % rows, cell / columns / rows];
        fn side(at: usize, count: usize) -> Range<usize> {
            at.saturating_sub(1)..(at + 2).min(count)
        }
        let along = side(x, columns);
        let across = side(y, rows);
        side(z, layers).flat_map(move |layer| {
            let along = along.clone();
            across.clone().map(move |row| {
                let start = (layer * rows + row) * columns;
                start + along.start..start + along.end
            })
        })
    }

    fn boxes_of(&self, cell: usize, samples: &[(u32, Vec3)]) -> Vec<u32> {
        const HALF: usize = BOXES / 2;
        let [columns, rows, _] = self.counts;
        let at = [cell % columns, cell / columns % rows, cell / columns / rows];
        let corner = self.low + Vec3::from(at.map(|along| along as f32)) * self.cell;
        let side = self.cell / BOXES as f32;
        let diagonal = side * 3.0_f32.sqrt();
        let mut found = vec![NONE; BOXES_OF_CELL];
        let mut few = Vec::new();
        let mut squares = Vec::new();
        // We take an eighth of the cell at a time, because few samples can be nearest to any of
        // its boxes.
        for eighth in 0..8 {
            let from = [eighth % 2, eighth / 2 % 2, eighth / 4].map(|half| half * HALF);
            let middle = corner + Vec3::from(from.map(|along| (along + HALF / 2) as f32)) * side;
            squares.clear();
            squares.extend(samples.iter().map(|(_, place)| (*place - middle).length_squared()));
            let least = squares.iter().copied().fold(f32::MAX, f32::min);
            // The middle of a box is at most half of this from the middle of the eighth.
            let far = least.sqrt() + ((HALF - 1) as f32 + 0.01) * diagonal;
            let near = samples.iter().zip(&squares).filter(|(_, square)| **square <= far * far);
            few.clear();
            few.extend(near.map(|(sample, _)| *sample));
            for inside in 0..HALF * HALF * HALF {
                let [x, y, z] = [inside % HALF, inside / HALF % HALF, inside / HALF / HALF];
                let at = [from[0] + x, from[1] + y, from[2] + z];
                let middle = corner + Vec3::from(at.map(|along| along as f32 + 0.5)) * side;
                let reach = self.cell + 0.5 * diagonal;
                let mut nearest = (reach * reach, NONE);
                for &(sample, place) in &few {
                    let square = (place - middle).length_squared();
                    // Among equally near samples we take the first.
                    if square < nearest.0 || (square == nearest.0 && sample < nearest.1) {
                        nearest = (square, sample);
                    }
                }
                found[(at[2] * BOXES + at[1]) * BOXES + at[0]] = nearest.1;
            }
        }
        found
    }
}

/// Two sums over the bits of all places (Fletcher 1982).
fn fingerprint_of(places: &[Vec3]) -> [u32; 2] {
    let words = places.iter().flat_map(|place| place.to_array()).map(f32::to_bits);
    words.fold([0, 1], |[sum, of_sums]: [u32; 2], word| {
        let sum = sum.wrapping_add(word).rotate_left(5);
        [sum, of_sums.wrapping_add(sum)]
    })
}

#[cfg(test)]
mod tests {
    use graphics::noise::random;
    use rand::RngExt;

    use super::*;

    #[test]
    fn the_sample_found_is_nearly_the_nearest() {
        let mut random = random(3, 0);
        let mut unit = || random.random::<f32>();
        let places: Vec<Vec3> =
            (0..3000).map(|_| Vec3::new(6.0 * unit(), 0.3 * unit(), 7.0 * unit())).collect();
        let lattice = SurfaceLattice::of(&places, 1.0).unwrap();
        let mut found = 0;
        let mut exact = 0;
        for _ in 0..4000 {
            let place = Vec3::new(8.0 * unit() - 1.0, 4.0 * unit() - 2.0, 9.0 * unit() - 1.0);
            let nearest = places.iter().copied();
            let nearest =
                nearest.min_by(|a, b| a.distance(place).total_cmp(&b.distance(place))).unwrap();
            let least = nearest.distance(place);
            let Some(sample) = lattice.nearest(place) else {
                assert!(least > 0.99, "{place} is {least} from a sample");
                continue;
            };
            assert!(sample.distance(place) <= least + 0.434, "{place}: {sample}, {nearest}");
            found += 1;
            exact += usize::from(sample == nearest);
        }
        assert!(found > 1000 && exact * 10 > found * 3, "{exact} of {found}");
    }

    #[test]
    fn a_lattice_too_fine_says_which_cell_would_fit() {
        let places = [Vec3::ZERO, Vec3::ONE];
        let error = SurfaceLattice::of(&places, 1e-4).unwrap_err();
        let MotionError::TooFine { fitting_cell, .. } = error else { panic!("{error}") };
        assert!(SurfaceLattice::of(&places, fitting_cell).is_ok(), "{error}");
        assert!(SurfaceLattice::of(&places, 0.0).is_err());
        let error = SurfaceLattice::of(&[Vec3::NAN], 1.0).unwrap_err();
        assert_eq!(error, MotionError::Place(0));
        assert_eq!(SurfaceLattice::of(&[], 1.0).unwrap().nearest(Vec3::ZERO), None);
    }
}
