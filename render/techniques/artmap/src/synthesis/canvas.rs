//! A map while it is synthesised. For every texel it holds the place in the sample that the texel
//! shows.
//!
//! We join overlapping patches along the cheapest cut, which dynamic programming finds (Efros and
//! Freeman 2001). Then we synthesise texels at the seams again, after Lee and Yan (2005) as far as
//! Yan and others (2008, section 4.3) describe it: worst texels first, each once. We count how
//! often each part of the sample is used, so that none repeats too often.

use graphics::field::Field;

use super::level::{LOOKS, Level, PatchGrid, difference};

const NONE: [u16; 2] = [u16::MAX; 2];

/// Sources of a map that tiles, made of patches.
#[derive(Debug)]
pub(crate) struct SourceCanvas<'a> {
    level: &'a Level,
    pub(crate) grid: PatchGrid,
    pub(crate) sources: Field<[u16; 2]>,
}

/// The texels that are already there. A new patch has to agree with these.
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

    /// Weighted mean of the squared differences between what is there and the patch that starts at
    /// `place` of the sample.
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
        fn source(column: usize, row: usize, place: [u16; 2]) -> [u16; 2] {
            [place[0] + column as u16, place[1] + row as u16]
        }
        let mut takes = vec![true; patch * patch];
        // `at(along, across)` is a texel of the strip. `across` counts from the patch's border.
        let mut cut = |width: usize, at: &dyn Fn(usize, usize) -> (usize, usize)| {
            if width == 0 {
                return;
            }
            let errors: Vec<f32> = (0..patch * width)
                .map(|index| at(index / width, index % width))
                .map(|(column, row)| {
                    let there = self.sources[self.texel(cell, column, row)];
                    if there == NONE {
                        return 0.0;
                    }
                    let new = as_texel(source(column, row, place));
                    difference(&self.level.look[new], &self.level.look[as_texel(there)])
                })
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
                self.sources[texel] = source(column, row, place);
            }
        }
    }

    pub(crate) fn middle(&self, cell: [usize; 2]) -> (usize, usize) {
        self.texel(cell, self.grid.patch / 2, self.grid.patch / 2)
    }
}

#[inline]
pub(crate) fn as_texel([x, y]: [u16; 2]) -> (usize, usize) {
    (usize::from(x), usize::from(y))
}

/// Column of the cut in every row of a strip with `width` errors a row. Columns of neighbouring
/// rows differ by one at most. The sum of errors along the cut is the least possible. Among equal
/// ones, this takes the leftmost.
pub(crate) fn cheapest_cut(errors: &[f32], width: usize) -> Vec<usize> {
    let rows = errors.len() / width;
    let mut sums = errors.to_vec();
    for row in 1..rows {
        for x in 0..width {
            let from = x.saturating_sub(1);
            let to = (x + 1).min(width - 1);
            let above = &sums[(row - 1) * width..][from..=to];
            let least = above.iter().copied().fold(f32::INFINITY, f32::min);
            sums[row * width + x] += least;
        }
    }
    let mut cut = vec![0; rows];
    for row in (0..rows).rev() {
        let (from, to) = if row + 1 == rows {
            (0, width - 1)
        } else {
            let below: usize = cut[row + 1];
            (below.saturating_sub(1), (below + 1).min(width - 1))
        };
        let sums = &sums[row * width..][..width];
        cut[row] = (from..=to).fold(from, |best, x| if sums[x] < sums[best] { x } else { best });
    }
    cut
}

/// We synthesise this many texels on either side of a seam anew.
const REACH: isize = 2;
/// Half the width of the neighbourhood that a texel has to fit.
const NEAR: isize = 3;

/// Synthesises the texels at seams anew. The candidates for a texel are the sources of the texels
/// around it, shifted (k-coherence, Tong and others 2002). We take the candidate that fits the
/// neighbourhood best.
pub(crate) fn mend(level: &Level, sources: &mut Field<[u16; 2]>) {
    let mut seams = seam_texels(level, sources);
    // Worst first, ties in the order of rows.
    seams.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let size = sources.width();
    for (_, index) in seams {
        let texel = (index % size, index / size);
        let mut candidates = Vec::new();
        for (i, j) in neighbourhood(NEAR) {
            let [x, y] = sources[shifted(texel, (i, j), size)].map(isize::try_from);
            let (Ok(x), Ok(y)) = (x, y) else { continue };
            let place = (x - i, y - j);
            if is_inside(level, place) && !candidates.contains(&place) {
                candidates.push(place);
            }
        }
        let mut best: Option<(f32, (isize, isize))> = None;
        for place in candidates {
            let found = misfit(level, sources, texel, place);
            if best.is_none_or(|(least, _)| found < least) {
                best = Some((found, place));
            }
        }
        if let Some((_, (x, y))) = best {
            sources[texel] = [x as u16, y as u16];
        }
    }
}

