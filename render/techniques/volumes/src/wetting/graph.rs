//! Which cells are joined by surface. Paint can spill from one such cell to the other.

use rayon::prelude::*;

use super::lattice::Lattice;
use super::pieces::Pieces;

/// The cells joined to each cell by surface, in ascending order. This is a list of links over all
/// cells.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Graph {
    /// Index of the first link of each cell. The last entry is the number of links.
    pub starts: Vec<u32>,
    /// The cell at the other end of each link.
    pub others: Vec<u32>,
    /// Number of axes along which the two cells of each link differ. It is 1 across a face, 2
    /// across an edge, 3 across a corner.
    pub axes: Vec<u8>,
    /// Index of the same link seen from the other end.
    pub back: Vec<u32>,
}

impl Graph {
    /// The links between cells. `of_cells` has the piece of each cell, in ascending order.
    ///
    /// We join two pieces in cells with a common face, edge or corner if they share surface: a
    /// triangle enters both, or two triangles with a common edge enter one each, and this edge
    /// touches both cells. There must also be steps through joined pieces, across faces of the
    /// cells between them, that lead from one to the other. This last rule makes the links the
    /// same for any cut into triangles.
    pub(super) fn of(pieces: &Pieces, of_cells: &[u32]) -> Self {
        let surface = Surface { keys: &pieces.keys, pairs: &pieces.pairs };
        let onwards: Vec<_> = (0..of_cells.len())
            .into_par_iter()
            .flat_map_iter(|cell: usize| {
                let piece = of_cells[cell];
                let at = Lattice::coordinates_of(pieces.keys[piece as usize]);
                let joined = forward_steps().flat_map(|step| {
                    let key = Lattice::key(plus(at, step));
                    let first = pieces.keys.partition_point(|other| *other < key) as u32;
                    let last = pieces.keys.partition_point(|other| *other <= key) as u32;
                    let taken = of_cells.partition_point(|other| *other < first)
                        ..of_cells.partition_point(|other| *other < last);
                    let surface = &surface;
                    let joined =
                        taken.filter(move |&other| surface.leads(piece, of_cells[other], step));
                    joined.map(move |other| (cell as u32, other as u32, axes_of(step)))
                });
                joined.collect::<Vec<_>>()
            })
            .collect();
        Self::of_links(&onwards, of_cells.len())
    }

    fn of_links(onwards: &[(u32, u32, u8)], count: usize) -> Self {
        let mut links: Vec<(u32, u32, u8)> = onwards
            .iter()
            .flat_map(|&(from, to, axes): &(u32, u32, u8)| [(from, to, axes), (to, from, axes)])
            .collect();
        links.par_sort_unstable();
        let mut starts = vec![0; count + 1];
        links.iter().for_each(|&(from, ..)| starts[from as usize + 1] += 1);
        for cell in 0..count {
            starts[cell + 1] += starts[cell];
        }
        let others: Vec<u32> = links.iter().map(|&(_, to, _)| to).collect();
        let back = links.par_iter().map(|&(from, to, _)| {
            let range = starts[to as usize] as usize..starts[to as usize + 1] as usize;
            (range.start + others[range].partition_point(|&other| other < from)) as u32
        });
        let back = back.collect();
        Self { starts, axes: links.iter().map(|link| link.2).collect(), others, back }
    }

    /// Number of cells.
    #[must_use]
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Whether there is no cell.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Indices of the links of a cell.
    #[must_use]
    pub fn links(&self, cell: usize) -> std::ops::Range<usize> {
        self.starts[cell] as usize..self.starts[cell + 1] as usize
    }

    /// The graph with only those links that connect two cells for which `kept` is true.
    #[must_use]
    pub fn cut(&self, kept: impl Fn(usize) -> bool) -> Self {
        let from = (0..self.len()).filter(|&cell| kept(cell));
        let onwards = from.flat_map(|cell| self.links(cell).map(move |link| (cell, link)));
        let onwards = onwards.filter_map(|(cell, link)| {
            let other = self.others[link];
            let onwards = other as usize > cell && kept(other as usize);
            onwards.then_some((cell as u32, other, self.axes[link]))
        });
        Self::of_links(&onwards.collect::<Vec<_>>(), self.len())
    }
}

struct Surface<'a> {
    keys: &'a [u64],
    pairs: &'a [(u32, u32)],
}

impl Surface<'_> {
    fn beside(&self, piece: u32) -> impl Iterator<Item = u32> + '_ {
        let from = self.pairs.partition_point(|pair| pair.0 < piece);
        self.pairs[from..].iter().take_while(move |pair| pair.0 == piece).map(|pair| pair.1)
    }

    /// Whether `piece` is joined to the piece `to`, in the cell at `step` from its own. They share
    /// surface, or a path leads from one to the other: it makes `step` in single axes, in any
    /// order, through pieces that share surface.
    fn leads(&self, piece: u32, to: u32, step: [i32; 3]) -> bool {
        self.pairs.binary_search(&(piece, to)).is_ok() || self.walks(piece, to, step)
    }

    fn walks(&self, piece: u32, to: u32, step: [i32; 3]) -> bool {
        if step == [0; 3] {
            return piece == to;
        }
        let at = Lattice::coordinates_of(self.keys[piece as usize]);
        (0..3).filter(|&axis| step[axis] != 0).any(|axis| {
            let mut next = at;
            let mut rest = step;
            next[axis] += step[axis];
            rest[axis] = 0;
            let key = Lattice::key(next);
            let mut beside = self.beside(piece).filter(|other| self.keys[*other as usize] == key);
            beside.any(|other| self.walks(other, to, rest))
        })
    }
}

fn plus(at: [i32; 3], step: [i32; 3]) -> [i32; 3] {
    [0, 1, 2].map(|axis| at[axis] + step[axis])
}

fn axes_of(step: [i32; 3]) -> u8 {
    step.iter().map(|value| value.unsigned_abs() as u8).sum()
}

/// Directions to 13 of the 26 cells around a cell: of two opposite directions, one.
fn forward_steps() -> impl Iterator<Item = [i32; 3]> {
    (14..27).map(|i| [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1])
}
