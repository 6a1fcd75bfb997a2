//! Places of patches on a map that tiles.

/// Patches of one size in equal distances on a torus, overlapping by a third or more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct PatchGrid {
    /// Width and height of the map in texels.
    pub(crate) size: usize,
    /// Width and height of a patch in texels.
    pub(crate) patch: usize,
    /// Number of patches in a row and in a column, at least 3.
    pub(crate) count: usize,
}

impl PatchGrid {
    pub(crate) fn new(size: usize, patch: usize) -> Self {
        let step = patch - patch.div_ceil(3);
        Self { size, patch, count: size.div_ceil(step).max(3) }
    }

    /// First texel of the patches of a row or column.
    pub(crate) fn origin(&self, index: usize) -> usize {
        index * self.size / self.count
    }

    /// Number of texels that a patch shares with the one before it and, for the last one, with the
    /// first one behind the border.
    pub(crate) fn overlaps(&self, index: usize) -> [usize; 2] {
        let end = |index: usize| self.origin(index) + self.patch;
        let before = if index > 0 { end(index - 1).saturating_sub(self.origin(index)) } else { 0 };
        let last = index + 1 == self.count;
        let after = if last { end(index).saturating_sub(self.size) } else { 0 };
        [before, after]
    }

    /// All patches in rows from the top: column and row.
    pub(crate) fn cells(&self) -> impl Iterator<Item = [usize; 2]> + use<> {
        let count = self.count;
        (0..count * count).map(move |index| [index % count, index / count])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_cover_the_map_and_overlap_on_every_side() {
        for (size, patch) in [(64, 16), (256, 20), (32, 8), (100, 33)] {
            let grid = PatchGrid::new(size, patch);
            let mut covered = vec![0; size];
            for index in 0..grid.count {
                (0..patch).for_each(|i| covered[(grid.origin(index) + i) % size] += 1);
            }
            assert!(covered.iter().all(|&count| count >= 1), "{size} {patch}: {covered:?}");
            assert!(grid.overlaps(0)[0] == 0 && grid.overlaps(grid.count - 1)[1] >= patch / 3);
            let shared = (1..grid.count).map(|index| grid.overlaps(index)[0]).min();
            assert!(shared >= Some(patch / 3), "{size} {patch}: {shared:?}");
        }
    }
}