/// Mean squared difference between the neighbourhoods of a place in the sample and a texel of the
/// map.
fn misfit(
    level: &Level,
    sources: &Field<[u16; 2]>,
    texel: (usize, usize),
    place: (isize, isize),
) -> f32 {
    let mut sum = 0.0;
    let mut count = 0.0;
    for (i, j) in neighbourhood(NEAR) {
        let at = (place.0 + i, place.1 + j);
        if is_inside(level, at) {
            let there = as_texel(sources[shifted(texel, (i, j), sources.width())]);
            let here = (at.0 as usize, at.1 as usize);
            sum += difference(&level.look[here], &level.look[there]);
            count += 1.0;
        }
    }
    // We judge places at the border of the sample by fewer texels. Half of them must be there.
    if count < 25.0 { f32::INFINITY } else { sum / count }
}

/// Texels near a seam, each with the largest error of the seams around it.
fn seam_texels(level: &Level, sources: &Field<[u16; 2]>) -> Vec<(f32, usize)> {
    let size = sources.width();
    let mut worst = vec![-1.0_f32; size * size];
    for index in 0..size * size {
        let texel = (index % size, index / size);
        for step in [(1, 0), (0, 1)] {
            let next = shifted(texel, step, size);
            let [x, y] = sources[texel];
            let there = sources[next];
            let continued = [x.wrapping_add(step.0 as u16), y.wrapping_add(step.1 as u16)];
            if continued == there {
                continue;
            }
            let [x, y] = continued.map(|value| value as isize);
            let error = if is_inside(level, (x, y)) {
                difference(&level.look[as_texel(continued)], &level.look[as_texel(there)])
            } else {
                0.0
            };
            for (i, j) in neighbourhood(REACH - 1) {
                let (x, y) = shifted(texel, (i, j), size);
                worst[y * size + x] = worst[y * size + x].max(error);
                let (x, y) = shifted(next, (i, j), size);
                worst[y * size + x] = worst[y * size + x].max(error);
            }
        }
    }
    let near = worst.into_iter().enumerate().filter(|(_, error)| *error >= 0.0);
    near.map(|(index, error)| (error, index)).collect()
}

fn neighbourhood(reach: isize) -> impl Iterator<Item = (isize, isize)> {
    (-reach..=reach).flat_map(move |j| (-reach..=reach).map(move |i| (i, j)))
}

fn shifted((x, y): (usize, usize), (i, j): (isize, isize), size: usize) -> (usize, usize) {
    fn wrap(value: usize, by: isize, size: usize) -> usize {
        (value as isize + by).rem_euclid(size as isize) as usize
    }
    (wrap(x, i, size), wrap(y, j, size))
}

fn is_inside(level: &Level, (x, y): (isize, isize)) -> bool {
    let width = level.mask.width() as isize;
    let height = level.mask.height() as isize;
    x >= 0 && y >= 0 && x < width && y < height && level.mask[(x as usize, y as usize)]
}

#[derive(Debug)]
pub(crate) struct Usage {
    counts: Field<u32>,
    block: usize,
    patch: usize,
    /// Number of patches that each block of the sample would give if all blocks were used equally.
    fair: f32,
    uniformity: f32,
}

impl Usage {
    /// Counts the use of a sample from which you will lay `patches` patches of `patch` x `patch`
    /// texels.
    pub(crate) fn new(level: &Level, patch: usize, patches: usize, uniformity: f32) -> Self {
        let block = (patch / 2).max(1);
        let width = level.mask.width();
        let height = level.mask.height();
        let counts = Field::filled(width.div_ceil(block), height.div_ceil(block), 0);
        let inside = level.mask.values().iter().filter(|&&inside| inside).count().max(1);
        let fair = (patches * patch * patch) as f32 / inside as f32;
        Self { counts, block, patch, fair, uniformity }
    }

    /// Factor on the cost of a patch. It is 1 for an unused one and grows with its use.
    pub(crate) fn penalty(&self, place: [u16; 2]) -> f32 {
        let [x, y] = place.map(|first| (usize::from(first) + self.patch / 2) / self.block);
        1.0 + self.uniformity * self.counts[(x, y)] as f32 / self.fair.max(1.0)
    }

    pub(crate) fn note(&mut self, place: [u16; 2]) {
        let [columns, rows] = place.map(|first| {
            let first = usize::from(first);
            first / self.block..=(first + self.patch - 1) / self.block
        });
        for y in rows {
            for x in columns.clone() {
                self.counts[(x, y)] += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cut_follows_a_valley_and_is_the_cheapest_of_all() {
        let width = 4;
        let errors = [9., 1., 9., 9., 9., 9., 2., 9., 9., 9., 1., 9., 9., 0., 9., 9.];
        let cut = cheapest_cut(&errors, width);
        assert_eq!(cut, [1, 2, 2, 1]);
        fn cost(cut: &[usize], errors: [f32; 16], width: usize) -> f32 {
            cut.iter().enumerate().map(|(row, &x)| errors[row * width + x]).sum()
        }
        for index in 0..256_usize {
            let other: Vec<usize> = (0..4).map(|row| index >> (2 * row) & 3).collect();
            let steady = other.windows(2).all(|pair| pair[0].abs_diff(pair[1]) <= 1);
            assert!(
                !steady || cost(&other, errors, width) >= cost(&cut, errors, width),
                "{other:?}"
            );
        }
    }
}
