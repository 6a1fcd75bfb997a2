//! A map while it is synthesised: for every texel the texel of the sample that it shows.

use graphics::field::Field;

use super::cut::cheapest_cut;
use super::grid::PatchGrid;
use super::level::{LOOKS, Level, difference};

/// Source of a texel that is not synthesised yet.
const NONE: [u16; 2] = [u16::MAX; 2];

/// Sources of a map that tiles, made of patches.
#[derive(Debug)]
pub(crate) struct SourceCanvas<'a> {
    level: &'a Level,
    pub(crate) grid: PatchGrid,
    pub(crate) sources: Field<[u16; 2]>,
}

/// What a new patch has to agree with: the texels that are already there.
#[derive(Debug)]
pub(crate) struct Overlap {
    /// Column and row within the patch, colour and height, weight.
    texels: Vec<([u16; 2], [f32; LOOKS], f32)>,
    weights: f32,
}

impl<'a> SourceCanvas<'a> {
    pub(crate) fn new(level: &'a Level, grid: PatchGrid) -> Self {
        Self { level, grid, sources: Field::filled(grid.size, grid.size, NONE) }
    }

    /// Texel of the map that lies `column` and `row` texels into the patch of a cell.
    fn texel(&self, cell: [usize; 2], column: usize, row: usize) -> (usize, usize) {
        let PatchGrid { size, .. } = self.grid;
        let [x, y] = cell.map(|index| self.grid.origin(index));
        ((x + column) % size, (y + row) % size)
    }

    /// The texels of the patch of a cell that are already there.
    pub(crate) fn overlap(&self, cell: [usize; 2]) -> Overlap {
        let mut texels = Vec::new();
        for row in 0..self.grid.patch {
            for column in 0..self.grid.patch {
                let source = self.sources[self.texel(cell, column, row)];
                if source != NONE {
                    let source = as_texel(source);
                    let place = [column as u16, row as u16];
                    texels.push((place, self.level.look[source], self.level.weight[source]));
                }
            }
        }
        let weights = texels.iter().map(|(_, _, weight)| weight).sum();
        Overlap { texels, weights }
    }

    /// Weighted mean of the squared differences between the patch that starts at `place` of the
    /// sample and what is there.
    pub(crate) fn cost(&self, overlap: &Overlap, [x, y]: [u16; 2]) -> f32 {
        let mut sum = 0.0;
        for &([column, row], there, weight) in &overlap.texels {
            sum += weight * difference(&self.level.look[as_texel([x + column, y + row])], &there);
        }
        if overlap.weights > 0.0 { sum / overlap.weights } else { 0.0 }
    }

    /// Lays the patch that starts at `place` of the sample into a cell, cut along the cheapest
    /// seams.
    pub(crate) fn paste(&mut self, cell: [usize; 2], place: [u16; 2]) {
        let patch = self.grid.patch;
        let source = |column: usize, row: usize| [place[0] + column as u16, place[1] + row as u16];
        let error = |column: usize, row: usize| {
            let there = self.sources[self.texel(cell, column, row)];
            if there == NONE {
                return 0.0;
            }
            let new = as_texel(source(column, row));
            difference(&self.level.look[new], &self.level.look[as_texel(there)])
        };
        let mut takes = vec![true; patch * patch];
        // `at(along, across)`: a texel of the strip, `across` counted from the patch's border.
        let mut cut = |width: usize, at: &dyn Fn(usize, usize) -> (usize, usize)| {
            if width == 0 {
                return;
            }
            let errors: Vec<f32> = (0..patch * width)
                .map(|index| at(index / width, index % width))
                .map(|(column, row)| error(column, row))
                .collect();
            for (along, seam) in cheapest_cut(&errors, width).into_iter().enumerate() {
                for across in 0..seam {
                    let (column, row) = at(along, across);
                    takes[row * patch + column] = false;
                }
            }
        };
        let [left, right] = self.grid.overlaps(cell[0]);
        let [above, below] = self.grid.overlaps(cell[1]);
        cut(left, &|along, across| (across, along));
        cut(right, &|along, across| (patch - 1 - across, along));
        cut(above, &|along, across| (along, across));
        cut(below, &|along, across| (along, patch - 1 - across));
        for (index, takes) in takes.into_iter().enumerate() {
            let column = index % patch;
            let row = index / patch;
            let texel = self.texel(cell, column, row);
            if takes || self.sources[texel] == NONE {
                self.sources[texel] = source(column, row);
            }
        }
    }

    /// Source of the texel at the middle of a cell's patch.
    pub(crate) fn middle(&self, cell: [usize; 2]) -> (usize, usize) {
        self.texel(cell, self.grid.patch / 2, self.grid.patch / 2)
    }
}

/// A source as an index of a field.
#[inline]
pub(crate) fn as_texel([x, y]: [u16; 2]) -> (usize, usize) {
    (usize::from(x), usize::from(y))
}
